//! `feimos man`: the pages of the manual.

use crate::folder::Folder;
use crate::offered::{commands, flags};
use std::fs;

fn names_in(folder: &Folder, directory: &str) -> Vec<String> {
    let entries = fs::read_dir(folder.path(directory)).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// A page without the escapes of hyphens.
fn page(folder: &Folder, name: &str) -> String {
    folder
        .text(name)
        .replace("\\-", "-")
        .replace("\\fB", "")
        .replace("\\fR", "")
}

#[test]
fn the_program_and_each_command_have_a_page() {
    let folder = Folder::new();
    let run = folder.run("man", "share/man1").succeeded();
    assert!(run.stdout.is_empty() && run.stderr.is_empty(), "{run:?}");
    let commands = commands(&folder);
    let mut expected: Vec<String> = commands
        .iter()
        .map(|command| format!("feimos-{command}.1"))
        .collect();
    expected.push("feimos.1".to_owned());
    expected.sort();
    // And no temporary file.
    assert_eq!(names_in(&folder, "share/man1"), expected);
    let program = page(&folder, "share/man1/feimos.1");
    for command in &commands {
        assert!(
            program.contains(&format!("feimos-{command}(1)")),
            "{command}:\n{program}"
        );
        let page = page(&folder, &format!("share/man1/feimos-{command}.1"));
        assert!(page.contains(&format!(".TH feimos-{command} 1")), "{page}");
        assert!(
            page.contains(concat!("\"feimos ", env!("CARGO_PKG_VERSION"), "\"")),
            "{page}"
        );
    }
}

#[test]
fn a_page_has_every_flag_except_hidden_ones() {
    let folder = Folder::new();
    folder.run("man", ".").succeeded();
    for command in commands(&folder) {
        let page = page(&folder, &format!("feimos-{command}.1"));
        for flag in flags(&folder, &command) {
            // Each flag begins an entry of its own.
            let entries = page.split(".TP\n").filter_map(|entry| entry.lines().next());
            let told = |entry: &str| entry.split([' ', ',']).any(|word| word == flag);
            assert!(entries.into_iter().any(told), "{command} {flag}:\n{page}");
        }
        for flag in ["--spp", "--quick", "--wavefront", "--outfile", "--nthreads"] {
            assert!(!page.contains(flag), "{command} {flag}:\n{page}");
        }
    }
}

#[test]
fn examples_keep_their_lines() {
    let folder = Folder::new();
    folder.run("man", ".").succeeded();
    for command in commands(&folder) {
        let page = page(&folder, &format!("feimos-{command}.1"));
        let (before, examples) = page.split_once(".nf\n").expect("examples");
        let (examples, _) = examples.split_once("\n.fi\n").expect("text after them");
        assert!(before.ends_with("Examples:\n"), "{before}");
        let is_example = |line: &str| line.starts_with(&format!("  feimos {command} "));
        assert!(examples.lines().all(is_example), "{examples}");
    }
}

#[test]
fn old_pages_are_replaced() {
    let folder = Folder::new()
        .with("feimos.1", "old")
        .with("feimos-other.1", "someone else's");
    folder.run("man", ".").succeeded();
    assert!(folder.text("feimos.1").contains(".TH feimos 1"));
    assert_eq!(folder.text("feimos-other.1"), "someone else's");
}

#[test]
fn pages_that_cannot_be_created_are_an_error() {
    let folder = Folder::new();
    folder
        .run("man", "ball.pbrt/man1")
        .failed(73, "ball.pbrt/man1: cannot create");
    folder
        .run("man", "ball.pbrt")
        .failed(73, "ball.pbrt: cannot create");
    fs::create_dir_all(folder.path("man1/feimos.1")).unwrap();
    folder
        .run("man", "man1")
        .failed(73, "man1/feimos.1: cannot create");
    folder.run("man", "").exited(2);
}
