//! The text of a file from its start to its end, decompressed, in pieces.

use std::fs::{self, File};
use std::io::{self, BufReader, Cursor, Read, Seek};
use std::path::Path;
use std::sync::Arc;

use rayon::prelude::*;

use super::budget::Budget;
use super::gzip;
use super::inflated::Inflated;
use super::storage::read_at;
use super::{PIECE, has_threads, irregular, missing, read_stream, refuse_special};
use crate::error::{Error, Result};

/// The bytes that tell how a file is compressed.
const HEAD: usize = 2;

/// The text of a file that is read once.
pub(crate) struct TextStream {
    path: Arc<Path>,
    source: Source,
}

/// Where the text comes from.
enum Source {
    /// Memory; the text up to the number is read.
    Memory(Vec<u8>, usize),
    /// A regular file that is not compressed; likewise. The last number is its size.
    File(File, u64, u64),
    /// A pipe or standard input.
    Pipe(Box<dyn Read + Send>),
    /// Gzip data, and whether the file was read before.
    Inflated(Inflated, bool),
}

impl TextStream {
    /// The text `bytes` of a file called `path`.
    pub(crate) fn of_memory(path: &Path, bytes: Vec<u8>, budget: &Budget) -> TextStream {
        budget.enter_bytes(bytes.len() as u64);
        TextStream {
            path: Arc::from(path),
            source: Source::Memory(bytes, 0),
        }
    }

    /// Opens the file that the user named, which may be a pipe; `-` is standard input.
    ///
    /// # Errors
    /// A file that is missing, unreadable, a folder, or a device, some of which never end.
    pub(crate) fn open_named(path: &Path, budget: &Budget) -> Result<TextStream> {
        if path == Path::new("-") {
            return TextStream::of_pipe(path, Box::new(io::stdin()), budget);
        }
        let is_known = budget.enter(path);
        let metadata = fs::metadata(path)
            .map_err(|error| missing::advise(path, Error::reading(path, &error)))?;
        irregular::refuse_named(path, metadata.file_type())?;
        if metadata.is_file() {
            return TextStream::of_file(path, is_known, budget);
        }
        let pipe = File::open(path).map_err(|error| Error::reading(path, &error))?;
        TextStream::of_pipe(path, Box::new(pipe), budget)
    }

    /// Opens a regular file that a scene includes.
    ///
    /// # Errors
    /// A file that is missing, unreadable or not regular, and one that `budget` has no room for.
    pub(crate) fn open_included(path: &Path, budget: &Budget) -> Result<TextStream> {
        budget.charge_file()?;
        refuse_special(path)?;
        let is_known = budget.enter(path);
        fs::metadata(path).map_err(|error| missing::advise(path, Error::reading(path, &error)))?;
        TextStream::of_file(path, is_known, budget)
    }

    fn of_file(path: &Path, is_known: bool, budget: &Budget) -> Result<TextStream> {
        let reading = |error: io::Error| Error::reading(path, &error);
        let mut file = File::open(path).map_err(reading)?;
        let mut head = Vec::new();
        (&file)
            .take(HEAD as u64)
            .read_to_end(&mut head)
            .map_err(reading)?;
        let size = file.metadata().map_err(reading)?.len();
        file.rewind().map_err(reading)?;
        let source = if gzip::recognises(&head) {
            let compressed = Box::new(BufReader::with_capacity(PIECE / 16, file));
            Source::Inflated(Inflated::new(compressed, size, budget), is_known)
        } else {
            budget.charge_text(size, is_known)?;
            match size {
                // The kernel's files claim to be empty.
                0 => Source::Pipe(Box::new(file)),
                _ => Source::File(file, 0, size),
            }
        };
        Ok(TextStream {
            path: Arc::from(path),
            source,
        })
    }

    fn of_pipe(path: &Path, mut pipe: Box<dyn Read + Send>, budget: &Budget) -> Result<TextStream> {
        let mut head = Vec::new();
        let read = pipe.by_ref().take(HEAD as u64).read_to_end(&mut head);
        read.map_err(|error| Error::reading(path, &error))?;
        let is_compressed = gzip::recognises(&head);
        let mut pipe: Box<dyn Read + Send> = Box::new(Cursor::new(head).chain(pipe));
        let source = if is_compressed {
            // The limit of the content depends on the size.
            let bytes = read_stream(path, &mut pipe)?;
            budget.enter_bytes(bytes.len() as u64);
            let size = bytes.len() as u64;
            Source::Inflated(
                Inflated::new(Box::new(Cursor::new(bytes)), size, budget),
                false,
            )
        } else {
            Source::Pipe(pipe)
        };
        Ok(TextStream {
            path: Arc::from(path),
            source,
        })
    }

