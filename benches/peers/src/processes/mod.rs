//! Whole processes in turn, from a scene file to depths.

mod child;
mod program;
mod rows;
mod scaling;
mod scene_file;
mod scene_name;

pub(crate) use scaling::run as run_scaling;
pub(crate) use scene_name::SceneName;

use crate::args::{PictureOptions, SceneOptions};
use crate::rounds::{Series, alternate};
use crate::{Result, memory, table};
use child::Ended;
use program::{Program, Run, Setting};
use rows::Row;
use scene_file::SceneFile;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// What the largest program is expected to take, in bytes a primitive; a scene that would not fit
/// is left out.
const NEEDED: u64 = 160;

/// Prints a table for each scene and number of threads.
pub(crate) fn run(options: &PictureOptions) -> Result<()> {
    let programs = programs(options)?;
    let folder = temporary_folder(options.folder.as_deref())?;
    let names = if options.all {
        SceneName::all()
    } else {
        options.views.clone()
    };
    for name in names {
        let available = memory::available_bytes()?;
        if name.primitives() * NEEDED > available {
            eprintln!("peers: {name} is left out: only {available} bytes of memory are free");
            continue;
        }
        let scene = write_by_child(name, folder.path())?;
        for &threads in &options.threads {
            let setting = Setting {
                scene: &scene,
                threads,
                simd: options.simd,
                isa: options.isa,
                images: &folder.path().join("images"),
            };
            println!("### {}, {}\n", name.title(), heading(setting, options.runs));
            println!("{}", rows::table(&rows(name, &programs, setting, options)?));
        }
        scene.remove()?;
    }
    Ok(())
}

/// A new folder in `parent`, or in the system's folder for temporary files.
fn temporary_folder(parent: Option<&Path>) -> Result<tempfile::TempDir> {
    let mut folder = tempfile::Builder::new();
    folder.prefix("feimos-peers-");
    Ok(match parent {
        Some(parent) => folder.tempdir_in(parent)?,
        None => folder.tempdir()?,
    })
}

/// Writes a scene by a process of its own: what this one takes would count as the memory of
/// programs.
fn write_by_child(name: SceneName, folder: &Path) -> Result<SceneFile> {
    let mut writer = Command::new(std::env::current_exe()?);
    writer.arg("scene").arg(name.to_string()).arg(folder);
    Ok(serde_json::from_slice(&child::run(&mut writer)?.output)?)
}

/// Writes a scene and prints where it is, as JSON.
pub(crate) fn write_scene(options: &SceneOptions) -> Result<()> {
    let written = SceneFile::write(options.name, &options.folder)?;
    println!("{}", serde_json::to_string(&written)?);
    Ok(())
}

/// feimos with all its flags, then the peers.
fn programs(options: &PictureOptions) -> Result<Vec<Program>> {
    let paths = if options.feimos.is_empty() {
        vec![build_feimos()?]
    } else {
        options.feimos.clone()
    };
    let flags = std::iter::once("").chain(options.flags.iter().map(String::as_str));
    let flags = flags.map(|flags| flags.split_whitespace().map(str::to_owned).collect());
    let flags: Vec<Vec<String>> = flags.collect();
    let feimos = paths.into_iter().flat_map(|path| {
        let with = move |flags: &Vec<String>| Program::Feimos {
            path: path.clone(),
            flags: flags.clone(),
        };
        flags.iter().map(with).collect::<Vec<_>>()
    });
    Ok(feimos
        .chain([Program::Embree, Program::Rasterizer])
        .collect())
}

/// Builds the program beside this package, as its users do.
fn build_feimos() -> Result<PathBuf> {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../Cargo.toml");
    let mut cargo = Command::new("cargo");
    cargo.args(["build", "--release", "--locked", "--bin", "feimos"]);
    cargo.arg("--message-format=json-render-diagnostics");
    let messages = child::run(cargo.arg("--manifest-path").arg(manifest))?.output;
    let messages = serde_json::Deserializer::from_slice(&messages).into_iter();
    let programs = messages.filter_map(|message: serde_json::Result<serde_json::Value>| {
        Some(message.ok()?.get("executable")?.as_str()?.into())
    });
    programs
        .last()
        .ok_or_else(|| "cargo builds no program".into())
}

fn heading(setting: Setting, runs: u32) -> String {
    let threads = match setting.threads {
        1 => "one thread".to_owned(),
        threads => format!("{threads} threads"),
    };
    let SceneFile {
        resolution: [width, height],
        primitives,
        kind,
        ..
    } = setting.scene;
    let primitives = table::grouped(*primitives);
    format!("{threads}: {width} x {height} pixels, {primitives} {kind}, {runs} rounds")
}

fn rows(
    name: SceneName,
    programs: &[Program],
    setting: Setting,
    options: &PictureOptions,
) -> Result<Vec<Row>> {
    let is_able = |program: &&Program| **program != Program::Rasterizer || !name.has_only_spheres();
    let programs: Vec<&Program> = programs.iter().filter(is_able).collect();
    clear(setting.images)?;
    programs[0].render_exact(setting)?;
    let agreements = programs.iter().map(|program| program.agreement(setting));
    let agreements: Vec<_> = agreements.collect::<Result<_>>()?;
    let rounds = [options.warmup, options.runs];
    let measured = measure(programs.len(), rounds, |row| {
        clear(setting.images)?;
        programs[row].run(setting)
    })?;
    let rows = programs.into_iter().zip(measured).zip(agreements);
    let row = |((program, (total, runs)), agreement): ((&Program, _), _)| Row {
        program: program.clone(),
        total,
        runs,
        agreement,
    };
    Ok(rows.map(row).collect())
}

/// Runs all `rows` once a round, after rounds of warmup. Returns whole processes and what they
/// report.
fn measure(
    rows: usize,
    [warmup, runs]: [u32; 2],
    mut run: impl FnMut(usize) -> Result<(Ended, Run)>,
) -> Result<Vec<(Series, Vec<Run>)>> {
    let mut measured = vec![Vec::new(); rows];
    let mut failure = None;
    let totals = alternate(rows, warmup, runs, |row| {
        if failure.is_some() {
            return Duration::ZERO;
        }
        match run(row) {
            Ok((ended, run)) => {
                measured[row].push(run);
                ended.wall
            }
            Err(error) => {
                failure = Some(error);
                Duration::ZERO
            }
        }
    });
    if let Some(error) = failure {
        return Err(error);
    }
    let measured = measured.into_iter();
    let measured = measured.map(|mut runs| runs.split_off(warmup as usize));
    Ok(totals.into_iter().zip(measured).collect())
}

/// Images of earlier runs are removed before the clock starts.
fn clear(folder: &Path) -> Result<()> {
    if folder.exists() {
        std::fs::remove_dir_all(folder)?;
    }
    Ok(std::fs::create_dir(folder)?)
}
