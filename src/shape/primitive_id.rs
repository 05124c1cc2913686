//! References to primitives.

/// One triangle or quadric of [`super::Geometry`], by its index in the list of its kind.
///
/// Packed into 32 bits: the top bit marks a quadric, the lower 31 are the index. Among primitives
/// of one kind the order of the indices is the order of the primitive numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct PrimitiveId(u32);

const QUADRIC: u32 = 1 << 31;

impl PrimitiveId {
    /// The number of triangles, and of quadrics, that a scene may have.
    pub const MAX_COUNT: usize = QUADRIC as usize;

    /// The first triangle, as a placeholder.
    pub(crate) const FIRST: PrimitiveId = PrimitiveId(0);

    /// Triangle `index`.
    pub fn triangle(index: usize) -> PrimitiveId {
        debug_assert!(index < Self::MAX_COUNT);
        PrimitiveId(index as u32)
    }

    /// Quadric `index`.
    pub fn quadric(index: usize) -> PrimitiveId {
        debug_assert!(index < Self::MAX_COUNT);
        PrimitiveId(index as u32 | QUADRIC)
    }

    /// The id with these [bits](PrimitiveId::to_bits).
    pub(crate) fn from_bits(bits: u32) -> PrimitiveId {
        PrimitiveId(bits)
    }

    /// The 32 bits of the id.
    pub(crate) fn to_bits(self) -> u32 {
        self.0
    }

    /// Tests whether this is a quadric: a sphere, a cylinder or a disk.
    pub fn is_quadric(self) -> bool {
        self.0 & QUADRIC != 0
    }

    /// The index among its kind.
    pub fn index(self) -> usize {
        (self.0 & !QUADRIC) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::PrimitiveId;

    #[test]
    fn fits_in_32_bits_and_comes_back() {
        assert_eq!(size_of::<PrimitiveId>(), 4);
        let last = PrimitiveId::MAX_COUNT - 1;
        assert!(
            PrimitiveId::quadric(last).is_quadric() && !PrimitiveId::triangle(last).is_quadric()
        );
        assert_eq!(
            (
                PrimitiveId::quadric(last).index(),
                PrimitiveId::triangle(last).index()
            ),
            (last, last)
        );
    }
}
