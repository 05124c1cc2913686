//! The machine of the measurements.

use serde::Serialize;
use std::collections::HashSet;
use std::fmt;

/// The machine that times depend on. Unknown values are `None`. Field names are JSON keys.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Machine {
    /// The model of the processor.
    pub cpu: Option<String>,
    /// Physical cores.
    pub cores: Option<usize>,
    /// Hardware threads that the process may use.
    pub threads: usize,
    /// The clock in MHz: the mean of all hardware threads.
    pub mhz: Option<f64>,
    /// The instruction set of the kernels.
    pub simd: String,
    /// The operating system and the architecture.
    pub os: String,
    /// The version of feimos.
    pub feimos: String,
}

impl Machine {
    /// Detects this machine; kernels use the instruction set `simd`.
    pub fn detect(simd: &str) -> Machine {
        let cpuinfo = read("/proc/cpuinfo").unwrap_or_default();
        Machine {
            cpu: field(&cpuinfo, "model name").next().map(str::to_owned),
            cores: cores(&cpuinfo),
            threads: std::thread::available_parallelism().map_or(1, usize::from),
            mhz: clock(&cpuinfo),
            simd: simd.to_owned(),
            os: os(read("/proc/sys/kernel/osrelease")),
            feimos: env!("CARGO_PKG_VERSION").to_owned(),
        }
    }
}

/// One line.
impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.cpu.as_deref().unwrap_or("unknown processor"))?;
        if let Some(cores) = self.cores {
            write!(f, ", {cores} {}", if cores == 1 { "core" } else { "cores" })?;
        }
        if let Some(mhz) = self.mhz {
            write!(f, ", {mhz:.0} MHz")?;
        }
        write!(f, ", {}, {}, feimos {}", self.simd, self.os, self.feimos)
    }
}

fn read(path: &str) -> Option<String> {
    std::fs::read_to_string(path).ok()
}

fn os(release: Option<String>) -> String {
    let words = [
        Some(std::env::consts::OS.to_owned()),
        release,
        Some(std::env::consts::ARCH.to_owned()),
    ];
    words
        .iter()
        .flatten()
        .map(|word| word.trim())
        .collect::<Vec<_>>()
        .join(" ")
}

/// The values of the lines `name : value` in `/proc/cpuinfo`, one for each hardware thread.
fn field<'a>(cpuinfo: &'a str, name: &'a str) -> impl Iterator<Item = &'a str> {
    let pairs = cpuinfo.lines().filter_map(|line| line.split_once(':'));
    pairs
        .filter(move |(key, _)| key.trim() == name)
        .map(|(_, value)| value.trim())
}

/// The mean clock of all threads.
fn clock(cpuinfo: &str) -> Option<f64> {
    let clocks = field(cpuinfo, "cpu MHz").filter_map(|mhz| mhz.parse().ok());
    let clocks: Vec<f64> = clocks.collect();
    (!clocks.is_empty()).then(|| clocks.iter().sum::<f64>() / clocks.len() as f64)
}

/// The number of different pairs of a socket and a core.
fn cores(cpuinfo: &str) -> Option<usize> {
    let pairs = field(cpuinfo, "physical id").zip(field(cpuinfo, "core id"));
    Some(pairs.collect::<HashSet<_>>().len()).filter(|count| *count > 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_core_counts_once_for_all_its_threads() {
        let thread = |socket, core| {
            format!("model name\t: Quick 9\nphysical id\t: {socket}\ncore id\t\t: {core}\n\n")
        };
        let cpuinfo: String = [(0, 0), (0, 1), (0, 0), (1, 0)]
            .map(|(socket, core)| thread(socket, core))
            .concat();
        assert_eq!(cores(&cpuinfo), Some(3));
        assert_eq!(field(&cpuinfo, "model name").next(), Some("Quick 9"));
        assert_eq!(clock("cpu MHz : 2000.0\ncpu MHz : 3000.0\n"), Some(2500.0));
        assert_eq!(cores("Features : fp asimd\n"), None);
    }

    #[test]
    fn unknown_values_are_left_out() {
        let known = Machine {
            cpu: Some("Quick 9".into()),
            cores: Some(2),
            threads: 4,
            mhz: Some(2500.4),
            simd: "scalar".into(),
            os: "linux 6.1 x86_64".into(),
            feimos: "0.1.0".into(),
        };
        assert_eq!(
            known.to_string(),
            "Quick 9, 2 cores, 2500 MHz, scalar, linux 6.1 x86_64, feimos 0.1.0"
        );
        let unknown = Machine {
            cpu: None,
            cores: None,
            mhz: None,
            ..known
        };
        assert_eq!(
            unknown.to_string(),
            "unknown processor, scalar, linux 6.1 x86_64, feimos 0.1.0"
        );
    }
}
