//! Links in the documents: relative ones, and absolute ones to files of this repository, which the
//! front page has because other sites show it without these files.

use std::fs;
use std::path::{Path, PathBuf};

/// Where the files of this repository stand: as pages, and as they are, for pictures.
const REPOSITORY: [&str; 3] = [
    "https://github.com/feimos/feimos/blob/main/",
    "https://github.com/feimos/feimos/tree/main/",
    "https://raw.githubusercontent.com/feimos/feimos/main/",
];

/// Links of all documents into this repository that lead to no file, or to no heading of one.
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
        "benches/peers",
        "benches/peers/python",
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
    let dead = links_of(&text).filter(|link| match path_in_repository(link) {
        // From the top, where the tests run, and the front page stands.
        Some(path) => !leads_somewhere(Path::new("README.md"), path),
        None => !link.contains("://") && !leads_somewhere(document, link),
    });
    dead.map(|link| format!("{}: {link}", document.display()))
        .collect()
}

/// What stands in parentheses behind a text in brackets.
fn links_of(text: &str) -> impl Iterator<Item = &str> {
    let ends = text.split("](").skip(1);
    let links = ends.filter_map(|rest| Some(rest.split_once(')')?.0));
    links.filter(|link| !link.contains(char::is_whitespace))
}

/// The file that an absolute link to this repository names, with its heading.
fn path_in_repository(link: &str) -> Option<&str> {
    REPOSITORY.iter().find_map(|start| link.strip_prefix(start))
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

#[test]
fn absolute_links_to_the_repository_are_checked_as_files() {
    let pages = "https://github.com/feimos/feimos/blob/main";
    assert_eq!(
        path_in_repository(&format!("{pages}/docs/design.md#layout")),
        Some("docs/design.md#layout")
    );
    assert_eq!(path_in_repository("https://github.com/feimos/feimos"), None);
    assert_eq!(path_in_repository("docs/design.md"), None);
    let leads = |link| leads_somewhere(Path::new("README.md"), link);
    assert!(leads("docs/design.md#layout"));
    assert!(!leads("docs/design.md#no-such-heading"));
    assert!(!leads("docs/no-such-file.md"));
}

#[test]
fn the_front_page_has_no_relative_links() {
    let text = fs::read_to_string("README.md").unwrap();
    let relative: Vec<_> = links_of(&text)
        .filter(|link| !link.contains("://"))
        .collect();
    assert!(
        relative.is_empty(),
        "PyPI resolves no relative links: {relative:?}"
    );
    assert!(links_of(&text).any(|link| path_in_repository(link).is_some()));
}
