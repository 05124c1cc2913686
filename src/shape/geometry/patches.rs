//! How bilinear patches are stored.

use super::Geometry;
use super::runs::{CapacityError, PatchRun};
use crate::geometry::{Matrix, Point};
use crate::shape::{Form, Quadric};

impl Geometry {
    /// Appends a bilinear patch, and moves its object-space corners p00, p10, p01 and p11 to world
    /// space (rule R4).
    pub fn add_patch(
        &mut self,
        corners: [Point; 4],
        world_from_object: &Matrix,
        shape: u32,
    ) -> Result<(), CapacityError> {
        let corners = corners.map(|corner| world_from_object.apply(corner));
        self.push_patch(corners, shape)
    }

    /// Appends a bilinear patch of an object, whose corners stay in object space. `transform` is a
    /// number from [`Geometry::add_transform`].
    pub fn add_object_patch(
        &mut self,
        corners: [Point; 4],
        transform: u32,
        shape: u32,
    ) -> Result<(), CapacityError> {
        let first_quadric = self.quadrics.len() as u32;
        self.push_patch(corners, shape)?;
        let last = self.patch_runs.last();
        if last.is_none_or(|run| run.transform != transform) {
            self.patch_runs.push(PatchRun {
                first_quadric,
                transform,
            });
        }
        Ok(())
    }

    fn push_patch(&mut self, corners: [Point; 4], shape: u32) -> Result<(), CapacityError> {
        let patch = Quadric::of_patch(corners);
        let corners = self.transforms.len() as u32;
        self.add_quadric(patch.radius, Form::Patch, corners, shape)?;
        self.transforms.push(patch.world_from_object);
        Ok(())
    }

    /// The transform of the corners of quadric `index` of an object, which is a patch.
    pub(crate) fn transform_of_patch(&self, index: usize) -> &Matrix {
        let runs = &self.patch_runs;
        let run = runs.partition_point(|run| run.first_quadric as usize <= index);
        &self.transforms[runs[run - 1].transform as usize]
    }
}
