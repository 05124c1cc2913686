//! The files that `tree` writes: boxes as a mesh, and over a picture.

use super::args::TreeArgs;
use crate::accel::{Aggregate, NodeBox, Precision};
use crate::boxes::{Palette, draw_boxes, write_ply};
use crate::cli::files::destination::Destination;
use crate::cli::files::inputs::{Inputs, check_against_scene};
use crate::cli::files::places::Places;
use crate::cli::files::results::check_extension;
use crate::cli::terminal::progress::{Phase, ProgressBars};
use crate::cli::terminal::reporter::Reporter;
use crate::cli::terminal::words::counted;
use crate::error::{Error, Result};
use crate::file_id::InputFiles;
use crate::film::atomic_file::{self, Overwrite};
use crate::film::{ChannelName, png_file};
use crate::progress::Progress;
use crate::render::{RenderOptions, render};
use crate::scene::Scene;
use crate::simd::Level;
use std::path::Path;

/// The flag that names a file, with its extension.
const PICTURE: (&str, &str) = ("-o", "png");
const MESH: (&str, &str) = ("--ply", "ply");

/// The files that the user wants, each with its flag and extension.
fn files(args: &TreeArgs) -> impl Iterator<Item = (&Path, (&'static str, &'static str))> {
    let picture = args.output.as_deref().map(|path| (path, PICTURE));
    let mesh = args.ply.as_deref().map(|path| (path, MESH));
    picture.into_iter().chain(mesh)
}

/// Checks the names before anything is read.
///
/// # Errors
/// There are depths without a file, a name has another extension or is that of the scene, both
/// files have one place, or a file cannot be made.
pub(super) fn check_names(args: &TreeArgs) -> Result<()> {
    args.check_depth()?;
    let inputs = Inputs::of_scenes(&[&args.scene]);
    let mut taken = Places::default();
    for (path, (flag, extension)) in files(args) {
        inputs.check(path, flag)?;
        check_extension(path, flag, &[extension])?;
        let destination = Destination::File(path.to_path_buf());
        if let Some(other) = taken.take(&destination, flag) {
            let name = path.display();
            let error = Error::usage(format!("two outputs would both go to `{name}`"));
            return Err(error.note(format!("of {other} and {flag}")));
        }
        atomic_file::check(path)?;
    }
    Ok(())
}

/// Checks the outputs against a scene before its tree is built.
///
/// # Errors
/// An output is a file that the scene reads, or the camera cannot show edges.
pub(super) fn check_scene(args: &TreeArgs, scene: &Scene, files_read: &InputFiles) -> Result<()> {
    for (path, (flag, _)) in files(args) {
        check_against_scene(files_read, path, flag)?;
    }
    if args.output.is_some() && !scene.camera.projection.is_linear() {
        let camera = scene.camera.projection.name();
        let message = format!("boxes cannot be drawn over the picture of a {camera} camera");
        return Err(Error::usage(message).note("--ply writes them as a mesh"));
    }
    Ok(())
}

/// Writes the files that the user wants.
pub(super) fn write(
    args: &TreeArgs,
    scene: &Scene,
    aggregate: &Aggregate,
    reporter: &Reporter,
) -> Result<()> {
    if files(args).next().is_none() {
        return Ok(());
    }
    let boxes = aggregate.boxes(args.depths());
    let palette = Palette::new(args.depths());
    if let Some(path) = &args.ply {
        let write = |out: &mut _| write_ply(&boxes, &palette, out);
        atomic_file::write_file(path, Overwrite::Yes, write)?;
        let count = counted_boxes(&boxes);
        reporter.result(format_args!("{}: {count} as quads", path.display()));
    }
    if let Some(path) = &args.output {
        write_picture(args, path, scene, aggregate, &boxes, &palette)?;
        let (first, last) = args.depths().into_inner();
        let colors = match first == last {
            true => format!("at depth {first}, red"),
            false => format!("from depth {first}, red, to {last}, blue"),
        };
        let count = counted_boxes(&boxes);
        reporter.result(format_args!("{}: {count} {colors}", path.display()));
    }
    Ok(())
}

fn counted_boxes(boxes: &[NodeBox]) -> String {
    match boxes.len() {
        1 => "1 box".to_owned(),
        count => format!("{}es", counted(count as u64, "box").trim_end_matches('s')),
    }
}

fn write_picture(
    args: &TreeArgs,
    path: &Path,
    scene: &Scene,
    aggregate: &Aggregate,
    boxes: &[NodeBox],
    palette: &Palette,
) -> Result<()> {
    let options = RenderOptions {
        data_window: scene.film.crop,
        channels: vec![ChannelName::Z, ChannelName::A],
        precision: Precision::Exact,
        miss: f32::INFINITY,
        level: Level::detect(),
    };
    let (camera, geometry) = (&scene.camera, &scene.geometry);
    let bars = ProgressBars::new(&args.messages);
    let trace = |progress: Progress<'_>| render(camera, geometry, aggregate, &options, progress);
    let image = bars
        .during(Phase::Rendering(scene.film.crop.area()), trace)?
        .image;
    let window = scene.film.crop;
    let size = [window.width(), window.height()];
    let write = |out: &mut _| {
        let pixels = draw_boxes(&image, camera, boxes, palette)?;
        png_file::write_rgb(size, &pixels, &[], out, Progress::SILENT)
    };
    atomic_file::write_file(path, Overwrite::Yes, write).map(|_| ())
}
