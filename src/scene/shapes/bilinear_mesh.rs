//! `Shape "bilinearmesh"` of pbrt-v4, and `"bilinearPatch"` of forks.

use super::arrays::{faces_of, uv_of, vertices_of};
use super::target::{SURFACE, ShapeRefusal, ShapeResult, ShapeTarget};
use crate::error::counted;
use crate::geometry::Point;
use crate::mesh::{TriangleMesh, bilinear_patch, of_corners};
use crate::parallel::CollectVec;
use crate::scene::parameters::{DeclaredType, Parameters};
use crate::shape::PatchUv;
use rayon::prelude::*;

/// The patches of a mesh.
struct Patches {
    vertices: Vec<Point>,
    /// The indices of p00, p10, p01 and p11 of each.
    corners: Vec<[u32; 4]>,
    /// The coordinates of the vertices, if the file has any and the options want them.
    uv: Option<Vec<[f32; 2]>>,
}

/// Adds two triangles for each patch that is flat and convex, and else a true patch (rules R7 and
/// E11).
pub(super) fn add(parameters: &mut Parameters, target: &mut ShapeTarget) -> ShapeResult<()> {
    parameters.ignore(&SURFACE);
    let vertices = vertices_of(parameters, "a bilinear mesh")?;
    let count = vertices.len();
    let corners = match faces_of(parameters, count, "four a patch", target.warnings)? {
        Some(patches) => patches,
        None if count == 4 => vec![[0, 1, 2, 3]],
        None => {
            let message = format!(
                "a bilinear mesh of {} without `indices`",
                counted(count as u64, "vertex")
            );
            let error = parameters.missing("indices", message);
            let error = error.note("only a single patch, of 4 vertices, needs none");
            return Err(ShapeRefusal::shape("without indices", error));
        }
    };
    let uv = match target.keeps_uv {
        true => uv_of(parameters, count, target.warnings)?,
        false => None,
    };
    let patches = Patches {
        vertices,
        corners,
        uv,
    };
    patches.add_to(parameters, target)
}

/// Adds the one patch of `bilinearPatch`, as forks of pbrt call it, by the names of its corners.
pub(super) fn add_patch(parameters: &mut Parameters, target: &mut ShapeTarget) -> ShapeResult<()> {
    let mut vertices = Vec::new();
    for name in ["P00", "P10", "P01", "P11"] {
        let Some(corner) = parameters.fixed_numbers::<3>(name, DeclaredType::POINT)? else {
            let message = format!("a bilinear patch without the corner `{name}`");
            let error = parameters.missing(name, message);
            let error = error.note("expected \"point3 P00\", `P10`, `P01` and `P11`");
            return Err(ShapeRefusal::shape("without a corner", error));
        };
        vertices.push(corner.into());
    }
    let patches = Patches {
        vertices,
        corners: vec![[0, 1, 2, 3]],
        uv: None,
    };
    patches.add_to(parameters, target)
}

impl Patches {
    fn add_to(self, parameters: &Parameters, target: &mut ShapeTarget) -> ShapeResult<()> {
        let is_flat = |patch: &[u32; 4]| bilinear_patch::is_flat_and_convex(self.points(patch));
        let are_flat: Vec<bool> = self.corners.par_iter().map(is_flat).collect_vec();
        if are_flat.iter().all(|is_flat| *is_flat) {
            let mesh = triangles_of(self.vertices, &self.corners, self.uv, target.keeps_uv);
            return Ok(target.add_mesh(parameters, mesh)?);
        }
        // Numbers follow the file: runs of flat patches and of others take turns.
        let mut first = 0;
        for run in are_flat.chunk_by(|a, b| a == b) {
            let patches = &self.corners[first..][..run.len()];
            first += run.len();
            if run[0] {
                self.add_flat(patches, parameters, target)?;
            } else {
                let points: Vec<[Point; 4]> = patches.iter().map(|p| self.points(p)).collect();
                let uv = self.uv.as_ref().map(|uv| {
                    let of_patch = |p: &[u32; 4]| p.map(|corner| uv[corner as usize]);
                    patches.iter().map(of_patch).collect::<Vec<PatchUv>>()
                });
                target.add_patches(parameters, &points, uv.as_deref())?;
            }
        }
        Ok(())
    }

    fn points(&self, patch: &[u32; 4]) -> [Point; 4] {
        patch.map(|corner| self.vertices[corner as usize])
    }

    /// Adds some of the patches, with vertices of their own, as triangles.
    fn add_flat(
        &self,
        patches: &[[u32; 4]],
        parameters: &Parameters,
        target: &mut ShapeTarget,
    ) -> ShapeResult<()> {
        let corners = patches.iter().flatten();
        let vertices = corners
            .clone()
            .map(|c| self.vertices[*c as usize])
            .collect();
        let uv = self
            .uv
            .as_ref()
            .map(|uv| corners.map(|c| uv[*c as usize]).collect());
        let own = |k: u32| [4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3];
        let own: Vec<[u32; 4]> = (0..patches.len() as u32).map(own).collect();
        let mesh = triangles_of(vertices, &own, uv, target.keeps_uv);
        Ok(target.add_mesh(parameters, mesh)?)
    }
}

/// Two triangles for each patch.
fn triangles_of(
    vertices: Vec<Point>,
    patches: &[[u32; 4]],
    uv: Option<Vec<[f32; 2]>>,
    wants_uv: bool,
) -> TriangleMesh {
    let triangles = patches
        .par_iter()
        .map(|patch| bilinear_patch::triangles(*patch));
    let triangles = triangles.collect_vec().into_flattened();
    let uv = wants_uv.then(|| match uv {
        Some(uv) => of_corners(&triangles, &uv),
        None => vec![bilinear_patch::UV; triangles.len() / 2].into_flattened(),
    });
    TriangleMesh {
        vertices,
        triangles,
        uv,
        ..TriangleMesh::default()
    }
}
