//! `feimos completions`: every shell, every flag, and the completions of bash.

use crate::folder::Folder;
use crate::offered::{commands, flags};

const SHELLS: [&str; 5] = ["bash", "elvish", "fish", "powershell", "zsh"];

fn script(folder: &Folder, shell: &str) -> String {
    let run = folder.run("completions", shell).succeeded();
    assert!(run.stderr.is_empty(), "{}", run.stderr);
    run.text().to_owned()
}

/// Returns true if a script names a flag, not only a longer one; fish writes `-l output`.
fn names(script: &str, shell: &str, flag: &str) -> bool {
    let flag = if shell == "fish" {
        flag.replacen("--", "-l ", 1)
    } else {
        flag.to_owned()
    };
    let ends = |rest: &str| !rest.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '-');
    script
        .match_indices(&flag)
        .any(|(at, _)| ends(&script[at + flag.len()..]))
}

#[test]
fn every_shell_completes_every_command_and_flag() {
    let folder = Folder::new();
    let commands = commands(&folder);
    for shell in SHELLS {
        let script = script(&folder, shell);
        for command in &commands {
            assert!(script.contains(command.as_str()), "{shell}: {command}");
            for flag in flags(&folder, command) {
                assert!(names(&script, shell, &flag), "{shell}: {command} {flag}");
            }
        }
    }
}

#[test]
fn hidden_flags_stay_hidden() {
    let folder = Folder::new();
    for shell in SHELLS {
        let script = script(&folder, shell);
        for flag in ["--spp", "--quick", "--wavefront", "--outfile", "--nthreads"] {
            assert!(!names(&script, shell, flag), "{shell}: {flag}");
        }
    }
}

#[test]
fn an_unknown_shell_lists_the_known_ones() {
    let run = Folder::new().run("completions", "tcsh").exited(2);
    SHELLS
        .iter()
        .for_each(|shell| assert!(run.stderr.contains(shell), "{}", run.stderr));
}

#[cfg(target_os = "linux")]
mod linux {
    use super::*;

    /// The completions of bash for the last of `words`.
    fn offered_by_bash(folder: &Folder, words: &str) -> String {
        let last = words.split(' ').count() - 1;
        let complete = format!(
            "source feimos.bash; COMP_WORDS=({words}); COMP_CWORD={last}
             _feimos feimos \"${{COMP_WORDS[{last}]}}\" \
             \"${{COMP_WORDS[{last} - 1]}}\"; echo \"${{COMPREPLY[*]}}\""
        );
        // Bash warns of locales that are not installed.
        let mut bash = std::process::Command::new("bash");
        let output = bash
            .current_dir(folder.path(""))
            .env("LC_ALL", "C")
            .args(["-c", &complete])
            .output();
        let output = output.unwrap();
        assert!(
            output.status.success() && output.stderr.is_empty(),
            "{output:?}"
        );
        String::from_utf8(output.stdout)
            .unwrap()
            .trim_end()
            .to_owned()
    }

    #[test]
    fn bash_completes() {
        let folder = Folder::new();
        std::fs::write(folder.path("feimos.bash"), script(&folder, "bash")).unwrap();
        for (words, expected) in [
            ("feimos rend", "render"),
            ("feimos render --pix", "--pixelbounds"),
            ("feimos render --accel s", "sah"),
            ("feimos render ball.pbrt --precision ''", "exact fast"),
            (
                "feimos render ball.pbrt --aov ''",
                "Z t A id prim instance N P uv cost",
            ),
            ("feimos render --simd po", "portable"),
            ("feimos bench --simd au", "auto"),
            ("feimos bench --precision exact-", "exact-single"),
            ("feimos render --view dep", "depth depth16"),
            ("feimos render --accel hl", "hlbvh"),
            ("feimos render --colormap v", "viridis"),
            ("feimos render --spp", ""),
            ("feimos completions po", "powershell"),
        ] {
            assert_eq!(offered_by_bash(&folder, words), expected, "{words}");
        }
    }

    #[test]
    fn a_closed_pipe_is_an_error() {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let folder = Folder::new();
        let output = folder
            .subcommand("completions", "bash")
            .stdout(writer)
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(74), "{output:?}");
        assert!(
            output
                .stderr
                .starts_with(b"error: standard output: cannot write: "),
            "{output:?}"
        );
    }
}
