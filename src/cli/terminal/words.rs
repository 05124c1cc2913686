//! Words and lines: counts of things, and text in two columns.

use feimos::error::printable;
use std::fmt::{self, Formatter};

pub(crate) use feimos::error::counted;

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
