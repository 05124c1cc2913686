//! The parameters of a directive, looked up by name and checked.

use super::declared_type::{DeclaredType, refusal_of_values};
use super::parser::{self, Entity, Parameter, Span, Text, Values};
use super::shape_defaults::{ShapeDefault, ShapeDefaults};
use super::source::Source;
use super::spelling;
use super::warnings::Warnings;
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use std::path::PathBuf;

/// The parameters of one directive. What nobody asked for is reported by [`Parameters::finish`].
pub(super) struct Parameters<'a> {
    /// The directive, for messages.
    keyword: &'static str,
    entity: &'a Entity<'a>,
    source: &'a Source,
    /// What stands for parameters that the directive does not have.
    defaults: &'a [ShapeDefault],
    /// The names that were asked for.
    asked: Vec<&'static str>,
    /// Names that mean something, if not here.
    ignored: Vec<&'static str>,
}

impl<'a> Parameters<'a> {
    /// # Errors
    /// A value that is not of its declared type, whatever its name.
    pub(super) fn new(
        keyword: &'static str,
        entity: &'a Entity<'a>,
        source: &'a Source,
    ) -> Result<Parameters<'a>> {
        for parameter in &entity.parameters {
            if let Some(refusal) = refusal_of_values(parameter) {
                return Err(Error::bad_input(
                    refusal.at(source.at(&parameter.values_span)),
                ));
            }
        }
        Ok(Parameters {
            keyword,
            entity,
            source,
            defaults: &[],
            asked: Vec::new(),
            ignored: Vec::new(),
        })
    }

    /// The parameters of a `Shape`; its own win over `defaults`.
    pub(super) fn of_shape(
        entity: &'a Entity<'a>,
        source: &'a Source,
        defaults: &'a ShapeDefaults,
    ) -> Result<Parameters<'a>> {
        Ok(Parameters {
            defaults: defaults.as_slice(),
            ..Parameters::new("Shape", entity, source)?
        })
    }

    /// The name behind the keyword: `sphere`, `perspective`.
    pub(super) fn entity_name(&self) -> &'a str {
        &self.entity.name.text
    }

    /// Marks names as known and without influence.
    pub(super) fn ignore(&mut self, names: &[&'static str]) {
        self.ignored.extend_from_slice(names);
    }

    /// The names that mean something.
    fn known(&self) -> impl Iterator<Item = &'static str> {
        self.asked.iter().chain(&self.ignored).copied()
    }

    /// The last parameter of this name, as in pbrt, with the file that it stands in.
    fn last(&self, name: &str) -> Option<(&'a Parameter<'a>, &'a Source)> {
        let own = self
            .entity
            .parameters
            .iter()
            .rfind(|parameter| parameter.name == name);
        own.map(|parameter| (parameter, self.source)).or_else(|| {
            let default = self
                .defaults
                .iter()
                .rfind(|default| default.parameter.name == name)?;
            Some((&default.parameter, &*default.source))
        })
    }

    fn find(&mut self, name: &'static str) -> Option<(&'a Parameter<'a>, &'a Source)> {
        self.asked.push(name);
        self.last(name)
    }

    /// As [`Parameters::last`], of a parameter that is to be a `declared`.
    fn find_declared(
        &mut self,
        name: &'static str,
        declared: DeclaredType,
    ) -> Result<Option<(&'a Parameter<'a>, &'a Source)>> {
        let found = self.find(name);
        match found.and_then(|(parameter, source)| {
            Some((declared.refusal(parameter)?, source.at(&parameter.span)))
        }) {
            Some((refusal, place)) => Err(Error::bad_input(refusal.at(place))),
            None => Ok(found),
        }
    }

    /// Whether the directive has a parameter of this name.
    pub(super) fn has(&mut self, name: &'static str) -> bool {
        self.find(name).is_some()
    }

    /// All numbers of a parameter that is to be a `declared`.
    pub(super) fn numbers(
        &mut self,
        name: &'static str,
        declared: DeclaredType,
    ) -> Result<Option<&'a [f64]>> {
        let Some((parameter, source)) = self.find_declared(name, declared)? else {
            return Ok(None);
        };
        match &parameter.values {
            Values::Numbers(numbers) => Ok(Some(numbers)),
            Values::None => Ok(Some(&[])),
            _ => Err(source.error(&parameter.values_span, format!("`{name}` takes numbers"))),
        }
    }

    /// Exactly N numbers.
    pub(super) fn fixed_numbers<const N: usize>(
        &mut self,
        name: &'static str,
        declared: DeclaredType,
    ) -> Result<Option<[f64; N]>> {
        let Some(numbers) = self.numbers(name, declared)? else {
            return Ok(None);
        };
        match numbers.try_into() {
            Ok(numbers) => Ok(Some(numbers)),
            Err(_) => {
                let number = if N == 1 {
                    "one number".to_owned()
                } else {
                    format!("{N} numbers")
                };
                Err(self.error_at(
                    name,
                    format!("`{name}` takes {number}, found {}", numbers.len()),
                ))
            }
        }
    }

    /// One number, declared as `float`.
    pub(super) fn number(&mut self, name: &'static str) -> Result<Option<f64>> {
        Ok(self
            .fixed_numbers::<1>(name, DeclaredType::FLOAT)?
            .map(|[number]| number))
    }

    /// The number that a parameter is, where it is one; it may be anything else.
    pub(super) fn lone_number(&mut self, name: &'static str) -> Option<f64> {
        match &self.find(name)?.0.values {
            Values::Numbers(numbers) if numbers.len() == 1 => Some(numbers[0]),
            _ => None,
        }
    }

    /// One finite number above 0.
    pub(super) fn positive_number(&mut self, name: &'static str) -> Result<Option<f64>> {
        match self.number(name)? {
            Some(number) if !(number > 0.0 && number.is_finite()) => Err(self.error_at(
                name,
                format!("`{name}` is {number}, expected a number above 0"),
            )),
            number => Ok(number),
        }
    }

    /// One integer from `least` to `most`.
    pub(super) fn integer(
        &mut self,
        name: &'static str,
        least: i64,
        most: i64,
    ) -> Result<Option<i64>> {
        let Some([number]) = self.fixed_numbers(name, DeclaredType::INTEGER)? else {
            return Ok(None);
        };
        if number.fract() == 0.0 && number >= least as f64 && number <= most as f64 {
            return Ok(Some(number as i64));
        }
        let message = format!("`{name}` is {number}, expected an integer from {least} to {most}");
        Err(self.error_at(name, message))
    }

    /// One string.
    pub(super) fn string(&mut self, name: &'static str) -> Result<Option<&'a str>> {
        Ok(self.text(name)?.map(|text| &*text.text))
    }

    /// One string that names a file.
    pub(super) fn path(&mut self, name: &'static str) -> Result<Option<PathBuf>> {
        Ok(self.text(name)?.map(Text::path))
    }

    fn text(&mut self, name: &'static str) -> Result<Option<&'a Text<'a>>> {
        let Some((parameter, source)) = self.find_declared(name, DeclaredType::STRING)? else {
            return Ok(None);
        };
        match &parameter.values {
            Values::Strings(strings) if strings.len() == 1 && !strings[0].text.is_empty() => {
                Ok(Some(&strings[0]))
            }
            _ => Err(source.error(
                &parameter.values_span,
                format!("`{name}` takes one string in quotes that is not empty"),
            )),
        }
    }

    /// An error that points at the values of the last parameter called `name`.
    pub(super) fn error_at(&self, name: &str, message: impl Into<String>) -> Error {
        let (span, source) = self.span_of(name);
        source.error(span, message)
    }

    /// Where the values of the last parameter called `name` are.
    pub(super) fn place_of(&self, name: &str) -> SourceLocation {
        let (span, source) = self.span_of(name);
        source.at(span)
    }

    /// Where the name behind the keyword is.
    pub(super) fn place_of_name(&self) -> SourceLocation {
        self.source.at(&self.entity.name.span)
    }

    fn span_of(&self, name: &str) -> (&'a Span, &'a Source) {
        let found = self
            .last(name)
            .map(|(parameter, source)| (&parameter.values_span, source));
        found.unwrap_or((&self.entity.name.span, self.source))
    }

    /// An error that points at the name behind the keyword.
    pub(super) fn error_at_name(&self, message: impl Into<String>) -> Error {
        self.source.error(&self.entity.name.span, message)
    }

    /// A warning, once a kind, that points at the parameter called `name`.
    pub(super) fn warn(&self, name: &str, message: impl Into<String>, warnings: &mut Warnings) {
        let kind = format!("{} {} {name}", self.keyword, self.entity.name.text);
        warnings.add(kind, || Diagnostic::new(message).at(self.place_of(name)));
    }

    /// A warning, once a kind, that points at the name behind the keyword.
    pub(super) fn warn_at_name(&self, kind: &str, diagnostic: Diagnostic, warnings: &mut Warnings) {
        let kind = format!("{} {kind}", self.keyword);
        warnings.add(kind, || {
            diagnostic.at(self.source.at(&self.entity.name.span))
        });
    }

    /// Warns of parameters that nobody asked for, and of those that occur more than once.
    pub(super) fn finish(self, warnings: &mut Warnings) {
        self.warn_of_repeated(warnings);
        for parameter in &self.entity.parameters {
            if self.known().any(|known| parameter.name == known) {
                continue;
            }
            let kind = format!(
                "unknown {} {} {}",
                self.keyword, self.entity.name.text, parameter.name
            );
            warnings.add(kind, || self.unknown(parameter));
        }
    }

    /// As [`Parameters::finish`], where there are many that do not matter: warns of those that look like misspelt known ones.
    pub(super) fn finish_with_suggestions(self, warnings: &mut Warnings) {
        self.warn_of_repeated(warnings);
        for parameter in &self.entity.parameters {
            let is_known = self.known().any(|known| parameter.name == known);
            if !is_known && spelling::closest(&parameter.name, self.known()).is_some() {
                let kind = format!("unknown {} {}", self.keyword, parameter.name);
                warnings.add(kind, || self.unknown(parameter));
            }
        }
    }

    /// Warns of parameters that matter and that a later one of the same name overrules, as in pbrt.
    fn warn_of_repeated(&self, warnings: &mut Warnings) {
        let mut rest = &self.entity.parameters[..];
        while let Some((parameter, later)) = rest.split_first() {
            rest = later;
            let matters = || self.asked.iter().any(|name| parameter.name == *name);
            if !later.is_empty()
                && matters()
                && later.iter().any(|other| other.name == parameter.name)
            {
                let kind = format!("repeated {} {}", self.keyword, parameter.name);
                warnings.add(kind, || {
                    let message = format!(
                        "`{}` is set more than once: the last one counts",
                        parameter.name
                    );
                    Diagnostic::new(message).at(self.source.at(&parameter.span))
                });
            }
        }
    }

    /// The error `message`, with a hint at a parameter that may be a misspelt `name`.
    pub(super) fn missing(&self, name: &str, message: impl Into<String>) -> Error {
        let error = self.error_at_name(message);
        let mut names = self
            .entity
            .parameters
            .iter()
            .map(|parameter| &*parameter.name);
        match names.find(|found| spelling::closest(found, std::iter::once(name)).is_some()) {
            Some(found) => error.note(format!("did you mean `{name}` by `{found}`?")),
            None => error,
        }
    }

    /// An error that points at number `place`, from 0, of the array called `name`.
    pub(super) fn error_at_number(
        &self,
        name: &str,
        place: usize,
        message: impl Into<String>,
    ) -> Error {
        let (array, source) = self.span_of(name);
        source.error(&parser::number_in(&source.text, array, place), message)
    }

    fn unknown(&self, parameter: &Parameter) -> Diagnostic {
        let (keyword, entity) = (self.keyword, &self.entity.name.text);
        let message = format!(
            "{keyword} \"{entity}\" has no parameter `{}`: ignored",
            parameter.name
        );
        let diagnostic = Diagnostic::new(message).at(self.source.at(&parameter.span));
        match spelling::closest(&parameter.name, self.known()) {
            Some(known) => diagnostic.note(format!("did you mean `{known}`?")),
            None => diagnostic,
        }
    }
}
