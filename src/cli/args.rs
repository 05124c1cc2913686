//! Options as typed.

use super::bench::BenchArgs;
use super::check::CheckArgs;
use super::compare::CompareArgs;
use super::completions::CompletionsArgs;
use super::man::ManArgs;
use super::merge::MergeArgs;
use super::pixel::PixelArgs;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{ArgAction, Args, Parser, Subcommand, ValueEnum};
use feimos::accel::{Precision, SplitMethod};
use feimos::film::view::Depth16;
use feimos::film::{Aov, ChannelName, ColorMap, PixelBounds, View};
use feimos::input::BudgetFactor;
use feimos::simd::{Level, UnavailableLevel};
use std::path::PathBuf;
use std::str::FromStr;

/// Hit and depth images of PBRT scenes.
#[derive(Debug, Parser)]
#[command(name = "feimos", version, max_term_width = 100)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Render scenes to images.
    ///
    /// A scene is a .pbrt file, `-` for standard input, or a bare .ply or .obj, which is framed automatically.
    Render(Box<RenderArgs>),
    /// Check scenes without rendering them: what they hold, and what is wrong with them.
    ///
    /// Reads everything that a picture would need and tells what there is: camera, film, shapes, bounds, directives. No ray is
    /// cast and no tree is built.
    Check(CheckArgs),
    /// Measure speed against error: how fast accelerators are built and traced, and how wrong the answers are.
    ///
    /// Every accelerator is built and every precision traces the whole image, in turn, round after round, so that whatever else the
    /// machine does meets all of them alike. Answers are compared with those of exact arithmetic on all primitives.
    Bench(BenchArgs),
    /// Compare two images: hits, what is hit, and depths in units in the last place.
    ///
    /// A is the image expected, B the one found: two EXR files with any of feimos's channels, by whatever program, or two PNG
    /// files, of which colours are compared. Misses in both are equal whatever their depths. Exits with 1 where the images differ by
    /// more than is allowed.
    Compare(CompareArgs),
    /// Explain one pixel: its ray, what it hits and where that is in the scene file, how close it was.
    ///
    /// Tells what each precision makes of the ray, what it costs with each accelerator, and what exact arithmetic on every single
    /// primitive says.
    Pixel(PixelArgs),
    /// Put crops of one film together: the same file, byte for byte, that one process would have written.
    ///
    /// Every crop is placed by its data window. Pixels that no crop has are an error, and so are crops that differ where they overlap, or that
    /// are of different films, scenes or options.
    Merge(MergeArgs),
    /// Print a script that completes what is typed in a shell.
    Completions(CompletionsArgs),
    /// Write the manual: a page for feimos and one for each command.
    Man(ManArgs),
}

#[derive(Debug, Args)]
pub(crate) struct RenderArgs {
    /// Scenes: .pbrt files, `-`, or bare .ply or .obj meshes.
    #[arg(required = true, value_name = "SCENE")]
    pub(crate) scenes: Vec<PathBuf>,
    #[command(flatten, next_help_heading = "Output")]
    pub(crate) output: OutputArgs,
    #[command(flatten, next_help_heading = "Region")]
    pub(crate) region: RegionArgs,
    #[command(flatten, next_help_heading = "Engine")]
    pub(crate) engine: EngineArgs,
    #[command(flatten, next_help_heading = "Cameras")]
    pub(crate) cameras: CameraArgs,
    #[command(flatten, next_help_heading = "Batch")]
    pub(crate) batch: BatchArgs,
    #[command(flatten, next_help_heading = "Input")]
    pub(crate) input: InputArgs,
    #[command(flatten, next_help_heading = "Talk")]
    pub(crate) talk: TalkArgs,
    #[command(flatten, next_help_heading = "Talk")]
    pub(crate) report: ReportArgs,
    #[command(flatten)]
    pub(crate) pbrt: PbrtArgs,
}

