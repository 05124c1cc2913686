//! Files that commands read and write: their names, and the places that they lead to.

pub(super) mod destination;
pub(super) mod folders;
pub(super) mod inputs;
pub(super) mod new_folders;
pub(super) mod places;
pub(super) mod results;
