//! The channels of an image: what they are called and what they hold.

use std::str::FromStr;

use crate::error::Error;

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
}

impl ChannelName {
    /// Every channel there is.
    pub const ALL: [ChannelName; 7] = {
        let [z, t, a, id, prim] = ChannelName::USUAL;
        [z, t, a, id, prim, ChannelName::Instance, ChannelName::Cost]
    };

    /// Those of an image of which nothing else was said.
    pub const USUAL: [ChannelName; 5] =
        [ChannelName::Z, ChannelName::T, ChannelName::A, ChannelName::Id, ChannelName::Prim];

    /// The name on the command line and in files; capitals count.
    pub fn as_str(self) -> &'static str {
        match self {
            ChannelName::Z => "Z",
            ChannelName::T => "t",
            ChannelName::A => "A",
            ChannelName::Id => "id",
            ChannelName::Prim => "prim",
            ChannelName::Instance => "instance",
            ChannelName::Cost => "cost",
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
        matches!(self, ChannelName::Id | ChannelName::Prim | ChannelName::Instance)
    }
}

impl FromStr for ChannelName {
    type Err = Error;

    fn from_str(name: &str) -> Result<ChannelName, Error> {
        ChannelName::ALL.into_iter().find(|known| known.as_str() == name).ok_or_else(|| {
            let known = ChannelName::ALL.map(ChannelName::as_str).join(", ");
            Error::usage(format!("unknown channel `{name}`")).note(format!("known channels: {known}"))
        })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_they_are_written() {
        for name in ChannelName::ALL {
            assert_eq!(name.as_str().parse::<ChannelName>().unwrap(), name);
        }
    }

    #[test]
    fn an_unknown_name_is_answered_with_the_known_ones() {
        let error = "z".parse::<ChannelName>().unwrap_err().to_string();
        assert_eq!(error, "unknown channel `z`\n   = known channels: Z, t, A, id, prim, instance, cost");
    }
}
