//! Places marks and labels of plots so that none hides another.

/// The height of a line of marks and labels, in pixels.
pub(super) const LINE: f64 = 17.0;

/// The least distance between neighbours on a line, in pixels.
const GAP: f64 = 8.0;

/// A part of a line that marks and labels cover.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Span {
    /// Lines below the place that the shape wants; negative above it.
    pub(super) line: i32,
    /// The left and the right end, in pixels.
    pub(super) ends: [f64; 2],
}

/// Lines that move up and down together.
#[derive(Debug, Clone)]
pub(super) struct Shape {
    /// The middle of line 0 in the best place, in pixels.
    pub(super) wanted: f64,
    pub(super) spans: Vec<Span>,
}

impl Shape {
    /// The upper and the lower end, in pixels.
    pub(super) fn extent(&self) -> [f64; 2] {
        let lines = self.spans.iter().map(|span| span.line);
        let [first, last] = [lines.clone().min(), lines.max()].map(Option::unwrap_or_default);
        [
            self.wanted + (f64::from(first) - 0.5) * LINE,
            self.wanted + (f64::from(last) + 0.5) * LINE,
        ]
    }
}

/// Distributes intervals to as few lines as a first fit finds. Returns the line of each, from 0.
pub(super) fn lines(intervals: &[[f64; 2]]) -> Vec<i32> {
    let mut taken: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut line_of = |interval: &[f64; 2]| {
        let is_free = |line: &Vec<[f64; 2]>| line.iter().all(|other| !overlap(*interval, *other));
        let line = taken.iter().position(is_free).unwrap_or(taken.len());
        if line == taken.len() {
            taken.push(Vec::new());
        }
        taken[line].push(*interval);
        line as i32
    };
    intervals.iter().map(&mut line_of).collect()
}

/// Places shapes close to where they want to be, between the upper and the lower of the `limits`.
/// Of two that share a column, the later one is below. Returns how far each moves down; `None` if
/// there is no room.
pub(super) fn place(shapes: &[Shape], [top, bottom]: [f64; 2]) -> Option<Vec<f64>> {
    let wanted: Vec<f64> = shapes.iter().map(|shape| shape.wanted).collect();
    let (mut below, mut above) = (wanted.clone(), wanted.clone());
    push_down(shapes, &mut below);
    push_up(shapes, &mut above);
    // Both keep all distances, so the middle does, too.
    let middle = below
        .iter()
        .zip(&above)
        .map(|(below, above)| (below + above) / 2.0);
    let mut places: Vec<f64> = middle.collect();
    let limits = |shape: &Shape| {
        let [first, last] = shape.extent().map(|end| end - shape.wanted);
        [top - first, bottom - last]
    };
    for (place, shape) in places.iter_mut().zip(shapes) {
        *place = place.min(limits(shape)[1]);
    }
    push_up(shapes, &mut places);
    for (place, shape) in places.iter_mut().zip(shapes) {
        *place = place.max(limits(shape)[0]);
    }
    push_down(shapes, &mut places);
    let mut placed = places.iter().zip(shapes);
    let has_room = placed.all(|(place, shape)| *place <= limits(shape)[1] + 1e-6);
    has_room.then(|| {
        places
            .iter()
            .zip(wanted)
            .map(|(place, wanted)| place - wanted)
            .collect()
    })
}

/// Moves shapes down until none hides an earlier one.
fn push_down(shapes: &[Shape], places: &mut [f64]) {
    for later in 0..shapes.len() {
        for earlier in 0..later {
            if let Some(distance) = distance(&shapes[earlier], &shapes[later]) {
                places[later] = places[later].max(places[earlier] + distance);
            }
        }
    }
}

/// Moves shapes up until none hides a later one.
fn push_up(shapes: &[Shape], places: &mut [f64]) {
    for earlier in (0..shapes.len()).rev() {
        for later in earlier + 1..shapes.len() {
            if let Some(distance) = distance(&shapes[earlier], &shapes[later]) {
                places[earlier] = places[earlier].min(places[later] - distance);
            }
        }
    }
}

