//! How meshes and quadrics are stored and numbered.

use std::fmt;

/// The triangles of one shape, with consecutive primitive numbers.
#[derive(Debug)]
pub(super) struct MeshRun {
    pub(super) first_triangle: u32,
    pub(super) first_number: FirstNumber,
    pub(super) shape: u32,
    /// For a mesh of an object: the transform of its vertices.
    pub(super) transform: Option<u32>,
}

/// Quadrics with consecutive primitive numbers.
#[derive(Debug)]
pub(super) struct QuadricRun {
    pub(super) first_quadric: u32,
    pub(super) first_number: FirstNumber,
}

/// Patches of an object, which share the transform of their corners.
#[derive(Debug)]
pub(super) struct PatchRun {
    pub(super) first_quadric: u32,
    pub(super) transform: u32,
}

/// The number of the first primitive of a run.
#[derive(Debug, Clone, Copy)]
pub(super) struct FirstNumber {
    /// The number of primitives before it that are in no instance.
    pub(super) alone: u32,
    /// The number of primitives before it that are in instances.
    pub(super) instanced: u64,
}

impl FirstNumber {
    pub(super) fn in_all(self) -> u64 {
        self.instanced + u64::from(self.alone)
    }
}

/// A quadric of 16 bytes. The forms of those that are not whole spheres are stored apart: most are.
#[derive(Debug)]
pub(super) struct StoredQuadric {
    pub(super) radius: f64,
    pub(super) transform: u32,
    pub(super) shape: u32,
}

/// A scene contains more items of a kind than 32-bit numbers can count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CapacityError {
    pub(super) what: &'static str,
    pub(super) limit: u64,
}

impl fmt::Display for CapacityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the scene has more than {} {}", self.limit, self.what)
    }
}

/// Refuses more of `what` than a limit.
pub(super) fn check_room(
    count: usize,
    limit: usize,
    what: &'static str,
) -> Result<(), CapacityError> {
    if count > limit {
        let limit = limit as u64;
        Err(CapacityError { what, limit })
    } else {
        Ok(())
    }
}
