//! The outputs of `bench` besides its tables.

use super::args::OutputArgs;
use super::page;
use crate::bench::{Machine, Row, Section, to_csv, to_html, to_json, to_markdown, to_svg, totals};
use crate::cli::files::destination::Destination;
use crate::cli::files::inputs::{Inputs, check_against_scene};
use crate::cli::files::new_folders::{NewFolders, write_with_folders};
use crate::cli::files::places::Places;
use crate::cli::files::results::check_extension;
use crate::cli::terminal::reporter::Reporter;
use crate::cli::terminal::stdout::write_to_stdout;
use crate::error::{Error, Result};
use crate::file_id::InputFiles;
use crate::film::atomic_file::Overwrite;
use crate::terminal_text;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The outputs that the user wants.
pub(super) struct Outputs {
    results: Vec<Output>,
    /// As the user typed it; pages quote it.
    command_line: String,
    /// The new folders of the report.
    _folders: Option<NewFolders>,
}

struct Output {
    content: Content,
    /// The flag that asks for it.
    flag: &'static str,
    destination: Destination,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Content {
    Json,
    Csv,
    Markdown,
    Plot,
    Page,
}

/// What outputs show.
struct Measured<'a> {
    machine: &'a Machine,
    command_line: &'a str,
    rows: &'a [Row],
    sections: &'a [Section],
}

impl Outputs {
    /// # Errors
    /// A name is that of another kind of file or of one of the `inputs`, two outputs have one place,
    /// or a file cannot be made.
    pub(super) fn new(args: &OutputArgs, inputs: &Inputs, command_line: String) -> Result<Outputs> {
        let results = results(args);
        let mut taken = Places::default();
        for Output {
            content,
            flag,
            destination,
        } in &results
        {
            if let Destination::File(path) = destination {
                inputs.check(path, flag)?;
                check_extension(path, flag, content.extensions())?;
            }
            if let Some(other) = taken.take(destination, *flag) {
                let error = Error::usage(format!("two outputs would both go to `{destination}`"));
                return Err(error.note(format!("of {other} and {flag}")));
            }
        }
        // Other outputs may go into the same folder.
        let folders = args.report.as_deref().map(NewFolders::make).transpose()?;
        results
            .iter()
            .try_for_each(|output| output.destination.check())?;
        args.report.as_deref().map_or(Ok(()), page::check)?;
        Ok(Outputs {
            results,
            command_line,
            _folders: folders,
        })
    }

    /// # Errors
    /// An output would overwrite one of the files that a scene reads.
    pub(super) fn check_against_scene(&self, files: &InputFiles) -> Result<()> {
        self.results
            .iter()
            .try_for_each(|output| output.check_against_scene(files))
    }

    /// Drops outputs that would overwrite one of the files that a scene reads.
    pub(super) fn leave_out(&mut self, files: &InputFiles) {
        self.results
            .retain(|output| output.check_against_scene(files).is_ok());
    }

    /// Returns true if an output replaces the tables on standard output.
    pub(super) fn replace_tables(&self) -> bool {
        self.results
            .iter()
            .any(|output| output.destination == Destination::Stdout)
    }

    /// Returns true if the report needs pictures.
    pub(super) fn need_pictures(&self) -> bool {
        self.results
            .iter()
            .any(|output| output.content == Content::Page)
    }

    /// Writes all outputs and returns the highest exit code. An error does not stop the others.
    /// Without rows, older files stay.
    pub(super) fn write(
        &self,
        machine: &Machine,
        rows: &[Row],
        sections: &[Section],
        reporter: &Reporter,
    ) -> u8 {
        if rows.is_empty() {
            return 0;
        }
        let measured = Measured {
            machine,
            command_line: &self.command_line,
            rows,
            sections,
        };
        let failed = |output: &Output| output.write(&measured).err();
        let codes = self.results.iter().filter_map(failed).map(|error| {
            reporter.error(&error);
            error.kind().exit_code()
        });
        codes.max().unwrap_or(0)
    }
}

fn results(args: &OutputArgs) -> Vec<Output> {
    let stdout = args.json.then(|| "-".into());
    let page = args
        .report
        .as_ref()
        .map(|directory| directory.join(page::NAME));
    let asked = [
        (Content::Json, "--json", &stdout),
        (Content::Json, "--json-file", &args.json_file),
        (Content::Csv, "--csv", &args.csv),
        (Content::Markdown, "--markdown", &args.markdown),
        (Content::Plot, "--plot", &args.plot),
        (Content::Page, "--report", &page),
    ];
    let output = |(content, flag, path): (Content, &'static str, &Option<_>)| {
        let path: &PathBuf = path.as_ref()?;
        let destination = Destination::of_name(path);
        Some(Output {
            content,
            flag,
            destination,
        })
    };
    asked.into_iter().filter_map(output).collect()
}

impl Output {
    fn check_against_scene(&self, files: &InputFiles) -> Result<()> {
        match &self.destination {
            Destination::File(path) => check_against_scene(files, path, self.flag),
            Destination::Stdout => Ok(()),
        }
    }

    fn write(&self, measured: &Measured) -> Result<()> {
        let bytes = self.content.bytes(measured);
        match &self.destination {
            Destination::Stdout => write_to_stdout(bytes.map(printable)),
            Destination::File(path) => write_file(path, bytes),
        }
    }
}

impl Content {
    /// The extensions of such files.
    fn extensions(self) -> &'static [&'static str] {
        match self {
            Content::Json => &["json", "jsonl"],
            Content::Csv => &["csv"],
            Content::Markdown => &["md"],
            Content::Plot => &["svg"],
            Content::Page => &["html"],
        }
    }

    fn bytes(self, measured: &Measured) -> io::Result<Vec<u8>> {
        let Measured {
            machine,
            command_line,
            rows,
            sections,
        } = *measured;
        match self {
            Content::Json => Ok(to_json(machine, rows)),
            Content::Csv => to_csv(machine, rows),
            Content::Markdown => Ok(to_markdown(machine, rows).into_bytes()),
            Content::Plot => Ok(plot(rows).into_bytes()),
            Content::Page => Ok(to_html(machine, command_line, sections).into_bytes()),
        }
    }
}

/// The same text without control characters, for a terminal.
fn printable(bytes: Vec<u8>) -> Vec<u8> {
    terminal_text::lines(&String::from_utf8_lossy(&bytes)).into_bytes()
}

/// A plot of one scene, or of the totals of several.
fn plot(rows: &[Row]) -> String {
    match rows.chunk_by(|a, b| a.scene == b.scene).count() {
        0 | 1 => {
            let scene = rows.first().map_or("", |row| &row.scene);
            to_svg(&terminal_text::line(scene), rows)
        }
        scenes => to_svg(&format!("{scenes} scenes together"), &totals(rows)),
    }
}

fn write_file(path: &Path, bytes: io::Result<Vec<u8>>) -> Result<()> {
    let write = |out: &mut _| bytes.and_then(|bytes| Write::write_all(out, &bytes));
    write_with_folders(path, Overwrite::Yes, write)
}
