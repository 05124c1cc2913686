//! Options as meant: checked against each other, before any work starts.

use super::args::{OutputArgs, RegionArgs, RenderArgs};
use super::output_name::{Destination, OutputName};
use super::picture::{Data, DataFormat, Picture, Shown};
use super::reporter::Reporter;
use feimos::accel::{BuildOptions, Precision, SplitMethod};
use feimos::error::{Error, Result};
use feimos::film::view::Depth16;
use feimos::film::{Aov, ChannelName, ColorMap, ColorRange, Format, PixelBounds, View};
use feimos::scene::{self, AcceleratorParameters, Film, LoadOptions, Pose, spelling};
use feimos::simd::Level;

/// How every scene of the command is rendered.
#[derive(Debug)]
pub(crate) struct Plan {
    pub(crate) output_name: OutputName,
    pub(crate) load: LoadOptions,
    pub(crate) accel: Option<SplitMethod>,
    pub(crate) precision: Precision,
    /// The instruction set of the kernels.
    pub(crate) simd: Level,
    /// All that the process may use, where nothing is said.
    pub(crate) threads: Option<usize>,
    pub(crate) stats: bool,
    /// The cameras to see each scene from, in place of its own.
    pub(crate) poses: Option<Vec<Pose>>,
    /// Leave out images that are there.
    pub(crate) skip_existing: bool,
    /// Replace also what is no image of feimos where a scene names it.
    pub(crate) force: bool,
    miss: Option<f32>,
    aov: Option<Vec<Aov>>,
    depth_channel: Option<String>,
    scale: Option<f64>,
    view: Option<View>,
    colors: Option<ColorMap>,
    /// The values at the two ends of the colours, the smaller one first.
    range: Option<ColorRange>,
    cropwindow: Option<[f64; 4]>,
    pixelbounds: Option<[u32; 4]>,
}

impl Plan {
    pub(crate) fn new(args: &RenderArgs) -> Result<Plan> {
        let OutputArgs {
            output,
            aov,
            depth_channel,
            view,
            colormap,
            range,
            scale,
            miss,
        } = &args.output;
        let RegionArgs {
            cropwindow,
            pixelbounds,
            resolution,
        } = args.region;
        if let Some(repeated) = aov.as_deref().and_then(first_repeated) {
            return Err(Error::usage(format!(
                "--aov names `{}` twice",
                repeated.name()
            )));
        }
        if args.report.json && output.as_deref() == Some("-") {
            return Err(Error::usage(
                "--json and -o - would both write to standard output",
            ));
        }
        let poses = args
            .cameras
            .cameras
            .as_deref()
            .map(scene::read_poses)
            .transpose()?;
        if let (Some(_), Some(pose)) = (
            resolution,
            poses.iter().flatten().find(|pose| pose.has_resolution()),
        ) {
            let error = Error::usage(format!(
                "--resolution and the resolution of camera `{}` contradict",
                pose.name()
            ));
            return Err(error.note("leave out --resolution: `K` is about images of one size"));
        }
        let asks = |wanted| aov.iter().flatten().any(|aov| *aov == wanted);
        let load = LoadOptions {
            resolution,
            orientation: asks(Aov::Normal) || *view == Some(View::Normal),
            uv: asks(Aov::Uv),
            input_budget: args.input.input_budget,
            ..LoadOptions::default()
        };
        let plan = Plan {
            output_name: OutputName::new(output.clone(), poses.is_some())?,
            load,
            accel: args.engine.accel,
            precision: args.engine.precision,
            simd: args.engine.simd,
            threads: args.engine.threads,
            poses,
            skip_existing: args.batch.skip_existing,
            force: args.batch.force,
            miss: *miss,
            stats: args.report.stats,
            aov: aov.clone(),
            depth_channel: depth_channel.clone(),
            scale: *scale,
            view: *view,
            colors: *colormap,
            range: range.map(color_range).transpose()?,
            cropwindow,
            pixelbounds,
        };
        // Mistakes that any scene would show are shown before the first one is read.
        plan.output_name
            .example()
            .map_or(Ok(()), |example| plan.picture(&example).map(|_| ()))?;
        Ok(plan)
    }

