//! Explains the ray of one pixel: what it hits and where, how close that was, and the answer of
//! each kernel.

mod answer;
mod film_space;
mod hit;
mod margin;
mod scan;
#[cfg(test)]
mod tests;

pub use answer::{Answer, Found};
pub use hit::HitDetails;
pub use margin::Margin;
pub use scan::{CutHit, MAX_SCANNED, Missed, Next, Scan};

use crate::accel::{Aggregate, BuildOptions, Precision, SplitMethod, Tracer, TraversalCounts};
use crate::error::Result;
use crate::geometry::Ray;
use crate::progress::Progress;
use crate::reference::{self, ReferenceHit};
use crate::scene::Scene;
use answer::answers;

/// With more primitives the [reference](mod@reference), which takes a few microseconds for each, is
/// not computed.
pub const MAX_REFERENCED: u64 = 2_000_000;

/// The explanation of a pixel.
#[derive(Debug)]
pub struct Explanation {
    /// Column and row, from the upper left corner.
    pub pixel: [u32; 2],
    /// The ray through the pixel's centre.
    pub ray: Ray,
    /// The exact hit.
    pub hit: Option<HitDetails>,
    /// The primitives near the ray; `None` if the scene has too many.
    pub scan: Option<Scan>,
    /// The answers of all kernels; the first one is [`Explanation::hit`].
    pub answers: Vec<Answer>,
    /// Tests of the ray with each accelerator, by the exact kernel.
    pub costs: Vec<(SplitMethod, TraversalCounts)>,
    /// The reference was computed.
    pub has_reference: bool,
    /// Contradictions between exact answers: a bug in feimos.
    pub contradictions: Vec<String>,
}

/// Explains a pixel of the film. Each of `builds` is tried; the answers come from the first tree.
///
/// # Errors
/// An image of one pixel does not fit into memory.
///
/// # Panics
/// `builds` is empty.
pub fn explain(scene: &Scene, pixel: [u32; 2], builds: &[BuildOptions]) -> Result<Explanation> {
    let Scene {
        camera, geometry, ..
    } = scene;
    let ray = camera.ray(pixel[0], pixel[1]);
    let tree =
        |build: BuildOptions| Aggregate::build(geometry, camera.anchor(), build, Progress::SILENT);
    let cost = |tree: &Aggregate| {
        let mut work = TraversalCounts::default();
        Tracer::new(tree, geometry, Precision::Exact).closest_hit_counted(&ray, &mut work);
        work
    };
    let first = tree(builds[0]);
    let mut tracer = Tracer::new(&first, geometry, Precision::Exact);
    let hit = tracer.closest_hit(&ray).map(|hit| {
        let depth = tracer.depth(&ray, &hit).seen_by(&camera.projection);
        HitDetails::new(scene, pixel, &ray, hit.primitive, depth)
    });
    let answers = answers(scene, &first, pixel)?;
    let mut costs = vec![(builds[0].method, cost(&first))];
    drop(first);
    costs.extend(
        builds[1..]
            .iter()
            .map(|build| (build.method, cost(&tree(*build)))),
    );
    let scan = Scan::of(scene, pixel, &ray, hit.is_none());
    let has_reference = geometry.primitive_count() <= MAX_REFERENCED;
    let reference = || {
        let hit = reference::closest_hit(geometry, &ray);
        hit.map(|hit| hit.seen_by(&camera.projection))
    };
    let reference = has_reference.then(reference);
    let contradictions = contradictions(hit.as_ref(), &answers, scan.as_ref(), reference);
    Ok(Explanation {
        pixel,
        ray,
        hit,
        scan,
        answers,
        costs,
        has_reference,
        contradictions,
    })
}

fn contradictions(
    hit: Option<&HitDetails>,
    answers: &[Answer],
    scan: Option<&Scan>,
    reference: Option<Option<ReferenceHit>>,
) -> Vec<String> {
    let mut found = Vec::new();
    let is_exact = |answer: &&Answer| answer.precision == Some(Precision::Exact);
    for answer in answers.iter().filter(is_exact) {
        if answer.found.map(Found::bits) != answers[0].found.map(Found::bits) {
            found.push(format!(
                "exact {}: {:?} is not {:?}",
                answer.way, answer.found, answers[0].found
            ));
        }
    }
    let primitive = hit.map(|hit| hit.primitive);
    if let Some(scan) = scan.filter(|scan| scan.first != primitive) {
        found.push(format!(
            "all primitives: {:?} is not {primitive:?}",
            scan.first
        ));
    }
    let bits = |z: f32, distance: f32| [z.to_bits(), distance.to_bits()];
    let expected = hit.map(|hit| (hit.primitive, bits(hit.depth.z, hit.depth.distance)));
    if let Some(reference) = reference {
        let reference = reference.map(|hit| (hit.primitive, bits(hit.z, hit.distance)));
        if reference != expected {
            found.push(format!("the reference: {reference:?} is not {expected:?}"));
        }
    }
    found
}
