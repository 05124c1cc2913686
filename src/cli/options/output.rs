//! Options for image files: their name, format and content.

use super::values::{depth_channel, named, numbers};
use crate::film::view::{Background, Depth16, DepthConvention};
use crate::film::{Aov, ColorMap, Format, View};
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use std::str::FromStr;

#[derive(Debug, Args)]
pub(crate) struct OutputArgs {
    /// Name the image. Repeat -o to write several files of one trace. The extension selects the
    /// format: .png, .exr, .pfm or .npy. {stem}, {accel} and {camera} stand for the scene's name,
    /// the accelerator and the camera's name. A folder such as out/ gets {stem}.exr, or
    /// {stem}-{camera}.exr for a list of cameras. `-` is standard output. Missing folders are made
    /// when the image is written [default: the file name in the scene's Film; for a bare mesh
    /// {stem}.png].
    #[arg(short, long, alias = "outfile", value_name = "TEMPLATE")]
    pub(crate) output: Vec<String>,
    /// Choose the format where the name does not: of `-`, folders, /dev/null and names without an
    /// extension [default: for `-` and folders exr; png if a view is chosen].
    #[arg(long, value_parser = named(Format::ALL, Format::name))]
    pub(crate) format: Option<Format>,
    /// Choose the channels of an .exr, .pfm or .npy: names separated by commas
    /// [default: Z,t,A,id,prim; for .pfm and .npy Z].
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    #[arg(value_parser = named(Aov::ALL, Aov::name))]
    pub(crate) aov: Option<Vec<Aov>>,
    /// Name the channel Z of an EXR for programs that expect another name, such as Y or R
    /// [default: Z].
    #[arg(long, value_name = "NAME", value_parser = depth_channel, hide_short_help = true)]
    pub(crate) depth_channel: Option<String>,
    /// Choose what a PNG shows. Several views, separated by commas, are for several PNG outputs in
    /// their order [default: depth].
    #[arg(long, value_name = "VIEW", value_delimiter = ',', value_parser = views())]
    pub(crate) view: Vec<View>,
    /// Choose the colours of depths or costs in a PNG [default: turbo].
    #[arg(long, value_name = "MAP", value_parser = color_maps(), hide_short_help = true)]
    pub(crate) colormap: Option<ColorMap>,
    /// Set the values at the two ends of the colours: depths in scene units [default: the range of
    /// the hits], or in a cost view low,high in tests a ray [default: 0 to what 99.5 % of the rays
    /// do not exceed].
    #[arg(long, value_name = "NEAR,FAR", value_parser = numbers::<2>)]
    #[arg(allow_hyphen_values = true)]
    pub(crate) range: Option<[f64; 2]>,
    /// Draw a bar of the colours with numbers beside the picture [default: off].
    #[arg(long)]
    pub(crate) legend: bool,
    /// Choose the colour of misses in a PNG: white, black, transparent or RRGGBB
    /// [default: depends on the view].
    #[arg(long, value_name = "COLOR", value_parser = Background::from_str)]
    pub(crate) background: Option<Background>,
    /// Set the steps a scene unit of a depth16 view: a number, or a convention for scenes in
    /// metres: tum (5000), kitti (256) or scannet (1000) [default: 1000].
    #[arg(long, value_name = "STEPS", value_parser = scale, allow_hyphen_values = true)]
    #[arg(hide_short_help = true)]
    pub(crate) scale: Option<f64>,
    /// Set the value of Z and t at a miss: inf, nan or a number [default: inf; in a depth16 view
    /// 0].
    #[arg(long, value_name = "VALUE", value_parser = miss, allow_hyphen_values = true)]
    #[arg(hide_short_help = true)]
    pub(crate) miss: Option<f32>,
}

impl OutputArgs {
    /// The format of standard output, and of images in a folder.
    pub(crate) fn format_without_name(&self) -> Format {
        let usual = match self.view.is_empty() {
            true => Format::Exr,
            false => Format::Png,
        };
        self.format.unwrap_or(usual)
    }
}

fn views() -> impl TypedValueParser<Value = View> {
    let value = |view: View| {
        PossibleValue::new(view.name()).help(match view {
            View::Depth => "Depth from near to far, through a colour map",
            View::Shaded => "Depth, lit by a lamp at the eye: shows the form of surfaces",
            View::Hit => "Hits red, misses yellow",
            View::Mask => "Hits as 8-bit data: 255 for a hit, 0 for a miss",
            View::Normal => "Normals in world space: x, y, z from -1 to 1 as red, green, blue",
            View::Id => "A colour for each shape number",
            View::Prim => "A colour for each primitive number",
            View::Instance => "A colour for each instance number",
            View::Cost => "Node boxes and primitives that each ray tests alone: cheap is dark",
            View::Depth16 => "Depth as 16-bit data: --scale steps a unit, 0 at a miss",
            View::Id16 => "Shape numbers as 16-bit data: 0 at a miss",
            View::Instance16 => "Instance numbers as 16-bit data: 0 outside of instances",
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
    if let Ok(convention) = text.parse::<DepthConvention>() {
        return Ok(convention.scale());
    }
    let scale = text.parse().ok();
    let scale = scale.filter(|scale: &f64| *scale > 0.0 && scale.is_finite());
    scale.ok_or_else(|| {
        let names = DepthConvention::ALL.map(DepthConvention::name).join(", ");
        format!(
            "expected a number above 0, such as {}, or one of {names}",
            Depth16::SCALE
        )
    })
}

fn miss(text: &str) -> Result<f32, String> {
    text.parse()
        .map_err(|_| "expected inf, nan or a number".to_owned())
}
