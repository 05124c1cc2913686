//! Marks and labels stay apart.

use super::*;
use crate::accel::Accelerator;
use crate::bench::kernel::Kernel;
use crate::bench::report::plot::quantity::QUANTITIES;
use proptest::prelude::*;

/// A point of every accelerator with every kernel, with these speeds and errors.
fn points(speeds: &[u16], errors: &[u8]) -> Vec<Point> {
    let pairs = Kernel::ALL.into_iter().flat_map(|kernel| {
        let accelerators = Accelerator::ALL.into_iter();
        let accelerators = accelerators.filter(move |one| kernel.suits(*one));
        accelerators.map(move |accelerator| (kernel, accelerator))
    });
    let point = |(place, (kernel, accelerator))| {
        let speed = 1.0 + f64::from(speeds[place]) / 100.0;
        let error = f64::from(errors[place]);
        Point {
            place,
            accelerator,
            kernel,
            speeds: [0.8 * speed, speed, 1.1 * speed],
            error,
            high: error,
        }
    };
    pairs.enumerate().map(point).collect()
}

/// The ends and the upper edge of each mark with its label, and of each heading.
fn rectangles(panel: &Panel) -> Vec<([f64; 2], f64)> {
    let of_block = |(block, shift): &(Block, f64)| {
        let top = block.shape.wanted + shift - LINE / 2.0;
        let spans = block.shape.spans.clone().into_iter();
        spans.map(move |span| (span.ends, top + f64::from(span.line) * LINE))
    };
    panel.blocks.iter().flat_map(of_block).collect()
}

proptest! {
    #[test]
    fn no_mark_or_label_hides_another_or_leaves_the_panel(
        speeds in prop::collection::vec(0u16..500, 27),
        errors in prop::collection::vec(prop_oneof![3 => 0u8..1, 2 => 0u8..40], 27),
    ) {
        let points = points(&speeds, &errors);
        let panel = Panel::new(&QUANTITIES[1], points.clone());
        let rectangles = rectangles(&panel);
        prop_assert!(rectangles.len() > points.len(), "marks and headings");
        for (index, (ends, top)) in rectangles.iter().enumerate() {
            let is_inside = ends[0] >= 0.0 && ends[1] <= WIDTH;
            prop_assert!(is_inside && *top >= TOP - 1e-6, "{ends:?} at {top}");
            prop_assert!(top + LINE <= panel.zero_area[1] + 1e-6, "{ends:?} at {top}");
            for (other, other_top) in &rectangles[..index] {
                let is_beside = ends[1] <= other[0] || other[1] <= ends[0];
                let is_apart = is_beside || (top - other_top).abs() >= LINE - 1e-6;
                prop_assert!(is_apart, "{ends:?} at {top}, {other:?} at {other_top}");
            }
        }
    }

    #[test]
    fn marks_that_move_lead_to_their_errors(error in 1u8..200) {
        let points = points(&[100; 27], &[error; 27]);
        let panel = Panel::new(&QUANTITIES[1], points);
        let svg = panel.draw().element([WIDTH, panel.height()], "");
        let is_stem = |line: &&str| line.contains("class=\"stem\"");
        // Of 27 marks with one error and one speed, at most one is in its place.
        prop_assert!(svg.lines().filter(is_stem).count() >= 26);
    }
}
