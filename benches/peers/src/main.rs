//! feimos beside Embree, obvhs and bvh: the same views, in alternating runs.

mod args;
mod camera_rays;
mod compare;
mod competitor;
mod competitors;
mod differences;
mod geometry;
mod grid;
mod memory;
mod picture;
mod ply;
mod processes;
mod programs;
mod random;
mod rounds;
mod scale;
mod single_rays;
mod table;
mod view;
mod views;

use args::{Arguments, Command};
use clap::Parser;
use std::process::ExitCode;

/// As in the program `feimos`. Embree asks for huge pages itself.
#[cfg(target_os = "linux")]
#[global_allocator]
static ALLOCATOR: feimos::huge_pages::HugePageAllocator = feimos::huge_pages::HugePageAllocator;

/// What can go wrong here only ends the program: a sentence is enough.
type Result<T> = std::result::Result<T, Box<dyn std::error::Error + Send + Sync>>;

fn main() -> ExitCode {
    #[cfg(target_os = "linux")]
    feimos::huge_pages::prepare();
    let done = match Arguments::parse().command {
        Command::Compare(options) => compare::run(&options),
        Command::Generate { triangles, output } => ply::generate(triangles, &output).map(drop),
        Command::Scale(options) => scale::run(&options),
        Command::Picture(options) => processes::run(&options),
        Command::Scaling(options) => processes::run_scaling(&options),
        Command::Embree(options) => programs::run_embree(&options),
        Command::Zbuffer(options) => programs::run_zbuffer(&options),
        Command::Scene(options) => processes::write_scene(&options),
        Command::Phases(options) => scale::print_phases(&options),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("peers: {error}");
            ExitCode::FAILURE
        }
    }
}
