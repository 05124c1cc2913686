//! Time and memory of feimos per phase, as meshes grow.

mod phases;

pub(crate) use phases::print_phases;

use crate::args::ScaleOptions;
use crate::rounds::median;
use crate::{Result, memory, ply, table};
use phases::{PHASES, Phases};
use std::path::Path;
use std::process::Command;

/// What feimos is expected to take at most, in bytes a triangle; a size that would not fit is left out.
const NEEDED: u64 = 250;

/// Prints a table for each split method; every measurement is a process of its own.
pub(crate) fn run(options: &ScaleOptions) -> Result<()> {
    let folder = options.folder.clone().unwrap_or_else(std::env::temp_dir);
    let folder = tempfile::Builder::new()
        .prefix("feimos-peers-")
        .tempdir_in(folder)?;
    let mut rows = vec![Vec::new(); options.accel.len()];
    for &millions in &options.millions {
        let triangles = millions * 1_000_000;
        let available = memory::available_bytes()?;
        if triangles * NEEDED > available {
            eprintln!(
                "peers: {millions} million triangles are left out: only {available} bytes of memory are free"
            );
            continue;
        }
        let mesh = folder.path().join(format!("sphere-{millions}.ply"));
        ply::generate(triangles, &mesh)?;
        for (rows, accel) in rows.iter_mut().zip(&options.accel) {
            let runs = (0..options.runs).map(|_| phases_of(&mesh, accel, options.threads));
            rows.push(row(&runs.collect::<Result<Vec<_>>>()?));
        }
        std::fs::remove_file(&mesh)?;
    }
    for (rows, accel) in rows.iter().zip(&options.accel) {
        println!(
            "### {accel}, {} threads, medians of {}\n\n{}",
            options.threads,
            options.runs,
            of_rows(rows)
        );
    }
    Ok(())
}

fn phases_of(mesh: &Path, accel: &str, threads: usize) -> Result<Phases> {
    let mut command = Command::new(std::env::current_exe()?);
    command
        .arg("phases")
        .arg(mesh)
        .args(["--accel", accel, "--threads", &threads.to_string()]);
    let output = command.stderr(std::process::Stdio::inherit()).output()?;
    if !output.status.success() {
        return Err(format!(
            "the process for {} ended with {}",
            mesh.display(),
            output.status
        )
        .into());
    }
    Ok(serde_json::from_slice(&output.stdout)?)
}

/// Medians: per phase milliseconds, nanoseconds a triangle (a ray for the trace, a pixel for the file), and bytes a
/// triangle at the peak.
fn row(runs: &[Phases]) -> String {
    let (triangles, pixels) = (runs[0].triangles, runs[0].pixels);
    let mut row = format!("| {} |", table::grouped(triangles));
    for (i, phase) in PHASES.iter().enumerate() {
        let of_runs = |of: fn(&phases::Cost) -> f64| {
            median(runs.iter().map(|run| of(&run.costs[i])).collect())
        };
        let (milliseconds, peak) = (
            of_runs(|cost| cost.milliseconds),
            of_runs(|cost| cost.peak_bytes as f64),
        );
        let per = if phase.is_per_pixel {
            pixels
        } else {
            triangles
        };
        let (nanoseconds, bytes) = (milliseconds * 1e6 / per as f64, peak / triangles as f64);
        row.push_str(&format!(
            " {} | {nanoseconds:.1} | {bytes:.0} |",
            table::milliseconds(milliseconds)
        ));
    }
    row
}

fn of_rows(rows: &[String]) -> String {
    let mut table = "| triangles |".to_owned();
    for phase in &PHASES {
        let unit = if phase.is_per_pixel {
            "pixel"
        } else {
            "triangle"
        };
        table.push_str(&format!(
            " {} ms | ns a {unit} | peak bytes a triangle |",
            phase.name
        ));
    }
    let columns = 1 + 3 * PHASES.len();
    format!(
        "{table}\n|{}\n{}\n",
        "---|".repeat(columns),
        rows.join("\n")
    )
}
