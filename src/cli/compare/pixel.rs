//! A pixel that differs, with its values in both images.

use crate::compare::Difference;
use crate::film::{ChannelName, Image, Samples};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};

const FALSE_HIT: &str = "false hit";
const MISSED_HIT: &str = "missed hit";

/// Field names are JSON keys.
#[derive(Debug, Serialize)]
pub(super) struct Pixel {
    x: u32,
    y: u32,
    kind: &'static str,
    /// The error of a depth or a surface.
    ulps: Option<u32>,
    expected: Values,
    found: Values,
}

/// The samples of an image by channel.
#[derive(Debug, Serialize)]
#[serde(transparent)]
struct Values(BTreeMap<&'static str, Sample>);

#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Sample {
    Measure(f32),
    Number(u32),
    /// An infinity or a NaN, which JSON does not have.
    NotFinite(String),
}

impl Pixel {
    /// Pixel number `pixel` of the expected and the found image, which show the same pixels.
    pub(super) fn new(
        [expected, found]: [&Image; 2],
        pixel: usize,
        difference: Difference,
    ) -> Pixel {
        let window = expected.data_window;
        let (number, width) = (pixel as u64, u64::from(window.width()));
        let (column, row) = (number % width, number / width);
        let (kind, ulps) = match difference {
            Difference::None => ("equal", None),
            Difference::FalseHit => (FALSE_HIT, None),
            Difference::MissedHit => (MISSED_HIT, None),
            Difference::WrongPrimitive => ("wrong primitive", None),
            Difference::Depth(ulps) => ("wrong depth", Some(ulps)),
            Difference::Surface(ulps) => ("wrong surface", Some(ulps)),
        };
        let (x, y) = (window.x0 + column as u32, window.y0 + row as u32);
        Pixel {
            x,
            y,
            kind,
            ulps,
            expected: Values::of(expected, pixel),
            found: Values::of(found, pixel),
        }
    }
}

impl Values {
    fn of(image: &Image, pixel: usize) -> Values {
        let sample = |samples: &Samples| match samples {
            Samples::F32(values) if values[pixel].is_finite() => Sample::Measure(values[pixel]),
            Samples::F32(values) => Sample::NotFinite(values[pixel].to_string()),
            Samples::U32(values) => Sample::Number(values[pixel]),
        };
        let channels = image.channels.iter();
        Values(
            channels
                .map(|channel| (channel.name.name(), sample(&channel.samples)))
                .collect(),
        )
    }
}

impl Display for Pixel {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let place = format!("({}, {})", self.x, self.y);
        let ulps = self
            .ulps
            .map_or(String::new(), |ulps| format!(" by {ulps}"));
        let kind = format!("{}{ulps}", self.kind);
        write!(f, "{place:<12}  {kind:<15}  ")?;
        match self.kind {
            FALSE_HIT => write!(f, "A: miss; B: {}", self.found),
            MISSED_HIT => write!(f, "A: {}; B: miss", self.expected),
            _ => write!(f, "A: {}; B: {}", self.expected, self.found),
        }
    }
}

impl Display for Values {
    /// The values of a hit, without `A`.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let names = ChannelName::ALL
            .into_iter()
            .filter(|name| *name != ChannelName::A);
        let samples = names.filter_map(|name| Some((name, self.0.get(name.name())?)));
        for (place, (name, sample)) in samples.enumerate() {
            let gap = if place == 0 { "" } else { ", " };
            match sample {
                // The fewest digits that distinguish the value from its neighbours.
                Sample::Measure(value) => write!(f, "{gap}{name} {value:?}")?,
                Sample::Number(number) => write!(f, "{gap}{name} {number}")?,
                Sample::NotFinite(value) => write!(f, "{gap}{name} {value}")?,
            }
        }
        Ok(())
    }
}
