//! Numbers of things, in words.

use indicatif::HumanCount;

/// `count` of a thing.
pub(super) fn counted(count: u64, thing: &str) -> String {
    format!(
        "{} {thing}{}",
        HumanCount(count),
        if count == 1 { "" } else { "s" }
    )
}
