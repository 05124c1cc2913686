//! EXR files as the `exr` crate reads them.

use exr::meta::attribute::{AttributeValue, Text};
use exr::prelude::{FlatSamples, ReadChannels, ReadLayers};
use std::collections::BTreeMap;

/// An EXR, read by the `exr` crate.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Exr {
    /// Columns and rows of the whole film.
    pub(crate) film: (usize, usize),
    /// The first column and row of the data window.
    pub(crate) origin: (i32, i32),
    /// Columns and rows of the data window.
    pub(crate) size: (usize, usize),
    /// The bits of each channel's samples.
    pub(crate) bits: BTreeMap<String, Vec<u32>>,
    /// The channels that hold `u32` rather than `f32`.
    pub(crate) integers: Vec<String>,
    /// The attribute `feimos`.
    pub(crate) header: serde_json::Value,
}

impl Exr {
    pub(crate) fn read(bytes: &[u8]) -> Exr {
        let read = exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels();
        let read = read.all_layers().all_attributes().pedantic();
        let file = read.from_buffered(std::io::Cursor::new(bytes)).unwrap();
        let [layer] = &file.layer_data[..] else {
            panic!("one layer")
        };
        let AttributeValue::Text(header) = &layer.attributes.other[&Text::from("feimos")] else {
            panic!("the attribute is a text")
        };
        let origin = layer.attributes.layer_position;
        let film = file.attributes.display_window.size;
        let mut exr = Exr {
            film: (film.width(), film.height()),
            origin: (origin.x(), origin.y()),
            size: (layer.size.width(), layer.size.height()),
            bits: BTreeMap::new(),
            integers: Vec::new(),
            header: serde_json::from_slice(header.as_slice()).unwrap(),
        };
        for channel in &layer.channel_data.list {
            let name = channel.name.to_string();
            let bits = match &channel.sample_data {
                FlatSamples::F32(values) => values.iter().map(|value| value.to_bits()).collect(),
                FlatSamples::U32(values) => {
                    exr.integers.push(name.clone());
                    values.clone()
                }
                FlatSamples::F16(_) => panic!("{name} holds halves"),
            };
            exr.bits.insert(name, bits);
        }
        exr
    }

    pub(crate) fn channels(&self) -> Vec<&str> {
        self.bits.keys().map(String::as_str).collect()
    }

    pub(crate) fn measures(&self, name: &str) -> Vec<f32> {
        self.bits[name]
            .iter()
            .map(|bits| f32::from_bits(*bits))
            .collect()
    }

    /// The values of channel `name` at misses; needs `A`.
    pub(crate) fn at_misses(&self, name: &str) -> Vec<f32> {
        let pairs = self.measures(name).into_iter().zip(self.measures("A"));
        pairs
            .filter(|(_, a)| *a == 0.0)
            .map(|(value, _)| value)
            .collect()
    }
}