    /// The pixels to render of `film`: the command line's region, else the scene's.
    pub(crate) fn data_window(&self, film: &Film) -> Result<PixelBounds> {
        let [width, height] = film.resolution;
        let whole = PixelBounds::of_film(width, height);
        let (name, window) = match (self.pixelbounds, self.cropwindow) {
            (Some([x0, x1, y0, y1]), _) => (
                "--pixelbounds",
                PixelBounds { x0, x1, y0, y1 }.intersection(&whole),
            ),
            (None, Some(window)) => (
                "--cropwindow",
                PixelBounds::of_crop_window(window, film.resolution),
            ),
            (None, None) => return Ok(film.crop),
        };
        if window.is_empty() {
            let error = Error::usage(format!(
                "{name} holds no pixel of the film, which is {width} x {height}"
            ));
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
            Format::Npy => self.data(destination, DataFormat::Npy),
            Format::Pfm => self.pfm(destination),
            Format::Png => self.png(destination),
        }
    }

    fn exr(&self, destination: &Destination) -> Result<Picture> {
        let aovs = self.aov.clone().unwrap_or_else(|| Aov::USUAL.to_vec());
        if self.depth_channel.is_some() && !aovs.contains(&Aov::Z) {
            return Err(
                Error::usage("--depth-channel has no meaning without Z").note("add Z to --aov")
            );
        }
        // Its own name is no other name.
        let depth_channel = self
            .depth_channel
            .clone()
            .filter(|name| name != ChannelName::Z.name());
        self.holding(aovs, destination, DataFormat::Exr { depth_channel })
    }

    fn pfm(&self, destination: &Destination) -> Result<Picture> {
        let picture = self.data(destination, DataFormat::Pfm)?;
        let channels = picture.channels();
        if !matches!(channels.len(), 1 | 3) || channels.iter().any(|channel| channel.is_integer()) {
            let error = Error::usage(format!(
                "{destination}: a PFM holds one of Z, t, A, N and P"
            ));
            return Err(error.note(
                "for more, or for whole numbers, give the output the extension .exr or .npy",
            ));
        }
        Ok(picture)
    }

    /// Formats that have no place for words.
    fn data(&self, destination: &Destination, format: DataFormat) -> Result<Picture> {
        let of_headers = [
            ("--depth-channel", self.depth_channel.is_some()),
            ("--skip-existing", self.skip_existing),
        ];
        refuse(
            &of_headers,
            destination,
            "a file without a header for it; an .exr has one",
        )?;
        self.holding(
            self.aov.clone().unwrap_or_else(|| vec![Aov::Z]),
            destination,
            format,
        )
    }

    fn holding(
        &self,
        aovs: Vec<Aov>,
        destination: &Destination,
        format: DataFormat,
    ) -> Result<Picture> {
        let of_png = [
            ("--view", self.view.is_some()),
            ("--colormap", self.colors.is_some()),
            ("--range", self.range.is_some()),
            ("--scale", self.scale.is_some()),
        ];
        refuse(
            &of_png,
            destination,
            "a file that holds the values themselves",
        )?;
        Ok(Picture::Data(Data {
            format,
            aovs,
            miss: self.miss.unwrap_or(f32::INFINITY),
            within_instances: false,
        }))
    }

