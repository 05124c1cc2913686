//! What directives change for those that follow: the current transform, defaults of shapes, and blocks around them.

use super::blocks::{Block, OpenBlock};
use super::materials::Material;
use super::name::Name;
use super::parser::ActiveTransform;
use super::shape_defaults::ShapeDefaults;
use super::source::Place;
use crate::geometry::{RoundedTransform, Transform};
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

/// The transform at the start time and, where it is another, at the end time.
#[derive(Clone)]
pub(super) struct Transforms {
    start: Transform,
    rounded: Option<Arc<RoundedTransform>>,
    end: Option<Box<Transform>>,
    unusable: Option<Rc<Unusable>>,
}

/// Why a transform takes points nowhere, and the matrix that began it.
pub(super) struct Unusable {
    pub(super) message: String,
    pub(super) place: Place,
}

/// What a block takes back when it ends.
pub(super) struct Saved {
    transforms: Transforms,
    active: ActiveTransform,
    reverses_orientation: bool,
    material: Material,
    is_light: bool,
    /// How many defaults of shapes there were.
    defaults: usize,
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
    /// What the current material makes of shapes.
    pub(super) material: Material,
    /// Whether shapes emit light: `AreaLightSource`.
    pub(super) is_light: bool,
    /// Why nothing can be placed by the current transform, where that is so.
    pub(super) unusable: Option<Rc<Unusable>>,
    open: Vec<OpenBlock>,
    named: HashMap<Name, Transforms>,
    /// Of each open import, what the names that it gave meant before.
    renamed: Vec<HashMap<Name, Option<Transforms>>>,
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
            material: Material::default(),
            is_light: false,
            unusable: None,
            open: Vec::new(),
            named: HashMap::new(),
            renamed: Vec::new(),
        }
    }

    /// The world's own transform: nothing of the camera's is left, nor what else has no meaning before the world.
    pub(super) fn begin_world(&mut self) {
        (self.current, self.end, self.active) = (Transform::IDENTITY, None, ActiveTransform::All);
        self.reverses_orientation = false;
        (self.material, self.is_light) = (Material::default(), false);
        self.unusable = None;
        self.rounded = self
            .rounded
            .as_ref()
            .map(|_| Arc::new(RoundedTransform::IDENTITY));
        self.name(Name::from("world"));
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
    pub(super) fn replace(
        &mut self,
        transform: &Transform,
        rounded: impl FnOnce() -> RoundedTransform,
    ) {
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
        if self
            .end
            .as_ref()
            .is_some_and(|end| end.matrix.bits() == self.current.matrix.bits())
        {
            self.end = None;
        }
    }

    /// Whether the current transform at the end time is another than at the start time.
    pub(super) fn is_moving(&self) -> bool {
        self.end.is_some()
    }

    /// Opens a block.
    pub(super) fn begin(&mut self, block: Block, place: Place) {
        let saved = Saved {
            transforms: self.transforms(),
            active: self.active,
            reverses_orientation: self.reverses_orientation,
            material: self.material.clone(),
            is_light: self.is_light,
            defaults: self.defaults.len(),
        };
        if block == Block::Import {
            self.renamed.push(HashMap::new());
        }
        self.open.push(OpenBlock {
            block,
            place,
            saved,
        });
    }

    /// Closes the innermost block, whatever it is, but for an import: that is closed by nothing in its file. Gives
    /// back what was closed, or `None` where nothing is open.
    pub(super) fn end_innermost(&mut self) -> Option<(Block, Place)> {
        let open = self.open.pop_if(|open| open.block != Block::Import)?;
        self.take_back(open.saved);
        Some((open.block, open.place))
    }

    /// Closes the import that is the innermost block. Coordinate systems that its file named are forgotten, as in
    /// pbrt-v4.
    pub(super) fn end_import(&mut self) {
        if let Some(open) = self.open.pop() {
            self.take_back(open.saved);
        }
        for (name, before) in self.renamed.pop().unwrap_or_default() {
            match before {
                Some(transforms) => self.named.insert(name, transforms),
                None => self.named.remove(&name),
            };
        }
    }

    fn take_back(&mut self, saved: Saved) {
        self.restore(saved.transforms);
        self.active = saved.active;
        self.reverses_orientation = saved.reverses_orientation;
        (self.material, self.is_light) = (saved.material, saved.is_light);
        self.defaults.truncate(saved.defaults);
    }

    fn transforms(&self) -> Transforms {
        Transforms {
            start: self.current,
            rounded: self.rounded.clone(),
            end: self.end.clone(),
            unusable: self.unusable.clone(),
        }
    }

    fn restore(&mut self, transforms: Transforms) {
        let Transforms {
            start,
            rounded,
            end,
            unusable,
        } = transforms;
        (self.current, self.rounded, self.end, self.unusable) = (start, rounded, end, unusable);
    }

    /// Gives a name to the current transform.
    pub(super) fn name(&mut self, name: Name) {
        let transforms = self.transforms();
        self.set_name(name, transforms);
    }

    /// Gives a name to the inverse of the current transform.
    pub(super) fn name_inverse(&mut self, name: Name) {
        let transforms = Transforms {
            start: self.current.inverted(),
            rounded: self
                .rounded
                .as_ref()
                .map(|rounded| Arc::new(rounded.inverted())),
            end: self.end.as_ref().map(|end| Box::new(end.inverted())),
            unusable: self.unusable.clone(),
        };
        self.set_name(name, transforms);
    }

    fn set_name(&mut self, name: Name, transforms: Transforms) {
        let before = self.named.insert(name.clone(), transforms);
        if let Some(renamed) = self.renamed.last_mut() {
            renamed.entry(name).or_insert(before);
        }
    }

    /// Makes the transform called `name`, by its [`key`](super::name::key), the current one; whether there is one.
    pub(super) fn recall(&mut self, name: &[u8]) -> bool {
        let found = self.named.get(name).cloned();
        let is_known = found.is_some();
        found
            .into_iter()
            .for_each(|transforms| self.restore(transforms));
        is_known
    }
}
