//! A file that goes to the disk while it is being written.

use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};

/// Bytes that go to the disk together.
const PIECE: u64 = 1 << 20;

/// A new file, written from its beginning. After each megabyte, the system is asked to begin to
/// write it to the disk, so that little is left for the sync at the end.
#[derive(Debug)]
pub struct WriteBehind {
    file: File,
    /// Where the next write goes.
    place: u64,
    /// The end of what the system was asked for.
    begun: u64,
}

impl WriteBehind {
    pub(super) fn new(file: File) -> WriteBehind {
        WriteBehind {
            file,
            place: 0,
            begun: 0,
        }
    }

    /// A file that need not reach the disk.
    pub(super) fn unsynced(file: File) -> WriteBehind {
        WriteBehind {
            begun: u64::MAX,
            ..WriteBehind::new(file)
        }
    }

    pub(super) fn into_file(self) -> File {
        self.file
    }
}

impl Write for WriteBehind {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.file.write(bytes)?;
        self.place += count as u64;
        // Whole pages: the last one is still growing.
        let end = self.place / PIECE * PIECE;
        if end > self.begun {
            begin(&self.file, self.begun, end - self.begun);
            self.begun = end;
        }
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for WriteBehind {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.place = self.file.seek(to)?;
        Ok(self.place)
    }
}

/// Asks the system to begin to write `length` bytes from `start`, without waiting.
///
/// Linux does so when a program no longer needs these pages. They stay in memory while they are
/// being written. An error changes nothing: the sync at the end writes everything.
#[cfg(target_os = "linux")]
fn begin(file: &File, start: u64, length: u64) {
    use rustix::fs::{Advice, fadvise};
    let _ = fadvise(
        file,
        start,
        std::num::NonZeroU64::new(length),
        Advice::DontNeed,
    );
}

#[cfg(not(target_os = "linux"))]
fn begin(_: &File, _: u64, _: u64) {}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    #[test]
    fn the_content_is_what_was_written_wherever() {
        let mut out = WriteBehind::new(tempfile::tempfile().unwrap());
        let bytes: Vec<u8> = (0..3 * PIECE + 77).map(|i| (i % 251) as u8).collect();
        let mut rest = &bytes[..];
        for length in [1, PIECE as usize - 1, 5, 2 * PIECE as usize]
            .into_iter()
            .cycle()
        {
            let (part, after) = rest.split_at(length.min(rest.len()));
            out.write_all(part).unwrap();
            rest = after;
            if rest.is_empty() {
                break;
            }
        }
        assert_eq!(out.begun, 3 * PIECE);
        out.seek(SeekFrom::Start(9)).unwrap();
        out.write_all(b"table").unwrap();
        assert_eq!((out.place, out.begun), (14, 3 * PIECE));
        out.flush().unwrap();
        out.rewind().unwrap();
        let mut found = Vec::new();
        out.into_file().read_to_end(&mut found).unwrap();
        assert!(found[..9] == bytes[..9] && found[14..] == bytes[14..]);
        assert_eq!(&found[9..14], b"table");
    }
}
