//! An instance of an object.

use crate::geometry::Matrix;

/// One `ObjectInstance`.
#[derive(Debug)]
pub struct Instance {
    pub(super) world_from_instance: Matrix,
    /// The number of its first primitive.
    pub(super) first_number: u64,
    pub(super) object: u32,
}

const _: () = assert!(size_of::<Instance>() == 112, "there may be millions");

impl Instance {
    /// The current transform at the directive.
    pub fn world_from_instance(&self) -> &Matrix {
        &self.world_from_instance
    }

    /// The number of the object.
    pub fn object(&self) -> usize {
        self.object as usize
    }

    /// The number of its first primitive, counted from 0 in the order of the file.
    pub fn first_number(&self) -> u64 {
        self.first_number
    }
}
