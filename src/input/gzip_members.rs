//! Reads the members of a gzip file, and the zeros that may pad it.

use std::io::{self, BufRead, Read};

use flate2::bufread::GzDecoder;

/// The first bytes of each member.
pub(super) const MAGIC: &[u8] = b"\x1f\x8b";

/// The content of all members, one after the other.
///
/// Tapes and some copying programs pad a file with zeros to the size of their blocks. Like gzip,
/// this reader skips them silently, also between members. Anything else after a member is an error.
pub(super) struct Members<R> {
    state: State<R>,
}

enum State<R> {
    /// Inside a member.
    Member(Box<GzDecoder<R>>),
    /// After the last member, or after an error.
    Done,
}

impl<R: BufRead> Members<R> {
    /// The members at the start of `file`.
    pub(super) fn new(file: R) -> Members<R> {
        Members {
            state: State::Member(Box::new(GzDecoder::new(file))),
        }
    }

    /// Goes to the next member, if there is one.
    fn advance(&mut self) -> io::Result<()> {
        let State::Member(member) = std::mem::replace(&mut self.state, State::Done) else {
            return Ok(());
        };
        let mut file = member.into_inner();
        match skip_zeros(&mut file)? {
            None => Ok(()),
            // Only the first byte is certainly in the buffer; the decoder checks the others.
            Some(first) if first == MAGIC[0] => {
                self.state = State::Member(Box::new(GzDecoder::new(file)));
                Ok(())
            }
            Some(_) => Err(io::Error::new(
                io::ErrorKind::InvalidData,
                "something that is neither gzip data nor zeros follows the compressed data",
            )),
        }
    }
}

/// Skips zeros, and returns the byte after them.
fn skip_zeros(file: &mut impl BufRead) -> io::Result<Option<u8>> {
    loop {
        let buffer = file.fill_buf()?;
        if buffer.is_empty() {
            return Ok(None);
        }
        let zeros = buffer.iter().position(|byte| *byte != 0);
        let found = zeros.map(|at| buffer[at]);
        let length = zeros.unwrap_or(buffer.len());
        file.consume(length);
        if found.is_some() {
            return Ok(found);
        }
    }
}

impl<R: BufRead> Read for Members<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            let State::Member(member) = &mut self.state else {
                return Ok(0);
            };
            match member.read(buffer)? {
                0 if !buffer.is_empty() => self.advance()?,
                length => return Ok(length),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::{Compression, write::GzEncoder};
    use std::io::{BufReader, Write};

    fn member(text: &[u8]) -> Vec<u8> {
        let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(text).expect("memory");
        encoder.finish().expect("memory")
    }

    fn read(file: &[u8]) -> io::Result<Vec<u8>> {
        let mut contents = Vec::new();
        for size in [1, 2, 7, 1 << 16] {
            let mut content = Vec::new();
            Members::new(BufReader::with_capacity(size, file)).read_to_end(&mut content)?;
            contents.push(content);
        }
        assert!(
            contents.windows(2).all(|pair| pair[0] == pair[1]),
            "the size of the buffer has no influence"
        );
        Ok(contents.remove(0))
    }

    #[test]
    fn members_follow_each_other() {
        let file = [member(b"one "), member(b""), member(b"two")].concat();
        assert_eq!(read(&file).unwrap(), b"one two");
    }

    #[test]
    fn zeros_pad_the_file_and_its_members() {
        let zeros = |count: usize| vec![0; count];
        for count in [1, 2, 3, 511, 100_000] {
            assert_eq!(
                read(&[member(b"one"), zeros(count)].concat()).unwrap(),
                b"one",
                "{count}"
            );
            let tape = [member(b"one "), zeros(count), member(b"two"), zeros(count)].concat();
            assert_eq!(read(&tape).unwrap(), b"one two", "{count}");
        }
    }

    #[test]
    fn anything_else_after_a_member_is_an_error() {
        for rest in [
            &b"x"[..],
            b"\0\0x",
            b"\x1f",
            b"\x1f\x8c\x08",
            b"\0\x1f\x8b\x08",
            b"\n",
        ] {
            assert!(
                read(&[&member(b"one")[..], rest].concat()).is_err(),
                "{rest:?}"
            );
        }
        let whole = member(b"one and two");
        for end in 1..whole.len() {
            assert!(read(&whole[..end]).is_err(), "cut off at {end}");
        }
    }
}
