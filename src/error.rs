//! What went wrong, where, and what to do about it.
//!
//! [`Diagnostic`] is the message with its place; [`Error`] adds the kind that decides the exit code, so
//! that *your file is wrong*, *we do not do that* and *the disk* can be told apart by a script.

use crate::terminal_text;
use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// The result of everything that can fail.
pub type Result<T> = std::result::Result<T, Error>;

/// What kind of failure this is; each has an exit code of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ErrorKind {
    /// The command line asks for something impossible (2).
    Usage,
    /// A scene or mesh file is wrong (65, `EX_DATAERR`).
    BadInput,
    /// A scene or mesh file is not there (66, `EX_NOINPUT`).
    MissingInput,
    /// A bug in feimos (70, `EX_SOFTWARE`).
    Internal,
    /// The output cannot be created, or exists and may not be overwritten (73, `EX_CANTCREAT`).
    Output,
    /// Reading or writing failed on the way (74, `EX_IOERR`).
    Io,
    /// Something failed for a reason that may pass: no space, no memory, a stale handle (75, `EX_TEMPFAIL`).
    TryAgain,
}

impl ErrorKind {
    /// The exit code of the process, from `sysexits.h`.
    pub fn exit_code(self) -> u8 {
        match self {
            ErrorKind::Usage => 2,
            ErrorKind::BadInput => 65,
            ErrorKind::MissingInput => 66,
            ErrorKind::Internal => 70,
            ErrorKind::Output => 73,
            ErrorKind::Io => 74,
            ErrorKind::TryAgain => 75,
        }
    }

    /// The kind of an I/O error met while reading an input or writing an output.
    fn of_io(error: &std::io::Error, otherwise: ErrorKind) -> ErrorKind {
        use std::io::ErrorKind as Io;
        match error.kind() {
            Io::StorageFull | Io::QuotaExceeded | Io::StaleNetworkFileHandle | Io::OutOfMemory => {
                ErrorKind::TryAgain
            }
            _ => otherwise,
        }
    }
}

/// A message with its place and advice; an error or a warning, as the owner decides.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// What was found, in one line without a full stop.
    pub message: String,
    /// Where it was found.
    pub location: Option<SourceLocation>,
    /// What was expected and what to do, a line each.
    pub notes: Vec<String>,
}

impl Diagnostic {
    /// A message that has no place yet.
    pub fn new(message: impl Into<String>) -> Diagnostic {
        Diagnostic {
            message: message.into(),
            location: None,
            notes: Vec::new(),
        }
    }

    /// The same message at `location`.
    pub fn at(mut self, location: SourceLocation) -> Diagnostic {
        self.location = Some(location);
        self
    }

    /// The same message with one more line of advice.
    pub fn note(mut self, note: impl Into<String>) -> Diagnostic {
        self.notes.push(note.into());
        self
    }
}

impl fmt::Display for Diagnostic {
    /// `path:line:column: message`, then the line with a caret under what is meant, then the notes.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(location) = &self.location {
            write!(f, "{}: ", printable(&location.to_string()))?;
        }
        write!(f, "{}", printable(&self.message))?;
        if let Some(Position::Text { line, excerpt, .. }) =
            self.location.as_ref().map(|l| &l.position)
        {
            let number = line.to_string();
            let margin = " ".repeat(number.len());
            write!(
                f,
                "\n {margin} |\n {number} | {}\n {margin} | {}",
                excerpt.text,
                excerpt.carets()
            )?;
        }
        for note in &self.notes {
            write!(f, "\n   = {}", printable(note))?;
        }
        Ok(())
    }
}

/// A line of a message that quotes names from files: cut where it is too long to be read, and without anything that
/// would command the terminal.
pub fn printable(line: &str) -> String {
    const MAX: usize = 500;
    match line.char_indices().nth(MAX) {
        Some((end, _)) => terminal_text::line(&line[..end]) + "...",
        None => terminal_text::line(line),
    }
}

/// A place in an input file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourceLocation {
    /// The file as the user named it, or as it was reached from there.
    pub path: PathBuf,
    /// Where in the file.
    pub position: Position,
}

/// Where in a file: as exactly as the format allows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Position {
    /// The file as a whole.
    File,
    /// A line of a text file whose column says nothing, counted from 1.
    Line(u64),
    /// A byte of a binary file, counted from 0.
    Byte(u64),
    /// A span of a text file.
    Text {
        /// Counted from 1.
        line: u64,
        /// Counted from 1, in characters.
        column: u64,
        /// The line, with what is meant marked.
        excerpt: Excerpt,
    },
}

