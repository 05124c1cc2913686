//! Messages about a structure and about a finished image.

use super::built::{Built, BuiltSize};
use super::record::Finished;

use crate::cli::files::destination::joined;
use crate::cli::terminal::reporter::Reporter;
use crate::cli::terminal::scene_summary::StoredGeometry;
use feimos::accel::{ExactFallbacks, Precision};
use feimos::scene::Scene;
use feimos::shape::Geometry;

/// Prints the size of a structure, and a note on primitives that no ray can hit.
pub(super) fn report_built(built: &Built, geometry: &Geometry, reporter: &Reporter) {
    reporter.detail(built.summary(geometry));
    let dead = built.never_hit();
    if dead > 0 {
        reporter.note(format_args!(
            "{dead} of {} primitives can never be hit: no area, or not finite",
            geometry.own_count()
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
        "{names}: {width} x {height} pixels, {hits} hit{description} \
         (load {:.0}, build {:.0} by {}, trace {:.0}, write {:.0} ms)",
        ms.load, ms.build, finished.accelerator, ms.trace, ms.write,
    ));
    for file in finished.files.iter().filter(|_| finished.files.len() > 1) {
        if let Some(description) = &file.description {
            reporter.result(format_args!("{}: {description}", file.destination));
        }
    }
}

/// Prints the lines of `--stats`.
pub(super) fn report_statistics(scene: &Scene, finished: &Finished, reporter: &Reporter) {
    let (ms, geometry) = (&finished.ms, &scene.geometry);
    let rays = finished.rendering.image.data_window.area() as f64;
    let mrays_per_s = rays / ms.trace / 1e3;
    let Finished {
        accelerator,
        precision,
        ..
    } = finished;
    let mut lines = vec![
        (
            "shapes",
            format!(
                "{} under {} transforms",
                scene.shape_count, scene.transform_count
            ),
        ),
        ("primitives", StoredGeometry::of(geometry).to_string()),
        ("geometry", format!("{} bytes", geometry.bytes())),
        ("precision", precision.to_string()),
        (
            "accelerator",
            format!("{accelerator}, built in {:.1} ms", ms.build),
        ),
    ];
    lines.extend(lines_on_size(finished.size));
    if let Some(counts) = finished.rendering.traced.counts {
        let (nodes, primitives) = (counts.nodes as f64 / rays, counts.primitives as f64 / rays);
        let text = format!("{nodes:.2} nodes, {primitives:.2} primitives tested");
        lines.push(("per ray", text));
    }
    lines.push((
        "trace",
        format!("{:.1} ms, {mrays_per_s:.2} million rays a second", ms.trace),
    ));
    for (subject, text) in lines {
        reporter.line(format_args!("{subject:12}{text}"));
    }
    if *precision == Precision::Exact {
        let ExactFallbacks {
            unsure_tests,
            comparisons,
            roundings,
            rays,
        } = finished.rendering.traced.fallbacks;
        reporter.line(format_args!(
            "integers    for {rays} rays: {unsure_tests} tests, {comparisons} comparisons, \
             {roundings} roundings"
        ));
    }
}

/// The lines on the size of a structure.
fn lines_on_size(size: BuiltSize) -> Vec<(&'static str, String)> {
    match size {
        BuiltSize::Bins { primitives, bytes } => vec![(
            "bins",
            format!("{primitives} primitives that rays may meet, {bytes} bytes"),
        )],
        BuiltSize::Tree(tree) => vec![
            (
                "nodes",
                format!(
                    "{} ({} leaves), depth {}",
                    tree.nodes, tree.leaves, tree.depth
                ),
            ),
            ("SAH cost", format!("{:.2}", tree.sah_cost)),
            ("tree", format!("{} bytes", tree.bytes)),
        ],
    }
}
