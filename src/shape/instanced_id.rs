//! References to primitives of the whole scene, including those in instances.

use super::PrimitiveId;

/// A primitive in the world: by itself, or in an instance of its object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct InstancedId {
    instance: u32,
    primitive: PrimitiveId,
}

/// Stands for no instance.
const NO_INSTANCE: u32 = u32::MAX;

impl InstancedId {
    /// The most instances.
    pub const MAX_INSTANCES: usize = NO_INSTANCE as usize;

    /// A primitive that belongs to no object.
    #[inline(always)]
    pub const fn alone(primitive: PrimitiveId) -> InstancedId {
        InstancedId {
            instance: NO_INSTANCE,
            primitive,
        }
    }

    /// A primitive of the object of instance `instance`, counted from 0.
    #[inline(always)]
    pub fn in_instance(instance: usize, primitive: PrimitiveId) -> InstancedId {
        debug_assert!(instance < InstancedId::MAX_INSTANCES);
        InstancedId {
            instance: instance as u32,
            primitive,
        }
    }

    /// The number of the instance, counted from 0; `None` for a primitive by itself.
    #[inline(always)]
    pub fn instance(self) -> Option<usize> {
        (self.instance != NO_INSTANCE).then_some(self.instance as usize)
    }

    /// Tests whether it is a triangle by itself.
    #[inline(always)]
    pub(crate) fn is_own_triangle(self) -> bool {
        self.instance == NO_INSTANCE && self.primitive.is_triangle()
    }

    /// The primitive in its store: that of the object, if it is in an instance.
    #[inline(always)]
    pub fn primitive(self) -> PrimitiveId {
        self.primitive
    }

    /// All its bits, for hashing.
    pub(crate) fn to_bits(self) -> u64 {
        u64::from(self.instance) << 32 | u64::from(self.primitive.to_bits())
    }

    /// Another primitive of the same instance, or also by itself.
    #[inline(always)]
    pub(crate) fn sibling(self, primitive: PrimitiveId) -> InstancedId {
        InstancedId { primitive, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_put_in_comes_out() {
        let triangle = PrimitiveId::triangle(7);
        assert_eq!(
            (
                InstancedId::alone(triangle).instance(),
                InstancedId::alone(triangle).primitive()
            ),
            (None, triangle)
        );
        let last = InstancedId::in_instance(InstancedId::MAX_INSTANCES - 1, triangle);
        assert_eq!(
            (last.instance(), last.primitive()),
            (Some(InstancedId::MAX_INSTANCES - 1), triangle)
        );
    }
}
