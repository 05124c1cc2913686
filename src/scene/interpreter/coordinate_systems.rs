//! Coordinate systems: transforms with names.

use super::transforms::Transforms;
use crate::scene::name::{Name, key};
use crate::scene::parser::Text;
use std::collections::HashMap;

/// The coordinate systems of a scene.
#[derive(Default)]
pub(super) struct CoordinateSystems {
    named: HashMap<Name, Transforms>,
    /// For each open import, the earlier meanings of the names that it gave.
    renamed: Vec<HashMap<Name, Option<Transforms>>>,
}

impl CoordinateSystems {
    /// The transforms called `name`.
    pub(super) fn get(&self, name: &Text) -> Option<&Transforms> {
        self.named.get(&*key(name))
    }

    /// Calls `transforms` `name`.
    pub(super) fn set(&mut self, name: Name, transforms: Transforms) {
        let before = self.named.insert(name.clone(), transforms);
        if let Some(renamed) = self.renamed.last_mut() {
            renamed.entry(name).or_insert(before);
        }
    }

    /// Starts an import, whose names end with it.
    pub(super) fn begin_import(&mut self) {
        self.renamed.push(HashMap::new());
    }

    /// Forgets the names that the imported file gave, as in pbrt-v4.
    pub(super) fn end_import(&mut self) {
        for (name, before) in self.renamed.pop().unwrap_or_default() {
            match before {
                Some(transforms) => self.named.insert(name, transforms),
                None => self.named.remove(&name),
            };
        }
    }
}
