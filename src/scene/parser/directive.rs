//! Directives: a keyword and the arguments that it takes.

use nom::Parser;
use nom::combinator::{map, opt, value};
use nom::sequence::preceded;

use super::keyword::{self, Keyword};
use super::source::{Parsed, Source, wrong};
use super::statement::{ActiveTransform, Directive, Statement};
use super::token::{blanks, word};
use super::value::Keep;

impl<'a> Source<'a> {
    /// The directive that `input` begins with; `previous` is the keyword of the one before it.
    pub(super) fn directive(
        &self,
        previous: Option<&str>,
        input: &'a [u8],
    ) -> Parsed<'a, (&'a str, Directive<'a>)> {
        let known = word(input)
            .ok()
            .and_then(|(rest, word)| Some((rest, keyword::number(word)?)));
        let Some((rest, number)) = known else {
            return self.private(previous, input);
        };
        let (keyword, name) = (self.span(input, rest), keyword::KEYWORDS[number]);
        let (rest, statement) = self.statement(Keyword { name, at: input }, rest)?;
        let span = self.span(input, rest);
        Ok((
            rest,
            (
                name,
                Directive {
                    span,
                    keyword,
                    keyword_number: Some(number),
                    statement,
                },
            ),
        ))
    }

    /// What follows `keyword`.
    fn statement(&self, keyword: Keyword<'a>, input: &'a [u8]) -> Parsed<'a, Statement<'a>> {
        use Statement as S;
        match keyword.name {
            "Identity" => Ok((input, S::Identity)),
            "ReverseOrientation" => Ok((input, S::ReverseOrientation)),
            "AttributeBegin" => Ok((input, S::AttributeBegin)),
            "AttributeEnd" => Ok((input, S::AttributeEnd)),
            "TransformBegin" => Ok((input, S::TransformBegin)),
            "TransformEnd" => Ok((input, S::TransformEnd)),
            "ObjectEnd" => Ok((input, S::ObjectEnd)),
            "WorldBegin" => Ok((input, S::WorldBegin)),
            "WorldEnd" => Ok((input, S::WorldEnd)),
            "TransformTimes" => map(|i| self.fixed(keyword, i), S::TransformTimes).parse(input),
            "Translate" => map(|i| self.fixed(keyword, i), S::Translate).parse(input),
            "Scale" => map(|i| self.fixed(keyword, i), S::Scale).parse(input),
            "Rotate" => map(|i| self.fixed(keyword, i), S::Rotate).parse(input),
            "LookAt" => map(|i| self.fixed(keyword, i), S::LookAt).parse(input),
            "Transform" => map(|i| self.fixed(keyword, i), S::Transform).parse(input),
            "ConcatTransform" => map(|i| self.fixed(keyword, i), S::ConcatTransform).parse(input),
            "CoordinateSystem" => {
                map(|i| self.string(keyword, i), S::CoordinateSystem).parse(input)
            }
            "CoordSysTransform" => {
                map(|i| self.string(keyword, i), S::CoordSysTransform).parse(input)
            }
            "Include" => map(|i| self.string(keyword, i), S::Include).parse(input),
            "Import" => map(|i| self.string(keyword, i), S::Import).parse(input),
            "ObjectBegin" => map(|i| self.string(keyword, i), S::ObjectBegin).parse(input),
            "ObjectInstance" => map(|i| self.string(keyword, i), S::ObjectInstance).parse(input),
            "Material" => map(
                (
                    |i| self.string(keyword, i),
                    |i| self.parameters(Keep::Nothing, i),
                ),
                |(name, _)| S::Material(name),
            )
            .parse(input),
            "MakeNamedMaterial" => {
                map(|i| self.entity(keyword, Keep::All, i), S::MakeNamedMaterial).parse(input)
            }
            "NamedMaterial" => map(|i| self.string(keyword, i), S::NamedMaterial).parse(input),
            "Camera" => map(|i| self.entity(keyword, Keep::All, i), S::Camera).parse(input),
            "Film" => map(|i| self.entity(keyword, Keep::All, i), S::Film).parse(input),
            "Accelerator" => {
                map(|i| self.entity(keyword, Keep::All, i), S::Accelerator).parse(input)
            }
            "Shape" => map(|i| self.entity(keyword, Keep::All, i), S::Shape).parse(input),
            "Attribute" => map(|i| self.entity(keyword, Keep::All, i), S::Attribute).parse(input),
            "ActiveTransform" => {
                map(|i| self.active_transform(keyword, i), S::ActiveTransform).parse(input)
            }
            name => value(S::Ignored(name), |i| self.ignored(keyword, i)).parse(input),
        }
    }

    /// The arguments of a directive without influence on hit and depth: their syntax is checked.
    fn ignored(&self, keyword: Keyword<'a>, input: &'a [u8]) -> Parsed<'a, ()> {
        let string = |i| self.string(keyword, i);
        let parameters = |i| self.parameters(Keep::Nothing, i);
        match keyword.name {
            "ColorSpace" => value((), string).parse(input),
            "MediumInterface" => {
                value((), (string, opt(preceded(blanks, |i| self.text(i))))).parse(input)
            }
            "Option" => self.option(keyword, input),
            "Texture" => value((), (string, string, string, parameters)).parse(input),
            _ => value((), (string, parameters)).parse(input),
        }
    }

    /// The bare word that `ActiveTransform` takes.
    fn active_transform(
        &self,
        keyword: Keyword<'a>,
        input: &'a [u8],
    ) -> Parsed<'a, ActiveTransform> {
        let (rest, word) = preceded(blanks, opt(word)).parse(input)?;
        match word {
            Some(b"StartTime") => Ok((rest, ActiveTransform::StartTime)),
            Some(b"EndTime") => Ok((rest, ActiveTransform::EndTime)),
            Some(b"All") => Ok((rest, ActiveTransform::All)),
            _ => wrong(self.no_argument(keyword, "`StartTime`, `EndTime` or `All`", input)),
        }
    }
}
