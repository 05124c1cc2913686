//! The help of `-h`: one line for each of the most used flags.

use clap::{Arg, ArgAction, Command};

/// What ends the first clause of a help text.
const ENDS: [&str; 4] = [". ", ": ", "; ", " ["];

/// `command` with short texts. Its `--help` keeps the long ones, so this is for `-h` alone.
pub(super) fn shortened(command: Command) -> Command {
    let name = command.get_name().to_owned();
    command.mut_subcommands(|command| {
        let (path, about) = (
            format!("{name} {}", command.get_name()),
            command.get_about().map(|about| clause(&about.to_string())),
        );
        let help = Arg::new("help").short('h').long("help").hide(true);
        let command = command
            .mut_args(|arg| {
                let help = arg.get_help().map(|help| clause(&help.to_string()));
                let takes_value = arg.get_action().takes_values();
                arg.help(help.unwrap_or_default())
                    .hide_possible_values(takes_value)
                    .hide_default_value(takes_value)
            })
            .disable_help_flag(true)
            .arg(help.action(ArgAction::HelpShort))
            .after_help(format!("All flags, defaults and examples: {path} --help"));
        match about {
            Some(about) => command.about(about),
            None => command,
        }
    })
}

/// The first clause of a text. One word is none.
fn clause(text: &str) -> String {
    let word = text.find(' ').map_or(text.len(), |end| end + 1);
    let end = ENDS.iter().filter_map(|end| text[word..].find(end)).min();
    text[..end.map_or(text.len(), |end| word + end)].to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clause_ends_at_a_stop_or_before_the_default() {
        for (text, expected) in [
            ("Name the image. The extension", "Name the image"),
            ("Print errors only [default: off]", "Print errors only"),
            ("Print more: results", "Print more"),
            ("Scenes: files, or `-`", "Scenes: files, or `-`"),
            ("One a.b c", "One a.b c"),
            ("", ""),
        ] {
            assert_eq!(clause(text), expected);
        }
    }
}
