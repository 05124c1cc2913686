//! The ticks of a colour bar: round values, and the two ends.

use crate::film::ColorRange;

/// A value beside a colour bar.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tick {
    /// The position between the start (0) and the end (1) of the range.
    pub(super) position: f64,
    /// The value as text.
    pub(super) text: String,
}

/// The ends of `range`, which are rounded to a digit more, and round values between them, where
/// there is room: `most` texts fit beside the bar.
pub(super) fn ticks(range: ColorRange, most: usize) -> Vec<Tick> {
    let [start, end] = [range.start, range.end].map(f64::from);
    if start == end {
        let text = Digits::of(start.abs(), start.abs() / 100.0).text(start);
        let position = 0.0;
        return vec![Tick { position, text }];
    }
    let room = (end - start) / most.max(2) as f64;
    let step = round_step(room);
    let largest = start.abs().max(end.abs());
    let tick = |value: f64, digits: Digits| Tick {
        position: (value - start) / (end - start),
        text: digits.text(value),
    };
    // The step is not smaller than the room, which bounds their number.
    let multiples = (0..=most).map(|k| ((start / step).ceil() + k as f64) * step);
    let is_apart = |value: &f64| (value - start).min(end - value) >= 0.8 * room;
    let between = multiples.filter(is_apart);
    let between = between.map(|value| tick(value, Digits::of(largest, step)));
    let ends = [start, end].map(|value| tick(value, Digits::of(largest, step / 10.0)));
    let [start, end] = ends;
    [start].into_iter().chain(between).chain([end]).collect()
}

/// The smallest of 1, 2 and 5 times a power of ten that is not below `least`, but for rounding.
fn round_step(least: f64) -> f64 {
    let power = 10f64.powf(least.log10().floor());
    let steps = [1.0, 2.0, 5.0].map(|digit| digit * power);
    let mut fitting = steps.into_iter().filter(|step| *step >= least * 0.999);
    fitting.next().unwrap_or(10.0 * power)
}

/// How numbers are written.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Digits {
    /// So many digits behind the point.
    Behind(usize),
    /// So many digits behind the point, and a power of ten.
    Scientific(usize),
}

impl Digits {
    /// Enough to distinguish multiples of `step` up to `largest`.
    fn of(largest: f64, step: f64) -> Digits {
        let exponent = |value: f64| match value > 0.0 {
            // A step of 0.1 may be slightly below.
            true => (value.log10() + 1e-9).floor() as i32,
            false => 0,
        };
        let (high, low) = (exponent(largest), exponent(step));
        if (-4..7).contains(&high) && low > -7 {
            Digits::Behind(low.min(0).unsigned_abs() as usize)
        } else {
            Digits::Scientific((high - low).clamp(0, 8) as usize)
        }
    }

    fn text(self, value: f64) -> String {
        let text = match self {
            Digits::Behind(digits) => format!("{value:.digits$}"),
            Digits::Scientific(digits) => format!("{value:.digits$e}"),
        };
        match text.parse() {
            // Neither -0 nor 0.00.
            Ok(0.0) => "0".to_owned(),
            _ => text,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(start: f32, end: f32, most: usize) -> Vec<String> {
        let ticks = ticks(ColorRange { start, end }, most);
        let positions: Vec<f64> = ticks.iter().map(|tick| tick.position).collect();
        assert!(positions.is_sorted() && positions.iter().all(|p| (0.0..=1.0).contains(p)));
        ticks.into_iter().map(|tick| tick.text).collect()
    }

    #[test]
    fn round_values_are_between_the_ends() {
        assert_eq!(texts(2.308, 3.94, 8), ["2.31", "2.5", "3.0", "3.5", "3.94"],);
        assert_eq!(texts(0.0, 57.0, 6), ["0", "10", "20", "30", "40", "57"]);
        assert_eq!(texts(-1.0, 1.0, 4), ["-1.00", "-0.5", "0", "0.5", "1.00"]);
        assert_eq!(texts(4.0, 7.26, 2), ["4.0", "7.3"]);
    }

    #[test]
    fn large_small_and_single_values_have_texts() {
        assert_eq!(texts(0.0, 3e20, 3), ["0", "1e20", "2e20", "3.0e20"]);
        assert_eq!(texts(1e-9, 3e-9, 2), ["1.0e-9", "2e-9", "3.0e-9"]);
        assert_eq!(texts(2.0, 2.0, 8), ["2.00"]);
        assert_eq!(texts(0.0, 0.0, 8), ["0"]);
        let all = texts(f32::MIN, f32::MAX, 10);
        assert_eq!((all.first().unwrap().as_str(), all.len()), ("-3.4e38", 7));
        assert!(texts(1.0, 1.0 + f32::EPSILON, 10).len() > 2);
    }
}