/// One source line, cut to what fits a terminal, and the part of it that is meant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Excerpt {
    /// The line, tabs as single blanks, without its end.
    pub text: String,
    /// The characters of `text` that the message is about.
    pub marked: Range<usize>,
}

impl Excerpt {
    /// Characters of a line that are shown at most.
    const WIDTH: usize = 100;

    /// Cuts a window out of `line` that shows the characters `marked`.
    fn new(line: &str, marked: Range<usize>) -> Excerpt {
        let length = line.chars().count();
        let first = if length <= Self::WIDTH {
            0
        } else {
            marked.start.saturating_sub(Self::WIDTH / 2)
        };
        let last = (first + Self::WIDTH).min(length);
        let mut text = String::new();
        let mut shift = 0;
        if first > 0 {
            text.push_str("...");
            shift = 3;
        }
        let shown = line.chars().skip(first).take(last - first);
        text.extend(shown.map(|c| if terminal_text::is_command(c) { ' ' } else { c }));
        if last < length {
            text.push_str("...");
        }
        let start = marked.start - first + shift;
        let end = (marked.end.min(last).max(marked.start) - first + shift).max(start + 1);
        Excerpt {
            text,
            marked: start..end,
        }
    }

    fn carets(&self) -> String {
        " ".repeat(self.marked.start) + &"^".repeat(self.marked.len())
    }
}

impl SourceLocation {
    /// The file as a whole.
    pub fn file(path: &Path) -> SourceLocation {
        SourceLocation {
            path: path.to_path_buf(),
            position: Position::File,
        }
    }

    /// A whole line, counted from 1.
    pub fn line(path: &Path, line: u64) -> SourceLocation {
        SourceLocation {
            path: path.to_path_buf(),
            position: Position::Line(line),
        }
    }

    /// A byte of a binary file, counted from 0.
    pub fn byte(path: &Path, offset: u64) -> SourceLocation {
        SourceLocation {
            path: path.to_path_buf(),
            position: Position::Byte(offset),
        }
    }

    /// The bytes `span` of the text `source`, which need not be UTF-8. A span that leaves its line is marked up
    /// to the line's end, one beyond the text at its end.
    pub fn text(path: &Path, source: &[u8], span: Range<usize>) -> SourceLocation {
        let start = span.start.min(source.len());
        let is_end = |byte: &u8| *byte == b'\n' || *byte == b'\r';
        let line_start = source[..start]
            .iter()
            .rposition(is_end)
            .map_or(0, |at| at + 1);
        let line_end = source[start..]
            .iter()
            .position(is_end)
            .map_or(source.len(), |at| start + at);
        let end = span.end.clamp(start, line_end.max(start));
        let characters = |bytes: &[u8]| String::from_utf8_lossy(bytes).chars().count();
        let column = characters(&source[line_start..start]);
        let marked = column..column + characters(&source[start..end]).max(1);
        let line = String::from_utf8_lossy(&source[line_start..line_end]);
        SourceLocation {
            path: path.to_path_buf(),
            position: Position::Text {
                line: 1 + count_line_ends(&source[..line_start]),
                column: column as u64 + 1,
                excerpt: Excerpt::new(&line, marked),
            },
        }
    }
}

/// Ends of line in `text`: LF, CR LF or a lone CR.
fn count_line_ends(text: &[u8]) -> u64 {
    let lone_cr = |pair: &[u8]| pair[0] == b'\r' && pair[1] != b'\n';
    let lf = text.iter().filter(|byte| **byte == b'\n').count();
    let cr = text.windows(2).filter(|pair| lone_cr(pair)).count()
        + usize::from(text.last() == Some(&b'\r'));
    (lf + cr) as u64
}

impl fmt::Display for SourceLocation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let path = self.path.display();
        match &self.position {
            Position::File => write!(f, "{path}"),
            Position::Line(line) => write!(f, "{path}:{line}"),
            Position::Byte(offset) => write!(f, "{path}: byte {offset}"),
            Position::Text { line, column, .. } => write!(f, "{path}:{line}:{column}"),
        }
    }
}

/// A failure: what kind it is, and the message to show.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Error(Box<(ErrorKind, Diagnostic)>);

impl Error {
    /// An error of `kind` with `diagnostic` to show.
    pub fn new(kind: ErrorKind, diagnostic: Diagnostic) -> Error {
        Error(Box::new((kind, diagnostic)))
    }

    /// The command line asks for something impossible.
    pub fn usage(message: impl Into<String>) -> Error {
        Error::new(ErrorKind::Usage, Diagnostic::new(message))
    }

