//! The channels of an image: what they are called and what they hold.

/// What a channel says about each pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ChannelName {
    /// Depth along the view axis, `f32`.
    Z,
    /// Distance from the ray's origin, `f32`.
    T,
    /// 1 for a hit, 0 for a miss, `f32`.
    A,
    /// Number of the shape that was hit, from 1; 0 for a miss, `u32`.
    Id,
    /// Number of the primitive that was hit, from 1; 0 for a miss, `u32`.
    Prim,
    /// Number of the object instance that was hit, from 1; 0 for a miss and for what is in no instance, `u32`.
    Instance,
    /// Boxes of nodes and primitives that the pixel's ray is tested against when it goes alone through the whole tree, `u32`.
    Cost,
    /// The geometric normal, a unit vector in world space, to the side that [pbrt takes for the front](crate::shape::SurfacePoint);
    /// its first component; `f32`, and 0 for a miss, as are those that follow.
    Nx,
    /// Its second component.
    Ny,
    /// Its third component.
    Nz,
    /// The point where the ray meets the surface, in world space: its first coordinate.
    Px,
    /// Its second coordinate.
    Py,
    /// Its third coordinate.
    Pz,
    /// The first of the surface's own coordinates there, as pbrt has them.
    U,
    /// The second one.
    V,
}

impl ChannelName {
    /// Every channel there is.
    pub const ALL: [ChannelName; 15] = {
        let [z, t, a, id, prim] = ChannelName::USUAL;
        let [nx, ny, nz, px, py, pz, u, v] = ChannelName::SURFACE;
        [
            z,
            t,
            a,
            id,
            prim,
            ChannelName::Instance,
            ChannelName::Cost,
            nx,
            ny,
            nz,
            px,
            py,
            pz,
            u,
            v,
        ]
    };

    /// Those of an image of which nothing else was said.
    pub const USUAL: [ChannelName; 5] = [
        ChannelName::Z,
        ChannelName::T,
        ChannelName::A,
        ChannelName::Id,
        ChannelName::Prim,
    ];

    /// Those that say what the surface is like where it is hit.
    pub const SURFACE: [ChannelName; 8] = [
        ChannelName::Nx,
        ChannelName::Ny,
        ChannelName::Nz,
        ChannelName::Px,
        ChannelName::Py,
        ChannelName::Pz,
        ChannelName::U,
        ChannelName::V,
    ];

    /// The name in files; capitals count.
    pub fn as_str(self) -> &'static str {
        match self {
            ChannelName::Z => "Z",
            ChannelName::T => "t",
            ChannelName::A => "A",
            ChannelName::Id => "id",
            ChannelName::Prim => "prim",
            ChannelName::Instance => "instance",
            ChannelName::Cost => "cost",
            ChannelName::Nx => "N.X",
            ChannelName::Ny => "N.Y",
            ChannelName::Nz => "N.Z",
            ChannelName::Px => "P.X",
            ChannelName::Py => "P.Y",
            ChannelName::Pz => "P.Z",
            ChannelName::U => "u",
            ChannelName::V => "v",
        }
    }

    /// Whether the samples are whole numbers (`u32`) and not `f32`.
    pub fn is_integer(self) -> bool {
        self.is_number_of_hit() || self == ChannelName::Cost
    }

    /// Whether the samples are depths, which hold at a miss what was asked for.
    pub fn is_depth(self) -> bool {
        matches!(self, ChannelName::Z | ChannelName::T)
    }

    /// Whether the samples are numbers of what was hit, 0 for a miss.
    pub fn is_number_of_hit(self) -> bool {
        matches!(
            self,
            ChannelName::Id | ChannelName::Prim | ChannelName::Instance
        )
    }

    /// Whether it is one of [`ChannelName::SURFACE`].
    pub fn is_of_surface(self) -> bool {
        ChannelName::SURFACE.contains(&self)
    }
}

/// The values of one channel, row by row of the data window, from the top.
#[derive(Debug, Clone, PartialEq)]
pub enum Samples {
    /// Measures.
    F32(Vec<f32>),
    /// Numbers of things.
    U32(Vec<u32>),
}

impl Samples {
    /// How many values there are.
    pub fn len(&self) -> usize {
        match self {
            Samples::F32(values) => values.len(),
            Samples::U32(values) => values.len(),
        }
    }

    /// Whether there is no value.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// One channel of an image.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// What the samples mean.
    pub name: ChannelName,
    /// One sample per pixel of the data window.
    pub samples: Samples,
}
