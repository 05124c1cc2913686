//! Places of outputs: two names of one place are recognized.

use super::destination::Destination;
use crate::file_id::FileId;
use crate::film::atomic_file::{self, directory_of};
use std::collections::HashMap;
use std::path::{Component, Path, PathBuf};

/// A place, independent of links, `..` and other spellings of its name.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
enum Place {
    Stdout,
    /// A file that exists.
    File(FileId),
    /// A name in a directory that exists; missing folders are part of the name.
    Name(FileId, PathBuf),
    /// A name that leads nowhere.
    Unknown(PathBuf),
}

impl Place {
    /// The identities of a destination: its name, and its file if it exists. A file that appears
    /// later still has the identity of its name.
    fn all_of(destination: &Destination) -> Vec<Place> {
        let Destination::File(path) = destination else {
            return vec![Place::Stdout];
        };
        let target = atomic_file::target(path).unwrap_or_else(|_| path.to_path_buf());
        let name = match (existing_part(directory_of(&target)), target.file_name()) {
            (Some((directory, missing)), Some(name)) => Place::Name(directory, missing.join(name)),
            _ => Place::Unknown(target),
        };
        let file = FileId::of(path).map(Place::File);
        [Some(name), file].into_iter().flatten().collect()
    }
}

/// The part of `directory` that exists, and the folders below that would be made for a file.
fn existing_part(directory: &Path) -> Option<(FileId, PathBuf)> {
    let (mut existing, mut missing) = (PathBuf::from("."), PathBuf::new());
    for component in directory.components() {
        let next = existing.join(component);
        if missing.as_os_str().is_empty() && next.is_dir() {
            existing = next;
        } else if component == Component::ParentDir {
            missing.pop();
        } else {
            missing.push(component);
        }
    }
    Some((FileId::of_directory(&existing)?, missing))
}

/// Places that are taken, each with its owner.
#[derive(Debug)]
pub(crate) struct Places<T>(HashMap<Place, T>);

impl<T> Default for Places<T> {
    fn default() -> Places<T> {
        Places(HashMap::new())
    }
}

impl<T: Clone> Places<T> {
    /// Takes the place of `destination` for `owner`, or returns its present owner.
    pub(crate) fn take(&mut self, destination: &Destination, owner: T) -> Option<T> {
        let places = Place::all_of(destination);
        let other = places.iter().find_map(|place| self.0.get(place)).cloned();
        if other.is_none() {
            let places = places.into_iter();
            self.0.extend(places.map(|place| (place, owner.clone())));
        }
        other
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// Returns true if both names in `directory` are one place.
    fn meet(directory: &Path, one: &str, other: &str) -> bool {
        let destination = |name: &str| Destination::File(directory.join(name));
        let mut places = Places::default();
        assert_eq!(places.take(&destination(one), 1), None);
        places.take(&destination(other), 2) == Some(1)
    }

    #[test]
    fn spellings_of_one_place_are_equal() {
        let directory = tempfile::tempdir().unwrap();
        fs::create_dir(directory.path().join("sub")).unwrap();
        let meet = |one, other| meet(directory.path(), one, other);
        assert!(meet("a.exr", "sub/../a.exr") && meet("gone/a.exr", "gone/a.exr"));
        assert!(!meet("a.exr", "b.exr") && !meet("a.exr", "sub/a.exr"));
        assert!(meet("gone/a.exr", "sub/../gone/b/../a.exr") && meet("gone/../a.exr", "a.exr"));
        assert!(!meet("gone/a.exr", "a.exr") && !meet("gone/a.exr", "sub/gone/a.exr"));
        fs::write(directory.path().join("a.exr"), "").unwrap();
        assert!(meet("a.exr", "./a.exr"));
    }

    #[test]
    fn a_file_that_appears_has_the_place_of_its_name() {
        let directory = tempfile::tempdir().unwrap();
        let destination = Destination::File(directory.path().join("a.exr"));
        let mut places = Places::default();
        assert_eq!(places.take(&destination, 1), None);
        fs::write(directory.path().join("a.exr"), "").unwrap();
        assert_eq!(places.take(&destination, 2), Some(1));
    }

    #[cfg(unix)]
    #[test]
    fn links_have_the_place_of_their_target() {
        use std::os::unix::fs::symlink;
        let directory = tempfile::tempdir().unwrap();
        let path = |name: &str| directory.path().join(name);
        fs::create_dir(path("sub")).unwrap();
        symlink("sub", path("link")).unwrap();
        symlink("sub/a.exr", path("b.exr")).unwrap();
        let meet = |one, other| meet(directory.path(), one, other);
        assert!(meet("link/a.exr", "sub/a.exr"));
        assert!(meet("b.exr", "sub/a.exr"), "the target does not exist yet");
        fs::write(path("sub/a.exr"), "").unwrap();
        fs::hard_link(path("sub/a.exr"), path("c.exr")).unwrap();
        assert!(meet("b.exr", "c.exr"));
    }
}
