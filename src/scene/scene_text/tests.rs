//! The memory that pieces of a text take.

use super::*;
use crate::scene::parser::Step;
use std::io::{self, Read};

/// Gives `text` again and again, so many times.
struct Repeated(&'static [u8], usize, usize);

impl Read for Repeated {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let Repeated(text, times, at) = self;
        if *times == 0 {
            return Ok(0);
        }
        let length = buffer.len().min(text.len() - *at);
        buffer[..length].copy_from_slice(&text[*at..*at + length]);
        *at += length;
        if *at == text.len() {
            (*times, *at) = (*times - 1, 0);
        }
        Ok(length)
    }
}

/// The number of directives, and the most bytes of memory that the pieces take.
fn read(text: &'static [u8], times: usize, window: usize) -> (usize, usize) {
    let (budget, path) = (Budget::default(), Path::new("a.pbrt"));
    let stream = TextStream::of_reader(path, Box::new(Repeated(text, times, 0)));
    let mut text = SceneText::new(stream, window, None, &budget).expect("text");
    let (mut count, mut most) = (0, 0);
    loop {
        let piece = Arc::clone(text.piece());
        most = most.max(piece.capacity() + text.spare.capacity());
        let mut directives = text.directives(&piece);
        loop {
            match directives.step() {
                Step::Directive(_) => count += 1,
                Step::NeedsMore => break,
                Step::End => return (count, most),
                Step::Error(error) => panic!("{error}"),
            }
        }
        let position = directives.into_position();
        drop(piece);
        text.advance(position, &budget).expect("text");
    }
}

#[test]
fn memory_does_not_grow_with_the_text() {
    const WINDOW: usize = 1 << 13;
    for (text, directives) in [
        (
            &b"Translate 1 2 3\nShape \"sphere\" \"float radius\" [0.125]\n"[..],
            2,
        ),
        (b"Identity Rotate 1 2 3 4 ", 2),
        (b"# A comment\r\n", 0),
        (b"\t\r\n", 0),
        (b" ", 0),
        (b"Texture \"a\" \"b\" \"c\" # A comment\n", 1),
    ] {
        let times = (300 * WINDOW).div_ceil(text.len());
        let (count, most) = read(text, times, WINDOW);
        assert_eq!(count, directives * times);
        assert!(most <= 8 * WINDOW, "{most}");
    }
}

#[test]
fn a_long_directive_takes_memory_in_proportion() {
    const WINDOW: usize = 1 << 10;
    let long = format!("Shape \"a\" \"float b\" [{}]\n", "1.5 ".repeat(100_000));
    let text: &'static [u8] = Box::leak(long.into_bytes().into_boxed_slice());
    let (count, most) = read(text, 10, WINDOW);
    assert_eq!(count, 10);
    assert!(most <= 5 * text.len(), "{most}");
}
