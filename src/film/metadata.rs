//! Metadata of an EXR.

use super::{CameraAttributes, ChannelName};

/// Everything in an EXR except its pixels, windows and channel names.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Metadata {
    /// A JSON object that describes how the image was made and what its numbers mean; empty if
    /// there is none.
    pub json: String,
    /// The camera, if it is known.
    pub camera: Option<CameraAttributes>,
    /// The name of the channel [`ChannelName::Z`] in the file, if it is another one.
    /// [`Metadata::json`] must name it under [`DEPTH_CHANNEL`] for readers.
    pub depth_channel: Option<String>,
}

/// The key of [`Metadata::json`] for the name of the depth channel.
pub const DEPTH_CHANNEL: &str = "depth_channel";

/// The key of [`Metadata::json`] for the value of `Z` and `t` at a miss: a number, or a string if
/// it is not finite.
pub const MISS: &str = "miss";

impl Metadata {
    /// The metadata of `json`, without a camera.
    pub fn of_json(json: String) -> Metadata {
        let value: Option<serde_json::Value> = serde_json::from_str(&json).ok();
        let depth_channel = value
            .as_ref()
            .and_then(|value| value[DEPTH_CHANNEL].as_str())
            .map(str::to_owned);
        Metadata {
            json,
            camera: None,
            depth_channel,
        }
    }

    /// The value of `Z` and `t` at a miss: the JSON names it under [`MISS`], otherwise it is
    /// infinity.
    pub fn miss(&self) -> f32 {
        let value: Option<serde_json::Value> = serde_json::from_str(&self.json).ok();
        let miss = value.and_then(|value| match &value[MISS] {
            serde_json::Value::String(text) => text.parse().ok(),
            number => number.as_f64().map(|number| number as f32),
        });
        miss.unwrap_or(f32::INFINITY)
    }

    /// The name of channel `name` in the file.
    pub(super) fn name_in_file(&self, name: ChannelName) -> &str {
        match (name, &self.depth_channel) {
            (ChannelName::Z, Some(depth_channel)) => depth_channel,
            _ => name.name(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_json_names_the_value_of_a_miss() {
        let miss = |json: &str| Metadata::of_json(json.to_owned()).miss();
        assert_eq!(
            (miss(r#"{"miss": -1.5}"#), miss(r#"{"miss": "-inf"}"#)),
            (-1.5, f32::NEG_INFINITY)
        );
        assert!(miss(r#"{"miss": "NaN"}"#).is_nan());
        assert_eq!(
            [miss(""), miss("{}"), miss(r#"{"miss": "far"}"#)],
            [f32::INFINITY; 3]
        );
    }

    #[test]
    fn the_json_names_the_depth_channel() {
        let renamed = Metadata::of_json(r#"{"depth_channel": "Y"}"#.to_owned());
        assert_eq!(
            [ChannelName::Z, ChannelName::A].map(|name| renamed.name_in_file(name)),
            ["Y", "A"]
        );
        for json in ["", "{}", r#"{"depth_channel": 7}"#, "[", "3"] {
            assert_eq!(
                Metadata::of_json(json.to_owned()).name_in_file(ChannelName::Z),
                "Z"
            );
        }
    }
}
