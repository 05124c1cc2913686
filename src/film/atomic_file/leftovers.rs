//! Removes unfinished files that dead processes have left, such as after `kill -9` on a file system
//! without unnamed files.

use super::temporary_file::{is_named, is_of_this_host, is_temporary};
use rustix::fs::{Dir, Mode, OFlags, open};
use std::collections::BTreeSet;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant, SystemTime};

/// How long to look at the names in a folder. A folder on a network may have very many.
const PATIENCE: Duration = Duration::from_millis(50);

/// A file of another machine is a leftover if nobody has written to it for so long: its lock may be
/// known to that machine alone.
const OLD: Duration = Duration::from_secs(24 * 60 * 60);

/// The folders that this process has looked at. One look is enough.
static SEEN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Removes leftovers in `folder`, once in the life of the process. `new` is a file that it has just
/// made there: the clock of its file system may not be that of this machine.
pub(super) fn remove(folder: &Path, new: &File) {
    let mut seen = SEEN.lock().unwrap_or_else(PoisonError::into_inner);
    let is_first = seen.insert(folder.to_path_buf());
    drop(seen);
    if let (true, Ok(now)) = (is_first, new.metadata().and_then(|new| new.modified())) {
        remove_at(folder, now);
    }
}

/// Removes leftovers in `folder`; `now` is by the clock of its file system. Errors are ignored:
/// leftovers do no harm but take room.
fn remove_at(folder: &Path, now: SystemTime) {
    // Not `std::fs::read_dir`: it panics if the folder cannot be closed.
    let flags = OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC;
    let opened = open(folder, flags, Mode::empty());
    let Ok(entries) = opened.and_then(Dir::new) else {
        return;
    };
    let start = Instant::now();
    let in_time = |_: &_| start.elapsed() < PATIENCE;
    for entry in entries.map_while(Result::ok).take_while(in_time) {
        let name = entry.file_name().to_str();
        if let Some(name) = name.ok().filter(|name| is_temporary(name)) {
            remove_leftover(&folder.join(name), name, now);
        }
    }
}

/// Removes the file `path`, which has a temporary `name`, unless its writer may be alive.
///
/// A living writer holds the lock. While this process holds it, no writer can give the file another
/// name: the one who made the file looks at its name again after locking it.
fn remove_leftover(path: &Path, name: &str, now: SystemTime) {
    let Some(file) = opened(path) else {
        return;
    };
    let is_old = || {
        let modified = file.metadata().and_then(|found| found.modified());
        modified.is_ok_and(|modified| now.duration_since(modified).is_ok_and(|age| age >= OLD))
    };
    let is_dead = (is_of_this_host(name) || is_old()) && file.try_lock().is_ok();
    if is_dead && is_named(&file, path).is_ok_and(|is_named| is_named) {
        let _ = std::fs::remove_file(path);
    }
}

/// Opens a regular file, for writing: locks of NFS need that. Anything else may wait for another
/// program, or be somebody's trap.
fn opened(path: &Path) -> Option<File> {
    let flags = OFlags::WRONLY | OFlags::NOFOLLOW | OFlags::NONBLOCK | OFlags::CLOEXEC;
    let file = File::from(open(path, flags, Mode::empty()).ok()?);
    let is_regular = file.metadata().is_ok_and(|found| found.is_file());
    is_regular.then_some(file)
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::super::temporary_file::create;
    use super::super::tests::names_in;
    use super::*;
    use std::fs;
    use std::os::unix::fs::symlink;

    /// A name as another machine makes it.
    const FOREIGN: &str = ".feimos-0123456789ab-AbCdEf.tmp";

    fn folder_with(names: &[&str]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for name in names {
            fs::write(folder.path().join(name), "half").unwrap();
        }
        folder
    }

    #[test]
    fn files_of_living_writers_stay() {
        let folder = folder_with(&[]);
        let target = folder.path().join("a.exr");
        let (file, path) = create(&target).unwrap();
        let path = path.keep().unwrap();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        assert!(is_temporary(&name) && is_of_this_host(&name), "{name}");
        let far = SystemTime::now() + 2 * OLD;
        remove_at(folder.path(), far);
        assert_eq!(names_in(folder.path()), [name]);
        // The system unlocks the files of a dead process.
        drop(file);
        remove_at(folder.path(), SystemTime::now());
        assert!(names_in(folder.path()).is_empty());
    }

    #[test]
    fn files_of_other_machines_stay_for_a_day() {
        let untagged = ".feimos-AbCdEf.tmp";
        let folder = folder_with(&[FOREIGN, untagged]);
        let now = SystemTime::now();
        remove_at(folder.path(), now + OLD / 2);
        assert_eq!(names_in(folder.path()), [FOREIGN, untagged]);
        remove_at(folder.path(), now - 2 * OLD);
        assert_eq!(
            names_in(folder.path()),
            [FOREIGN, untagged],
            "clocks differ"
        );
        remove_at(folder.path(), now + 2 * OLD);
        assert!(names_in(folder.path()).is_empty());
    }

    #[test]
    fn other_files_stay() {
        let others = [".feimos-a.exr", ".feimos.tmp", "a.tmp", "feimos-a.tmp"];
        let folder = folder_with(&others);
        let path = |name: &str| folder.path().join(name);
        fs::create_dir(path(".feimos-folder.tmp")).unwrap();
        symlink(path("a.tmp"), path(".feimos-link.tmp")).unwrap();
        let before = names_in(folder.path());
        remove_at(folder.path(), SystemTime::now() + 2 * OLD);
        assert_eq!(names_in(folder.path()), before);
    }

    #[test]
    fn a_writer_makes_another_file_if_its_first_is_taken_for_a_leftover() {
        let folder = folder_with(&[]);
        let target = folder.path().join("a.exr");
        // Other processes remove whatever they can lock, all the time.
        let done = std::sync::atomic::AtomicBool::new(false);
        std::thread::scope(|scope| {
            scope.spawn(|| {
                while !done.load(std::sync::atomic::Ordering::Relaxed) {
                    remove_at(folder.path(), SystemTime::now());
                }
            });
            for _ in 0..1000 {
                let (file, path) = create(&target).unwrap();
                assert!(is_named(&file, &path).unwrap());
            }
            done.store(true, std::sync::atomic::Ordering::Relaxed);
        });
    }

    #[test]
    fn a_folder_is_looked_at_once() {
        let folder = folder_with(&[]);
        let leftover = || {
            let (_, path) = create(&folder.path().join("a.exr")).unwrap();
            path.keep().unwrap()
        };
        let new = tempfile::tempfile_in(folder.path()).unwrap();
        let first = leftover();
        remove(folder.path(), &new);
        assert!(!first.exists());
        let second = leftover();
        remove(folder.path(), &new);
        assert!(second.exists());
    }
}
