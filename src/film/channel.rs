//! The channels of an image: their names and their samples.

use crate::named::named;

/// The kind of a channel.
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
    /// Number of the object instance that was hit, from 1; 0 for a miss and for primitives in no
    /// instance, `u32`.
    Instance,
    /// Node boxes and primitives that the pixel's ray tests when it is traced alone through the
    /// whole tree, `u32`.
    Cost,
    /// First component of the geometric normal: a unit vector in world space, on the side that
    /// [pbrt takes for the front](crate::shape::SurfacePoint). This and the following channels
    /// are `f32`, and 0 for a miss.
    Nx,
    /// Second component of the normal.
    Ny,
    /// Third component of the normal.
    Nz,
    /// First coordinate of the point of the hit, in world space.
    Px,
    /// Its second coordinate.
    Py,
    /// Its third coordinate.
    Pz,
    /// First parameter of the surface at the hit, as in pbrt.
    U,
    /// Its second parameter.
    V,
}

// Names in files; case matters.
named!(ChannelName:
    Z => "Z", T => "t", A => "A", Id => "id", Prim => "prim", Instance => "instance",
    Cost => "cost", Nx => "N.X", Ny => "N.Y", Nz => "N.Z", Px => "P.X", Py => "P.Y", Pz => "P.Z",
    U => "u", V => "v",
);

impl ChannelName {
    /// The channels of an image if the user asks for none.
    pub const USUAL: [ChannelName; 5] = [
        ChannelName::Z,
        ChannelName::T,
        ChannelName::A,
        ChannelName::Id,
        ChannelName::Prim,
    ];

    /// Channels that describe the surface at the hit.
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

    /// Returns true if the samples are integers (`u32`) rather than `f32`.
    pub fn is_integer(self) -> bool {
        self.is_number_of_hit() || self == ChannelName::Cost
    }

    /// Returns true for depths, whose value at a miss the user chooses.
    pub fn is_depth(self) -> bool {
        matches!(self, ChannelName::Z | ChannelName::T)
    }

    /// Returns true for numbers that identify what was hit; they are 0 at a miss.
    pub fn is_number_of_hit(self) -> bool {
        matches!(
            self,
            ChannelName::Id | ChannelName::Prim | ChannelName::Instance
        )
    }

    /// Returns true for a channel of [`ChannelName::SURFACE`].
    pub fn is_of_surface(self) -> bool {
        ChannelName::SURFACE.contains(&self)
    }
}

/// The values of one channel, row by row of the data window, from the top.
#[derive(Debug, Clone, PartialEq)]
pub enum Samples {
    /// Measured values: depths, coordinates.
    F32(Vec<f32>),
    /// Identifiers and counts.
    U32(Vec<u32>),
}

impl Samples {
    /// The number of values.
    pub fn len(&self) -> usize {
        match self {
            Samples::F32(values) => values.len(),
            Samples::U32(values) => values.len(),
        }
    }

    /// Returns true if there is no value.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// One channel of an image.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// The kind of the channel.
    pub name: ChannelName,
    /// One sample a pixel of the data window.
    pub samples: Samples,
}
