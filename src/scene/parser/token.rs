//! What scene text is made of: blanks and comments, words, quoted strings.

use std::borrow::Cow;

use nom::Parser;
use nom::bytes::complete::{take_till, take_while, take_while1};
use nom::character::complete::char;

use super::keyword;
use super::source::{Parsed, Source, wrong};
use super::statement::Text;
use crate::decimal;
use crate::error::Error;

/// Characters of the file that a message repeats at most.
const QUOTED_IN_MESSAGE: usize = 40;

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r' | 0x0b | 0x0c)
}

fn is_blank_or_comma(byte: u8) -> bool {
    is_blank(byte) || byte == b','
}

fn is_line_end(byte: u8) -> bool {
    byte == b'\n' || byte == b'\r'
}

/// Whether a word goes on with `byte`.
pub(super) fn is_word(byte: u8) -> bool {
    !is_blank_or_comma(byte) && !matches!(byte, b'"' | b'[' | b']' | b'#')
}

/// Skips blanks and comments, of which there may be none.
pub(super) fn blanks(input: &[u8]) -> Parsed<'_, ()> {
    gap(is_blank, input)
}

/// Skips what may stand between the values of an array, where a comma counts as a blank.
pub(super) fn separators(input: &[u8]) -> Parsed<'_, ()> {
    gap(is_blank_or_comma, input)
}

#[inline]
fn gap(is_gap: fn(u8) -> bool, input: &[u8]) -> Parsed<'_, ()> {
    let (mut rest, _) = take_while(is_gap)(input)?;
    while rest.first() == Some(&b'#') {
        (rest, _) = (take_till(is_line_end), take_while(is_gap)).parse(rest)?;
    }
    Ok((rest, ()))
}

/// A keyword, a number, a bare `true`: anything up to a blank, a quote, a bracket, a comma or a comment.
pub(super) fn word(input: &[u8]) -> Parsed<'_, &[u8]> {
    let (rest, word) = take_while1(is_word)(input)?;
    // What looks like a comment may be a number that is none: `1.#INF`.
    if rest.first() == Some(&b'#')
        && let Some(length) = decimal::leading_non_finite(input, is_word)
    {
        return Ok((&input[length..], &input[..length]));
    }
    Ok((rest, word))
}

/// Skips a comma with the blanks before it, where there is one: behind a bare number it says nothing.
pub(super) fn commas(input: &[u8]) -> Parsed<'_, ()> {
    let mut rest = input;
    while let (Token::Comma, at) = Token::next(rest) {
        rest = &at[1..];
    }
    Ok((rest, ()))
}

