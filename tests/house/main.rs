//! Keeps `docs/design.md` true: the arrows between modules, no cycle between files, no dead link.
//!
//! An arrow leads from a file to each file that defines what it imports or names. Tests are
//! left out. A `pub use` stands for the file behind it.

mod graph;
mod imports;
mod links;
mod module_tree;

use graph::cycle;
use module_tree::ModuleTree;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;

/// What each file of `src` imports.
fn arrows_between_files() -> BTreeMap<String, BTreeSet<String>> {
    let tree = ModuleTree::read("src");
    let files = tree.files();
    files
        .into_iter()
        .map(|file| (file.clone(), tree.targets_of(&file)))
        .collect()
}

#[test]
fn no_files_import_each_other_in_a_circle() {
    let circle = cycle(&arrows_between_files());
    assert!(
        circle.is_empty(),
        "a circle of imports: {}",
        circle.join(" -> ")
    );
}

/// Modules by what they import.
type Arrows = BTreeMap<String, BTreeSet<String>>;

/// The row of the modules that all others may import.
const ALL: &str = "*";

/// The table of arrows in the design document. A row `from -> to, to` may go on in the next line.
fn documented_arrows() -> Arrows {
    let text = fs::read_to_string("docs/design.md").unwrap();
    let (_, table) = text
        .split_once("<!-- arrows -->")
        .expect("the start of the table");
    let (table, _) = table
        .split_once("<!-- end -->")
        .expect("the end of the table");
    let mut arrows = Arrows::new();
    let mut from = "";
    for line in table.lines().filter(|line| !line.starts_with("```")) {
        let list = line.split_once("->").map_or(line, |(name, list)| {
            from = name.trim();
            list
        });
        let names = list
            .split(',')
            .map(str::trim)
            .filter(|name| !name.is_empty());
        arrows
            .entry(from.to_owned())
            .or_default()
            .extend(names.map(str::to_owned));
    }
    arrows.retain(|_, targets| !targets.is_empty());
    arrows
}

/// The longest name of the table that `file` belongs to, or the part of `src` that it stands in.
fn module_of<'a>(file: &'a str, names: &BTreeSet<&'a str>) -> &'a str {
    let path = file
        .trim_start_matches("src/")
        .trim_end_matches(".rs")
        .trim_end_matches("/mod");
    let holds = |name: &&&str| path == **name || path.starts_with(&format!("{name}/"));
    names
        .iter()
        .filter(holds)
        .max_by_key(|name| name.len())
        .copied()
        .unwrap_or(top(path))
}

/// The first part of a module's name.
fn top(name: &str) -> &str {
    name.split_once('/').map_or(name, |(top, _)| top)
}

/// The arrows between the modules of the table; a module elsewhere counts as a whole.
fn arrows_between_modules(documented: &Arrows) -> Arrows {
    let every_name = documented
        .iter()
        .flat_map(|(from, to)| to.iter().chain([from]));
    let names: BTreeSet<&str> = every_name.map(String::as_str).collect();
    let mut found = Arrows::from([(ALL.to_owned(), documented[ALL].clone())]);
    for (file, targets) in arrows_between_files() {
        let from = module_of(&file, &names);
        for target in targets {
            let to = module_of(&target, &names);
            let to = if top(from) == top(to) { to } else { top(to) };
            if from != to && !documented[ALL].contains(to) {
                found
                    .entry(from.to_owned())
                    .or_default()
                    .insert(to.to_owned());
            }
        }
    }
    found
}

fn rows(arrows: &Arrows) -> Vec<String> {
    let list = |targets: &BTreeSet<String>| targets.iter().cloned().collect::<Vec<_>>().join(", ");
    arrows
        .iter()
        .map(|(from, to)| format!("{from} -> {}", list(to)))
        .collect()
}

#[test]
fn the_design_document_has_all_arrows_and_no_others() {
    let documented = documented_arrows();
    assert!(
        cycle(&documented).is_empty(),
        "a circle: {:?}",
        cycle(&documented)
    );
    let (found, documented) = (
        rows(&arrows_between_modules(&documented)),
        rows(&documented),
    );
    assert!(
        found == documented,
        "the arrows of `src` are\n    {}",
        found.join("\n    ")
    );
}

#[test]
fn links_in_the_documents_lead_somewhere() {
    let dead = links::dead_links();
    assert!(dead.is_empty(), "dead links:\n{}", dead.join("\n"));
}
