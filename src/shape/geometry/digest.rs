//! The digest of the geometry.

use super::Geometry;
use super::curves::Curves;
use super::runs::FirstNumber;
use crate::digest::Digester;

impl Geometry {
    /// Adds everything that pictures of the geometry depend on.
    pub fn digest(&self, digester: &mut Digester) {
        digester.list(&self.vertices, |vertex| vertex.to_array().map(f64::to_bits));
        digester.list(&self.triangles, |[a, b, c]| {
            [u64::from(*a) << 32 | u64::from(*b), u64::from(*c)]
        });
        digester.list(&self.meshes, |run| {
            let [alone, instanced] = words_of(run.first_number);
            let transform = run.transform.map_or(u64::MAX, u64::from);
            [
                run.first_triangle.into(),
                alone,
                instanced,
                run.shape.into(),
                transform,
            ]
        });
        digester.list(&self.quadrics, |quadric| {
            [
                quadric.radius.to_bits(),
                u64::from(quadric.transform) << 32 | u64::from(quadric.shape),
            ]
        });
        digester.list(&self.quadric_runs, |run| {
            let [alone, instanced] = words_of(run.first_number);
            [run.first_quadric.into(), alone, instanced]
        });
        self.forms.digest(digester);
        if !self.patch_runs.is_empty() {
            digester.list(&self.patch_runs, |run| {
                [run.first_quadric.into(), run.transform.into()]
            });
        }
        self.curves.digest(digester);
        digester.list(&self.transforms, |transform| transform.bits());
        digester.word(self.attributes.is_some().into());
        self.attributes
            .iter()
            .for_each(|attributes| attributes.digest(digester));
        // A word only if there are some: pictures without them keep their digests.
        if let Some(cut_outs) = &self.cut_outs {
            digester.word(CUT_OUTS);
            cut_outs.digest(digester);
        }
        digester.word(self.objects.len() as u64);
        self.objects
            .iter()
            .for_each(|object| object.digest(digester));
        digester.list(&self.instances, |instance| {
            let mut words = [instance.object.into(); 14];
            words[1] = instance.first_number;
            words[2..].copy_from_slice(&instance.world_from_instance.bits());
            words
        });
    }
}

impl Curves {
    /// Nothing where there are no curves, so that images without them keep their headers.
    fn digest(&self, digester: &mut Digester) {
        if self.segments.is_empty() {
            return;
        }
        digester.list(&self.points, |point| point.bits());
        digester.list(&self.segments, |segment| segment.words());
        digester.list(&self.runs, |run| {
            let [alone, instanced] = words_of(run.first_number);
            [
                u64::from(run.first_segment) << 32 | u64::from(run.shape),
                alone,
                instanced,
            ]
        });
    }
}
/// Begins the alphas; no geometry has as many objects.
const CUT_OUTS: u64 = u64::MAX;

fn words_of(number: FirstNumber) -> [u64; 2] {
    [number.alone.into(), number.instanced]
}