    fn png(&self, destination: &Destination) -> Result<Picture> {
        let of_data = [
            ("--aov", self.aov.is_some()),
            ("--depth-channel", self.depth_channel.is_some()),
        ];
        refuse(
            &of_data,
            destination,
            "a PNG; for channels give the output the extension .exr",
        )?;
        let view = self.view.unwrap_or_default();
        let of_colors = [
            ("--colormap", self.colors.is_some()),
            ("--range", self.range.is_some()),
        ];
        if !matches!(view, View::Depth | View::Cost) {
            refuse(
                &of_colors,
                destination,
                &format!("a PNG of the view {}, whose colours are fixed", view.name()),
            )?;
        }
        let of_depth16 = [
            ("--scale", self.scale.is_some()),
            ("--miss", self.miss.is_some()),
        ];
        if view != View::Depth16 {
            refuse(
                &of_depth16,
                destination,
                "a PNG, and not of the view depth16",
            )?;
        }
        let colors = self.colors.unwrap_or_default();
        Ok(Picture::View(match view {
            View::Hit => Shown::Hit,
            View::Normal => Shown::Normal,
            View::Id => Shown::Id,
            View::Depth => Shown::Depth {
                colors,
                range: self.range,
            },
            View::Cost => Shown::Cost {
                colors,
                range: self.range,
            },
            View::Depth16 => {
                let miss = self.miss.map_or(Ok(0), whole_miss)?;
                Shown::Depth16(Depth16 {
                    scale: self.scale.unwrap_or(Depth16::SCALE),
                    miss,
                })
            }
        }))
    }

    /// How to build: by the command line's method, else the scene's, else `sah`.
    pub(crate) fn build_options(
        &self,
        accelerator: &AcceleratorParameters,
        reporter: &Reporter,
    ) -> BuildOptions {
        if let (None, Some(note)) = (self.accel, note_on(accelerator)) {
            reporter.note(note);
        }
        build_options(
            self.accel
                .or(method_of_scene(accelerator).ok())
                .unwrap_or(SplitMethod::Sah),
            accelerator,
        )
    }
}

/// How to build by `method`, with leaves as large as the scene wants them.
pub(super) fn build_options(
    method: SplitMethod,
    accelerator: &AcceleratorParameters,
) -> BuildOptions {
    let max_leaf = accelerator
        .max_leaf
        .map_or(BuildOptions::MAX_LEAF, |count| count as usize);
    BuildOptions { method, max_leaf }
}

/// What the scene asks for, or the name that means nothing here.
fn method_of_scene(accelerator: &AcceleratorParameters) -> std::result::Result<SplitMethod, &str> {
    match (
        accelerator.name.as_deref(),
        accelerator.split_method.as_deref(),
    ) {
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
    Some(format!(
        "the scene asks for the accelerator `{unknown}`, which is unknown here: sah is used{meant}"
    ))
}

fn refuse(flags: &[(&str, bool)], destination: &Destination, reason: &str) -> Result<()> {
    match flags.iter().find(|(_, given)| *given) {
        Some((flag, _)) => Err(Error::usage(format!(
            "{flag} has no meaning for {destination}: it is {reason}"
        ))),
        None => Ok(()),
    }
}

/// The first item of a list from the command line that stands there before.
pub(super) fn first_repeated<T: Copy + PartialEq>(items: &[T]) -> Option<T> {
    items
        .iter()
        .enumerate()
        .find(|(place, item)| items[..*place].contains(item))
        .map(|(_, item)| *item)
}

/// What stands for a miss among numbers of 16 bits.
fn whole_miss(miss: f32) -> Result<u16> {
    let whole = miss as u16;
    if f32::from(whole) == miss {
        return Ok(whole);
    }
    Err(
        Error::usage(format!("--miss {miss} is no number of a depth16 view"))
            .note("expected an integer from 0 to 65535"),
    )
}

fn color_range([near, far]: [f64; 2]) -> Result<ColorRange> {
    let range = [near as f32, far as f32];
    if !range.iter().all(|end| end.is_finite()) {
        let error = Error::usage(format!(
            "--range {near},{far} is beyond the depths that an image can hold"
        ));
        return Err(error.note(format!(
            "expected numbers from {:e} to {:e}",
            f32::MIN,
            f32::MAX
        )));
    }
    if near < far && range[0] < range[1] {
        let [start, end] = range;
        return Ok(ColorRange { start, end });
    }
    Err(Error::usage(format!("--range {near},{far} is empty"))
        .note("expected near,far with near < far"))
}
