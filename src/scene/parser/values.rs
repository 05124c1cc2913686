//! The grammar of values: strings, numbers, booleans and arrays of them.

use std::borrow::Cow;

use nom::Parser;
use nom::branch::alt;
use nom::character::complete::char;
use nom::combinator::{map, success, verify};
use nom::sequence::preceded;

use super::diagnostics::{Diagnostics, Keyword};
use super::lexer::{
    Parsed, Token, blanks, closing_quote, commas, mismatch, separators, word, wrong,
};
use super::numbers::{Keep, numbers};
use super::statement::{Declaration, Text, Values};
use crate::decimal;
use crate::error::Result;
use crate::scene::source_file::{SourceFile, Span};

/// A quoted string.
pub(super) fn text<'a>(errors: Diagnostics, input: &'a [u8]) -> Parsed<'a, Text<'a>> {
    let (inside, _) = char('"')(input)?;
    let Some(length) = closing_quote(inside) else {
        return wrong(errors.unclosed_string(input));
    };
    let rest = &inside[length + 1..];
    let bytes = unescape(errors, &inside[..length], inside)?;
    Ok((rest, Text::new(bytes, errors.span(input, rest))))
}

/// The string that `keyword` takes next.
pub(super) fn string<'a>(
    errors: Diagnostics,
    keyword: Keyword,
    input: &'a [u8],
) -> Parsed<'a, Text<'a>> {
    match preceded(blanks, |input| text(errors, input)).parse(input) {
        Err(nom::Err::Error(_)) => wrong(errors.no_string(keyword, input)),
        parsed => parsed,
    }
}

/// The bytes that `raw` stands for. The text from `raw` on is `start`.
fn unescape<'a>(errors: Diagnostics, raw: &'a [u8], start: &[u8]) -> Result<Cow<'a, [u8]>> {
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
        bytes.push(match after.first() {
            Some(b'b') => 0x08,
            Some(b'f') => 0x0c,
            Some(b'n') => b'\n',
            Some(b'r') => b'\r',
            Some(b't') => b'\t',
            Some(letter @ (b'\\' | b'\'' | b'"')) => *letter,
            _ => return Err(errors.unknown_escape(after, &start[raw.len() - after.len() - 1..])),
        });
        rest = &after[1..];
    }
    Ok(Cow::Owned(bytes))
}

fn number(input: &[u8]) -> Parsed<'_, f64> {
    let (rest, word) = word(input)?;
    decimal::parse(word).map_or_else(mismatch, |value| Ok((rest, value)))
}

/// `true` or `false` without quotes.
fn boolean(input: &[u8]) -> Parsed<'_, bool> {
    let (rest, word) = word(input)?;
    match word {
        b"true" => Ok((rest, true)),
        b"false" => Ok((rest, false)),
        _ => mismatch(),
    }
}

/// One value or more of one kind, up to the next token.
fn several<'a, T>(
    mut one: impl FnMut(&'a [u8]) -> Parsed<'a, T>,
    keep: Keep,
) -> impl FnMut(&'a [u8]) -> Parsed<'a, Vec<T>> {
    move |input| {
        let mut values = Vec::new();
        let mut rest = input;
        loop {
            match one(rest) {
                Ok((after, value)) => {
                    values.extend((keep == Keep::All).then_some(value));
                    (rest, ()) = separators(after)?;
                }
                Err(nom::Err::Error(_)) if rest.len() < input.len() => return Ok((rest, values)),
                Err(refused) => return Err(refused),
            }
        }
    }
}

/// The values of the parameter `declared`, without blanks before them.
pub(super) fn values<'a>(
    errors: Diagnostics,
    declared: &Declaration,
    keep: Keep,
    input: &'a [u8],
) -> Parsed<'a, Values<'a>> {
    let (rest, values) = alt((
        |input| array(errors, keep, input),
        |input| single(errors, declared, input),
    ))
    .parse(input)?;
    match values {
        Values::Strings(texts) if declared.type_name == "bool" => {
            Ok((rest, Values::Booleans(booleans(errors, &texts)?)))
        }
        values => Ok((rest, values)),
    }
}

