//! Words and lines: counts of things, and text in two columns.

use crate::error::printable;
use std::fmt::{self, Formatter};

pub(crate) use crate::error::counted;

/// Width of the first column.
pub(crate) const INDENT: usize = 14;

/// Writes a line: `subject` in the first column, `text` in the second.
pub(crate) fn line(f: &mut Formatter<'_>, subject: &str, text: &str) -> fmt::Result {
    writeln!(
        f,
        "  {subject:<width$}{}",
        printable(text),
        width = INDENT - 2
    )
}

/// Writes several lines that share one `subject`.
pub(crate) fn lines(
    f: &mut Formatter<'_>,
    subject: &str,
    texts: impl IntoIterator<Item = String>,
) -> fmt::Result {
    let mut texts = texts.into_iter();
    texts
        .next()
        .map_or(Ok(()), |first| line(f, subject, &first))?;
    texts.try_for_each(|text| line(f, "", &text))
}

/// A point in six digits a coordinate.
pub(crate) fn triple(numbers: [f64; 3]) -> String {
    let [x, y, z] = numbers.map(short);
    format!("({x}, {y}, {z})")
}

/// A number in six digits.
pub(crate) fn short(number: f64) -> String {
    let rounded: f64 = format!("{number:.5e}").parse().unwrap_or(number);
    match rounded.abs() {
        0.0 => "0".to_owned(),
        size if (1e-4..1e9).contains(&size) => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_have_six_digits() {
        let cases = [
            (0.1 + 0.2, "0.3"),
            (-0.0, "0"),
            (1.0 / 3.0, "0.333333"),
            (123_456_789.0, "123457000"),
            (-1e300, "-1e300"),
            (1.5e-7, "1.5e-7"),
            (f64::INFINITY, "inf"),
        ];
        for (number, expected) in cases {
            assert_eq!(short(number), expected);
        }
    }
}
