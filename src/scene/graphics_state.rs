//! What directives change for those that follow: the current transform, and blocks around it.

use super::source::Place;
use crate::geometry::Transform;
use std::collections::HashMap;

/// The kinds of block, each with an end of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Block {
    /// `AttributeBegin` to `AttributeEnd`. Of the attributes only the transform matters here.
    Attribute,
    /// `TransformBegin` to `TransformEnd`.
    Transform,
    /// `ObjectBegin` to `ObjectEnd`.
    Object,
}

impl Block {
    /// The directive that opens it.
    pub(super) fn begin(self) -> &'static str {
        match self {
            Block::Attribute => "AttributeBegin",
            Block::Transform => "TransformBegin",
            Block::Object => "ObjectBegin",
        }
    }

    /// The directive that closes it.
    pub(super) fn end(self) -> &'static str {
        match self {
            Block::Attribute => "AttributeEnd",
            Block::Transform => "TransformEnd",
            Block::Object => "ObjectEnd",
        }
    }
}

/// A block that is not closed yet.
pub(super) struct OpenBlock {
    pub(super) block: Block,
    /// Where it began.
    pub(super) place: Place,
    outer: Transform,
}

/// The current transform with what surrounds it.
pub(super) struct GraphicsState {
    /// The current transform and its tracked inverse (rule R3).
    pub(super) current: Transform,
    open: Vec<OpenBlock>,
    named: HashMap<String, Transform>,
}

impl GraphicsState {
    pub(super) fn new() -> GraphicsState {
        GraphicsState { current: Transform::IDENTITY, open: Vec::new(), named: HashMap::new() }
    }

    /// The current transform becomes `current * leaf`.
    pub(super) fn concat(&mut self, leaf: &Transform) {
        self.current = self.current.times(leaf);
    }

    /// Opens a block.
    pub(super) fn begin(&mut self, block: Block, place: Place) {
        self.open.push(OpenBlock { block, place, outer: self.current });
    }

    /// Closes the innermost block, which must be a `block`.
    ///
    /// # Errors
    /// What is open instead: nothing, or a block of another kind.
    pub(super) fn end(&mut self, block: Block) -> Result<(), Option<Block>> {
        match self.open.last() {
            Some(open) if open.block == block => {
                self.current = self.open.pop().expect("the block just seen").outer;
                Ok(())
            }
            open => Err(open.map(|open| open.block)),
        }
    }

    /// The innermost block that is still open.
    pub(super) fn innermost(&self) -> Option<&OpenBlock> {
        self.open.last()
    }

    /// Gives a name to `transform`.
    pub(super) fn name(&mut self, name: &str, transform: Transform) {
        self.named.insert(name.to_owned(), transform);
    }

    /// Makes the transform called `name` the current one; whether there is one.
    pub(super) fn recall(&mut self, name: &str) -> bool {
        let found = self.named.get(name);
        if let Some(transform) = found {
            self.current = *transform;
        }
        found.is_some()
    }
}
