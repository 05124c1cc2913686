//! Help: every flag, with its default.

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
