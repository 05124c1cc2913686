//! Keeps `docs/design.md` true: the arrows between modules, no cycle between files, no dead link.
//!
//! An arrow leads from a file to the file that defines what it imports or names by a path. Tests are
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

/// The table of arrows in the design document: `from -> to, to` in an indented block.
fn documented_arrows() -> BTreeMap<String, BTreeSet<String>> {
    let text = fs::read_to_string("docs/design.md").unwrap();
    let (_, table) = text
        .split_once("<!-- arrows -->")
        .expect("the start of the table");
    let (table, _) = table
        .split_once("<!-- end -->")
        .expect("the end of the table");
    let rows = table.lines().filter_map(|line| line.split_once("->"));
    let names = |list: &str| list.split(',').map(|name| name.trim().to_owned()).collect();
    rows.map(|(from, to)| (from.trim().to_owned(), names(to)))
        .collect()
}

/// The longest name of the table that `file` belongs to.
fn module_of<'a>(file: &str, names: &BTreeSet<&'a str>) -> &'a str {
    let path = file
        .trim_start_matches("src/")
        .trim_end_matches(".rs")
        .trim_end_matches("/mod");
    let holds = |name: &&&str| path == **name || path.starts_with(&format!("{name}/"));
    let longest = names.iter().filter(holds).max_by_key(|name| name.len());
    longest.unwrap_or_else(|| panic!("docs/design.md has no row for {file}"))
}

#[test]
fn the_design_document_has_all_arrows_and_no_others() {
    let documented = documented_arrows();
    let every_name = documented
        .iter()
        .flat_map(|(from, to)| to.iter().chain([from]));
    let names: BTreeSet<&str> = every_name.map(String::as_str).collect();
    let mut found: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (file, targets) in arrows_between_files() {
        let from = module_of(&file, &names);
        for target in targets {
            let to = module_of(&target, &names);
            if from != to {
                found
                    .entry(from.to_owned())
                    .or_default()
                    .insert(to.to_owned());
            }
        }
    }
    assert!(
        cycle(&documented).is_empty(),
        "a circle: {:?}",
        cycle(&documented)
    );
    let table = |arrows: &BTreeMap<String, BTreeSet<String>>| -> Vec<String> {
        let row = |(from, to): (&String, &BTreeSet<String>)| {
            format!(
                "{from} -> {}",
                to.iter().cloned().collect::<Vec<_>>().join(", ")
            )
        };
        arrows.iter().map(row).collect()
    };
    let (found, documented) = (table(&found), table(&documented));
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
