//! References to primitives.

/// One triangle, quadric or segment of a curve of [`super::Geometry`], by its index in the list of
/// its kind.
///
/// Packed into 32 bits: the top bit is 0 for a triangle, and the lower 31 are the index. Otherwise
/// the next bit is 0 for a quadric and 1 for a segment, and the lower 30 are the index. Among
/// primitives of one kind the order of the indices is the order of the primitive numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct PrimitiveId(u32);

/// The kinds of primitives, each with a list of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PrimitiveKind {
    /// A triangle of a mesh.
    Triangle,
    /// A surface that a quadratic equation describes, such as a sphere.
    Quadric,
    /// A piece of a curve.
    Segment,
}

const CURVED: u32 = 1 << 31;
const SEGMENT: u32 = 1 << 30;

impl PrimitiveId {
    /// The number of triangles that a scene may have.
    pub const MOST_TRIANGLES: usize = CURVED as usize;
    /// The number of quadrics, and of segments, that a scene may have.
    pub const MOST_CURVED: usize = SEGMENT as usize;

    /// The first triangle, as a placeholder.
    pub(crate) const FIRST: PrimitiveId = PrimitiveId(0);

    /// Triangle `index`.
    pub fn triangle(index: usize) -> PrimitiveId {
        debug_assert!(index < Self::MOST_TRIANGLES);
        PrimitiveId(index as u32)
    }

    /// Quadric `index`.
    pub fn quadric(index: usize) -> PrimitiveId {
        debug_assert!(index < Self::MOST_CURVED);
        PrimitiveId(index as u32 | CURVED)
    }

    /// Segment `index`.
    pub fn segment(index: usize) -> PrimitiveId {
        debug_assert!(index < Self::MOST_CURVED);
        PrimitiveId(index as u32 | CURVED | SEGMENT)
    }

    /// The id with these [bits](PrimitiveId::to_bits).
    pub(crate) fn from_bits(bits: u32) -> PrimitiveId {
        PrimitiveId(bits)
    }

    /// The 32 bits of the id.
    pub(crate) fn to_bits(self) -> u32 {
        self.0
    }

    /// Tests whether this is a triangle.
    #[inline]
    pub fn is_triangle(self) -> bool {
        self.0 & CURVED == 0
    }

    /// Its kind.
    #[inline]
    pub fn kind(self) -> PrimitiveKind {
        match self.0 & (CURVED | SEGMENT) {
            CURVED => PrimitiveKind::Quadric,
            bits if bits & CURVED != 0 => PrimitiveKind::Segment,
            _ => PrimitiveKind::Triangle,
        }
    }

    /// The index among its kind.
    #[inline]
    pub fn index(self) -> usize {
        if self.is_triangle() {
            self.0 as usize
        } else {
            (self.0 & !(CURVED | SEGMENT)) as usize
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{PrimitiveId, PrimitiveKind};

    #[test]
    fn fits_in_32_bits_and_comes_back() {
        assert_eq!(size_of::<PrimitiveId>(), 4);
        let last = PrimitiveId::MOST_CURVED - 1;
        for index in [0, last, PrimitiveId::MOST_TRIANGLES - 1] {
            let triangle = PrimitiveId::triangle(index);
            assert!(triangle.is_triangle() && triangle.kind() == PrimitiveKind::Triangle);
            assert_eq!(triangle.index(), index);
        }
        for index in [0, last] {
            let (quadric, segment) = (PrimitiveId::quadric(index), PrimitiveId::segment(index));
            assert!(!quadric.is_triangle() && quadric.kind() == PrimitiveKind::Quadric);
            assert!(!segment.is_triangle() && segment.kind() == PrimitiveKind::Segment);
            assert_eq!((quadric.index(), segment.index()), (index, index));
        }
    }
}