#[derive(Debug, Args)]
pub(crate) struct OutputArgs {
    /// Where the image goes; the extension (.png, .exr, .pfm, .npy) tells the format; {stem}, {accel} and {camera} stand for the
    /// scene's name, the accelerator and the camera's name. `-` writes to standard output: an EXR, with --view a PNG.
    /// [default: the file name in the scene's Film; of a bare mesh, {stem}.png]
    #[arg(short, long, alias = "outfile", value_name = "TEMPLATE")]
    pub(crate) output: Option<String>,
    /// What an .exr, .pfm or .npy holds, of Z, t, A, id, prim, instance, N, P, uv and cost [default: Z,t,A,id,prim; of .pfm and .npy: Z].
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = named(Aov::ALL, Aov::name))]
    pub(crate) aov: Option<Vec<Aov>>,
    /// What the channel Z of an EXR is called, for programs that know depth by another name, such as Y or R [default: Z].
    #[arg(long, value_name = "NAME", value_parser = depth_channel)]
    pub(crate) depth_channel: Option<String>,
    /// What a PNG shows [default: depth].
    #[arg(long, value_name = "VIEW", value_parser = named(View::ALL, View::name))]
    pub(crate) view: Option<View>,
    /// Colours of a PNG's depths or costs [default: turbo].
    #[arg(long, value_name = "MAP", value_parser = named(ColorMap::ALL, ColorMap::name))]
    pub(crate) colormap: Option<ColorMap>,
    /// Depths at the ends of the colours, in scene units [default: of the hits]; of a cost view, low,high in tests a ray
    /// [default: from 0 to the largest].
    #[arg(long, value_name = "NEAR,FAR", value_parser = numbers::<2>, allow_hyphen_values = true)]
    pub(crate) range: Option<[f64; 2]>,
    /// Steps a scene unit in a depth16 view [default: 1000].
    #[arg(long, value_name = "STEPS", value_parser = scale, allow_hyphen_values = true)]
    pub(crate) scale: Option<f64>,
    /// What Z and t hold where nothing is hit: inf, nan, 0 or any number [default: inf; in a depth16 view 0].
    #[arg(long, value_name = "VALUE", value_parser = miss, allow_hyphen_values = true)]
    pub(crate) miss: Option<f32>,
}

#[derive(Debug, Args)]
pub(crate) struct RegionArgs {
    /// Render only this part of the film, in fractions of it, y downwards, rounded as pbrt does [default: as the scene says, else all].
    #[arg(long, value_name = "X0,X1,Y0,Y1", value_parser = numbers::<4>, allow_hyphen_values = true)]
    pub(crate) cropwindow: Option<[f64; 4]>,
    /// Render only this part of the film, in pixels, upper ends exclusive [default: as the scene says, else all].
    #[arg(long, value_name = "X0,X1,Y0,Y1", value_parser = pixel_bounds, allow_hyphen_values = true)]
    #[arg(conflicts_with = "cropwindow")]
    pub(crate) pixelbounds: Option<[u32; 4]>,
    /// Width and height of the film [default: the scene's].
    #[arg(long, value_name = "WxH", value_parser = resolution)]
    pub(crate) resolution: Option<[u32; 2]>,
}

#[derive(Debug, Args)]
pub(crate) struct EngineArgs {
    /// How primitives are aggregated: none, middle, equal, sah or hlbvh [default: as the scene says, else sah].
    #[arg(long, value_name = "METHOD", value_parser = named(SplitMethod::ALL, SplitMethod::name))]
    pub(crate) accel: Option<SplitMethod>,
    /// How hits are decided: exact gives the right answer for every pixel, to the last bit of the depth; fast what comes of
    /// computing in f32.
    #[arg(long, value_name = "HOW", default_value = "exact")]
    #[arg(value_parser = named(Precision::ALL, Precision::name))]
    pub(crate) precision: Precision,
    /// Instruction set of the kernels: auto (the widest that this machine has), avx512, avx2, sse4.1 or portable.
    /// Images are the same with each.
    #[arg(long, value_name = "SET", default_value = "auto", value_parser = simd)]
    pub(crate) simd: Level,
    /// Threads to use [default: all that the process may use].
    #[arg(long, alias = "nthreads", value_name = "N", value_parser = threads)]
    pub(crate) threads: Option<usize>,
}

