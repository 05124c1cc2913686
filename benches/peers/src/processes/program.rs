//! The programs in turn, and what they print.

use super::child::{self, Ended};
use super::scene_file::SceneFile;
use crate::Result;
use crate::args::Isa;
use crate::programs::{Agreement, Report};
use feimos::simd::Level;
use serde::Deserialize;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A program, with its flags.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Program {
    Feimos { path: PathBuf, flags: Vec<String> },
    Embree,
    Rasterizer,
}

/// Where and how the programs run.
#[derive(Debug, Clone, Copy)]
pub(super) struct Setting<'a> {
    pub(super) scene: &'a SceneFile,
    pub(super) threads: usize,
    /// The instruction set that feimos is limited to.
    pub(super) simd: Option<Level>,
    /// The instruction set that peers are limited to.
    pub(super) isa: Option<Isa>,
    /// An empty folder for images.
    pub(super) images: &'a Path,
}

/// What one run has taken.
#[derive(Debug, Clone, Copy)]
pub(super) struct Run {
    pub(super) cpu_ms: f64,
    pub(super) peak_bytes: f64,
    /// Milliseconds of load, build, trace and write.
    pub(super) phases: [f64; 4],
}

/// A line of `feimos render --json`.
#[derive(Debug, Deserialize)]
struct Line {
    ms: Milliseconds,
}

#[derive(Debug, Deserialize)]
struct Milliseconds {
    load: f64,
    build: f64,
    trace: f64,
    write: f64,
}

impl Program {
    pub(super) fn name(&self) -> String {
        match self {
            Program::Feimos { path, flags } => {
                let name = path.file_name().unwrap_or_default().display();
                format!("{name} {}", flags.join(" ")).trim().to_owned()
            }
            Program::Embree => "Embree".to_owned(),
            Program::Rasterizer => "rasterizer".to_owned(),
        }
    }

    /// Renders the scene once.
    pub(super) fn run(&self, setting: Setting) -> Result<(Ended, Run)> {
        let mut command = match self {
            Program::Feimos { path, flags } => feimos(path, flags, "exr", setting),
            Program::Embree => peer("embree", setting)?,
            Program::Rasterizer => peer("zbuffer", setting)?,
        };
        let ended = child::run(&mut command)?;
        let phases = match self {
            Program::Feimos { .. } => feimos_phases(&ended.output)?,
            Program::Embree | Program::Rasterizer => {
                let report: Report = serde_json::from_slice(&ended.output)?;
                [report.load, report.build, report.trace, 0.0]
            }
        };
        let run = Run {
            cpu_ms: ended.cpu.as_secs_f64() * 1e3,
            peak_bytes: ended.peak_bytes as f64,
            phases,
        };
        Ok((ended, run))
    }

    /// Renders the scene once more and compares depths with the exact ones; `None` for feimos,
    /// which renders those.
    pub(super) fn agreement(&self, setting: Setting) -> Result<Option<Agreement>> {
        let mut command = match self {
            Program::Feimos { .. } => return Ok(None),
            Program::Embree => peer("embree", setting)?,
            Program::Rasterizer => peer("zbuffer", setting)?,
        };
        let exact = image(setting, "npy");
        let ended = child::run(command.arg("--compare").arg(exact))?;
        let report: Report = serde_json::from_slice(&ended.output)?;
        Ok(report.agreement)
    }

    /// Leaves exact depths for [`Program::agreement`].
    pub(super) fn render_exact(&self, setting: Setting) -> Result<()> {
        if let Program::Feimos { path, .. } = self {
            child::run(feimos(path, &[], "npy", setting).args(["--aov", "Z"]))?;
        }
        Ok(())
    }
}

/// The name of an image: with a list of cameras a template.
fn image(setting: Setting, extension: &str) -> PathBuf {
    let name = match setting.scene.cameras {
        Some(_) => format!("{{camera}}.{extension}"),
        None => format!("image.{extension}"),
    };
    setting.images.join(name)
}

fn feimos(path: &Path, flags: &[String], extension: &str, setting: Setting) -> Command {
    let mut command = Command::new(path);
    command.arg("render").arg(&setting.scene.scene);
    command.arg("-o").arg(image(setting, extension));
    command.args(["--json", "--quiet", "--threads"]);
    command.arg(setting.threads.to_string());
    if let Some(list) = &setting.scene.cameras {
        command.arg("--cameras").arg(list);
    }
    if let Some(level) = setting.simd {
        command.args(["--simd", level.name()]);
    }
    command.args(flags);
    command
}

/// A peer is this program, with another command.
fn peer(name: &str, setting: Setting) -> Result<Command> {
    let mut command = Command::new(std::env::current_exe()?);
    command.arg(name).arg(&setting.scene.scene);
    command.args(["--threads", &setting.threads.to_string()]);
    if let Some(list) = &setting.scene.cameras {
        command.arg("--cameras").arg(list);
    }
    if let Some(isa) = setting.isa {
        command.args(["--isa", isa.name()]);
    }
    Ok(command)
}

/// Sums over all images.
fn feimos_phases(output: &[u8]) -> Result<[f64; 4]> {
    let mut sums = [0.0; 4];
    for line in serde_json::Deserializer::from_slice(output).into_iter::<Line>() {
        let Milliseconds {
            load,
            build,
            trace,
            write,
        } = line?.ms;
        for (sum, phase) in sums.iter_mut().zip([load, build, trace, write]) {
            *sum += phase;
        }
    }
    Ok(sums)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phases_of_all_images_add_up() {
        let line = r#"{"hits":1,"ms":{"load":1.5,"build":2.0,"trace":3,"write":4,"total":11}}"#;
        let output = format!("{line}\n{line}\n");
        let sums = feimos_phases(output.as_bytes()).unwrap();
        assert_eq!(sums, [3.0, 4.0, 6.0, 8.0]);
        assert!(feimos_phases(b"{}").is_err());
    }
}
