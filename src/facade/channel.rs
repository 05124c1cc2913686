//! The channels of an image, as a user asks for them.

use crate::error::Error;
use crate::film::{Aov, ChannelName};
use crate::named::UnknownName;
use std::fmt;
use std::str::FromStr;

/// What an [`Image`](crate::Image) holds of each pixel.
///
/// The names, such as `"prim"`, are those of `--aov`: [`Channel::name`] returns and `parse` takes
/// them.
#[non_exhaustive]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Channel {
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

impl Channel {
    /// All of them.
    pub const ALL: &'static [Channel] = &[
        Channel::Z,
        Channel::T,
        Channel::A,
        Channel::Id,
        Channel::Prim,
        Channel::Instance,
        Channel::Normal,
        Channel::Point,
        Channel::Uv,
        Channel::Cost,
    ];

    /// The name, as in `--aov`.
    pub fn name(self) -> &'static str {
        self.aov().name()
    }

    /// The number of values of a pixel: 1, 2 or 3.
    pub fn components(self) -> usize {
        self.parts().len()
    }

    /// Whether the values are `u32` rather than `f32`.
    pub fn is_integer(self) -> bool {
        self.parts()[0].is_integer()
    }

    /// The channels of image files that it stands for.
    pub(super) fn parts(self) -> &'static [ChannelName] {
        self.aov().channels()
    }

    pub(super) fn aov(self) -> Aov {
        match self {
            Channel::Z => Aov::Z,
            Channel::T => Aov::T,
            Channel::A => Aov::A,
            Channel::Id => Aov::Id,
            Channel::Prim => Aov::Prim,
            Channel::Instance => Aov::Instance,
            Channel::Normal => Aov::Normal,
            Channel::Point => Aov::Point,
            Channel::Uv => Aov::Uv,
            Channel::Cost => Aov::Cost,
        }
    }
}

impl fmt::Display for Channel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Channel {
    type Err = Error;

    fn from_str(name: &str) -> Result<Channel, Error> {
        let mut all = Channel::ALL.iter().copied();
        all.find(|channel| channel.name() == name).ok_or_else(|| {
            let names: Vec<&str> = Channel::ALL.iter().map(|known| known.name()).collect();
            Error::usage(UnknownName::new(name, &names).to_string())
        })
    }
}