#[derive(Debug, Args)]
pub(crate) struct CameraArgs {
    /// Render each scene from every camera that this file lists, in place of its own: JSON, a list of objects with a `name` and with
    /// `lookat`, `transform`, or `K`, `R`, `t` and `resolution`. Name them in the output by {camera} [default: the scene's camera].
    #[arg(long, value_name = "POSES.json")]
    pub(crate) cameras: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct BatchArgs {
    /// With several images: overwrite those that exist [default: they are an error; a single one is
    /// overwritten]. Where the scene names its image: overwrite also what is no image of feimos
    /// [default: that is an error].
    #[arg(long, conflicts_with = "skip_existing")]
    pub(crate) force: bool,
    /// Leave out images that exist already, if scene and options are still the same: an .exr and a .png tell [default: off].
    #[arg(long)]
    pub(crate) skip_existing: bool,
    /// Stop at the first image that fails [default: go on, and report at the end].
    #[arg(long)]
    pub(crate) fail_fast: bool,
    /// Append a line of JSON for each image to this file [default: none].
    #[arg(long, value_name = "FILE.jsonl")]
    pub(crate) manifest: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct TalkArgs {
    /// Print errors only [default: results and warnings, too].
    #[arg(short, long, conflicts_with = "verbose")]
    pub(crate) quiet: bool,
    /// Print more: what each phase found [default: off].
    #[arg(short, long)]
    pub(crate) verbose: bool,
    /// Progress bars.
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    pub(crate) progress: When,
    /// Colours in messages.
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    pub(crate) color: When,
}

#[derive(Debug, Args)]
pub(crate) struct ReportArgs {
    /// Print counts and costs of the aggregate and of the rays [default: off].
    #[arg(long)]
    pub(crate) stats: bool,
    /// Print a line of JSON for each image on standard output [default: off].
    #[arg(long)]
    pub(crate) json: bool,
    /// Take warnings for errors: exit with 1 [default: off].
    #[arg(long)]
    pub(crate) strict: bool,
}

/// What input files may cost.
#[derive(Debug, Args)]
pub(crate) struct InputArgs {
    /// Multiply every limit on what input files may expand to: bytes decompressed, text read again, memory of meshes and images, faces
    /// made by subdivision, files included, pairs of corners looked at to cut polygons.
    #[arg(long, value_name = "FACTOR", default_value_t, value_parser = budget_factor)]
    pub(crate) input_budget: BudgetFactor,
}

fn budget_factor(text: &str) -> Result<BudgetFactor, String> {
    let factor = text.parse().ok().and_then(BudgetFactor::new);
    factor.ok_or_else(|| format!("expected an integer from 1 to {}", BudgetFactor::MAX))
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum When {
    /// On a terminal.
    Auto,
    /// Everywhere.
    Always,
    /// Nowhere.
    Never,
}

/// Flags of pbrt that mean nothing here; they are taken, with a note.
#[derive(Debug, Args)]
pub(crate) struct PbrtArgs {
    #[arg(long, hide = true, action = ArgAction::SetTrue)]
    quick: bool,
    #[arg(long, hide = true, action = ArgAction::SetTrue)]
    gpu: bool,
    #[arg(long, hide = true, action = ArgAction::SetTrue)]
    wavefront: bool,
    #[arg(long, hide = true, action = ArgAction::SetTrue)]
    interactive: bool,
    #[arg(long, hide = true, action = ArgAction::SetTrue)]
    force_diffuse: bool,
    #[arg(long, hide = true, action = ArgAction::SetTrue)]
    disable_pixel_jitter: bool,
    #[arg(long, hide = true, action = ArgAction::SetTrue)]
    disable_wavelength_jitter: bool,
    #[arg(long, hide = true, action = ArgAction::SetTrue)]
    disable_texture_filtering: bool,
    #[arg(long, hide = true, action = ArgAction::SetTrue)]
    write_partial_images: bool,
    #[arg(long, hide = true)]
    spp: Option<String>,
    #[arg(long, hide = true)]
    seed: Option<String>,
    #[arg(long, hide = true)]
    gpu_device: Option<String>,
    #[arg(long, hide = true)]
    display_server: Option<String>,
    #[arg(long, hide = true)]
    rendering_space: Option<String>,
    #[arg(long, hide = true)]
    log_level: Option<String>,
}

impl PbrtArgs {
    /// Those that were typed.
    pub(crate) fn given(&self) -> Vec<&'static str> {
        let flags = [
            (self.quick, "--quick"),
            (self.gpu, "--gpu"),
            (self.wavefront, "--wavefront"),
            (self.interactive, "--interactive"),
            (self.force_diffuse, "--force-diffuse"),
            (self.disable_pixel_jitter, "--disable-pixel-jitter"),
            (
                self.disable_wavelength_jitter,
                "--disable-wavelength-jitter",
            ),
            (
                self.disable_texture_filtering,
                "--disable-texture-filtering",
            ),
            (self.write_partial_images, "--write-partial-images"),
            (self.spp.is_some(), "--spp"),
            (self.seed.is_some(), "--seed"),
            (self.gpu_device.is_some(), "--gpu-device"),
            (self.display_server.is_some(), "--display-server"),
            (self.rendering_space.is_some(), "--rendering-space"),
            (self.log_level.is_some(), "--log-level"),
        ];
        flags
            .into_iter()
            .filter_map(|(given, name)| given.then_some(name))
            .collect()
    }
}

/// Parses one of `values` by its name, and lists the names in help, completions and errors.
pub(super) fn named<T: FromStr, const N: usize>(
    values: [T; N],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T>
where
    T: Clone + Send + Sync + 'static,
    T::Err: std::error::Error + Send + Sync + 'static,
{
    PossibleValuesParser::new(values.map(name)).try_map(|name| name.parse())
}

fn simd(name: &str) -> Result<Level, String> {
    match name {
        "auto" => Ok(Level::detect()),
        name => name
            .parse()
            .map_err(|error: UnavailableLevel| format!("{error}; auto takes the widest")),
    }
}

/// Longer names are not read by older programs.
const MAX_CHANNEL_NAME: usize = 31;

fn depth_channel(name: &str) -> Result<String, String> {
    if name.is_empty()
        || name.len() > MAX_CHANNEL_NAME
        || !name.chars().all(|c| c.is_ascii_graphic())
    {
        return Err(format!(
            "expected 1 to {MAX_CHANNEL_NAME} letters, digits or signs of ASCII"
        ));
    }
    if name != "Z" && ChannelName::ALL.iter().any(|known| known.name() == name) {
        return Err("it is the name of another channel".to_owned());
    }
    Ok(name.to_owned())
}

fn scale(text: &str) -> Result<f64, String> {
    let scale = text
        .parse()
        .ok()
        .filter(|scale: &f64| *scale > 0.0 && scale.is_finite());
    scale.ok_or_else(|| format!("expected a number above 0, such as {}", Depth16::SCALE))
}

fn miss(text: &str) -> Result<f32, String> {
    text.parse()
        .map_err(|_| "expected inf, nan or a number".to_owned())
}

/// Threads at most: a typing error should not take the machine down.
const MAX_THREADS: usize = 4096;

pub(super) fn threads(text: &str) -> Result<usize, String> {
    let threads = text
        .parse()
        .ok()
        .filter(|threads| (1..=MAX_THREADS).contains(threads));
    threads.ok_or_else(|| format!("expected a number from 1 to {MAX_THREADS}"))
}

fn parts<const N: usize>(text: &str, separator: char) -> Result<[&str; N], String> {
    let parts: Vec<&str> = text.split(separator).map(str::trim).collect();
    let count = parts.len();
    parts
        .try_into()
        .map_err(|_| format!("expected {N} values separated by `{separator}`, found {count}"))
}

fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let mut numbers = [0.0; N];
    for (number, part) in numbers.iter_mut().zip(parts::<N>(text, ',')?) {
        *number = part
            .parse()
            .map_err(|_| format!("`{part}` is not a number"))?;
        if !f64::is_finite(*number) {
            return Err(format!("`{part}` is not a finite number"));
        }
    }
    Ok(numbers)
}

/// Column and row of a pixel.
pub(super) fn pixel(text: &str) -> Result<[u32; 2], String> {
    integers(parts(text, ',')?)
}

fn pixel_bounds(text: &str) -> Result<[u32; 4], String> {
    integers(parts(text, ',')?)
}

pub(super) fn resolution(text: &str) -> Result<[u32; 2], String> {
    let resolution = integers(parts(text, 'x')?)?;
    const MAX_SIDE: u32 = PixelBounds::MAX_SIDE;
    match resolution {
        [width, height] if width == 0 || height == 0 => {
            Err("a film needs a pixel at least".to_owned())
        }
        [width, height] if width.max(height) > MAX_SIDE => {
            Err(format!("at most {MAX_SIDE} pixels along a side"))
        }
        resolution => Ok(resolution),
    }
}

fn integers<const N: usize>(parts: [&str; N]) -> Result<[u32; N], String> {
    let mut integers = [0; N];
    for (integer, part) in integers.iter_mut().zip(parts) {
        *integer = part
            .parse()
            .map_err(|_| format!("`{part}` is not an integer from 0 to {}", u32::MAX))?;
    }
    Ok(integers)
}
