//! Reads the text of a scene file piece by piece, so that files may be larger than the memory.

use super::parser::{BYTES_TO_JUDGE_BY, Directives, WorldSearch, check_encoding, may_be_long};
use super::source_file::SourceFile;
use super::source_span::SourceSpan;
use crate::error::{Error, Result, SourceLocation, TextPosition, shown_from};
use crate::input::{Budget, TextStream};
use crate::memory;
use std::path::Path;
use std::sync::Arc;

/// The bytes of a piece. A longer directive gets a piece of its own.
pub(super) const WINDOW: usize = 1 << 20;

/// A piece without the end of its first directive is parsed all the same when it has so many
/// windows.
const PATIENCE: usize = 256;

/// The windows that are read at a time for a long directive: enough for all threads.
const PIECE_WINDOWS: usize = 4;

/// The bytes of a long directive that are read between two looks at the memory that is left.
const CHECKED_STEP: usize = 32 << 20;

/// The text of a scene file, of which one piece at a time is in memory.
pub(super) struct SceneText {
    stream: TextStream,
    /// What was read to check the encoding.
    head: Vec<u8>,
    piece: Arc<SourceFile>,
    /// Where the directives of the piece begin, and the keyword before them.
    start: (usize, Option<String>),
    /// Where the last directive of the piece seems to begin. It is probably incomplete.
    last_start: usize,
    window: usize,
    /// Memory for the next piece.
    spare: Vec<u8>,
    /// The name in the directive that includes the file.
    named_at: Option<SourceSpan>,
}

impl SceneText {
    /// The text of `stream`, in pieces of `window` bytes. `named_at` is where a scene names it.
    ///
    /// # Errors
    /// A file that is not text, and errors of reading.
    pub(super) fn new(
        stream: TextStream,
        window: usize,
        named_at: Option<SourceSpan>,
        budget: &Budget,
    ) -> Result<SceneText> {
        let empty = SourceFile::piece(stream.path(), 0, TextPosition::default(), Vec::new(), false);
        let mut text = SceneText {
            stream,
            head: Vec::new(),
            piece: Arc::new(empty),
            start: (0, None),
            last_start: usize::MAX,
            window,
            spare: Vec::new(),
            named_at,
        };
        let mut head = Vec::new();
        text.read(&mut head, BYTES_TO_JUDGE_BY, budget)?;
        let mark = check_encoding(text.stream.path(), &head);
        text.start.0 = mark.map_err(|error| text.damage(budget).unwrap_or(error))?;
        text.head = head;
        text.grow(budget)?;
        Ok(text)
    }

    /// The piece that is in memory.
    pub(super) fn piece(&self) -> &Arc<SourceFile> {
        &self.piece
    }

