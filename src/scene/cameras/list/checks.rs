//! Checks of whole lists, and what they refuse.

use std::collections::HashSet;

/// The most cameras in a file.
pub(super) const MAX_POSES: usize = 1_000_000;

/// What was found, and what was expected.
pub(super) type Refusal = (String, String);

pub(super) fn check_count(count: usize) -> Result<(), Refusal> {
    if count == 0 || count > MAX_POSES {
        return Err((
            format!("a list of {count} cameras"),
            format!("1 to {MAX_POSES}"),
        ));
    }
    Ok(())
}

pub(super) fn check_names<'a>(mut names: impl Iterator<Item = &'a str>) -> Result<(), Refusal> {
    let mut known = HashSet::new();
    match names.find(|name| !known.insert(*name)) {
        Some(name) => Err((
            format!("two cameras are called `{name}`"),
            "a name of its own for each".to_owned(),
        )),
        None => Ok(()),
    }
}
