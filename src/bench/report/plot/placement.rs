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

/// Places each shape as close to where it wants to be as those before it leave room, between the
/// upper and the lower of the `limits`; rather below than above. Returns how far each moves down;
/// `None` if there is no room.
pub(super) fn place(shapes: &[Shape], [top, bottom]: [f64; 2]) -> Option<Vec<f64>> {
    let mut placed: Vec<(&Shape, f64)> = Vec::new();
    for shape in shapes {
        let [first, last] = shape.extent();
        let [most_up, most_down] = [first - top, bottom - last].map(|room| room.ceil() as i64);
        let by_distance = (0..=most_up.max(most_down).max(0)).flat_map(|d| [d, -d]);
        let fits = |shift: &f64| {
            let is_inside = first + shift >= top && last + shift <= bottom;
            let mut others = placed.iter();
            is_inside && others.all(|(other, moved)| !collide(shape, *shift, other, *moved))
        };
        let shift = by_distance.map(|shift| shift as f64).find(fits)?;
        placed.push((shape, shift));
    }
    Some(placed.into_iter().map(|(_, shift)| shift).collect())
}

fn collide(a: &Shape, a_shift: f64, b: &Shape, b_shift: f64) -> bool {
    let middle =
        |shape: &Shape, shift: f64, span: &Span| shape.wanted + shift + f64::from(span.line) * LINE;
    a.spans.iter().any(|of_a| {
        let a_middle = middle(a, a_shift, of_a);
        let is_hit = |of_b: &Span| {
            let distance = (a_middle - middle(b, b_shift, of_b)).abs();
            distance < LINE && overlap(of_a.ends, of_b.ends)
        };
        b.spans.iter().any(is_hit)
    })
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
        assert_eq!(place(&crowded, [0.0, 100.0]), Some(vec![0.0, LINE]));
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
                    prop_assert!(apart || (top - other_top).abs() >= LINE);
                }
            }
        }
    }
}
