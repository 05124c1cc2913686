//! Parameter lists: `"type name" value`, again and again.

use std::borrow::Cow;

use nom::Parser;
use nom::sequence::preceded;

use super::keyword::Keyword;
use super::source::{Parsed, Source, wrong};
use super::statement::{Entity, Parameter, Span, Text, Values};
use super::token::{Token, blanks, commas};
use super::value::Keep;
use crate::error::Result;

/// What a parameter's first string says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Declaration<'a> {
    pub(super) type_name: Cow<'a, str>,
    pub(super) name: Cow<'a, str>,
    /// The string with its quotes.
    pub(super) span: Span,
}

/// The types whose values are numbers, in every version of pbrt.
pub const NUMBER_TYPES: [&str; 11] = [
    "float",
    "integer",
    "normal",
    "normal3",
    "point",
    "point2",
    "point3",
    "vector",
    "vector2",
    "vector3",
    "blackbody",
];

impl Declaration<'_> {
    /// Whether `text` cannot be the value of this parameter, being the declaration of another.
    pub(super) fn is_followed_by_another(&self, text: &str) -> bool {
        NUMBER_TYPES.contains(&&*self.type_name) && text.split_whitespace().count() == 2
    }

    /// Whether the string whose quote is followed by `inside` is made like a declaration.
    pub(super) fn is_like(inside: &[u8]) -> bool {
        let end = inside
            .iter()
            .position(|byte| matches!(byte, b'"' | b'\n' | b'\r'))
            .unwrap_or(inside.len());
        inside[..end]
            .split(u8::is_ascii_whitespace)
            .filter(|word| !word.is_empty())
            .count()
            == 2
    }
}

/// The first and the second word of `text`, either of which may be missing. As in pbrt, more words say nothing.
fn two_words<'a>(text: &Cow<'a, str>) -> (Cow<'a, str>, Cow<'a, str>) {
    match text {
        Cow::Borrowed(text) => {
            let mut words = text.split_whitespace();
            let mut next = || Cow::Borrowed(words.next().unwrap_or_default());
            (next(), next())
        }
        Cow::Owned(text) => {
            let (first, second) = two_words(&Cow::Borrowed(text.as_str()));
            (
                Cow::Owned(first.into_owned()),
                Cow::Owned(second.into_owned()),
            )
        }
    }
}

impl<'a> Source<'a> {
    /// `"name" parameters`, the arguments of most directives.
    pub(super) fn entity(
        &self,
        keyword: Keyword<'a>,
        keep: Keep,
        input: &'a [u8],
    ) -> Parsed<'a, Entity<'a>> {
        let (rest, name) = self.string(keyword, input)?;
        let (rest, parameters) = self.parameters(keep, rest)?;
        Ok((rest, Entity { name, parameters }))
    }

    /// The quoted string that `keyword` takes next.
    pub(super) fn string(&self, keyword: Keyword<'a>, input: &'a [u8]) -> Parsed<'a, Text<'a>> {
        match preceded(blanks, |input| self.text(input)).parse(input) {
            Err(nom::Err::Error(_)) => wrong(self.no_string(keyword, input)),
            parsed => parsed,
        }
    }

    /// Parameters as long as there are any; the rest begins right after the last.
    pub(super) fn parameters(&self, keep: Keep, input: &'a [u8]) -> Parsed<'a, Vec<Parameter<'a>>> {
        let mut parameters = Vec::new();
        let mut rest = input;
        loop {
            match preceded(blanks, |input| self.parameter(keep, input)).parse(rest) {
                Ok((after, parameter)) => {
                    parameters.extend((keep == Keep::All).then_some(parameter));
                    rest = after;
                }
                Err(nom::Err::Error(_)) => return Ok((rest, parameters)),
                Err(refused) => return Err(refused),
            }
        }
    }

    /// A declaration and its values.
    fn parameter(&self, keep: Keep, input: &'a [u8]) -> Parsed<'a, Parameter<'a>> {
        let (rest, text) = self.text(input)?;
        let declared = self.declaration(text)?;
        let (first, ()) = blanks(rest)?;
        let (mut rest, values) = self.values(&declared, keep, first)?;
        if first.first() != Some(&b'[') && matches!(values, Values::Numbers(_)) {
            (rest, ()) = commas(rest)?;
        }
        if matches!(
            Token::next(rest).0,
            Token::Number(_) | Token::Open | Token::Word(b"true" | b"false")
        ) {
            return wrong(self.second_value(&declared, rest));
        }
        let Declaration {
            type_name,
            name,
            span,
        } = declared;
        Ok((
            rest,
            Parameter {
                type_name,
                name,
                span,
                values,
                values_span: self.span(first, rest),
            },
        ))
    }

    fn declaration(&self, text: Text<'a>) -> Result<Declaration<'a>> {
        let (type_name, name) = two_words(&text.text);
        if name.is_empty() {
            return Err(self.half_declaration(text.span, &type_name));
        }
        Ok(Declaration {
            type_name,
            name,
            span: text.span,
        })
    }

    /// `"name" value` or `"type name" value`: the one parameter of `Option`.
    pub(super) fn option(&self, keyword: Keyword<'a>, input: &'a [u8]) -> Parsed<'a, ()> {
        let (rest, text) = self.string(keyword, input)?;
        let (type_name, name) = two_words(&text.text);
        let (rest, ()) = blanks(rest)?;
        let (rest, _) = self.values(
            &Declaration {
                type_name,
                name,
                span: text.span,
            },
            Keep::Nothing,
            rest,
        )?;
        Ok((rest, ()))
    }
}
