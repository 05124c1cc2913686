//! Options as meant: checked against each other, before any work starts.

use super::args::{OutputArgs, RegionArgs, RenderArgs};
use super::output_name::{Destination, OutputName};
use super::picture::Picture;
use super::reporter::Reporter;
use feimos::accel::{BuildOptions, Precision, SplitMethod};
use feimos::error::{Error, Result};
use feimos::film::{Aov, ColorMap, CostRange, DepthRange, Format, PixelBounds, View};
use feimos::scene::{AcceleratorParameters, Film, LoadOptions, spelling};

/// How every scene of the command is rendered.
#[derive(Debug)]
pub(crate) struct Plan {
    pub(crate) output_name: OutputName,
    pub(crate) load: LoadOptions,
    pub(crate) accel: Option<SplitMethod>,
    pub(crate) precision: Precision,
    /// All that the process may use, where nothing is said.
    pub(crate) threads: Option<usize>,
    pub(crate) stats: bool,
    miss: Option<f32>,
    aov: Option<Vec<Aov>>,
    view: Option<View>,
    colors: Option<ColorMap>,
    /// The values at the two ends of the colours, the smaller one first.
    range: Option<[f32; 2]>,
    cropwindow: Option<[f64; 4]>,
    pixelbounds: Option<[u32; 4]>,
}

impl Plan {
    pub(crate) fn new(args: &RenderArgs) -> Result<Plan> {
        let OutputArgs { output, aov, view, colormap, range, miss } = &args.output;
        let RegionArgs { cropwindow, pixelbounds, resolution } = args.region;
        if let Some(repeated) = aov.as_deref().and_then(first_repeated) {
            return Err(Error::usage(format!("--aov names `{}` twice", repeated.as_str())));
        }
        if args.report.json && output.as_deref() == Some("-") {
            return Err(Error::usage("--json and -o - would both write to standard output"));
        }
        let asks = |wanted| aov.iter().flatten().any(|aov| *aov == wanted);
        let plan = Plan {
            output_name: OutputName::new(output.clone())?,
            load: LoadOptions {
                resolution,
                orientation: asks(Aov::Normal),
                uv: asks(Aov::Uv),
                ..LoadOptions::default()
            },
            accel: args.engine.accel,
            precision: args.engine.precision,
            threads: args.engine.threads,
            miss: *miss,
            stats: args.report.stats,
            aov: aov.clone(),
            view: *view,
            colors: *colormap,
            range: range.map(color_range).transpose()?,
            cropwindow,
            pixelbounds,
        };
        // Mistakes that any scene would show are shown before the first one is read.
        plan.output_name.example().map_or(Ok(()), |example| plan.picture(&example).map(|_| ()))?;
        Ok(plan)
    }

    /// The pixels to render of `film`: the command line's region, else the scene's.
    pub(crate) fn data_window(&self, film: &Film) -> Result<PixelBounds> {
        let [width, height] = film.resolution;
        let whole = PixelBounds::of_film(width, height);
        let (name, window) = match (self.pixelbounds, self.cropwindow) {
            (Some([x0, x1, y0, y1]), _) => ("--pixelbounds", PixelBounds { x0, x1, y0, y1 }.intersection(&whole)),
            (None, Some(window)) => ("--cropwindow", PixelBounds::of_crop_window(window, film.resolution)),
            (None, None) => return Ok(film.crop),
        };
        if window.is_empty() {
            let error = Error::usage(format!("{name} holds no pixel of the film, which is {width} x {height}"));
            return Err(error.note("expected x0,x1,y0,y1 with x0 < x1 and y0 < y1"));
        }
        Ok(window)
    }

    /// What to put into `destination`; a flag that has no meaning there is an error.
    pub(crate) fn picture(&self, destination: &Destination) -> Result<Picture> {
        let format = match destination {
            Destination::Stdout if self.view.is_some() => Format::Png,
            Destination::Stdout => Format::Exr,
            Destination::File(path) => Format::of_path(path)?,
        };
        match format {
            Format::Exr => self.exr(destination),
            Format::Png => self.png(destination),
        }
    }

