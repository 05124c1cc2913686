//! References to primitives of the whole scene, those of instances among them.

use super::Primitive;

/// A primitive where it stands in the world: by itself, or in an instance of the object that it belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Placed {
    instance: u32,
    primitive: Primitive,
}

/// In place of an instance's number.
const NO_INSTANCE: u32 = u32::MAX;

impl Placed {
    /// Instances at most.
    pub const MAX_INSTANCES: usize = NO_INSTANCE as usize;

    /// A primitive that belongs to no object.
    #[inline(always)]
    pub const fn alone(primitive: Primitive) -> Placed {
        Placed {
            instance: NO_INSTANCE,
            primitive,
        }
    }

    /// A primitive of the object that instance number `instance`, from 0, places.
    #[inline(always)]
    pub fn in_instance(instance: usize, primitive: Primitive) -> Placed {
        debug_assert!(instance < Placed::MAX_INSTANCES);
        Placed {
            instance: instance as u32,
            primitive,
        }
    }

    /// The number of the instance, from 0, if it is in one.
    #[inline(always)]
    pub fn instance(self) -> Option<usize> {
        (self.instance != NO_INSTANCE).then_some(self.instance as usize)
    }

    /// Its place in the store: the object's, if it is in an instance.
    #[inline(always)]
    pub fn primitive(self) -> Primitive {
        self.primitive
    }

    /// All that there is to it, for hashing.
    pub(crate) fn to_bits(self) -> u64 {
        u64::from(self.instance) << 32 | u64::from(self.primitive.to_bits())
    }

    /// Another primitive of the same instance, or one by itself too.
    #[inline(always)]
    pub(crate) fn sibling(self, primitive: Primitive) -> Placed {
        Placed { primitive, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_put_in_comes_out() {
        let triangle = Primitive::triangle(7);
        assert_eq!(
            (
                Placed::alone(triangle).instance(),
                Placed::alone(triangle).primitive()
            ),
            (None, triangle)
        );
        let last = Placed::in_instance(Placed::MAX_INSTANCES - 1, triangle);
        assert_eq!(
            (last.instance(), last.primitive()),
            (Some(Placed::MAX_INSTANCES - 1), triangle)
        );
    }
}
