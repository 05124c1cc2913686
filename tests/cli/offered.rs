//! Commands and flags that help lists.

use crate::folder::Folder;

/// The commands, without `help`.
pub(crate) fn commands(folder: &Folder) -> Vec<String> {
    let help = folder.run("--help", "").succeeded();
    let (_, listed) = help
        .text()
        .split_once("Commands:\n")
        .expect("help lists commands");
    let (listed, _) = listed.split_once("\n\n").expect("and options after them");
    let names = listed
        .lines()
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let names = names.map(|line| line.split_whitespace().next().unwrap().to_owned());
    names.filter(|name| name != "help").collect()
}

/// The long flags of a command, such as `--output`.
pub(crate) fn flags(folder: &Folder, command: &str) -> Vec<String> {
    let help = folder.run(command, "--help").succeeded();
    // Of the lines that name a flag: `  -o, --output <TEMPLATE>`, `      --aov <CHANNELS>`.
    let named = help
        .text()
        .lines()
        .filter(|line| line.trim_start().starts_with('-') && line.starts_with("  "));
    let flags =
        named.filter_map(|line| line.split_whitespace().find(|word| word.starts_with("--")));
    flags.map(str::to_owned).collect()
}

#[test]
fn commands_and_flags_are_found_in_help() {
    let folder = Folder::new();
    let commands = commands(&folder);
    for command in [
        "render",
        "check",
        "bench",
        "compare",
        "pixel",
        "completions",
        "man",
    ] {
        assert!(
            commands.iter().any(|name| name == command),
            "{command}: {commands:?}"
        );
    }
    let flags = flags(&folder, "render");
    for flag in [
        "--output",
        "--aov",
        "--pixelbounds",
        "--accel",
        "--threads",
        "--strict",
        "--help",
    ] {
        assert!(flags.iter().any(|name| name == flag), "{flag}: {flags:?}");
    }
}
