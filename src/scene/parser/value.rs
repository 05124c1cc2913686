//! The values of a parameter: an array in brackets, or one value without.

use nom::Parser;
use nom::branch::alt;
use nom::character::complete::char;
use nom::combinator::{map, success, verify};
use nom::sequence::preceded;

use super::keyword::Keyword;
use super::numbers::numbers;
use super::parameter::Declaration;
use super::source::{Parsed, Source, mismatch, wrong};
use super::statement::{Span, Text, Values};
use super::token::{Token, blanks, commas, separators, shorten, word};
use crate::decimal;
use crate::error::Error;

/// What becomes of values once their syntax has been checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Keep {
    /// They are handed out.
    All,
    /// They have no influence on the image and are dropped; there are none of them in the result.
    Nothing,
}

/// A number.
pub(super) fn number(input: &[u8]) -> Parsed<'_, f64> {
    let (rest, word) = word(input)?;
    decimal::parse(word).map_or_else(mismatch, |value| Ok((rest, value)))
}

/// Where number `place`, from 0, of the numbers at `array` is, for messages; all of `array` where there are fewer.
pub fn number_in(source: &[u8], array: &Span, place: usize) -> Span {
    let text = &source[array.clone()];
    let mut rest = text.strip_prefix(b"[").unwrap_or(text);
    for _ in 0..place {
        rest = match separators(rest).and_then(|(rest, ())| word(rest)) {
            Ok((rest, _)) => rest,
            Err(_) => return array.clone(),
        };
    }
    match separators(rest).and_then(|(rest, ())| word(rest)) {
        Ok((rest, word)) => array.end - rest.len() - word.len()..array.end - rest.len(),
        Err(_) => array.clone(),
    }
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

/// One value or more of one kind, with what follows them up to the next token.
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

impl<'a> Source<'a> {
    /// The values of the parameter `declared`, before which there are no blanks.
    pub(super) fn values(
        &self,
        declared: &Declaration,
        keep: Keep,
        input: &'a [u8],
    ) -> Parsed<'a, Values<'a>> {
        let (rest, values) = alt((
            |input| self.array(keep, input),
            |input| self.single(declared, input),
        ))
        .parse(input)?;
        match values {
            Values::Strings(texts) if declared.type_name == "bool" => {
                Ok((rest, Values::Booleans(self.booleans(&texts)?)))
            }
            values => Ok((rest, values)),
        }
    }

    /// One value without brackets.
    fn single(&self, declared: &Declaration, input: &'a [u8]) -> Parsed<'a, Values<'a>> {
        let string = verify(
            |input| self.text(input),
            |text: &Text| !declared.is_followed_by_another(&text.text),
        );
        let value = alt((
            map(number, |value| Values::Numbers(vec![value])),
            map(string, |text| Values::Strings(vec![text])),
            map(boolean, |value| Values::Booleans(vec![value])),
        ))
        .parse(input);
        match value {
            Err(nom::Err::Error(_)) => wrong(self.no_value(declared, input)),
            value => value,
        }
    }

    fn array(&self, keep: Keep, input: &'a [u8]) -> Parsed<'a, Values<'a>> {
        let (first, ()) = preceded(char('['), separators).parse(input)?;
        let (rest, values) = self.elements(keep, first)?;
        match rest.first() {
            Some(b']') => Ok((&rest[1..], values)),
            _ => wrong(self.not_in_array(input, &values, rest)),
        }
    }

    /// The values between brackets, all of the kind of the first.
    fn elements(&self, keep: Keep, input: &'a [u8]) -> Parsed<'a, Values<'a>> {
        let (rest, values) = numbers(input, keep)?;
        if rest.len() < input.len() {
            return Ok((rest, Values::Numbers(values)));
        }
        alt((
            map(several(|input| self.text(input), keep), Values::Strings),
            map(several(boolean, keep), Values::Booleans),
            map(success(()), |()| Values::None),
        ))
        .parse(input)
    }

    /// What quoted `true` and `false` mean.
    fn booleans(&self, texts: &[Text]) -> Result<Vec<bool>, Error> {
        let boolean = |text: &Text| match &*text.text {
            "true" => Ok(true),
            "false" => Ok(false),
            other => {
                let message = format!(
                    "found the string \"{}\" where a boolean is expected",
                    shorten(other.as_bytes())
                );
                Err(self
                    .error(text.span.clone(), message)
                    .note("expected `true` or `false`"))
            }
        };
        texts.iter().map(boolean).collect()
    }

    /// `N` numbers, with or without brackets, that `keyword` takes.
    pub(super) fn fixed<const N: usize>(
        &self,
        keyword: Keyword<'a>,
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
                    return wrong(self.unclosed(open, next));
                }
                Err(_) => return wrong(self.too_few(keyword, N, count, next)),
            }
        }
        let (next, ()) = separators(rest)?;
        match Token::next(next).0 {
            Token::Number(_) => wrong(self.too_many(keyword, N, next)),
            Token::Close if in_brackets => Ok((&next[1..], values)),
            _ if in_brackets => wrong(self.unclosed(open, next)),
            _ => commas(rest).map(|(rest, ())| (rest, values)),
        }
    }
}

/// Whether nothing but the next directive, or nothing at all, comes next.
fn is_end_of_directive(input: &[u8]) -> bool {
    matches!(Token::next(input).0, Token::Keyword(_) | Token::End)
}
