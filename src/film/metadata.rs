//! What an image file says beside its pixels.

use super::{CameraAttributes, ChannelName};

/// Everything in an EXR that is not pixels, windows or names of channels.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Metadata {
    /// A JSON object that says what made the image and what its numbers mean; empty where nothing is said.
    pub json: String,
    /// Where it was seen from, where that is known.
    pub camera: Option<CameraAttributes>,
    /// The name of the channel [`ChannelName::Z`] in the file, where it is not its own. [`Metadata::json`] has to say so under
    /// [`DEPTH_CHANNEL`]: that is how readers know.
    pub depth_channel: Option<String>,
}

/// The key of [`Metadata::json`] that holds the name of the depth channel.
pub const DEPTH_CHANNEL: &str = "depth_channel";

/// The key of [`Metadata::json`] that holds what `Z` and `t` are where nothing is hit: a number, or a string with an infinite one.
pub const MISS: &str = "miss";

impl Metadata {
    /// What `json` says, without a camera.
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

    /// What `Z` and `t` hold where nothing is hit: as the JSON says under [`MISS`], else infinity.
    pub fn miss(&self) -> f32 {
        let value: Option<serde_json::Value> = serde_json::from_str(&self.json).ok();
        let miss = value.and_then(|value| match &value[MISS] {
            serde_json::Value::String(text) => text.parse().ok(),
            number => number.as_f64().map(|number| number as f32),
        });
        miss.unwrap_or(f32::INFINITY)
    }

    /// What channel `name` is called in the file.
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
    fn a_miss_is_what_the_json_says() {
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
    fn the_depth_channel_is_called_as_the_json_says() {
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