    /// The directives of the `piece` that is in memory.
    pub(super) fn directives<'a>(&mut self, piece: &'a SourceFile) -> Directives<'a> {
        Directives::of_piece(piece, self.start.0, self.start.1.take(), self.last_start)
    }

    /// Goes to the piece that begins with the directive at `start`, after the keyword `previous`.
    /// If the present piece does, it becomes longer.
    ///
    /// # Errors
    /// An error of reading, and a directive that does not fit into memory.
    pub(super) fn advance(
        &mut self,
        (start, previous): (usize, Option<String>),
        budget: &Budget,
    ) -> Result<()> {
        if start > self.start.0 {
            let old = &self.piece;
            let before = start - old.start();
            let from = shown_from(old.from(old.start()), before);
            let mut text = std::mem::take(&mut self.spare);
            text.clear();
            text.extend_from_slice(old.from(old.start() + from));
            let begin = old.position(old.start() + from);
            let piece =
                SourceFile::piece(old.shared_path(), old.start() + from, begin, text, false);
            let old = std::mem::replace(&mut self.piece, Arc::new(piece));
            // A block or a message may still need the text.
            self.spare = Arc::into_inner(old).map_or_else(Vec::new, SourceFile::into_text);
            if self.spare.capacity() > 4 * self.window {
                self.spare = Vec::new();
            }
        }
        self.start = (start, previous);
        self.grow(budget)
    }

    /// Adds text to the piece until it probably has the whole of its first directive.
    fn grow(&mut self, budget: &Budget) -> Result<()> {
        let (path, offset) = (Arc::clone(self.piece.shared_path()), self.piece.start());
        let begin = self.piece.position(offset);
        let empty = SourceFile::piece(&path, offset, begin, Vec::new(), false);
        let old = std::mem::replace(&mut self.piece, Arc::new(empty));
        let copy = |shared: Arc<SourceFile>| shared.from(offset).to_vec();
        let mut text = Arc::try_unwrap(old).map_or_else(copy, SourceFile::into_text);
        let first = self.start.0 - offset;
        // A piece that was too short was parsed in vain, which must not happen too often.
        let held = text.len().saturating_sub(first);
        let least = if held < self.window { 0 } else { 2 * held };
        let (mut known, mut next_look) = (text.len().max(first + 1), least);
        self.last_start = usize::MAX;
        let is_last = loop {
            let count = held.clamp(self.window, PIECE_WINDOWS * self.window);
            if !self.read(&mut text, count, budget)? {
                break true;
            }
            if let Some(last) = last_capital(&text, known) {
                self.last_start = offset + last;
            }
            known = text.len().max(first + 1);
            let held = text.len().saturating_sub(first);
            let mut is_worth_it = self.last_start != usize::MAX;
            if !is_worth_it && held >= next_look {
                next_look = 2 * held;
                let start = &text[first.min(text.len())..];
                is_worth_it = held >= PATIENCE * self.window || !may_be_long(start);
            }
            if held >= least && is_worth_it {
                break false;
            }
        };
        if is_last {
            self.last_start = usize::MAX;
        }
        self.piece = Arc::new(SourceFile::piece(&path, offset, begin, text, is_last));
        Ok(())
    }

    /// Adds `count` bytes to `text`, fewer only at the end. Returns whether there may be more.
    fn read(&mut self, text: &mut Vec<u8>, count: usize, budget: &Budget) -> Result<bool> {
        let too_large = || "this file is too large for this machine's memory".to_owned();
        let step = text.len() / CHECKED_STEP;
        let checked = match (text.len() + count) / CHECKED_STEP {
            next if next > step => memory::check(CHECKED_STEP as u64, too_large),
            _ => Ok(()),
        };
        let read = checked.and_then(|()| {
            let taken = count.min(self.head.len());
            text.extend(self.head.drain(..taken));
            match count - taken {
                0 => Ok(true),
                missing => self.stream.read(text, missing, budget),
            }
        });
        read.map_err(|error| self.located(error))
    }

    /// An error without a place is about the directive that includes the file, or the file.
    fn located(&self, error: Error) -> Error {
        error.or_at(|| match &self.named_at {
            Some(named_at) => named_at.location(),
            None => SourceLocation::file(self.stream.path()),
        })
    }

    /// Whether the rest of compressed data is damaged: then nothing in it is worth an error.
    pub(super) fn damage(&mut self, budget: &Budget) -> Option<Error> {
        let checked = self.stream.check_rest(budget);
        checked.map_err(|error| self.located(error)).err()
    }

    /// Ends the reading before the text does.
    ///
    /// # Errors
    /// Damaged data in the rest.
    pub(super) fn finish(&mut self, budget: &Budget) -> Result<()> {
        let finished = self.stream.finish(budget);
        finished.map_err(|error| self.located(error))
    }
}

/// Whether the scene file `path` has a `WorldBegin`, even if the rest of it is wrong.
///
/// # Errors
/// A file that cannot be read.
pub(super) fn has_world(path: &Path, window: usize) -> Result<bool> {
    let budget = Budget::default();
    let mut stream = TextStream::open_named(path, &budget)?;
    let mut text = Vec::new();
    loop {
        let count = window.max(text.len());
        let is_last = !stream.read(&mut text, count, &budget)?;
        match WorldSearch::of(&text, is_last) {
            WorldSearch::Found => return Ok(true),
            WorldSearch::NotWithin(_) if is_last => return Ok(false),
            WorldSearch::NotWithin(passed) => _ = text.drain(..passed),
        }
    }
}

/// The index, from `from` on, of the last capital letter between a blank and a small letter: a
/// directive may begin there, and no number.
fn last_capital(text: &[u8], from: usize) -> Option<usize> {
    const AT_ONCE: usize = 64;
    let mut end = text.len().saturating_sub(1);
    while end > from {
        let start = from.max(end.saturating_sub(AT_ONCE));
        let (before, after) = (&text[start - 1..end - 1], &text[start + 1..end + 1]);
        let bytes = || before.iter().zip(&text[start..end]).zip(after);
        let is_start = |((before, byte), after): ((&u8, &u8), &u8)| {
            (*before <= b' ') & byte.is_ascii_uppercase() & after.is_ascii_lowercase()
        };
        // Without an early exit, the compiler turns the loop into vector instructions.
        if bytes().fold(false, |found, bytes| found | is_start(bytes)) {
            return bytes().rposition(is_start).map(|index| start + index);
        }
        end = start;
    }
    None
}

#[cfg(test)]
mod tests;
