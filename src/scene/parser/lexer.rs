//! The tokens of scene text: blanks and comments, words, quoted strings.

use nom::Parser;
use nom::bytes::complete::{take_till, take_while, take_while1};

use super::directive;
use crate::decimal;
use crate::error::Error;

/// The result of a nom parser of the grammar.
pub(super) type Parsed<'a, T> = nom::IResult<&'a [u8], T, Fault>;

/// Why a parser of the grammar did not succeed.
#[derive(Debug)]
pub(super) enum Fault {
    /// The text is not of this form; it may be of another.
    Mismatch,
    /// The text is wrong.
    Wrong(Error),
}

impl<I> nom::error::ParseError<I> for Fault {
    fn from_error_kind(_: I, _: nom::error::ErrorKind) -> Fault {
        Fault::Mismatch
    }

    fn append(_: I, _: nom::error::ErrorKind, other: Fault) -> Fault {
        other
    }
}

/// No alternative can mend an error in the text.
impl From<Error> for nom::Err<Fault> {
    fn from(error: Error) -> nom::Err<Fault> {
        nom::Err::Failure(Fault::Wrong(error))
    }
}

/// Fails: the input is wrong.
pub(super) fn wrong<'a, T>(error: Error) -> Parsed<'a, T> {
    Err(error.into())
}

/// Fails: the input is of another form.
pub(super) fn mismatch<'a, T>() -> Parsed<'a, T> {
    Err(nom::Err::Error(Fault::Mismatch))
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r' | 0x0b | 0x0c)
}

fn is_blank_or_comma(byte: u8) -> bool {
    is_blank(byte) || byte == b','
}

/// Whether a word continues with `byte`.
pub(super) fn is_word(byte: u8) -> bool {
    !is_blank_or_comma(byte) && !matches!(byte, b'"' | b'[' | b']' | b'#')
}

/// Skips blanks and comments, if there are any.
pub(super) fn blanks(input: &[u8]) -> Parsed<'_, ()> {
    gap(is_blank, input)
}

/// Skips blanks, comments and commas: what may stand between the values of an array.
pub(super) fn separators(input: &[u8]) -> Parsed<'_, ()> {
    gap(is_blank_or_comma, input)
}

#[inline]
fn gap(is_gap: fn(u8) -> bool, input: &[u8]) -> Parsed<'_, ()> {
    let is_line_end = |byte| byte == b'\n' || byte == b'\r';
    let (mut rest, _) = take_while(is_gap)(input)?;
    while rest.first() == Some(&b'#') {
        (rest, _) = (take_till(is_line_end), take_while(is_gap)).parse(rest)?;
    }
    Ok((rest, ()))
}

/// A keyword, a number or a bare `true`: everything up to a blank, quote, bracket, comma or
/// comment.
pub(super) fn word(input: &[u8]) -> Parsed<'_, &[u8]> {
    let (rest, word) = take_while1(is_word)(input)?;
    // What looks like a comment may belong to a number that is not finite: `1.#INF`.
    if rest.first() == Some(&b'#')
        && let Some(length) = decimal::leading_non_finite(input, is_word)
    {
        return Ok((&input[length..], &input[..length]));
    }
    Ok((rest, word))
}

/// Skips commas with the blanks before them: they have no meaning behind a bare number.
pub(super) fn commas(input: &[u8]) -> Parsed<'_, ()> {
    let mut rest = input;
    while let (Token::Comma, at) = Token::next(rest) {
        rest = &at[1..];
    }
    Ok((rest, ()))
}

/// The next token, for messages and for decisions that depend on it.
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
    /// A string, by the bytes after its opening quote.
    Quoted(&'a [u8]),
    /// A word that is a number.
    Number(&'a [u8]),
    /// A word that names a directive.
    Keyword(&'static str),
    /// Another word.
    Word(&'a [u8]),
}

impl<'a> Token<'a> {
    /// The token after any blanks and comments, and the input from there on.
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
        match directive::number(word) {
            Some(number) => Token::Keyword(directive::KEYWORDS[number]),
            None if decimal::parse(word).is_some() => Token::Number(word),
            None => Token::Word(word),
        }
    }

    /// Its length in bytes.
    pub(super) fn length(self) -> usize {
        match self {
            Token::End => 0,
            Token::Open | Token::Close | Token::Comma => 1,
            Token::Quoted(inside) => 1 + closing_quote(inside).map_or(0, |length| length + 1),
            Token::Keyword(keyword) => keyword.len(),
            Token::Number(word) | Token::Word(word) => word.len(),
        }
    }

    /// Its name in messages.
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

/// Whether `word` consists of characters that can be typed.
pub(super) fn is_text(word: &[u8]) -> bool {
    std::str::from_utf8(word).is_ok_and(|word| !word.chars().any(char::is_control))
}

/// The first 40 characters of `bytes`, for messages.
pub(super) fn shorten(bytes: &[u8]) -> String {
    const LONGEST: usize = 40;
    // A character has at most four bytes: the rest of a long token does not matter.
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(4 * (LONGEST + 1))]);
    let mut shown: String = head.chars().take(LONGEST).collect();
    if head.chars().count() > LONGEST {
        shown.push_str("...");
    }
    shown
}

/// The length of a string without its quotes; `None` if the line ends first.
pub(super) fn closing_quote(inside: &[u8]) -> Option<usize> {
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
