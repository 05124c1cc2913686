//! `feimos merge`: merges crops of one film.

mod args;

pub(crate) use args::MergeArgs;

use crate::cli::files::destination::{Destination, Encode};
use crate::cli::files::inputs::Inputs;
use crate::cli::process::threads::thread_pool;
use crate::cli::terminal::progress::{Phase, ProgressBars};
use crate::cli::terminal::reporter::Reporter;
use crate::cli::terminal::stdout;
use crate::cli::terminal::words::counted;
use crate::error::{Error, Result};
use crate::film::atomic_file::Overwrite;
use crate::film::{Format, exr_file};
use crate::merge::{self, Merged};
use crate::progress::Progress;
use std::io::{self, Seek, Write};
use std::path::Path;

/// Merges the crops, writes the whole and returns the exit code.
pub(crate) fn merge(args: &MergeArgs, reporter: &Reporter) -> Result<u8> {
    let destination = Destination::of_name(&args.output);
    if let Destination::File(path) = &destination {
        check_format(path)?;
        Inputs::default()
            .with(&args.crops, "a crop")
            .check(path, "-o")?;
    } else {
        stdout::check_binary()?;
    }
    destination.check()?;
    let pool = thread_pool(args.threads.count, reporter)?;
    pool.install(|| write_merged(args, &destination, reporter))
        .map(|()| 0)
}

fn write_merged(args: &MergeArgs, destination: &Destination, reporter: &Reporter) -> Result<()> {
    let MergeArgs {
        crops,
        partial,
        input,
        ..
    } = args;
    let merge =
        |progress: Progress<'_>| merge::merge(crops, *partial, input.input_budget, progress);
    let bars = ProgressBars::new(&args.messages);
    let merged = bars.during(Phase::Merging(crops.len()), merge)?;
    let window = &merged.image.data_window;
    let write = |progress: Progress<'_>| destination.write(Overwrite::Yes, &merged, progress);
    bars.during(Phase::Writing(window.height().into()), write)?;
    let (width, height) = (window.width(), window.height());
    let holes = match merged.holes {
        0 => String::new(),
        holes => format!(", {} in no crop", counted(holes, "pixel")),
    };
    let crops = counted(crops.len() as u64, "crop");
    reporter.result(format_args!(
        "{destination}: {width} x {height} pixels of {crops}{holes}"
    ));
    Ok(())
}

fn check_format(path: &Path) -> Result<()> {
    if Format::of_path(path)? == Format::Exr {
        return Ok(());
    }
    let message = format!(
        "{}: the merged image is an EXR, like its crops",
        path.display()
    );
    Err(Error::usage(message).note("expected a name that ends in .exr"))
}

impl Encode for Merged {
    fn encode(&self, out: &mut (impl Write + Seek + Send), progress: Progress) -> io::Result<()> {
        exr_file::write(&self.image, &self.metadata, out, progress)
    }
}
