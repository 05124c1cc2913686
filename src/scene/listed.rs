//! Items of a scene that reports list: the first ones, and the number of all.

/// The first 20 items, and the number of all.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Listed<T> {
    /// The first items.
    pub first: Vec<T>,
    /// The number of all items.
    pub count: u64,
}

/// A shape that rays pass through, since it only bounds a medium or its alpha hides it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Boundary {
    /// The type of the shape.
    pub shape: String,
    /// File, line and column of the `Shape` statement.
    pub place: String,
}

/// A texture that shapes use as their alpha.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AlphaTexture {
    /// Its name as the file spells it.
    pub name: String,
    /// File, line and column of the name in its definition.
    pub place: String,
}

/// An object that no instance shows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnusedObject {
    /// Its name as the file spells it.
    pub name: String,
    /// File, line and column of the name.
    pub place: String,
}

/// The most items that are listed.
pub(super) const MAX_LISTED: usize = 20;

impl<T> Listed<T> {
    pub(super) fn add(&mut self, item: impl FnOnce() -> T) {
        self.count += 1;
        if self.first.len() < MAX_LISTED {
            self.first.push(item());
        }
    }
}

impl<T> Default for Listed<T> {
    fn default() -> Listed<T> {
        Listed {
            first: Vec::new(),
            count: 0,
        }
    }
}
