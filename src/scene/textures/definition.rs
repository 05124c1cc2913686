//! A texture as a scene defines it.

use crate::error::{Diagnostic, Error, ErrorKind};
use crate::scene::parser::{Entity, Text, TextureDirective, Values};
use crate::scene::source_file::SourceFile;
use crate::scene::source_span::SourceSpan;
use crate::texture::FloatTexture;
use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

/// A texture, made when it is first needed.
pub(crate) struct Definition {
    pub(super) name: String,
    /// Its name in the file.
    pub(super) at: SourceSpan,
    /// Its type and parameters; `None` if it is too large.
    pub(super) entity: Option<Entity<'static>>,
    pub(super) file: Arc<SourceFile>,
    /// The textures that its parameters name, as defined before it: so no texture contains itself.
    pub(super) parts: HashMap<String, Arc<Definition>>,
    /// The number of textures in it, each as often as it is named.
    size: usize,
    pub(super) made: OnceLock<Result<Arc<FloatTexture>, Unusable>>,
}

/// Why a texture cannot be used.
#[derive(Debug, Clone)]
pub(crate) struct Unusable {
    /// A text that all textures share that are wrong in this way.
    pub(crate) kind: String,
    pub(crate) diagnostic: Box<Diagnostic>,
    /// Set if the scene cannot be read at all: memory, or a limit, does not allow it.
    pub(crate) fatal: Option<ErrorKind>,
}

impl Unusable {
    pub(super) fn new(kind: impl Into<String>, diagnostic: Diagnostic) -> Unusable {
        Unusable {
            kind: kind.into(),
            diagnostic: Box::new(diagnostic),
            fatal: None,
        }
    }

    /// The same with a note.
    pub(super) fn note(self, note: &str) -> Unusable {
        Unusable {
            diagnostic: Box::new(self.diagnostic.note(note)),
            ..self
        }
    }
}

impl From<Error> for Unusable {
    fn from(error: Error) -> Unusable {
        let diagnostic = error.diagnostic().clone();
        Unusable::new(diagnostic.message.clone(), diagnostic)
    }
}

/// The most textures in one, and bytes of a directive: a value takes as long as its textures.
pub(super) const MAX_SIZE: usize = 256;
pub(super) const MAX_TEXT: usize = 1 << 16;

impl Definition {
    /// The texture of a directive at `at`; `find` returns the texture that a name means there.
    pub(super) fn new<'a>(
        directive: &TextureDirective,
        at: &SourceSpan,
        find: impl Fn(&Text) -> Option<&'a Arc<Definition>>,
    ) -> Definition {
        let mut parts = HashMap::new();
        let mut size: usize = 1;
        for parameter in &directive.entity.parameters {
            if let ("texture", Values::Strings(names)) = (&*parameter.type_name, &parameter.values)
                && let [name] = &names[..]
            {
                let part = find(name).cloned();
                size = size.saturating_add(part.as_ref().map_or(0, |part| part.size));
                // The last parameter of a name counts, as in pbrt.
                match part {
                    Some(part) => parts.insert(parameter.name.clone().into_owned(), part),
                    None => parts.remove(&*parameter.name),
                };
            }
        }
        let is_small = size <= MAX_SIZE && at.span().len() <= MAX_TEXT;
        if !is_small {
            parts.clear();
        }
        Definition {
            name: directive.name.text.clone().into_owned(),
            at: at.beside(&directive.name.span).kept(),
            entity: is_small.then(|| directive.entity.to_owned()),
            file: match is_small {
                true => SourceFile::kept(at.file(), at.span()),
                false => SourceFile::kept(at.file(), &directive.name.span),
            },
            parts,
            size,
            made: OnceLock::new(),
        }
    }

    /// Its name as the file spells it.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// Where its name stands.
    pub(crate) fn at(&self) -> &SourceSpan {
        &self.at
    }

    /// Whether it has been made before.
    pub(crate) fn is_made(&self) -> bool {
        self.made.get().is_some()
    }
}
