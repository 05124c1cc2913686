//! What a person reads about a thing: a line a subject, in two columns.

use feimos::error::printable;
use std::fmt::{self, Formatter};

/// Characters before the second column.
pub(super) const INDENT: usize = 14;

/// A line on `subject`.
pub(super) fn line(f: &mut Formatter<'_>, subject: &str, text: &str) -> fmt::Result {
    writeln!(
        f,
        "  {subject:<width$}{}",
        printable(text),
        width = INDENT - 2
    )
}