/// What stands at some place, for messages and for what depends on what comes next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Token<'a> {
    /// The end of the file.
    End,
    /// `[`
    Open,
    /// `]`
    Close,
    /// `,`
    Comma,
    /// A string, by what follows its first quote.
    Quoted(&'a [u8]),
    /// A word that is a number.
    Number(&'a [u8]),
    /// A word that is the name of a directive.
    Keyword(&'static str),
    /// Another word.
    Word(&'a [u8]),
}

impl<'a> Token<'a> {
    /// The token that `input` begins with, after blanks and comments.
    pub(super) fn next(input: &'a [u8]) -> (Token<'a>, &'a [u8]) {
        let rest = blanks(input).map_or(input, |(rest, ())| rest);
        let token = match rest.first() {
            None => Token::End,
            Some(b'[') => Token::Open,
            Some(b']') => Token::Close,
            Some(b',') => Token::Comma,
            Some(b'"') => Token::Quoted(&rest[1..]),
            Some(_) => Token::of_word(word(rest).map_or(rest, |(_, word)| word)),
        };
        (token, rest)
    }

    fn of_word(word: &'a [u8]) -> Token<'a> {
        match keyword::known(word) {
            Some(keyword) => Token::Keyword(keyword),
            None if decimal::parse(word).is_some() => Token::Number(word),
            None => Token::Word(word),
        }
    }

    /// The bytes of the token.
    pub(super) fn length(self) -> usize {
        match self {
            Token::End => 0,
            Token::Open | Token::Close | Token::Comma => 1,
            Token::Quoted(inside) => 1 + closing_quote(inside).map_or(0, |length| length + 1),
            Token::Keyword(keyword) => keyword.len(),
            Token::Number(word) | Token::Word(word) => word.len(),
        }
    }

    /// The token as a message calls it.
    pub(super) fn describe(self) -> String {
        match self {
            Token::End => String::from("the end of the file"),
            Token::Open => String::from("`[`"),
            Token::Close => String::from("`]`"),
            Token::Comma => String::from("`,`"),
            Token::Quoted(inside) => {
                let length = closing_quote(inside).unwrap_or(0);
                format!("the string \"{}\"", shorten(&inside[..length]))
            }
            Token::Keyword(keyword) => format!("`{keyword}`"),
            Token::Number(word) => format!("the number `{}`", shorten(word)),
            Token::Word(word) if is_text(word) => format!("`{}`", shorten(word)),
            Token::Word(_) => String::from("bytes that are not text"),
        }
    }
}

/// Whether a person can have typed `word`.
pub(super) fn is_text(word: &[u8]) -> bool {
    std::str::from_utf8(word).is_ok_and(|word| !word.chars().any(char::is_control))
}

/// `bytes` as a message repeats them.
pub(super) fn shorten(bytes: &[u8]) -> String {
    // A character has four bytes at most: the end of a long token need not be looked at.
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(4 * (QUOTED_IN_MESSAGE + 1))]);
    let mut shown: String = head.chars().take(QUOTED_IN_MESSAGE).collect();
    if head.chars().count() > QUOTED_IN_MESSAGE {
        shown.push_str("...");
    }
    shown
}

/// The length of a string's inside, without its quotes; `None` where the line ends first.
fn closing_quote(inside: &[u8]) -> Option<usize> {
    let mut at = 0;
    loop {
        match inside.get(at)? {
            b'"' => return Some(at),
            b'\n' | b'\r' => return None,
            b'\\' if matches!(inside.get(at + 1), Some(b'"' | b'\\')) => at += 2,
            _ => at += 1,
        }
    }
}

impl<'a> Source<'a> {
    /// The quoted string that `input` begins with.
    pub(super) fn text(&self, input: &'a [u8]) -> Parsed<'a, Text<'a>> {
        let (inside, _) = char('"')(input)?;
        let Some(length) = closing_quote(inside) else {
            return wrong(self.unclosed_string(input));
        };
        let rest = &inside[length + 1..];
        let bytes = self.unescape(&inside[..length], inside)?;
        Ok((rest, Text::new(bytes, self.span(input, rest))))
    }

    /// The bytes that `raw` stands for, which is where `start` begins.
    fn unescape(&self, raw: &'a [u8], start: &[u8]) -> Result<Cow<'a, [u8]>, Error> {
        if !raw.contains(&b'\\') {
            return Ok(Cow::Borrowed(raw));
        }
        let mut bytes = Vec::new();
        let mut rest = raw;
        while let Some((&byte, after)) = rest.split_first() {
            rest = after;
            if byte != b'\\' {
                bytes.push(byte);
                continue;
            }
            let escaped = after.first().and_then(|letter| unescaped(*letter));
            let Some(escaped) = escaped else {
                return Err(self.unknown_escape(after, &start[raw.len() - after.len() - 1..]));
            };
            bytes.push(escaped);
            rest = &after[1..];
        }
        Ok(Cow::Owned(bytes))
    }

    fn unknown_escape(&self, after: &[u8], backslash: &[u8]) -> Error {
        let letter = String::from_utf8_lossy(&after[..after.len().min(4)]);
        let letter: String = letter.chars().take(1).collect();
        self.error(
            self.first(backslash, 1 + letter.len()),
            format!("unknown escape `\\{letter}` in a string"),
        )
        .note("write `\\\\` for a backslash; paths take `/` on every system")
    }
}

/// The byte that `\letter` stands for.
fn unescaped(letter: u8) -> Option<u8> {
    Some(match letter {
        b'b' => 0x08,
        b'f' => 0x0c,
        b'n' => b'\n',
        b'r' => b'\r',
        b't' => b'\t',
        b'\\' | b'\'' | b'"' => letter,
        _ => return None,
    })
}
