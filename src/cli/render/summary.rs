//! Messages about a structure and about a finished image.

use super::built::{Built, BuiltSize};
use super::record::Finished;
use super::tree_statistics::TreeStatistics;
use crate::error::grouped;

use crate::accel::{ExactFallbacks, Precision};
use crate::cli::files::destination::joined;
use crate::cli::terminal::reporter::Reporter;
use crate::cli::terminal::scene_summary::StoredGeometry;
use crate::cli::terminal::words::counted;
use crate::scene::Scene;
use crate::shape::Geometry;

/// If verbose, prints the size of a structure, and how many primitives no ray can hit.
pub(super) fn report_built(built: &Built, geometry: &Geometry, reporter: &Reporter) {
    reporter.detail(built.summary(geometry));
    let dead = built.never_hit();
    if dead > 0 {
        reporter.detail(format_args!(
            "{} of {} can never be hit: no area, or not finite",
            grouped(dead as u64),
            counted(geometry.own_count() as u64, "primitive")
        ));
    }
}

/// Prints one line on the image, and one on each of several files whose colours have a meaning.
pub(super) fn report_image(finished: &Finished, reporter: &Reporter) {
    let hits = finished.rendering.traced.hits;
    if hits == 0 {
        reporter.note("no ray hits anything");
    }
    let window = &finished.rendering.image.data_window;
    let (width, height) = (window.width(), window.height());
    let (names, description) = match &finished.files[..] {
        [file] => (file.destination.to_string(), file.description.as_deref()),
        files => (joined(files.iter().map(|file| &file.destination)), None),
    };
    let description = description.map_or(String::new(), |words| format!(", {words}"));
    let ms = &finished.ms;
    reporter.result(format_args!(
        "{names}: {width} x {height} pixels, {} hit{description} \
         (load {:.0}, build {:.0} by {}, trace {:.0}, write {:.0} ms)",
        grouped(hits),
        ms.load,
        ms.build,
        finished.accelerator,
        ms.trace,
        ms.write,
    ));
    for file in finished.files.iter().filter(|_| finished.files.len() > 1) {
        if let Some(description) = &file.description {
            reporter.result(format_args!("{}: {description}", file.destination));
        }
    }
}

/// Prints the lines of `--stats`.
pub(super) fn report_statistics(scene: &Scene, finished: &Finished, reporter: &Reporter) {
    let rays = finished.rendering.image.data_window.area();
    let mut lines = lines_on_scene(scene);
    lines.extend(lines_on_trace(finished, rays));
    if let Some(tree) = &finished.tree {
        lines.extend(lines_on_tree(tree, rays));
    }
    for (subject, text) in lines {
        reporter.line(format_args!("{subject:12}{text}"));
    }
}

/// A line of `--stats`: its subject and its text.
type Line = (&'static str, String);

fn lines_on_scene(scene: &Scene) -> Vec<Line> {
    let geometry = &scene.geometry;
    let shapes = counted(scene.shape_count.into(), "shape");
    let transforms = counted(scene.transform_count as u64, "transform");
    vec![
        ("scene", format!("{shapes} under {transforms}")),
        ("primitives", StoredGeometry::of(geometry).to_string()),
        ("geometry", counted(geometry.bytes() as u64, "byte")),
    ]
}

/// What the image was traced through, and how fast.
fn lines_on_trace(finished: &Finished, rays: u64) -> Vec<Line> {
    let (accelerator, ms) = (finished.accelerator, &finished.ms);
    let structure = match finished.size {
        BuiltSize::Bins { primitives, bytes } => format!(
            "bins of this view, with {} that rays may meet, {}",
            counted(primitives as u64, "primitive"),
            counted(bytes as u64, "byte"),
        ),
        BuiltSize::Tree(_) => "a tree of the whole scene".to_owned(),
    };
    let mut lines = vec![
        ("accelerator", format!("{accelerator}: {structure}")),
        ("precision", finished.precision.to_string()),
        ("build", format!("{:.1} ms", ms.build)),
        (
            "trace",
            format!(
                "{:.1} ms, {:.2} million rays a second",
                ms.trace,
                rays as f64 / ms.trace / 1e3
            ),
        ),
    ];
    if finished.precision == Precision::Exact {
        let ExactFallbacks {
            unsure_tests,
            comparisons,
            roundings,
            rays,
        } = finished.rendering.traced.fallbacks;
        let text = format!(
            "for {}: {}, {}, {}",
            counted(rays, "ray"),
            counted(unsure_tests, "test"),
            counted(comparisons, "comparison"),
            counted(roundings, "rounding"),
        );
        lines.push(("integers", text));
    }
    lines
}

/// A tree, and what the rays test in it.
fn lines_on_tree(tree: &TreeStatistics, rays: u64) -> Vec<Line> {
    let (method, size) = (tree.method, tree.size);
    let purpose = match tree.is_traced {
        true => "the image was traced through it",
        false => "built for these statistics, since bins have no nodes",
    };
    let per_ray = |count: u64| count as f64 / rays as f64;
    let (nodes, primitives) = (per_ray(tree.counts.nodes), per_ray(tree.counts.primitives));
    vec![
        ("tree", format!("by {method}: {purpose}")),
        (
            "nodes",
            format!(
                "{} ({} {}), depth {}, {}",
                grouped(size.nodes as u64),
                grouped(size.leaves as u64),
                if size.leaves == 1 { "leaf" } else { "leaves" },
                size.depth,
                counted(size.bytes as u64, "byte"),
            ),
        ),
        ("SAH cost", format!("{:.2}", size.sah_cost)),
        (
            "per ray",
            format!("{nodes:.2} nodes, {primitives:.2} primitives tested, by each ray alone"),
        ),
    ]
}
