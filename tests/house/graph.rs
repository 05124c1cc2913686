//! Directed graphs by names.

use std::collections::{BTreeMap, BTreeSet};

type Arrows = BTreeMap<String, BTreeSet<String>>;

/// The names along a cycle, the first one again at the end; empty where there is none.
pub(crate) fn cycle(arrows: &Arrows) -> Vec<String> {
    let mut done = BTreeSet::new();
    let mut path = Vec::new();
    for start in arrows.keys() {
        if visit(start, arrows, &mut path, &mut done) {
            return path;
        }
    }
    Vec::new()
}

/// Walks depth first; true once `path` ends where it has been before.
fn visit(name: &str, arrows: &Arrows, path: &mut Vec<String>, done: &mut BTreeSet<String>) -> bool {
    if let Some(start) = path.iter().position(|passed| passed == name) {
        path.drain(..start);
        path.push(name.to_owned());
        return true;
    }
    if !done.insert(name.to_owned()) {
        return false;
    }
    path.push(name.to_owned());
    let found = arrows.get(name).is_some_and(|targets| {
        targets
            .iter()
            .any(|target| visit(target, arrows, path, done))
    });
    if !found {
        path.pop();
    }
    found
}

#[test]
fn cycles_are_found() {
    let arrows = |rows: &[(&str, &[&str])]| -> Arrows {
        let set = |to: &[&str]| to.iter().map(|name| name.to_string()).collect();
        rows.iter()
            .map(|(from, to)| (from.to_string(), set(to)))
            .collect()
    };
    let chain = arrows(&[("a", &["b", "c"]), ("b", &["c"]), ("c", &[])]);
    assert!(cycle(&chain).is_empty());
    let circle = arrows(&[("a", &["b"]), ("b", &["c"]), ("c", &["d", "b"])]);
    assert_eq!(cycle(&circle), ["b", "c", "b"]);
}
