//! `feimos man`: writes the manual pages.

use crate::error::{Error, Result};
use crate::film::atomic_file::{Overwrite, write_file};
use clap::{Args, Command};
use clap_mangen::Man;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct ManArgs {
    /// Directory for the pages, such as /usr/local/share/man/man1; made if it is missing.
    #[arg(value_name = "DIR")]
    directory: PathBuf,
}

/// Writes a page for `program` and one for each of its commands.
pub(crate) fn man(args: &ManArgs, program: Command) -> Result<u8> {
    let directory = &args.directory;
    fs::create_dir_all(directory).map_err(|error| Error::creating(directory, &error))?;
    let mut program = program.disable_help_subcommand(true);
    // Gives commands their full names.
    program.build();
    for command in program.get_subcommands() {
        write_page(command, directory)?;
    }
    write_page(&program, directory).map(|()| 0)
}

fn write_page(command: &Command, directory: &Path) -> Result<()> {
    let source = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));
    let page = Man::new(command.clone())
        .source(source)
        .manual("User Commands");
    let path = directory.join(page.get_filename());
    let mut text = Vec::new();
    let rendered = page.render(&mut text);
    let text = with_examples_as_they_are(&String::from_utf8_lossy(&text));
    write_file(&path, Overwrite::Yes, |out| {
        rendered?;
        out.write_all(text.as_bytes())
    })
    .map(|_| ())
}

/// Keeps indented lines, which are examples, from being filled and justified.
fn with_examples_as_they_are(page: &str) -> String {
    let mut text = String::new();
    let mut is_example = false;
    for line in page.lines() {
        if line.starts_with("  ") != is_example {
            is_example = !is_example;
            text.push_str(if is_example { ".nf\n" } else { ".fi\n" });
        }
        text.push_str(line);
        text.push('\n');
    }
    text
}
