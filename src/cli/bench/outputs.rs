//! Where results of `bench` go.

use super::args::OutputArgs;
use crate::cli::output_name::Destination;
use crate::cli::stdout::write_to_stdout;
use feimos::bench::{Machine, Row, Section, to_csv, to_html, to_json, to_markdown, to_svg, totals};
use feimos::error::{Error, Result};
use feimos::film::atomic_file::{self, Overwrite};
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Files that were asked for, each with what goes into it.
pub(super) struct Outputs {
    files: Vec<(Content, Destination)>,
    report: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Content {
    Json,
    Csv,
    Markdown,
    Plot,
}

/// The page in the directory of a report.
const PAGE: &str = "index.html";

impl Outputs {
    /// # Errors
    /// A place where no file can be made, before anybody waits for what should go there; two results that would go to one place.
    pub(super) fn new(args: &OutputArgs) -> Result<Outputs> {
        // First, since other files may go there.
        if let Some(directory) = &args.report {
            fs::create_dir_all(directory).map_err(|error| Error::creating(directory, &error))?;
            atomic_file::check(&directory.join(PAGE))?;
        }
        let asked = [
            (Content::Json, &args.json),
            (Content::Csv, &args.csv),
            (Content::Markdown, &args.markdown),
            (Content::Plot, &args.plot),
        ];
        let destination =
            |(content, path): (Content, &Option<PathBuf>)| Some((content, Destination::of_name(path.as_deref()?)));
        let files: Vec<(Content, Destination)> = asked.into_iter().filter_map(destination).collect();
        for (place, (_, destination)) in files.iter().enumerate() {
            if files[..place].iter().any(|(_, other)| other.resolved() == destination.resolved()) {
                return Err(Error::usage(format!("two results would both go to `{destination}`")));
            }
            if let Destination::File(path) = destination {
                atomic_file::check(path)?;
            }
        }
        Ok(Outputs { files, report: args.report.clone() })
    }

    /// Whether standard output has other things to hold than tables.
    pub(super) fn replace_tables(&self) -> bool {
        self.files.iter().any(|(_, destination)| *destination == Destination::Stdout)
    }

    /// Whether somebody wants to see pictures.
    pub(super) fn need_pictures(&self) -> bool {
        self.report.is_some()
    }

    /// Writes what was asked for of all rows.
    pub(super) fn write(&self, machine: &Machine, rows: &[Row], sections: &[Section]) -> Result<()> {
        for (content, destination) in &self.files {
            let bytes = content.bytes(machine, rows);
            match destination {
                Destination::Stdout => write_to_stdout(bytes)?,
                Destination::File(path) => write_file(path, bytes)?,
            }
        }
        let Some(directory) = &self.report else { return Ok(()) };
        write_file(&directory.join(PAGE), Ok(to_html(machine, &command_line(), sections).into_bytes()))
    }
}

impl Content {
    fn bytes(self, machine: &Machine, rows: &[Row]) -> io::Result<Vec<u8>> {
        match self {
            Content::Json => Ok(to_json(machine, rows)),
            Content::Csv => to_csv(machine, rows),
            Content::Markdown => Ok(to_markdown(machine, rows).into_bytes()),
            Content::Plot => Ok(plot(rows).into_bytes()),
        }
    }
}

/// Of one scene, or of all together.
fn plot(rows: &[Row]) -> String {
    match rows.chunk_by(|a, b| a.scene == b.scene).count() {
        0 | 1 => to_svg(rows.first().map_or("", |row| &row.scene), rows),
        scenes => to_svg(&format!("{scenes} scenes together"), &totals(rows)),
    }
}

fn write_file(path: &Path, bytes: io::Result<Vec<u8>>) -> Result<()> {
    atomic_file::write_file(path, Overwrite::Yes, |out| bytes.and_then(|bytes| out.write_all(&bytes))).map(|_| ())
}

/// As it was typed, for people; the program without its path.
fn command_line() -> String {
    let arguments = std::env::args_os().skip(1).map(|argument| argument.to_string_lossy().into_owned());
    std::iter::once("feimos".to_owned()).chain(arguments).collect::<Vec<_>>().join(" ")
}