    /// The text that `reader` gives, as if from a pipe.
    #[cfg(test)]
    pub(crate) fn of_reader(path: &Path, reader: Box<dyn Read + Send>) -> TextStream {
        TextStream {
            path: Arc::from(path),
            source: Source::Pipe(reader),
        }
    }

    /// The file, as the user or a scene named it.
    pub(crate) fn path(&self) -> &Arc<Path> {
        &self.path
    }

    /// Adds `count` bytes to `text`, fewer only at the end. Returns whether there may be more.
    ///
    /// # Errors
    /// A read error, damaged data, and more text than `budget` allows.
    pub(crate) fn read(
        &mut self,
        text: &mut Vec<u8>,
        count: usize,
        budget: &Budget,
    ) -> Result<bool> {
        let before = text.len();
        let reading = |error: io::Error| Error::reading(&self.path, &error);
        match &mut self.source {
            Source::Memory(bytes, at) => {
                let end = bytes.len().min(*at + count);
                text.extend_from_slice(&bytes[*at..end]);
                *at = end;
            }
            Source::File(file, at, size) => {
                let left = usize::try_from(size.saturating_sub(*at)).unwrap_or(usize::MAX);
                read_file(file, *at, text, count, left).map_err(reading)?;
                *at += (text.len() - before) as u64;
            }
            Source::Pipe(pipe) => {
                pipe.take(count as u64).read_to_end(text).map_err(reading)?;
                budget.enter_bytes((text.len() - before) as u64);
            }
            Source::Inflated(content, is_known) => {
                content.read(&self.path, text, count, budget)?;
                budget.charge_text((text.len() - before) as u64, *is_known)?;
            }
        }
        Ok(text.len() - before == count)
    }

    /// Reads the rest of compressed data and drops it.
    ///
    /// # Errors
    /// Damaged data, and more than `budget` allows.
    pub(crate) fn check_rest(&mut self, budget: &Budget) -> Result<()> {
        if matches!(self.source, Source::Inflated(..)) {
            self.drop_rest(budget)?;
        }
        Ok(())
    }

    /// Reads the rest of anything but a file that is not compressed, and drops it: a program that
    /// writes into a pipe is not interrupted.
    ///
    /// # Errors
    /// A read error, damaged data, and more than `budget` allows.
    pub(crate) fn finish(&mut self, budget: &Budget) -> Result<()> {
        match self.source {
            Source::Memory(..) | Source::File(..) => Ok(()),
            Source::Pipe(_) | Source::Inflated(..) => self.drop_rest(budget),
        }
    }

    fn drop_rest(&mut self, budget: &Budget) -> Result<()> {
        let mut text = Vec::new();
        while self.read(&mut text, PIECE, budget)? {
            text.clear();
        }
        Ok(())
    }
}

/// Makes room for `count` bytes more, of which `left` may follow. A long text gets addresses for
/// three times its length, which cost no memory before they are used: moving it often would.
fn reserve(text: &mut Vec<u8>, count: usize, left: usize) -> io::Result<()> {
    let needed = count.min(left);
    if text.capacity() - text.len() >= needed {
        return Ok(());
    }
    let many = text.len().saturating_mul(3).clamp(needed, left);
    let reserved = text.try_reserve_exact(many);
    Ok(reserved.or_else(|_| text.try_reserve_exact(needed))?)
}

/// Adds `count` bytes from byte `at` of `file` on to `text`, fewer only at the end, before which
/// `left` bytes should be. If they are many, the threads share copies and page faults.
fn read_file(
    mut file: &File,
    at: u64,
    text: &mut Vec<u8>,
    count: usize,
    left: usize,
) -> io::Result<()> {
    reserve(text, count, left)?;
    let expected = count.min(left);
    if expected > PIECE && has_threads() {
        let start = text.len();
        text.resize(start + expected, 0);
        let pieces = text[start..].par_chunks_mut(PIECE).enumerate();
        let read = pieces.map(|(number, piece)| read_at(file, piece, at + (number * PIECE) as u64));
        if read.collect::<io::Result<()>>().is_ok() {
            return Ok(());
        }
        // The file has shrunk meanwhile.
        text.truncate(start);
    }
    file.seek(io::SeekFrom::Start(at))?;
    file.take(count as u64).read_to_end(text).map(|_| ())
}

#[cfg(test)]
mod tests;
