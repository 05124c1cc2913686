//! Arbitrary output variables, as renderers call what a picture holds beside colours: the channels that are asked for by one name.

use super::ChannelName;
use crate::error::Error;
use std::str::FromStr;

/// One or several channels that belong together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aov {
    /// A channel by itself.
    Lone(ChannelName),
    /// `N.X`, `N.Y` and `N.Z`.
    Normal,
    /// `P.X`, `P.Y` and `P.Z`.
    Point,
    /// `u` and `v`.
    Uv,
}

impl Aov {
    /// Every one there is. Together they have every channel, once.
    pub const ALL: [Aov; 10] = {
        let [z, t, a, id, prim] = Aov::USUAL;
        let (instance, cost) = (
            Aov::Lone(ChannelName::Instance),
            Aov::Lone(ChannelName::Cost),
        );
        [
            z,
            t,
            a,
            id,
            prim,
            instance,
            Aov::Normal,
            Aov::Point,
            Aov::Uv,
            cost,
        ]
    };

    /// Those of an image of which nothing else was said: [`ChannelName::USUAL`].
    pub const USUAL: [Aov; 5] = {
        let [z, t, a, id, prim] = ChannelName::USUAL;
        [
            Aov::Lone(z),
            Aov::Lone(t),
            Aov::Lone(a),
            Aov::Lone(id),
            Aov::Lone(prim),
        ]
    };

    /// The name on the command line; capitals count.
    pub fn as_str(self) -> &'static str {
        match self {
            Aov::Lone(channel) => channel.as_str(),
            Aov::Normal => "N",
            Aov::Point => "P",
            Aov::Uv => "uv",
        }
    }

    /// What it stands for.
    pub fn channels(self) -> Vec<ChannelName> {
        use ChannelName::{Nx, Ny, Nz, Px, Py, Pz, U, V};
        match self {
            Aov::Lone(channel) => vec![channel],
            Aov::Normal => vec![Nx, Ny, Nz],
            Aov::Point => vec![Px, Py, Pz],
            Aov::Uv => vec![U, V],
        }
    }
}

impl FromStr for Aov {
    type Err = Error;

    fn from_str(name: &str) -> Result<Aov, Error> {
        Aov::ALL
            .into_iter()
            .find(|known| known.as_str() == name)
            .ok_or_else(|| {
                let known = Aov::ALL.map(Aov::as_str).join(", ");
                Error::usage(format!("unknown AOV `{name}`")).note(format!("known AOVs: {known}"))
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_they_are_written() {
        for aov in Aov::ALL {
            assert_eq!(aov.as_str().parse::<Aov>().unwrap(), aov);
        }
    }

    #[test]
    fn an_unknown_name_is_answered_with_the_known_ones() {
        let error = "z".parse::<Aov>().unwrap_err().to_string();
        assert_eq!(
            error,
            "unknown AOV `z`\n   = known AOVs: Z, t, A, id, prim, instance, N, P, uv, cost"
        );
    }

    #[test]
    fn every_channel_is_in_one() {
        let channels: Vec<ChannelName> = Aov::ALL.into_iter().flat_map(Aov::channels).collect();
        let times = |channel| channels.iter().filter(|found| **found == channel).count();
        assert!(
            ChannelName::ALL
                .into_iter()
                .all(|channel| times(channel) == 1)
        );
        assert_eq!(channels.len(), ChannelName::ALL.len());
        assert_eq!(Aov::USUAL.map(Aov::channels).concat(), ChannelName::USUAL);
    }
}
