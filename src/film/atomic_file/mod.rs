//! Writes files that appear completely or not at all.
//!
//! The bytes go to a new file in the directory of the final name, which gets this name when it is
//! complete. Readers see the old file or the new one, and an error leaves the old one untouched.

mod check;
#[cfg(unix)]
mod leftovers;
mod permissions;
mod target;
mod temporary_file;
#[cfg(test)]
mod tests;
mod unfinished;
mod unnamed_file;
mod write;
mod write_behind;

pub use check::check;
pub use target::{directory_of, target};
pub use unfinished::{Overwrite, abandon};
pub use write::{Out, sync_folder, write_file};
pub use write_behind::WriteBehind;
