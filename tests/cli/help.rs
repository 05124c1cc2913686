//! Help: every flag, with its default; examples first; the most used flags on one page.

use crate::folder::Folder;
use crate::offered::{commands, flags};

/// The promised flags of `render`.
const RENDER: &str = "--output --aov --view --colormap --range --scale --miss --depth-channel \
                      --cropwindow --pixelbounds --resolution --accel --precision --threads \
                      --cameras --force --skip-existing --fail-fast --manifest --quiet --verbose \
                      --progress --color --stats --json --strict";

/// The promised flags of `bench`.
const BENCH: &str = "--accel --precision --threads --runs --warmup --reference --json --json-file \
                     --csv --plot --report";

/// The help on each flag of `command`, which begins with the name of the flag.
fn blocks(folder: &Folder, command: &str) -> Vec<String> {
    let help = folder.run(command, "--help").succeeded();
    let mut blocks: Vec<String> = Vec::new();
    for line in help.text().lines() {
        // Values are listed behind a dash and a blank.
        let names_a_flag =
            line.starts_with("  ") && line.trim_start().starts_with('-') && !line.contains(" - ");
        if names_a_flag {
            blocks.push(line.to_owned());
        } else if let Some(block) = blocks.last_mut() {
            // Paragraphs are broken where the line ends.
            block.push_str(&format!(" {}", line.trim()));
        }
    }
    blocks
}

#[test]
fn every_flag_has_its_default_in_help() {
    let folder = Folder::new();
    for command in commands(&folder) {
        for block in blocks(&folder, &command) {
            let is_told = block.contains("[default: ");
            let has_none = ["--help", "--version"]
                .iter()
                .any(|flag| block.contains(flag));
            let is_required = command == "merge" && block.contains("--output");
            assert!(is_told || has_none || is_required, "{command}: {block}");
        }
    }
}

#[test]
fn every_promised_flag_exists() {
    let folder = Folder::new();
    let promised = [
        ("render", RENDER),
        ("bench", BENCH),
        ("compare", "--max-ulp --max-pixels --diff --json"),
        ("check", "--json --strict"),
        ("merge", "--output --partial"),
    ];
    for (command, promised) in promised {
        let flags = flags(&folder, command);
        for flag in promised.split_whitespace() {
            assert!(
                flags.iter().any(|name| name == flag),
                "{command} {flag}: {flags:?}"
            );
        }
    }
}

#[test]
fn aliases_of_flags_work() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt --outfile a.exr --nthreads 1 -q")
        .succeeded();
    assert_eq!(folder.images(), ["a.exr"]);
}

/// The lines of help on a terminal of 80 columns.
fn lines(folder: &Folder, command: &str, flag: &str) -> Vec<String> {
    let mut run = folder.subcommand(command, flag);
    let output = run.env("COLUMNS", "80").output().unwrap();
    assert!(output.status.success(), "{output:?}");
    let help = String::from_utf8(output.stdout).unwrap();
    help.lines().map(str::to_owned).collect()
}

#[test]
fn short_help_fits_on_a_page_and_names_the_long_help() {
    let folder = Folder::new();
    for command in commands(&folder) {
        let lines = lines(&folder, &command, "-h");
        assert!(lines.len() <= 40, "{command}: {lines:#?}");
        assert!(lines.iter().all(|line| line.chars().count() <= 80));
        let last = format!("All flags, defaults and examples: feimos {command} --help");
        assert_eq!(lines.last(), Some(&last));
    }
    let render = lines(&folder, "render", "-h").join("\n");
    for flag in ["--output", "--view", "--accel", "--cameras", "--json"] {
        assert!(render.contains(flag), "{render}");
    }
    assert!(!render.contains("--input-budget") && !render.contains("[default"));
}

#[test]
fn examples_come_first_in_long_help_and_are_right() {
    let folder = Folder::new();
    for command in commands(&folder) {
        let lines = lines(&folder, &command, "--help");
        assert!(lines.iter().all(|line| line.chars().count() <= 80));
        let begin = lines.iter().position(|line| line == "Examples:");
        // Before them, there are one or two lines that say what the command does.
        let begin = begin.filter(|begin| *begin <= 3).expect("examples");
        let examples = lines[begin + 1..]
            .iter()
            .take_while(|line| !line.is_empty());
        let offered = flags(&folder, &command);
        for example in examples.clone() {
            // As many columns as fit on a terminal in a manual page.
            let is_right = example.starts_with(&format!("  feimos {command} "));
            assert!(is_right && example.len() <= 73, "{example}");
            for flag in example.split(' ').filter(|word| word.starts_with("--")) {
                assert!(offered.iter().any(|name| name == flag), "{example}");
            }
        }
        let fewest = if command == "render" { 5 } else { 1 };
        assert!(examples.count() >= fewest, "{command}");
    }
}