    /// A scene or mesh is wrong.
    pub fn bad_input(diagnostic: Diagnostic) -> Error {
        Error::new(ErrorKind::BadInput, diagnostic)
    }

    /// `path` could not be read.
    pub fn reading(path: &Path, error: &std::io::Error) -> Error {
        use std::io::ErrorKind as Io;
        let missing = matches!(
            error.kind(),
            Io::NotFound | Io::IsADirectory | Io::NotADirectory | Io::InvalidFilename
        );
        let kind = if missing {
            ErrorKind::MissingInput
        } else {
            ErrorKind::of_io(error, ErrorKind::Io)
        };
        Error::new(
            kind,
            Diagnostic::new(format!("cannot read: {error}")).at(SourceLocation::file(path)),
        )
    }

    /// `path` could not be created (as opposed to written to).
    pub fn creating(path: &Path, error: &std::io::Error) -> Error {
        let kind = ErrorKind::of_io(error, ErrorKind::Output);
        Error::new(
            kind,
            Diagnostic::new(format!("cannot create: {error}")).at(SourceLocation::file(path)),
        )
    }

    /// `path` could not be written to the end; nothing is left under its name.
    pub fn writing(path: &Path, error: &std::io::Error) -> Error {
        let kind = ErrorKind::of_io(error, ErrorKind::Io);
        Error::new(
            kind,
            Diagnostic::new(format!("cannot write: {error}")).at(SourceLocation::file(path)),
        )
    }

    /// What kind of failure this is.
    pub fn kind(&self) -> ErrorKind {
        self.0.0
    }

    /// The message to show.
    pub fn diagnostic(&self) -> &Diagnostic {
        &self.0.1
    }

    /// The same error with one more line of advice.
    pub fn note(mut self, note: impl Into<String>) -> Error {
        self.0.1.notes.push(note.into());
        self
    }

    /// The same error at `location`, unless it already has a place: the innermost one helps most.
    pub fn or_at(mut self, location: impl FnOnce() -> SourceLocation) -> Error {
        self.0.1.location.get_or_insert_with(location);
        self
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.diagnostic().fmt(f)
    }
}

impl std::error::Error for Error {}

#[cfg(test)]
mod tests {
    use super::*;

    fn located(source: &[u8], span: Range<usize>) -> String {
        let location = SourceLocation::text(Path::new("a.pbrt"), source, span);
        Diagnostic::new("found `foo`")
            .at(location)
            .note("expected a number")
            .to_string()
    }

    #[test]
    fn marks_the_span_in_its_line() {
        let shown = located(b"Identity\n\tScale 1 foo 1\r\nWorldBegin", 18..21);
        let expected = "a.pbrt:2:10: found `foo`\n   |\n 2 |  Scale 1 foo 1\n   |          ^^^\n   = expected a number";
        assert_eq!(shown, expected);
    }

    #[test]
    fn names_from_files_neither_flood_nor_command_the_terminal() {
        let name = format!("\x1b[31m{}", "x".repeat(1_000_000));
        let shown = Diagnostic::new(name).note("a\nb").to_string();
        assert!(
            shown.starts_with("\u{fffd}[31mxxx") && shown.ends_with("...\n   = a\u{fffd}b"),
            "{shown}"
        );
        assert!(shown.len() < 600);
    }

    #[test]
    fn counts_every_kind_of_line_end_once() {
        assert_eq!(count_line_ends(b"a\r\nb\rc\nd\r"), 4);
        assert!(located(b"a\rb\rfoo", 4..7).starts_with("a.pbrt:3:1:"));
    }

    #[test]
    fn marks_one_character_at_the_end_of_the_text() {
        assert!(located(b"Scale 1", 7..7).contains("Scale 1\n   |        ^\n"));
        assert!(located(b"", 5..9).starts_with("a.pbrt:1:1:"));
    }

    #[test]
    fn cuts_long_lines_around_the_span() {
        let mut source = vec![b'1'; 1_000_000];
        source[500_000..500_003].copy_from_slice(b"foo");
        let shown = located(&source, 500_000..500_003);
        assert!(
            shown.len() < 400 && shown.contains("...") && shown.contains("foo"),
            "{shown}"
        );
        assert!(shown.starts_with("a.pbrt:1:500001:"));
    }

    #[test]
    fn counts_columns_in_characters_and_survives_other_encodings() {
        assert!(located("äö foo".as_bytes(), 5..8).starts_with("a.pbrt:1:4:"));
        assert!(located(b"\xff\xfe foo", 3..6).starts_with("a.pbrt:1:4:"));
    }
}