    fn exr(&self, destination: &Destination) -> Result<Picture> {
        let of_png =
            [("--view", self.view.is_some()), ("--colormap", self.colors.is_some()), ("--range", self.range.is_some())];
        refuse(&of_png, destination, "an EXR, which holds the values themselves")?;
        let aov = self.aov.as_deref().unwrap_or(&Aov::USUAL);
        let channels = aov.iter().flat_map(|aov| aov.channels()).collect();
        Ok(Picture::Exr { channels, miss: self.miss.unwrap_or(f32::INFINITY), within_instances: false })
    }

    fn png(&self, destination: &Destination) -> Result<Picture> {
        let of_exr = [("--aov", self.aov.is_some()), ("--miss", self.miss.is_some())];
        refuse(&of_exr, destination, "a PNG; for channels give the output the extension .exr")?;
        match self.view.unwrap_or_default() {
            View::Hit => {
                let of_colors = [("--colormap", self.colors.is_some()), ("--range", self.range.is_some())];
                refuse(&of_colors, destination, "a hit view, which has two colours")?;
                Ok(Picture::Hit)
            }
            View::Depth => {
                let range = self.range.map(|[near, far]| DepthRange { near, far });
                Ok(Picture::Depth { colors: self.colors.unwrap_or_default(), range })
            }
            View::Cost => {
                let range = self.range.map(|[low, high]| CostRange { low, high });
                Ok(Picture::Cost { colors: self.colors.unwrap_or_default(), range })
            }
        }
    }

    /// How to build: by the command line's method, else the scene's, else `sah`.
    pub(crate) fn build_options(&self, accelerator: &AcceleratorParameters, reporter: &Reporter) -> BuildOptions {
        if let (None, Some(note)) = (self.accel, note_on(accelerator)) {
            reporter.note(note);
        }
        build_options(self.accel.or(method_of_scene(accelerator).ok()).unwrap_or(SplitMethod::Sah), accelerator)
    }
}

/// How to build by `method`, with leaves as large as the scene wants them.
pub(super) fn build_options(method: SplitMethod, accelerator: &AcceleratorParameters) -> BuildOptions {
    let max_leaf = accelerator.max_leaf.map_or(BuildOptions::MAX_LEAF, |count| count as usize);
    BuildOptions { method, max_leaf }
}

/// What the scene asks for, or the name that means nothing here.
fn method_of_scene(accelerator: &AcceleratorParameters) -> std::result::Result<SplitMethod, &str> {
    match (accelerator.name.as_deref(), accelerator.split_method.as_deref()) {
        (None, _) | (Some("bvh"), None) => Ok(SplitMethod::Sah),
        (Some("bvh"), Some(name)) => name.parse().map_err(|_| name),
        (Some(name), _) => Err(name),
    }
}

/// What to say of an accelerator that is unknown here.
pub(super) fn note_on(accelerator: &AcceleratorParameters) -> Option<String> {
    let unknown = method_of_scene(accelerator).err()?;
    let meant = match accelerator.split_method.as_deref() {
        Some(_) => spelling::closest(unknown, SplitMethod::ALL.into_iter().map(SplitMethod::name)),
        None => spelling::closest(unknown, ["bvh"].into_iter()),
    };
    let meant = meant.map_or(String::new(), |known| format!("; did you mean `{known}`?"));
    Some(format!("the scene asks for the accelerator `{unknown}`, which is unknown here: sah is used{meant}"))
}

fn refuse(flags: &[(&str, bool)], destination: &Destination, reason: &str) -> Result<()> {
    match flags.iter().find(|(_, given)| *given) {
        Some((flag, _)) => Err(Error::usage(format!("{flag} has no meaning for {destination}: it is {reason}"))),
        None => Ok(()),
    }
}

/// The first item of a list from the command line that stands there before.
pub(super) fn first_repeated<T: Copy + PartialEq>(items: &[T]) -> Option<T> {
    items.iter().enumerate().find(|(place, item)| items[..*place].contains(item)).map(|(_, item)| *item)
}

fn color_range([near, far]: [f64; 2]) -> Result<[f32; 2]> {
    let range = [near as f32, far as f32];
    if !range.iter().all(|end| end.is_finite()) {
        let error = Error::usage(format!("--range {near},{far} is beyond the depths that an image can hold"));
        return Err(error.note(format!("expected numbers from {:e} to {:e}", f32::MIN, f32::MAX)));
    }
    if near < far && range[0] < range[1] {
        return Ok(range);
    }
    Err(Error::usage(format!("--range {near},{far} is empty")).note("expected near,far with near < far"))
}
