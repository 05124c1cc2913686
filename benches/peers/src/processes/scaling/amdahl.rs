//! Amdahl's law (1967): a part of the work is serial, and threads share the rest.

/// The part of the work that must be serial, if one thread takes the time `one` and two take
/// `two`. It is negative if two threads are more than twice as fast as one.
pub(super) fn serial_part(one: f64, two: f64) -> f64 {
    2.0 * two / one - 1.0
}

/// The time of so many threads if one takes the time `one`.
pub(super) fn predicted(one: f64, serial_part: f64, threads: f64) -> f64 {
    let serial = serial_part.max(0.0);
    one * (serial + (1.0 - serial) / threads)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_threads_tell_what_more_can_gain() {
        assert_eq!(serial_part(10.0, 5.0), 0.0);
        assert_eq!(serial_part(10.0, 10.0), 1.0);
        for (one, two) in [(10.0, 5.0), (10.0, 7.0), (8.0, 8.0)] {
            let serial = serial_part(one, two);
            assert!((predicted(one, serial, 1.0) - one).abs() < 1e-12);
            assert!((predicted(one, serial, 2.0) - two).abs() < 1e-12);
        }
        assert!((predicted(10.0, serial_part(10.0, 7.0), 16.0) - 4.375).abs() < 1e-12);
        assert_eq!(predicted(16.0, serial_part(16.0, 7.0), 16.0), 1.0);
    }
}
