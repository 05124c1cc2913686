//! The grammar of directives: a keyword and the arguments that the table gives it.

use std::borrow::Cow;

use nom::Parser;
use nom::combinator::{map, opt};
use nom::sequence::preceded;

use super::diagnostics::{Diagnostics, Keyword};
use super::directive::{self, Arguments, Description, Directive, Dropped, KEYWORDS, Row};
use super::lexer::{Parsed, Token, blanks, commas, word, wrong};
use super::numbers::Keep;
use super::statement::{
    ActiveTransform, Declaration, Entity, Parameter, Statement, Text, TextureDirective,
    TransformDirective, Values,
};
use super::unknown::unknown_directive;
use super::values::{fixed, string, text, values};
use crate::error::Result;

/// The directive at the start of `input`, and its keyword. `previous` is the keyword before it.
pub(super) fn directive<'a>(
    errors: Diagnostics,
    previous: Option<&str>,
    input: &'a [u8],
) -> Parsed<'a, (&'a str, Directive<'a>)> {
    let known = word(input)
        .ok()
        .and_then(|(rest, word)| Some((rest, directive::number(word)?)));
    let Some((after, number)) = known else {
        return unknown_directive(errors, previous, input);
    };
    let (name, row) = (KEYWORDS[number], Row::ALL[number]);
    let (rest, statement) = arguments(errors, row, Keyword { name, at: input }, after)?;
    let directive = Directive {
        span: errors.span(input, rest),
        keyword: errors.span(input, after),
        description: Some(Description {
            number,
            legal: row.legal,
            matters: row.matters,
        }),
        statement,
    };
    Ok((rest, (name, directive)))
}

/// The statement that `keyword` and its arguments make.
fn arguments<'a>(
    errors: Diagnostics,
    row: Row<'a>,
    keyword: Keyword,
    input: &'a [u8],
) -> Parsed<'a, Statement<'a>> {
    let transform = Statement::Transform;
    match row.arguments {
        Arguments::None(make) => Ok((input, make())),
        Arguments::Identity => Ok((input, transform(TransformDirective::Identity))),
        Arguments::Three(make) => {
            map(|i| fixed(errors, keyword, i), |n| transform(make(n))).parse(input)
        }
        Arguments::Four(make) => {
            map(|i| fixed(errors, keyword, i), |n| transform(make(n))).parse(input)
        }
        Arguments::Nine(make) => {
            map(|i| fixed(errors, keyword, i), |n| transform(make(n))).parse(input)
        }
        Arguments::Sixteen(make) => {
            map(|i| fixed(errors, keyword, i), |n| transform(make(n))).parse(input)
        }
        Arguments::Times(make) => map(|i| times(errors, keyword, i), make).parse(input),
        Arguments::Name(make) => map(|i| string(errors, keyword, i), make).parse(input),
        Arguments::Type(make) => {
            let (rest, name) = string(errors, keyword, input)?;
            let (rest, _) = parameters(errors, Keep::Nothing, rest)?;
            Ok((rest, make(name)))
        }
        Arguments::Entity(make) => {
            let (rest, name) = string(errors, keyword, input)?;
            let (rest, parameters) = parameters(errors, Keep::All, rest)?;
            Ok((rest, make(Entity { name, parameters })))
        }
        Arguments::Texture(make) => {
            let (rest, name) = string(errors, keyword, input)?;
            let (rest, value_type) = string(errors, keyword, rest)?;
            let (rest, class) = string(errors, keyword, rest)?;
            let is_number = value_type.text == "float";
            let keep = if is_number { Keep::All } else { Keep::Nothing };
            let (rest, parameters) = parameters(errors, keep, rest)?;
            let entity = Entity {
                name: class,
                parameters,
            };
            let texture = TextureDirective { name, entity };
            Ok((rest, make(is_number.then_some(texture))))
        }
        Arguments::Dropped(arguments, make) => {
            let mut rest = input;
            for argument in arguments {
                (rest, ()) = dropped(errors, *argument, keyword, rest)?;
            }
            Ok((rest, make()))
        }
    }
}

/// Checks the syntax of an argument.
fn dropped<'a>(
    errors: Diagnostics,
    argument: Dropped,
    keyword: Keyword,
    input: &'a [u8],
) -> Parsed<'a, ()> {
    let rest = match argument {
        Dropped::TwoNumbers => fixed::<2>(errors, keyword, input)?.0,
        Dropped::Text => string(errors, keyword, input)?.0,
        Dropped::OptionalText => opt(preceded(blanks, |i| text(errors, i))).parse(input)?.0,
        Dropped::Parameters => parameters(errors, Keep::Nothing, input)?.0,
        Dropped::Option => {
            let (rest, text) = string(errors, keyword, input)?;
            let (type_name, name) = two_words(&text.text);
            let declared = Declaration {
                type_name,
                name,
                span: text.span,
            };
            let (rest, ()) = blanks(rest)?;
            values(errors, &declared, Keep::Nothing, rest)?.0
        }
    };
    Ok((rest, ()))
}

/// The bare word that `ActiveTransform` takes.
fn times<'a>(
    errors: Diagnostics,
    keyword: Keyword,
    input: &'a [u8],
) -> Parsed<'a, ActiveTransform> {
    let (rest, word) = preceded(blanks, opt(word)).parse(input)?;
    match word {
        Some(b"StartTime") => Ok((rest, ActiveTransform::StartTime)),
        Some(b"EndTime") => Ok((rest, ActiveTransform::EndTime)),
        Some(b"All") => Ok((rest, ActiveTransform::All)),
        _ => wrong(errors.no_argument(keyword, "`StartTime`, `EndTime` or `All`", input)),
    }
}

/// All parameters that follow; the rest begins right after the last one.
fn parameters<'a>(
    errors: Diagnostics,
    keep: Keep,
    input: &'a [u8],
) -> Parsed<'a, Vec<Parameter<'a>>> {
    let mut parameters = Vec::new();
    let mut rest = input;
    loop {
        match preceded(blanks, |input| parameter(errors, keep, input)).parse(rest) {
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
fn parameter<'a>(errors: Diagnostics, keep: Keep, input: &'a [u8]) -> Parsed<'a, Parameter<'a>> {
    let (rest, text) = text(errors, input)?;
    let declared = declaration(errors, text)?;
    let (first, ()) = blanks(rest)?;
    let (mut rest, values) = values(errors, &declared, keep, first)?;
    if first.first() != Some(&b'[') && matches!(values, Values::Numbers(_)) {
        (rest, ()) = commas(rest)?;
    }
    let next = Token::next(rest).0;
    if matches!(
        next,
        Token::Number(_) | Token::Open | Token::Word(b"true" | b"false")
    ) {
        return wrong(errors.second_value(&declared, rest));
    }
    let Declaration {
        type_name,
        name,
        span,
    } = declared;
    let values_span = errors.span(first, rest);
    Ok((
        rest,
        Parameter {
            type_name,
            name,
            span,
            values,
            values_span,
        },
    ))
}

fn declaration<'a>(errors: Diagnostics, text: Text<'a>) -> Result<Declaration<'a>> {
    let (type_name, name) = two_words(&text.text);
    if name.is_empty() {
        return Err(errors.half_declaration(&text.span, &type_name));
    }
    Ok(Declaration {
        type_name,
        name,
        span: text.span,
    })
}

/// The first two words of `text`, either of which may be missing. pbrt ignores more words, too.
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
