//! AOVs (arbitrary output variables): names for one or several channels.

use super::ChannelName;
use crate::named::named;

/// What an image holds of each pixel: one channel of image files, or several that belong together.
///
/// The names, such as `"prim"`, are those of `--aov`.
#[non_exhaustive]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Aov {
    /// `Z`: the depth along the view axis, `f32`; infinity at a miss. For a camera that looks
    /// around, such as a spherical one, the distance.
    Z,
    /// `t`: the distance from the ray's origin, `f32`; infinity at a miss.
    T,
    /// `A`: 1 for a hit, 0 for a miss, `f32`.
    A,
    /// `id`: the number of the `Shape` statement, from 1, `u32`; 0 for a miss.
    Id,
    /// `prim`: the number of the primitive, from 1, `u32`; 0 for a miss. In a scene of more than
    /// 2^32 - 1 primitives, it counts within each instance.
    Prim,
    /// `instance`: the number of the object instance, from 1, `u32`; 0 for a miss and for what is
    /// in no instance.
    Instance,
    /// `N`: the geometric normal in world space, three `f32` of length 1; 0 for a miss.
    Normal,
    /// `P`: the point of the hit in world space, three `f32`; 0 for a miss.
    Point,
    /// `uv`: the parameters of the surface, two `f32`; 0 for a miss.
    Uv,
    /// `cost`: the nodes and primitives that the ray tests when it is traced alone through a tree,
    /// `u32`.
    Cost,
}

// Case matters.
named!(Aov:
    Z => "Z", T => "t", A => "A", Id => "id", Prim => "prim", Instance => "instance",
    Normal => "N", Point => "P", Uv => "uv", Cost => "cost",
);

impl Aov {
    /// The AOVs of an image if the user asks for none: [`ChannelName::USUAL`].
    #[doc(hidden)]
    pub const USUAL: [Aov; 5] = [Aov::Z, Aov::T, Aov::A, Aov::Id, Aov::Prim];

    /// The number of values of a pixel: 1, 2 or 3.
    pub fn components(self) -> usize {
        self.channels().len()
    }

    /// Whether the values are `u32` rather than `f32`.
    pub fn is_integer(self) -> bool {
        self.channels()[0].is_integer()
    }

    /// The channels that the name stands for.
    #[doc(hidden)]
    pub fn channels(self) -> &'static [ChannelName] {
        use ChannelName::*;
        match self {
            Aov::Z => &[Z],
            Aov::T => &[T],
            Aov::A => &[A],
            Aov::Id => &[Id],
            Aov::Prim => &[Prim],
            Aov::Instance => &[Instance],
            Aov::Normal => &[Nx, Ny, Nz],
            Aov::Point => &[Px, Py, Pz],
            Aov::Uv => &[U, V],
            Aov::Cost => &[Cost],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_channel_is_in_exactly_one_aov() {
        let mut channels = Aov::ALL.map(Aov::channels).concat();
        channels.sort();
        let mut all = ChannelName::ALL;
        all.sort();
        assert_eq!(channels, all);
        assert_eq!(Aov::USUAL.map(Aov::channels).concat(), ChannelName::USUAL);
    }
}