/// The least distance from line 0 of the upper shape down to that of the lower one; `None` if they
/// share no column.
fn distance(upper: &Shape, lower: &Shape) -> Option<f64> {
    let pairs = upper
        .spans
        .iter()
        .flat_map(|a| lower.spans.iter().map(move |b| (a, b)));
    let hiding = pairs.filter(|(a, b)| overlap(a.ends, b.ends));
    let lines = hiding.map(|(a, b)| a.line - b.line + 1).max()?;
    Some(f64::from(lines) * LINE)
}

fn overlap([left, right]: [f64; 2], [other_left, other_right]: [f64; 2]) -> bool {
    left < other_right + GAP && other_left < right + GAP
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A shape with one span on each line, from the top.
    fn shape(wanted: f64, ends: &[[f64; 2]]) -> Shape {
        let span = |(line, ends): (usize, &[f64; 2])| Span {
            line: line as i32 - 1,
            ends: *ends,
        };
        Shape {
            wanted,
            spans: ends.iter().enumerate().map(span).collect(),
        }
    }

    #[test]
    fn a_shape_with_room_stays_where_it_wants_to_be() {
        let shapes = [shape(50.0, &[[0.0, 30.0]]), shape(50.0, &[[40.0, 70.0]])];
        assert_eq!(place(&shapes, [0.0, 100.0]), Some(vec![0.0, 0.0]));
        let crowded = [shape(50.0, &[[0.0, 30.0]]), shape(50.0, &[[35.0, 70.0]])];
        assert_eq!(
            place(&crowded, [0.0, 100.0]),
            Some(vec![-LINE / 2.0, LINE / 2.0])
        );
        // The spans are one line above the places.
        let at_bottom = place(&crowded, [0.0, 40.0]);
        assert_eq!(at_bottom, Some(vec![-1.5 - LINE, -1.5]));
        assert_eq!(place(&crowded, [20.0, 45.0]), None);
    }

    #[test]
    fn only_colliding_intervals_get_lines_of_their_own() {
        let intervals = [[0.0, 30.0], [20.0, 50.0], [60.0, 90.0], [25.0, 95.0]];
        assert_eq!(lines(&intervals), [0, 1, 0, 2]);
    }

    proptest! {
        #[test]
        fn nothing_overlaps_and_nothing_leaves_the_limits(
            wanted in prop::collection::vec(0u16..300, 1..28),
            lefts in prop::collection::vec(0u16..400, 81),
            widths in prop::collection::vec(1u16..200, 81),
            lengths in prop::collection::vec(1usize..4, 28),
        ) {
            let ends = |index: usize| {
                let left = f64::from(lefts[index]);
                [left, left + f64::from(widths[index])]
            };
            let shape_of = |(index, wanted): (usize, &u16)| {
                let ends = (0..lengths[index]).map(|line| ends(3 * index + line));
                shape(f64::from(*wanted), &ends.collect::<Vec<_>>())
            };
            let shapes: Vec<Shape> = wanted.iter().enumerate().map(shape_of).collect();
            // High enough for all of them below each other, with gaps of any size.
            let limits = [-3000.0, 3000.0];
            let shifts = place(&shapes, limits).expect("there is room");
            let placed = shapes.iter().zip(&shifts);
            let places: Vec<f64> = placed.map(|(shape, shift)| shape.wanted + shift).collect();
            for (later, lower) in shapes.iter().enumerate() {
                for (earlier, upper) in shapes[..later].iter().enumerate() {
                    let least = distance(upper, lower).unwrap_or(f64::NEG_INFINITY);
                    prop_assert!(places[later] - places[earlier] >= least - 1e-6);
                }
            }
            let mut rectangles = Vec::new();
            for (shape, shift) in shapes.iter().zip(shifts) {
                for Span { line, ends } in &shape.spans {
                    let top = shape.wanted + shift + (f64::from(*line) - 0.5) * LINE;
                    prop_assert!(top >= limits[0] && top + LINE <= limits[1]);
                    rectangles.push((*ends, top));
                }
            }
            for (index, (ends, top)) in rectangles.iter().enumerate() {
                for (other, other_top) in &rectangles[..index] {
                    let apart = ends[1] <= other[0] || other[1] <= ends[0];
                    prop_assert!(apart || (top - other_top).abs() >= LINE - 1e-6);
                }
            }
        }
    }
}
