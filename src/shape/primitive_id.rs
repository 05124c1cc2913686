//! References to primitives.

/// One triangle or sphere of [`super::Shapes`], by its place in the store of its kind. Cylinders and disks are in the store of
/// spheres.
///
/// Packed into 32 bits: the top bit tells a sphere, the lower 31 are the index. Among primitives of one kind the
/// order of the indices is the order of the primitive numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct PrimitiveId(u32);

const SPHERE: u32 = 1 << 31;

impl PrimitiveId {
    /// Triangles or spheres at most.
    pub const MAX_COUNT: usize = SPHERE as usize;

    /// The first triangle of the store, for places that have to hold something.
    pub(crate) const FIRST: PrimitiveId = PrimitiveId(0);

    /// Triangle `index` of the store.
    pub fn triangle(index: usize) -> PrimitiveId {
        debug_assert!(index < Self::MAX_COUNT);
        PrimitiveId(index as u32)
    }

    /// Sphere `index` of the store.
    pub fn sphere(index: usize) -> PrimitiveId {
        debug_assert!(index < Self::MAX_COUNT);
        PrimitiveId(index as u32 | SPHERE)
    }

    /// What [`PrimitiveId::to_bits`] gave.
    pub(crate) fn from_bits(bits: u32) -> PrimitiveId {
        PrimitiveId(bits)
    }

    /// All that there is to it, for places that hold numbers.
    pub(crate) fn to_bits(self) -> u32 {
        self.0
    }

    /// Whether this is a sphere.
    pub fn is_sphere(self) -> bool {
        self.0 & SPHERE != 0
    }

    /// The place in the store of its kind.
    pub fn index(self) -> usize {
        (self.0 & !SPHERE) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::PrimitiveId;

    #[test]
    fn fits_in_32_bits_and_comes_back() {
        assert_eq!(size_of::<PrimitiveId>(), 4);
        let last = PrimitiveId::MAX_COUNT - 1;
        assert!(PrimitiveId::sphere(last).is_sphere() && !PrimitiveId::triangle(last).is_sphere());
        assert_eq!(
            (
                PrimitiveId::sphere(last).index(),
                PrimitiveId::triangle(last).index()
            ),
            (last, last)
        );
    }
}
