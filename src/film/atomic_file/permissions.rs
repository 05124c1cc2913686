//! Keeps the owner and the permissions of a replaced file.

use std::fs::{File, Metadata};

/// Permissions to read, write and execute. The content is new, so it must not inherit the right to
/// run as another user (setuid, setgid).
#[cfg(unix)]
const ACCESS: u32 = 0o777;

/// Gives `file` the owner, the group and the permissions of the `replaced` file: all of them or
/// none.
///
/// Permissions alone would mean something else: those of the old group would apply to the group of
/// the new owner. A file system without permissions is no reason to fail.
#[cfg(unix)]
pub(super) fn keep(file: &File, replaced: &Metadata) {
    use std::fs::Permissions;
    use std::os::unix::fs::{MetadataExt, PermissionsExt, fchown};

    let Ok(new) = file.metadata() else { return };
    let owners = |metadata: &Metadata| (metadata.uid(), metadata.gid());
    let give_to = |(user, group)| fchown(file, Some(user), Some(group));
    let is_other = owners(&new) != owners(replaced);
    if is_other && give_to(owners(replaced)).is_err() {
        return;
    }
    let permissions = Permissions::from_mode(replaced.mode() & ACCESS);
    if file.set_permissions(permissions).is_err() && is_other {
        let _ = give_to(owners(&new));
    }
}

/// Gives `file` the permissions of the `replaced` file, if the file system has them.
#[cfg(not(unix))]
pub(super) fn keep(file: &File, replaced: &Metadata) {
    let _ = file.set_permissions(replaced.permissions());
}
