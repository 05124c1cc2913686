//! Options for image files: their name, format and content.

use super::values::{depth_channel, named, numbers};
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use feimos::film::view::Depth16;
use feimos::film::{Aov, ColorMap, View};

#[derive(Debug, Args)]
pub(crate) struct OutputArgs {
    /// Name the image. The extension selects the format: .png, .exr, .pfm or .npy. {stem}, {accel}
    /// and {camera} stand for the scene's name, the accelerator and the camera's name. `-` writes
    /// to standard output: an EXR, with --view a PNG [default: the file name in the scene's Film;
    /// for a bare mesh {stem}.png].
    #[arg(short, long, alias = "outfile", value_name = "TEMPLATE")]
    pub(crate) output: Option<String>,
    /// Choose the channels of an .exr, .pfm or .npy: names separated by commas
    /// [default: Z,t,A,id,prim; for .pfm and .npy Z].
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    #[arg(value_parser = named(Aov::ALL, Aov::name))]
    pub(crate) aov: Option<Vec<Aov>>,
    /// Name the channel Z of an EXR for programs that expect another name, such as Y or R
    /// [default: Z].
    #[arg(long, value_name = "NAME", value_parser = depth_channel, hide_short_help = true)]
    pub(crate) depth_channel: Option<String>,
    /// Choose what a PNG shows [default: depth].
    #[arg(long, value_parser = views())]
    pub(crate) view: Option<View>,
    /// Choose the colours of depths or costs in a PNG [default: turbo].
    #[arg(long, value_name = "MAP", value_parser = color_maps(), hide_short_help = true)]
    pub(crate) colormap: Option<ColorMap>,
    /// Set the values at the two ends of the colours: depths in scene units [default: the range of
    /// the hits], or in a cost view low,high in tests a ray [default: 0 to the largest].
    #[arg(long, value_name = "NEAR,FAR", value_parser = numbers::<2>)]
    #[arg(allow_hyphen_values = true)]
    pub(crate) range: Option<[f64; 2]>,
    /// Set the steps a scene unit of a depth16 view [default: 1000].
    #[arg(long, value_name = "STEPS", value_parser = scale, allow_hyphen_values = true)]
    #[arg(hide_short_help = true)]
    pub(crate) scale: Option<f64>,
    /// Set the value of Z and t at a miss: inf, nan or a number [default: inf; in a depth16 view
    /// 0].
    #[arg(long, value_name = "VALUE", value_parser = miss, allow_hyphen_values = true)]
    #[arg(hide_short_help = true)]
    pub(crate) miss: Option<f32>,
}

fn views() -> impl TypedValueParser<Value = View> {
    let value = |view: View| {
        PossibleValue::new(view.name()).help(match view {
            View::Depth => "Depth from near to far, through a colour map",
            View::Hit => "Hits red, misses yellow",
            View::Normal => "Normals in world space: x, y, z from -1 to 1 as red, green, blue",
            View::Id => "A colour for each shape number",
            View::Cost => "Node boxes and primitives that each ray tests alone: cheap is dark",
            View::Depth16 => "Depth as 16-bit data: --scale steps a unit, 0 at a miss",
        })
    };
    PossibleValuesParser::new(View::ALL.map(value)).try_map(|name| name.parse::<View>())
}

fn color_maps() -> impl TypedValueParser<Value = ColorMap> {
    let value = |map: ColorMap| {
        PossibleValue::new(map.name()).help(match map {
            ColorMap::Turbo => "A rainbow: near is red, far is blue and in the end almost black",
            ColorMap::Viridis => "Perceptually uniform: near is yellow, far is dark violet",
            ColorMap::Gray => "Near is white, far is black",
        })
    };
    PossibleValuesParser::new(ColorMap::ALL.map(value)).try_map(|name| name.parse::<ColorMap>())
}

fn scale(text: &str) -> Result<f64, String> {
    let scale = text.parse().ok();
    let scale = scale.filter(|scale: &f64| *scale > 0.0 && scale.is_finite());
    scale.ok_or_else(|| format!("expected a number above 0, such as {}", Depth16::SCALE))
}

fn miss(text: &str) -> Result<f32, String> {
    text.parse()
        .map_err(|_| "expected inf, nan or a number".to_owned())
}
