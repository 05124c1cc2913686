//! AOVs (arbitrary output variables): names for one or several channels.

use super::ChannelName;
use crate::named::named;

/// One channel, or several that belong together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aov {
    /// Depth along the view axis.
    Z,
    /// Distance from the ray's origin.
    T,
    /// 1 for a hit, 0 for a miss.
    A,
    /// Number of the shape.
    Id,
    /// Number of the primitive.
    Prim,
    /// Number of the object instance.
    Instance,
    /// The geometric normal: `N.X`, `N.Y` and `N.Z`.
    Normal,
    /// The point of the hit: `P.X`, `P.Y` and `P.Z`.
    Point,
    /// The surface's parameters: `u` and `v`.
    Uv,
    /// Node boxes and primitives that the ray tests.
    Cost,
}

// Case matters.
named!(Aov:
    Z => "Z", T => "t", A => "A", Id => "id", Prim => "prim", Instance => "instance",
    Normal => "N", Point => "P", Uv => "uv", Cost => "cost",
);

impl Aov {
    /// The AOVs of an image if the user asks for none: [`ChannelName::USUAL`].
    pub const USUAL: [Aov; 5] = [Aov::Z, Aov::T, Aov::A, Aov::Id, Aov::Prim];

    /// The channels that the name stands for.
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
