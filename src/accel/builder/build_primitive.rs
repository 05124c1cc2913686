//! The record that a build sorts and partitions: a box and the bits of its primitive.

use super::f32x4::{F32x4, LaneBox};
use crate::accel::space::Box32;
use rayon::prelude::*;

/// The box of a primitive, of an instance or of a treelet, in 32 bytes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BuildPrimitive {
    /// Each spare lane holds half of the bits that identify the primitive.
    corners: LaneBox,
}

const _: () = assert!(size_of::<BuildPrimitive>() == 32);

/// A number from 1 to below 2 with 16 bits in its mantissa. Sums of lanes include it; as the bits
/// of an `f32` small numbers would be subnormal, which makes sums many times slower.
fn with_bits(bits: u32) -> f32 {
    f32::from_bits(1f32.to_bits() | bits & 0xffff)
}

fn bits_in(number: f32) -> u32 {
    number.to_bits() & 0xffff
}

impl BuildPrimitive {
    /// Stands for a primitive that can never be hit, until it is removed.
    pub(super) const DEAD: BuildPrimitive = BuildPrimitive {
        corners: LaneBox::EMPTY,
    };

    /// A primitive that its maker identifies by `bits`.
    pub(crate) fn new(bounds: &Box32, bits: u32) -> BuildPrimitive {
        let ([x0, y0, z0], [x1, y1, z1]) = (bounds.low, bounds.high);
        let low = F32x4([x0, y0, z0, with_bits(bits >> 16)]);
        let high = F32x4([x1, y1, z1, with_bits(bits)]);
        BuildPrimitive {
            corners: LaneBox { low, high },
        }
    }

    /// The box, with arbitrary numbers in the spare lanes.
    #[inline(always)]
    pub(super) fn bounds(&self) -> LaneBox {
        self.corners
    }

    #[inline(always)]
    pub(super) fn bits(&self) -> u32 {
        bits_in(self.corners.low.0[3]) << 16 | bits_in(self.corners.high.0[3])
    }

    /// Twice the centre of the box. The spare lane holds a normal number.
    #[inline(always)]
    pub(super) fn doubled_centre(&self) -> F32x4 {
        self.corners.low.plus(self.corners.high)
    }

    /// Twice the centre of the box along one axis.
    #[inline(always)]
    pub(super) fn centre_along(&self, axis: usize) -> f32 {
        self.corners.low.0[axis] + self.corners.high.0[axis]
    }

    /// Tests for [`BuildPrimitive::DEAD`]: no box of a primitive begins at infinity.
    #[inline]
    pub(super) fn is_dead(&self) -> bool {
        self.corners.low.0[0] == f32::INFINITY
    }
}

/// Lists longer than this are processed by several threads.
pub(super) const PARALLEL: usize = 1 << 16;

/// The part of a long list that a thread takes at a time. It does not depend on the number of
/// threads, so neither does the tree.
pub(super) const CHUNK: usize = PARALLEL / 4;

/// The box around the doubled centres.
pub(super) fn centre_bounds(primitives: &[BuildPrimitive]) -> LaneBox {
    union_of(primitives, |primitive| {
        let centre = primitive.doubled_centre();
        LaneBox {
            low: centre,
            high: centre,
        }
    })
}

/// The box around all of `primitives`.
pub(super) fn bounds_of(primitives: &[BuildPrimitive]) -> Box32 {
    union_of(primitives, BuildPrimitive::bounds).to_box()
}

#[inline]
fn union_of(
    primitives: &[BuildPrimitive],
    part: impl Fn(&BuildPrimitive) -> LaneBox + Sync,
) -> LaneBox {
    let of_chunk = |chunk: &[BuildPrimitive]| {
        chunk.iter().fold(LaneBox::EMPTY, |bounds, primitive| {
            part(primitive).union(bounds)
        })
    };
    if primitives.len() < PARALLEL {
        return of_chunk(primitives);
    }
    let boxes = primitives.par_chunks(CHUNK).map(of_chunk);
    boxes.reduce(|| LaneBox::EMPTY, LaneBox::union)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bits_of_a_primitive_survive_and_do_not_disturb_sums() {
        let bounds = Box32 {
            low: [-1.0, 2.0, 3.0],
            high: [4.0, 5.0, 6.0],
        };
        for bits in [
            0,
            1,
            0xffff,
            0x1_0000,
            0x1234_5678,
            0x7fff_ffff,
            0x8000_0000,
            0xffff_ffff,
        ] {
            let placed = BuildPrimitive::new(&bounds, bits);
            assert_eq!((placed.bits(), placed.bounds().to_box()), (bits, bounds));
            assert!((2.0..4.0).contains(&placed.doubled_centre().0[3]));
            assert!(!placed.is_dead());
        }
    }
}
