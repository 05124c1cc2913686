//! What directives change for those that follow: the current transform, defaults of shapes, and blocks around them.

use super::parser::ActiveTransform;
use super::shape_defaults::ShapeDefaults;
use super::source::Place;
use crate::geometry::{RoundedTransform, Transform};
use std::collections::HashMap;
use std::sync::Arc;

/// The kinds of block, each with an end of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Block {
    /// `AttributeBegin` to `AttributeEnd`.
    Attribute,
    /// `TransformBegin` to `TransformEnd`.
    Transform,
    /// `ObjectBegin` to `ObjectEnd`.
    Object,
    /// A file that is read with a state of its own.
    Import,
}

impl Block {
    /// The directive that opens it.
    pub(super) fn begin(self) -> &'static str {
        match self {
            Block::Attribute => "AttributeBegin",
            Block::Transform => "TransformBegin",
            Block::Object => "ObjectBegin",
            Block::Import => "Import",
        }
    }

    /// The directive that closes it.
    pub(super) fn end(self) -> &'static str {
        match self {
            Block::Attribute => "AttributeEnd",
            Block::Transform => "TransformEnd",
            Block::Object => "ObjectEnd",
            Block::Import => "the end of the imported file",
        }
    }
}

/// A block that is not closed yet.
pub(super) struct OpenBlock {
    pub(super) block: Block,
    /// Where it began.
    pub(super) place: Place,
    outer: Transforms,
    active: ActiveTransform,
    reverses_orientation: bool,
    /// How many defaults of shapes there were.
    defaults: usize,
}

/// The transform at the start time and, where it is another, at the end time.
#[derive(Clone)]
struct Transforms {
    start: Transform,
    rounded: Option<Arc<RoundedTransform>>,
    end: Option<Box<Transform>>,
}

/// The current transform with what surrounds it.
///
/// As in pbrt-v4 every kind of block holds all of the state. In v3 a block of transforms does not hold `ReverseOrientation`; the rest of what
/// is here are transforms there.
pub(super) struct GraphicsState {
    /// The current transform and its tracked inverse (rule R3), at the start time.
    pub(super) current: Transform,
    /// It again with the errors of its entries, where roundings are followed.
    pub(super) rounded: Option<Arc<RoundedTransform>>,
    /// That of the end time where it differs: kept only to know what moves.
    end: Option<Box<Transform>>,
    /// Which of the two the directives change.
    pub(super) active: ActiveTransform,
    /// Whether `ReverseOrientation` was there an odd number of times.
    pub(super) reverses_orientation: bool,
    /// What `Attribute "shape"` has set.
    pub(super) defaults: ShapeDefaults,
    open: Vec<OpenBlock>,
    named: HashMap<String, Transforms>,
}

impl GraphicsState {
    pub(super) fn new() -> GraphicsState {
        GraphicsState {
            current: Transform::IDENTITY,
            rounded: None,
            end: None,
            active: ActiveTransform::All,
            reverses_orientation: false,
            defaults: ShapeDefaults::default(),
            open: Vec::new(),
            named: HashMap::new(),
        }
    }

    /// The world's own transform: nothing of the camera's is left, nor what else has no meaning before the world.
    pub(super) fn begin_world(&mut self) {
        (self.current, self.end, self.active) = (Transform::IDENTITY, None, ActiveTransform::All);
        self.reverses_orientation = false;
        self.rounded = self.rounded.as_ref().map(|_| Arc::new(RoundedTransform::IDENTITY));
        self.name("world");
    }

    /// Whether directives change the transform of the start time, which is the one that is rendered.
    pub(super) fn changes_start(&self) -> bool {
        self.active != ActiveTransform::EndTime
    }

    /// The current transform becomes `current * leaf`. `rounded` is the leaf with its errors, where they are followed.
    pub(super) fn concat(&mut self, leaf: &Transform, rounded: impl FnOnce() -> RoundedTransform) {
        self.change(|current| current.times(leaf));
        self.change_rounded(|current| current.times(&rounded()));
    }

    /// `transform` takes the place of the current transform. `rounded` is as for `concat`.
    pub(super) fn replace(&mut self, transform: &Transform, rounded: impl FnOnce() -> RoundedTransform) {
        self.change(|_| *transform);
        self.change_rounded(|_| rounded());
    }

    fn change_rounded(&mut self, changed: impl FnOnce(&RoundedTransform) -> RoundedTransform) {
        if let (true, Some(rounded)) = (self.changes_start(), &mut self.rounded) {
            *rounded = Arc::new(changed(rounded));
        }
    }

    fn change(&mut self, changed: impl Fn(&Transform) -> Transform) {
        if self.end.is_none() && self.active != ActiveTransform::All {
            self.end = Some(Box::new(self.current));
        }
        if self.active != ActiveTransform::StartTime
            && let Some(end) = &mut self.end
        {
            **end = changed(end);
        }
        if self.changes_start() {
            self.current = changed(&self.current);
        }
        if self.end.as_ref().is_some_and(|end| end.matrix.bits() == self.current.matrix.bits()) {
            self.end = None;
        }
    }

    /// Whether the current transform at the end time is another than at the start time.
    pub(super) fn is_moving(&self) -> bool {
        self.end.is_some()
    }

    /// Opens a block.
    pub(super) fn begin(&mut self, block: Block, place: Place) {
        let (outer, active, defaults) = (self.transforms(), self.active, self.defaults.len());
        let reverses_orientation = self.reverses_orientation;
        self.open.push(OpenBlock { block, place, outer, active, reverses_orientation, defaults });
    }

    /// Closes the innermost block, which must be a `block`.
    ///
    /// # Errors
    /// What is open instead: nothing, or a block of another kind.
    pub(super) fn end(&mut self, block: Block) -> Result<(), Option<Block>> {
        match self.open.pop_if(|open| open.block == block) {
            Some(open) => {
                self.restore(open.outer);
                self.active = open.active;
                self.reverses_orientation = open.reverses_orientation;
                self.defaults.truncate(open.defaults);
                Ok(())
            }
            None => Err(self.open.last().map(|open| open.block)),
        }
    }

    /// The innermost block that is still open.
    pub(super) fn innermost(&self) -> Option<&OpenBlock> {
        self.open.last()
    }

    fn transforms(&self) -> Transforms {
        Transforms { start: self.current, rounded: self.rounded.clone(), end: self.end.clone() }
    }

    fn restore(&mut self, transforms: Transforms) {
        (self.current, self.rounded, self.end) = (transforms.start, transforms.rounded, transforms.end);
    }

    /// Gives a name to the current transform.
    pub(super) fn name(&mut self, name: &str) {
        self.named.insert(name.to_owned(), self.transforms());
    }

    /// Gives a name to the inverse of the current transform.
    pub(super) fn name_inverse(&mut self, name: &str) {
        let end = self.end.as_ref().map(|end| Box::new(end.inverted()));
        let rounded = self.rounded.as_ref().map(|rounded| Arc::new(rounded.inverted()));
        self.named.insert(name.to_owned(), Transforms { start: self.current.inverted(), rounded, end });
    }

    /// Makes the transform called `name` the current one; whether there is one.
    pub(super) fn recall(&mut self, name: &str) -> bool {
        let found = self.named.get(name).cloned();
        let is_known = found.is_some();
        found.into_iter().for_each(|transforms| self.restore(transforms));
        is_known
    }
}
