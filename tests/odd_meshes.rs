//! Meshes by other programs, some of them broken, with the results in `tests/odd_meshes.tsv`.
//!
//! Small ones are in `tests/meshes`. The table names the repositories of the others. With a folder
//! that holds them all, run
//!
//!     FEIMOS_CORPUS=FOLDER cargo test --test odd_meshes -- --ignored

use feimos::mesh::{read_obj, read_ply};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A line of the table.
struct Row {
    /// Repository and path in it; `/` of the repository's name is `+`.
    path: String,
    /// Counts, and then all warnings, or the error.
    expected: String,
}

impl Row {
    fn file_name(&self) -> &str {
        self.path.rsplit('/').next().unwrap()
    }

    /// What is wrong when the file is in `folder` under `path`.
    fn check(&self, folder: &Path, path: &str) -> Result<(), String> {
        let found = outcome(folder, path)?;
        let same = found == self.expected;
        same.then_some(()).ok_or_else(|| {
            format!(
                "{}\nexpected {}\nfound    {found}",
                self.path, self.expected
            )
        })
    }
}

fn table() -> Vec<Row> {
    let text = std::fs::read_to_string(repository().join("tests/odd_meshes.tsv")).unwrap();
    let row = |line: &str| {
        let (path, expected) = line.split_once('\t').unwrap();
        Row {
            path: path.to_owned(),
            expected: expected.to_owned(),
        }
    };
    text.lines().skip(1).map(row).collect()
}

fn repository() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// As in the table: one line, and the name of the file without its folder.
fn outcome(folder: &Path, path: &str) -> Result<String, String> {
    let path = folder.join(path);
    std::fs::metadata(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let is_ply = path.extension().is_some_and(|extension| extension == "ply");
    let told = match if is_ply {
        read_ply(&path)
    } else {
        read_obj(&path)
    } {
        Err(error) => format!("\t\t{error}"),
        Ok(loaded) => {
            let warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
            format!(
                "{}\t{}\t{}",
                loaded.mesh.triangles.len(),
                loaded.mesh.vertices.len(),
                warnings.join("\n")
            )
        }
    };
    let folder = format!("{}/", path.parent().unwrap().display());
    Ok(told.replace(&folder, "").replace('\n', "\\n"))
}

fn assert_none(wrong: &[String]) {
    assert!(
        wrong.is_empty(),
        "{} wrong\n\n{}",
        wrong.len(),
        wrong.join("\n\n")
    );
}

#[test]
fn meshes_in_the_repository() {
    let folder = repository().join("tests/meshes");
    let rows: BTreeMap<String, Row> = table()
        .into_iter()
        .map(|row| (row.file_name().to_owned(), row))
        .collect();
    let is_mesh = |name: &String| name.ends_with(".ply") || name.ends_with(".obj");
    let names = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let meshes: Vec<String> = names.filter(is_mesh).collect();
    assert_eq!(meshes.len(), 4);
    let check = |name: &String| {
        rows.get(name)
            .ok_or(format!("{name} is not in the table"))?
            .check(&folder, name)
    };
    assert_none(
        &meshes
            .iter()
            .filter_map(|name| check(name).err())
            .collect::<Vec<_>>(),
    );
}

#[test]
#[ignore = "needs files of other repositories: FEIMOS_CORPUS"]
fn meshes_of_other_repositories() {
    let folder = PathBuf::from(
        std::env::var_os("FEIMOS_CORPUS").expect("FEIMOS_CORPUS, the folder of the files"),
    );
    let rows = table();
    assert_eq!(rows.len(), 49);
    assert_none(
        &rows
            .iter()
            .filter_map(|row| row.check(&folder, &row.path).err())
            .collect::<Vec<_>>(),
    );
}