/// One value without brackets.
fn single<'a>(
    errors: Diagnostics,
    declared: &Declaration,
    input: &'a [u8],
) -> Parsed<'a, Values<'a>> {
    let string = verify(
        |input| text(errors, input),
        |text: &Text| !declared.is_followed_by_another(&text.text),
    );
    let value = alt((
        map(number, |value| Values::Numbers(vec![value])),
        map(string, |text| Values::Strings(vec![text])),
        map(boolean, |value| Values::Booleans(vec![value])),
    ))
    .parse(input);
    match value {
        Err(nom::Err::Error(_)) => wrong(errors.no_value(declared, input)),
        value => value,
    }
}

fn array<'a>(errors: Diagnostics, keep: Keep, input: &'a [u8]) -> Parsed<'a, Values<'a>> {
    let (first, ()) = preceded(char('['), separators).parse(input)?;
    let (rest, values) = elements(errors, keep, first)?;
    match rest.first() {
        Some(b']') => Ok((&rest[1..], values)),
        _ => wrong(errors.not_in_array(input, &values, rest)),
    }
}

/// The values between brackets, all of the kind of the first.
fn elements<'a>(errors: Diagnostics, keep: Keep, input: &'a [u8]) -> Parsed<'a, Values<'a>> {
    let (rest, values) = numbers(input, keep)?;
    if rest.len() < input.len() {
        return Ok((rest, Values::Numbers(values)));
    }
    alt((
        map(several(|input| text(errors, input), keep), Values::Strings),
        map(several(boolean, keep), Values::Booleans),
        map(success(()), |()| Values::None),
    ))
    .parse(input)
}

/// The meaning of quoted `true` and `false`.
fn booleans(errors: Diagnostics, texts: &[Text]) -> Result<Vec<bool>> {
    let boolean = |text: &Text| match &*text.text {
        "true" => Ok(true),
        "false" => Ok(false),
        other => Err(errors.no_boolean(&text.span, other)),
    };
    texts.iter().map(boolean).collect()
}

/// The `N` numbers that `keyword` takes, with or without brackets.
pub(super) fn fixed<'a, const N: usize>(
    errors: Diagnostics,
    keyword: Keyword,
    input: &'a [u8],
) -> Parsed<'a, [f64; N]> {
    let (open, ()) = blanks(input)?;
    let in_brackets = open.first() == Some(&b'[');
    let mut rest = if in_brackets { &open[1..] } else { open };
    let mut values = [0.0; N];
    for (count, value) in values.iter_mut().enumerate() {
        let (next, ()) = separators(rest)?;
        match number(next) {
            Ok((after, parsed)) => (rest, *value) = (after, parsed),
            Err(_) if in_brackets && is_end_of_directive(next) => {
                return wrong(errors.unclosed(open, next));
            }
            Err(_) => return wrong(errors.too_few(keyword, N, count, next)),
        }
    }
    let (next, ()) = separators(rest)?;
    match Token::next(next).0 {
        Token::Number(_) => wrong(errors.too_many(keyword, N, next)),
        Token::Close if in_brackets => Ok((&next[1..], values)),
        _ if in_brackets => wrong(errors.unclosed(open, next)),
        _ => commas(rest).map(|(rest, ())| (rest, values)),
    }
}

/// Whether the next directive or the end of the file comes next.
fn is_end_of_directive(input: &[u8]) -> bool {
    matches!(Token::next(input).0, Token::Keyword(_) | Token::End)
}

/// The span of number `index`, counted from 0, of the numbers at `array`; all of `array` if there
/// are fewer.
pub(crate) fn number_in(file: &SourceFile, array: &Span, index: usize) -> Span {
    let text = file.slice(array);
    let mut rest = text.strip_prefix(b"[").unwrap_or(text);
    for left in (0..=index).rev() {
        let Ok((after, word)) = separators(rest).and_then(|(rest, ())| word(rest)) else {
            break;
        };
        if left == 0 {
            return array.end - after.len() - word.len()..array.end - after.len();
        }
        rest = after;
    }
    array.clone()
}
