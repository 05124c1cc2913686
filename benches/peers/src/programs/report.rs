//! What a program prints about its run: one line of JSON.

use super::npy;
use crate::Result;
use crate::args::ProgramOptions;
use serde::{Deserialize, Serialize};
use std::io::Write;
use std::time::Instant;

/// Milliseconds of the phases, and how far the depths agree with the exact ones.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(crate) struct Report {
    pub(crate) load: f64,
    /// 0 for a program without a tree.
    pub(crate) build: f64,
    /// Of all cameras.
    pub(crate) trace: f64,
    /// With `--compare`.
    #[serde(default)]
    pub(crate) agreement: Option<Agreement>,
}

/// Pixels of all cameras that agree with exact depths, and that do not.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Agreement {
    pub(crate) hits: u64,
    pub(crate) exact_hits: u64,
    /// A hit here and a miss there.
    pub(crate) hit_or_miss: u64,
    /// Two hits whose depths differ by more than [`TOLERANCE`].
    pub(crate) depths: u64,
}

/// How far two depths may be apart, as a share of the exact one.
pub(crate) const TOLERANCE: f32 = 1e-4;

/// Times one phase after the other.
pub(super) struct Clock(Instant);

impl Clock {
    pub(super) fn start() -> Clock {
        Clock(Instant::now())
    }

    /// Milliseconds since the last lap.
    pub(super) fn lap(&mut self) -> f64 {
        let now = Instant::now();
        let elapsed = now - std::mem::replace(&mut self.0, now);
        elapsed.as_secs_f64() * 1e3
    }
}

impl Report {
    /// Compares a camera's depths with the exact ones, if the options name files of them.
    pub(super) fn compare(
        &mut self,
        depths: &[f32],
        options: &ProgramOptions,
        camera: &str,
    ) -> Result<()> {
        let Some(template) = &options.compare else {
            return Ok(());
        };
        let exact = npy::read_depths(template.replace("{camera}", camera).as_ref())?;
        if exact.len() != depths.len() {
            return Err("the exact picture has another size".into());
        }
        let agreement = self.agreement.get_or_insert_default();
        for (&depth, &exact) in depths.iter().zip(&exact) {
            agreement.add(depth, exact);
        }
        Ok(())
    }

    /// Leaves memory to the system: to free it piece by piece would take time that no user waits.
    pub(super) fn print_and_exit(&self) -> ! {
        let line = serde_json::to_string(self).expect("numbers become JSON");
        let printed = writeln!(std::io::stdout(), "{line}");
        std::process::exit(i32::from(printed.is_err()))
    }
}

impl Agreement {
    fn add(&mut self, depth: f32, exact: f32) {
        let [is_hit, is_exact_hit] = [depth, exact].map(f32::is_finite);
        self.hits += u64::from(is_hit);
        self.exact_hits += u64::from(is_exact_hit);
        self.hit_or_miss += u64::from(is_hit != is_exact_hit);
        let is_off = (depth - exact).abs() > TOLERANCE * exact;
        self.depths += u64::from(is_hit && is_exact_hit && is_off);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_counted_by_kind() {
        let mut agreement = Agreement::default();
        let miss = f32::INFINITY;
        for (depth, exact) in [
            (miss, miss),
            (1.0, miss),
            (miss, 1.0),
            (2.0, 2.0001),
            (2.0, 2.1),
        ] {
            agreement.add(depth, exact);
        }
        let expected = Agreement {
            hits: 3,
            exact_hits: 3,
            hit_or_miss: 2,
            depths: 1,
        };
        assert_eq!(agreement, expected);
    }
}
