//! What a person reads about a scene and its image.

use super::counted::counted;
use super::job::Finished;
use super::loaded_scene::Built;
use super::record::Milliseconds;
use super::reporter::Reporter;
use feimos::accel::{ExactFallbacks, Precision, SplitMethod};
use feimos::scene::Scene;
use feimos::shape::Geometry;
use indicatif::HumanCount;

/// Warnings, what was skipped, and what there is.
pub(super) fn report_scene(scene: &Scene, reporter: &Reporter) {
    reporter.warnings(&scene.warnings);
    if let Some(summary) = scene.census.summary() {
        reporter.note(summary);
    }
    let geometry = &scene.geometry;
    reporter.detail(format_args!(
        "loaded {} shapes: {}, {} transforms, {} bytes",
        scene.shape_count,
        stored_geometry(geometry),
        scene.transform_count,
        geometry.bytes(),
    ));
}

/// What is stored, and how often objects are instanced, if there are any.
pub(super) fn stored_geometry(geometry: &Geometry) -> String {
    let quadrics = match geometry.stored_quadrics() {
        0 => String::new(),
        1 => ", 1 sphere, cylinder or disk".to_owned(),
        count => format!(
            ", {} spheres, cylinders and disks",
            HumanCount(count as u64)
        ),
    };
    let stored = format!(
        "{}{quadrics}",
        counted(geometry.stored_triangles() as u64, "triangle")
    );
    match geometry.instances().len() as u64 {
        0 => stored,
        instances => {
            let (instances, objects) = (
                counted(instances, "instance"),
                counted(geometry.objects().len() as u64, "object"),
            );
            let primitives = counted(geometry.primitive_count(), "primitive");
            format!("{stored}, {instances} of {objects}: {primitives} in all")
        }
    }
}

/// What was built, and a note on primitives that no ray can hit.
pub(super) fn report_tree(
    built: &Built,
    geometry: &Geometry,
    method: SplitMethod,
    reporter: &Reporter,
) {
    let Built {
        aggregate,
        statistics,
    } = built;
    let (nodes, built) = (statistics.nodes, aggregate.primitive_count(geometry));
    let primitives = geometry.primitive_count();
    reporter.detail(format_args!(
        "built {nodes} nodes by {method} over {built} of {primitives} primitives"
    ));
    let (dead, of) = (aggregate.never_hit(), geometry.own_count());
    if dead > 0 {
        reporter.note(format_args!(
            "{dead} of {of} primitives can never be hit: no area, or not finite"
        ));
    }
}

/// One line on the image.
pub(super) fn report_image(finished: &Finished, reporter: &Reporter) {
    if finished.rendering.traced.hits == 0 {
        reporter.note("no ray hits anything");
    }
    let window = &finished.rendering.image.data_window;
    let legend = finished
        .legend
        .as_ref()
        .map_or(String::new(), |legend| format!(", {legend}"));
    let Milliseconds {
        load,
        build,
        trace,
        write,
        ..
    } = finished.ms;
    reporter.result(format_args!(
        "{}: {} x {} pixels, {} hit{legend} (load {load:.0}, build {build:.0}, trace {trace:.0}, write {write:.0} ms)",
        finished.destination,
        window.width(),
        window.height(),
        finished.rendering.traced.hits,
    ));
}

/// The lines of `--stats`.
pub(super) fn report_statistics(scene: &Scene, finished: &Finished, reporter: &Reporter) {
    let (tree, ms, geometry) = (&finished.statistics, &finished.ms, &scene.geometry);
    let rays = finished.rendering.image.data_window.area() as f64;
    let work = finished.rendering.traced.counts.unwrap_or_default();
    let (nodes, primitives) = (work.nodes as f64 / rays, work.primitives as f64 / rays);
    let lines = [
        format!(
            "shapes      {} under {} transforms",
            scene.shape_count, scene.transform_count
        ),
        format!("primitives  {}", stored_geometry(geometry)),
        format!("geometry    {} bytes", geometry.bytes()),
        format!("precision   {}", finished.precision),
        format!(
            "accelerator {}, built in {:.1} ms",
            finished.method, ms.build
        ),
        format!(
            "nodes       {} ({} leaves), depth {}",
            tree.nodes, tree.leaves, tree.depth
        ),
        format!("SAH cost    {:.2}", tree.sah_cost),
        format!("tree        {} bytes", tree.bytes),
        format!("per ray     {nodes:.2} nodes, {primitives:.2} primitives tested"),
        format!(
            "trace       {:.1} ms, {:.2} million rays a second",
            ms.trace,
            rays / ms.trace / 1e3
        ),
    ];
    lines.iter().for_each(|line| reporter.line(line));
    if finished.precision == Precision::Exact {
        let ExactFallbacks {
            unsure_tests,
            comparisons,
            roundings,
            rays: hard,
        } = finished.rendering.traced.fallbacks;
        reporter.line(format_args!(
            "integers    for {hard} rays: {unsure_tests} tests, {comparisons} comparisons, {roundings} roundings"
        ));
    }
}
