//! Named textures of numbers, which shapes use as their alpha.
//!
//! A texture is made, and its image read, when a shape first needs it. In pbrt-v3 a name that a
//! block defines again means the texture before it when the block ends; in pbrt-v4 names never
//! change and outlive their blocks. Here both hold: a block gives back the names that it took, and
//! keeps those that it made.

mod classes;
mod decoded_image;
mod definition;
pub(super) mod encoding;
mod exr_image;
pub(super) mod image_cache;
mod image_parameters;
pub(super) mod image_refusal;
mod made;
mod texture_parameters;

pub(super) use definition::{Definition, Unusable};

use super::name::{Name, key};
use super::parser::{Text, TextureDirective};
use super::source_span::SourceSpan;
use std::collections::HashMap;
use std::sync::Arc;

/// The textures that a scene has defined so far.
#[derive(Default)]
pub(super) struct Textures {
    defined: HashMap<Name, Arc<Definition>>,
    /// The definitions that others have replaced, in order: blocks put them back.
    replaced: Vec<(Name, Arc<Definition>)>,
}

impl Textures {
    /// Defines a texture at `at`, which spans the whole directive.
    pub(super) fn define(&mut self, texture: &TextureDirective, at: &SourceSpan) {
        let definition = Arc::new(Definition::new(texture, at, |name| self.find(name)));
        let name = Name::new(&texture.name);
        if let Some(before) = self.defined.insert(name.clone(), definition) {
            self.replaced.push((name, before));
        }
    }

    /// The texture that a name means now.
    pub(super) fn find(&self, name: &Text) -> Option<&Arc<Definition>> {
        self.defined.get(&*key(name))
    }

    /// All names, in no order.
    pub(super) fn names(&self) -> impl Iterator<Item = String> {
        self.defined.keys().map(Name::to_string)
    }

    /// The number of definitions that were replaced so far.
    pub(super) fn save(&self) -> usize {
        self.replaced.len()
    }

    /// Puts back all definitions that were replaced since there were `count`.
    pub(super) fn restore(&mut self, count: usize) {
        while self.replaced.len() > count
            && let Some((name, before)) = self.replaced.pop()
        {
            self.defined.insert(name, before);
        }
    }
}
