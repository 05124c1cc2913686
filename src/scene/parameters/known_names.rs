//! The parameter names that a directive knows, and the warnings about all others.

use crate::error::Diagnostic;
use crate::scene::parser::{Entity, Parameter};
use crate::scene::source_file::SourceFile;
use crate::scene::spelling;
use crate::scene::warnings::Warnings;

/// The names that a directive knows.
#[derive(Debug, Default)]
pub(super) struct KnownNames {
    /// The names that matter: they were looked up.
    used: Vec<&'static str>,
    /// The names that pbrt knows, but that do not matter here.
    ignored: Vec<&'static str>,
}

impl KnownNames {
    /// Adds a name that matters.
    pub(super) fn add(&mut self, name: &'static str) {
        self.used.push(name);
    }

    /// Adds names that do not matter.
    pub(super) fn ignore(&mut self, names: &[&'static str]) {
        self.ignored.extend_from_slice(names);
    }

    fn iter(&self) -> impl Iterator<Item = &'static str> {
        self.used.iter().chain(&self.ignored).copied()
    }

    /// Warns of parameters that matter and that a later one of the same name overrides, as in pbrt.
    pub(super) fn warn_of_repeated(
        &self,
        keyword: &str,
        entity: &Entity,
        file: &SourceFile,
        warnings: &mut Warnings,
    ) {
        let mut rest = &entity.parameters[..];
        while let Some((parameter, later)) = rest.split_first() {
            rest = later;
            let name = &parameter.name;
            let matters = || self.used.iter().any(|known| name == known);
            if !later.is_empty() && matters() && later.iter().any(|other| other.name == *name) {
                warnings.add(format!("repeated {keyword} {name}"), || {
                    let message = format!("`{name}` is set more than once: the last one counts");
                    Diagnostic::new(message).at(file.at(&parameter.span))
                });
            }
        }
    }

    /// Warns of unknown parameters: of all, or of those that look like `misspelt` known ones.
    pub(super) fn warn_of_unknown(
        &self,
        misspelt: bool,
        keyword: &str,
        entity: &Entity,
        file: &SourceFile,
        warnings: &mut Warnings,
    ) {
        for parameter in self.unknown(entity) {
            let name = &parameter.name;
            let closest = spelling::closest(name, self.iter());
            if misspelt && closest.is_none() {
                continue;
            }
            let kind = match misspelt {
                true => format!("unknown {keyword} {name}"),
                false => format!("unknown {keyword} {} {name}", entity.name.text),
            };
            warnings.add(kind, || {
                let entity = &entity.name.text;
                let message = format!("{keyword} \"{entity}\" has no parameter `{name}`: ignored");
                let diagnostic = Diagnostic::new(message).at(file.at(&parameter.span));
                match closest {
                    Some(known) => diagnostic.note(format!("did you mean `{known}`?")),
                    None => diagnostic,
                }
            });
        }
    }

    fn unknown<'a>(&self, entity: &'a Entity) -> impl Iterator<Item = &'a Parameter<'a>> {
        let parameters = entity.parameters.iter();
        parameters.filter(|parameter| !self.iter().any(|known| parameter.name == known))
    }
}
