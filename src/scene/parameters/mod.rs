//! The parameters of a directive, looked up by name and checked.

mod declared_type;
mod known_names;
mod lone_numbers;
mod references;
mod shape_defaults;

pub(super) use declared_type::DeclaredType;
pub(super) use shape_defaults::{MAX_DEFAULTS, ShapeDefaults};

use super::parser::{self, Entity, Parameter, Text, Values};
use super::source_file::{SourceFile, Span};
use super::spelling;
use super::warnings::Warnings;
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use known_names::KnownNames;
use shape_defaults::ShapeDefault;
use std::path::PathBuf;

/// The parameters of one directive. [`Parameters::finish`] warns of those that nothing looked up.
pub(super) struct Parameters<'a> {
    /// The directive, for messages.
    keyword: &'static str,
    entity: &'a Entity<'a>,
    file: &'a SourceFile,
    /// Parameters that `Attribute` sets for directives without them.
    defaults: &'a [ShapeDefault],
    known: KnownNames,
}

/// A parameter, and the file that it stands in.
type Found<'a> = (&'a Parameter<'a>, &'a SourceFile);

impl<'a> Parameters<'a> {
    /// # Errors
    /// A value that is not of its declared type, whatever its name.
    pub(super) fn new(
        keyword: &'static str,
        entity: &'a Entity<'a>,
        file: &'a SourceFile,
    ) -> Result<Parameters<'a>> {
        for parameter in &entity.parameters {
            if let Some(refusal) = declared_type::refusal_of_values(parameter) {
                let at = file.at(&parameter.values_span);
                return Err(Error::bad_input(refusal.at(at)));
            }
        }
        let known = KnownNames::default();
        Ok(Parameters {
            keyword,
            entity,
            file,
            defaults: &[],
            known,
        })
    }

    /// The parameters of a `Shape`; they override `defaults`.
    pub(super) fn of_shape(
        entity: &'a Entity<'a>,
        file: &'a SourceFile,
        defaults: &'a ShapeDefaults,
    ) -> Result<Parameters<'a>> {
        let mut parameters = Parameters::new("Shape", entity, file)?;
        parameters.defaults = defaults.as_slice();
        Ok(parameters)
    }

    /// The name after the keyword: `sphere`, `perspective`.
    pub(super) fn entity_name(&self) -> &'a str {
        &self.entity.name.text
    }

    /// Marks names as known and without influence.
    pub(super) fn ignore(&mut self, names: &[&'static str]) {
        self.known.ignore(names);
    }

    /// The last parameter of this name, as in pbrt.
    fn last(&self, name: &str) -> Option<Found<'a>> {
        let own = self
            .entity
            .parameters
            .iter()
            .rfind(|parameter| parameter.name == name);
        if let Some(parameter) = own {
            return Some((parameter, self.file));
        }
        let default = self
            .defaults
            .iter()
            .rfind(|default| default.parameter.name == name)?;
        Some((&default.parameter, &default.file))
    }

    fn find(&mut self, name: &'static str) -> Option<Found<'a>> {
        self.known.add(name);
        self.last(name)
    }

    /// # Errors
    /// A parameter that is not `declared`.
    fn find_declared(
        &mut self,
        name: &'static str,
        declared: DeclaredType,
    ) -> Result<Option<Found<'a>>> {
        let Some((parameter, file)) = self.find(name) else {
            return Ok(None);
        };
        match declared.refusal(parameter) {
            Some(refusal) => Err(Error::bad_input(refusal.at(file.at(&parameter.span)))),
            None => Ok(Some((parameter, file))),
        }
    }

    /// Whether the directive has a parameter of this name.
    pub(super) fn has(&mut self, name: &'static str) -> bool {
        self.find(name).is_some()
    }

    /// All numbers of a parameter of the type `declared`.
    pub(super) fn numbers(
        &mut self,
        name: &'static str,
        declared: DeclaredType,
    ) -> Result<Option<&'a [f64]>> {
        let Some((parameter, file)) = self.find_declared(name, declared)? else {
            return Ok(None);
        };
        match &parameter.values {
            Values::Numbers(numbers) => Ok(Some(numbers)),
            Values::None => Ok(Some(&[])),
            _ => Err(file.error(&parameter.values_span, format!("`{name}` takes numbers"))),
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
        if let Ok(numbers) = numbers.try_into() {
            return Ok(Some(numbers));
        }
        let expected = if N == 1 {
            "one number"
        } else {
            &format!("{N} numbers")
        };
        let message = format!("`{name}` takes {expected}, found {}", numbers.len());
        Err(self.error_at(name, message))
    }

    /// One number, declared as `float`.
    pub(super) fn number(&mut self, name: &'static str) -> Result<Option<f64>> {
        let number = self.fixed_numbers::<1>(name, DeclaredType::FLOAT)?;
        Ok(number.map(|[number]| number))
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
        let Some((parameter, file)) = self.find_declared(name, DeclaredType::STRING)? else {
            return Ok(None);
        };
        match &parameter.values {
            Values::Strings(strings) if strings.len() == 1 && !strings[0].text.is_empty() => {
                Ok(Some(&strings[0]))
            }
            _ => {
                let message = format!("`{name}` takes one string in quotes that is not empty");
                Err(file.error(&parameter.values_span, message))
            }
        }
    }

    /// The values of the last parameter called `name`, or the name after the keyword.
    fn span_of(&self, name: &str) -> (&'a Span, &'a SourceFile) {
        match self.last(name) {
            Some((parameter, file)) => (&parameter.values_span, file),
            None => (&self.entity.name.span, self.file),
        }
    }

    /// An error that points at the values of the last parameter called `name`.
    pub(super) fn error_at(&self, name: &str, message: impl Into<String>) -> Error {
        let (span, file) = self.span_of(name);
        file.error(span, message)
    }

    /// An error that points at number `index`, counted from 0, of the array called `name`.
    pub(super) fn error_at_number(
        &self,
        name: &str,
        index: usize,
        message: impl Into<String>,
    ) -> Error {
        let (array, file) = self.span_of(name);
        file.error(&parser::number_in(file, array, index), message)
    }

    /// An error that points at the name after the keyword.
    pub(super) fn error_at_name(&self, message: impl Into<String>) -> Error {
        self.file.error(&self.entity.name.span, message)
    }

    /// An error that points at the name after the keyword, with a hint at a parameter that may be a
    /// misspelt `name`.
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

    /// The place of the values of the last parameter called `name`.
    pub(super) fn place_of(&self, name: &str) -> SourceLocation {
        let (span, file) = self.span_of(name);
        file.at(span)
    }

    /// The place of the name after the keyword.
    pub(super) fn place_of_name(&self) -> SourceLocation {
        self.file.at(&self.entity.name.span)
    }

    /// A warning, once a kind, that points at the parameter called `name`.
    pub(super) fn warn(&self, name: &str, message: impl Into<String>, warnings: &mut Warnings) {
        let kind = format!("{} {} {name}", self.keyword, self.entity.name.text);
        warnings.add(kind, || Diagnostic::new(message).at(self.place_of(name)));
    }

    /// A warning, once a kind, that points at the name after the keyword.
    pub(super) fn warn_at_name(&self, kind: &str, diagnostic: Diagnostic, warnings: &mut Warnings) {
        let kind = format!("{} {kind}", self.keyword);
        warnings.add(kind, || diagnostic.at(self.place_of_name()));
    }

    /// Warns of parameters that are unknown, and of those that occur more than once.
    pub(super) fn finish(self, warnings: &mut Warnings) {
        self.warn_of_names(false, warnings);
    }

    /// Like [`Parameters::finish`], but warns only of unknown parameters that look misspelt: for
    /// directives with many parameters that do not matter.
    pub(super) fn finish_with_suggestions(self, warnings: &mut Warnings) {
        self.warn_of_names(true, warnings);
    }

    fn warn_of_names(self, misspelt: bool, warnings: &mut Warnings) {
        let (keyword, entity, file) = (self.keyword, self.entity, self.file);
        self.known.warn_of_repeated(keyword, entity, file, warnings);
        self.known
            .warn_of_unknown(misspelt, keyword, entity, file, warnings);
    }
}
