//! Links in the documents.

use std::fs;
use std::path::{Path, PathBuf};

/// Relative links of all documents that lead to no file, or to no heading of one.
pub(crate) fn dead_links() -> Vec<String> {
    let mut documents = Vec::new();
    for folder in [
        ".",
        "docs",
        "scenes",
        "tests/hard",
        "tests/cases",
        "fuzz",
        "benches",
    ] {
        documents.extend(documents_in(Path::new(folder)));
    }
    documents
        .iter()
        .flat_map(|document| dead_links_of(document))
        .collect()
}

fn documents_in(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else {
        return Vec::new();
    };
    let paths = entries.map(|entry| entry.unwrap().path());
    paths
        .filter(|path| path.extension().is_some_and(|extension| extension == "md"))
        .collect()
}

fn dead_links_of(document: &Path) -> Vec<String> {
    let text = fs::read_to_string(document).unwrap();
    let links = text
        .split("](")
        .skip(1)
        .filter_map(|rest| rest.split_once(')'))
        .map(|(link, _)| link);
    let relative =
        links.filter(|link| !link.contains("://") && !link.contains(char::is_whitespace));
    let dead = relative.filter(|link| !leads_somewhere(document, link));
    dead.map(|link| format!("{}: {link}", document.display()))
        .collect()
}

fn leads_somewhere(document: &Path, link: &str) -> bool {
    let (path, heading) = link.split_once('#').unwrap_or((link, ""));
    let target = match path {
        "" => document.to_owned(),
        path => document.parent().unwrap().join(path),
    };
    if heading.is_empty() || target.extension().is_none_or(|extension| extension != "md") {
        return target.exists();
    }
    fs::read_to_string(target).is_ok_and(|text| {
        text.lines()
            .filter_map(anchor)
            .any(|anchor| anchor == heading)
    })
}

/// The anchor that web pages give to a heading.
fn anchor(line: &str) -> Option<String> {
    let title = line
        .starts_with('#')
        .then(|| line.trim_start_matches('#').trim().to_lowercase())?;
    let kept = title
        .chars()
        .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    Some(kept.map(|c| if c == ' ' { '-' } else { c }).collect())
}

#[test]
fn anchors_are_made_as_web_pages_make_them() {
    assert_eq!(
        anchor("## Speed, against `Embree`").as_deref(),
        Some("speed-against-embree")
    );
    assert_eq!(anchor("no heading"), None);
}
