//! The ray of one pixel, explained: what it meets and where, how close that was, and what each way of computing says.

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
pub use scan::{MAX_SCANNED, Missed, Next, Scan};

use crate::accel::{Aggregate, BuildOptions, Precision, SplitMethod, Tracer, TraversalCounts};
use crate::error::Result;
use crate::geometry::Ray;
use crate::progress::Progress;
use crate::reference::{self, ReferenceHit};
use crate::scene::Scene;
use answer::answers;

/// Primitives up to which the [reference](mod@reference) is asked, too: a few microseconds each.
pub const MAX_JUDGED: u64 = 2_000_000;

/// All that is to be said of a pixel.
#[derive(Debug)]
pub struct Explanation {
    /// From the left and from the top.
    pub pixel: [u32; 2],
    /// Through the pixel's centre.
    pub ray: Ray,
    /// What it hits, exactly.
    pub hit: Option<HitDetails>,
    /// What of the scene is near the ray; `None` where there is too much to look at all of it.
    pub scan: Option<Scan>,
    /// What each way of computing finds. The first one is what [`Explanation::hit`] tells.
    pub answers: Vec<Answer>,
    /// What the ray costs with each accelerator, by the exact search.
    pub costs: Vec<(SplitMethod, TraversalCounts)>,
    /// Whether the reference was asked.
    pub is_judged: bool,
    /// Where exact answers contradict each other, in words: a bug of this program.
    pub contradictions: Vec<String>,
}

/// Explains pixel `x`, `y` of the film, which holds it. Each of `builds` is tried; the answers come of the first one's tree.
///
/// # Errors
/// Where an image of one pixel does not fit into memory.
///
/// # Panics
/// Where `builds` is empty.
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
        let depth = tracer.depth(&ray, &hit);
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
    let is_judged = geometry.primitive_count() <= MAX_JUDGED;
    let judged = is_judged.then(|| reference::closest_hit(geometry, &ray));
    let contradictions = contradictions(hit.as_ref(), &answers, scan.as_ref(), judged);
    Ok(Explanation {
        pixel,
        ray,
        hit,
        scan,
        answers,
        costs,
        is_judged,
        contradictions,
    })
}

fn contradictions(
    hit: Option<&HitDetails>,
    answers: &[Answer],
    scan: Option<&Scan>,
    judged: Option<Option<ReferenceHit>>,
) -> Vec<String> {
    let mut found = Vec::new();
    for answer in answers
        .iter()
        .filter(|answer| answer.precision == Some(Precision::Exact))
    {
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
    let expected = hit.map(|hit| {
        (
            hit.primitive,
            hit.depth.z.to_bits(),
            hit.depth.distance.to_bits(),
        )
    });
    if let Some(judged) = judged {
        let judged = judged.map(|hit| (hit.primitive, hit.z.to_bits(), hit.distance.to_bits()));
        if judged != expected {
            found.push(format!("the reference: {judged:?} is not {expected:?}"));
        }
    }
    found
}
