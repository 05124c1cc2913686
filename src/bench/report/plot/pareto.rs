//! The Pareto front of speed and error.

/// Marks the points, each a speed and an error, on the Pareto front: no other point is at least as
/// fast and as accurate, and better in one of the two.
pub(super) fn front(points: &[[f64; 2]]) -> Vec<bool> {
    let beats = |[speed, error]: [f64; 2], [other_speed, other_error]: [f64; 2]| {
        speed >= other_speed && error <= other_error && (speed > other_speed || error < other_error)
    };
    points
        .iter()
        .map(|point| !points.iter().any(|other| beats(*other, *point)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_front_has_the_fastest_of_the_most_accurate_and_faster_ones() {
        let points = [
            [1.0, 0.0],
            [3.0, 0.0],
            [5.0, 2.0],
            [4.0, 2.0],
            [4.0, 1.0],
            [3.0, 0.0],
        ];
        assert_eq!(front(&points), [false, true, true, false, true, true]);
    }

    proptest! {
        #[test]
        fn the_front_is_never_empty_and_rises(
            points in prop::collection::vec(prop::array::uniform2(0u8..6), 1..12),
        ) {
            let points: Vec<[f64; 2]> = points.iter().map(|point| point.map(f64::from)).collect();
            let front = front(&points);
            let best = points.iter().zip(&front).filter(|(_, is)| **is);
            let mut best: Vec<[f64; 2]> = best.map(|(point, _)| *point).collect();
            prop_assert!(!best.is_empty());
            best.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
            let rises = |[a, b]: [[f64; 2]; 2]| a == b || (a[0] < b[0] && a[1] < b[1]);
            prop_assert!(best.windows(2).all(|pair| rises([pair[0], pair[1]])));
        }
    }
}
