//! How phases gain from threads: whole processes of feimos, and Embree's trace.

mod amdahl;
mod embree;
mod table;

use super::program::{Program, Run, Setting};
use super::scene_file::SceneFile;
use super::scene_name::SceneName;
use super::{build_feimos, clear, measure, temporary_folder, write_by_child};
use crate::Result;
use crate::args::ScalingOptions;
use crate::rounds::{Series, median};
use crate::table::grouped;
use std::path::Path;
use table::Row;

/// The phases of [`Run`].
const PHASES: [&str; 4] = ["load", "build", "trace", "write"];

/// Prints a table for each view.
pub(crate) fn run(options: &ScalingOptions) -> Result<()> {
    let path = match &options.feimos {
        Some(path) => path.clone(),
        None => build_feimos()?,
    };
    let program = |accel: &String| Program::Feimos {
        path: path.clone(),
        flags: vec!["--accel".to_owned(), accel.clone()],
    };
    let programs: Vec<Program> = options.accel.iter().map(program).collect();
    let threads: Vec<usize> = options.threads.iter().map(|&count| count.into()).collect();
    let folder = temporary_folder(options.folder.as_deref())?;
    for name in &options.views {
        let scene = write_by_child(SceneName::View(*name), folder.path())?;
        let images = folder.path().join("images");
        let mut rows = rows_of_feimos(&programs, &scene, &threads, &images, options)?;
        rows.push(embree::row(*name, &threads, options)?);
        println!("### {}, {}\n", name.title(), heading(&scene, options.runs));
        println!("{}{}", table::markdown(&threads, &rows), note(&threads));
        scene.remove()?;
    }
    Ok(())
}

fn heading(scene: &SceneFile, runs: u32) -> String {
    let [width, height] = scene.resolution;
    let (primitives, kind) = (grouped(scene.primitives), &scene.kind);
    format!("{width} x {height} pixels, {primitives} {kind}, medians of {runs} rounds")
}

/// A note on threads that have no processor of their own.
fn note(threads: &[usize]) -> String {
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    if threads.iter().all(|&count| count <= processors) {
        return String::new();
    }
    format!("\nThis process may use {processors} processors: more threads share them.\n")
}

/// The phases of every program and the whole of it, each with every number of threads.
fn rows_of_feimos(
    programs: &[Program],
    scene: &SceneFile,
    threads: &[usize],
    images: &Path,
    options: &ScalingOptions,
) -> Result<Vec<Row>> {
    let pairs = programs.iter();
    let pairs = pairs.flat_map(|program| threads.iter().map(move |&threads| (program, threads)));
    let pairs: Vec<(&Program, usize)> = pairs.collect();
    let measured = measure(pairs.len(), [options.warmup, options.runs], |pair| {
        let (program, threads) = pairs[pair];
        clear(images)?;
        program.run(Setting {
            scene,
            threads,
            simd: options.simd,
            isa: options.isa,
            images,
        })
    })?;
    let of_programs = options.accel.iter().zip(measured.chunks(threads.len()));
    Ok(of_programs
        .flat_map(|(accel, measured)| rows_of(accel, measured))
        .collect())
}

/// The rows of one program, from its measurements with each number of threads.
fn rows_of(accel: &str, measured: &[(Series, Vec<Run>)]) -> Vec<Row> {
    let row = |(phase, name): (usize, &&str)| {
        let time = |(_, runs): &(Series, Vec<Run>)| {
            median(runs.iter().map(|run| run.phases[phase]).collect())
        };
        Row {
            name: format!("{accel}, {name}"),
            times: measured.iter().map(time).collect(),
        }
    };
    let total = Row {
        name: format!("{accel}, total"),
        times: measured.iter().map(|(total, _)| total.median()).collect(),
    };
    let phases = PHASES.iter().enumerate().map(row);
    phases.chain([total]).collect()
}
