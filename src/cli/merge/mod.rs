//! `feimos merge`: crops of one film to the whole.

mod args;

pub(crate) use args::MergeArgs;

use super::counted::counted;
use super::inputs::Inputs;
use super::output_name::{Destination, Encode};
use super::progress_bar::{Phase, ProgressBars};
use super::reporter::Reporter;
use super::thread_pool::thread_pool;
use feimos::error::{Error, Result};
use feimos::film::atomic_file::Overwrite;
use feimos::film::{Format, exr_file};
use feimos::merge::{self, Merged};
use feimos::progress::Progress;
use std::io::{self, Seek, Write};
use std::path::Path;

/// Puts the crops together and writes the whole.
pub(crate) fn merge(args: &MergeArgs, reporter: &Reporter) -> Result<u8> {
    let destination = Destination::of_name(&args.output);
    if let Destination::File(path) = &destination {
        check_format(path)?;
        Inputs::default()
            .with(&args.crops, "a crop")
            .check(path, "-o")?;
    }
    destination.check()?;
    thread_pool(args.threads, reporter)?.install(|| {
        let put_together = |progress: Progress<'_>| {
            merge::merge(&args.crops, args.partial, args.input.input_budget, progress)
        };
        let merged =
            ProgressBars::new(&args.talk).during(Phase::Merging(args.crops.len()), put_together)?;
        destination.write(Overwrite::Yes, &merged)?;
        let window = &merged.image.data_window;
        let holes = match merged.holes {
            0 => String::new(),
            holes => format!(", {} in no crop", counted(holes, "pixel")),
        };
        let crops = counted(args.crops.len() as u64, "crop");
        reporter.result(format_args!(
            "{destination}: {} x {} pixels of {crops}{holes}",
            window.width(),
            window.height()
        ));
        Ok(0)
    })
}

fn check_format(path: &Path) -> Result<()> {
    if Format::of_path(path)? != Format::Exr {
        let error = Error::usage(format!(
            "{}: the whole is an EXR, as its crops are",
            path.display()
        ));
        return Err(error.note("expected a name that ends in .exr"));
    }
    Ok(())
}

impl Encode for Merged {
    fn encode(&self, out: &mut (impl Write + Seek)) -> io::Result<()> {
        exr_file::write(&self.image, &self.metadata, out)
    }
}
