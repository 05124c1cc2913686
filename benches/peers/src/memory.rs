//! What this process takes of the machine's memory, from Linux's `/proc`.

use crate::Result;
use std::fs;

/// Begins to look for the peak anew.
pub(crate) fn reset_peak() -> Result<()> {
    Ok(fs::write("/proc/self/clear_refs", "5")?)
}

/// The most bytes resident since the last [`reset_peak`].
pub(crate) fn peak_bytes() -> Result<u64> {
    kibibytes("/proc/self/status", "VmHWM:")
}

/// Bytes that a new process could have.
pub(crate) fn available_bytes() -> Result<u64> {
    kibibytes("/proc/meminfo", "MemAvailable:")
}

fn kibibytes(file: &str, label: &str) -> Result<u64> {
    let text = fs::read_to_string(file)?;
    let number = text
        .lines()
        .find_map(|line| line.strip_prefix(label)?.trim().strip_suffix(" kB"));
    let number: u64 = number
        .ok_or_else(|| format!("no `{label}` in {file}"))?
        .parse()?;
    Ok(number * 1024)
}

/// Held by tests that take much memory, and by the one that measures it.
#[cfg(test)]
pub(crate) static MEASURED: std::sync::Mutex<()> = std::sync::Mutex::new(());

#[cfg(test)]
mod tests {
    use super::*;
    use std::hint::black_box;

    #[test]
    fn a_peak_passes_when_it_is_reset() {
        let _alone = MEASURED.lock();
        let size = 64 << 20;
        drop(black_box(vec![1u8; size]));
        let high = peak_bytes().unwrap();
        reset_peak().unwrap();
        let low = peak_bytes().unwrap();
        assert!(high >= size as u64 && low < high, "{high}, then {low}");
        assert!(available_bytes().unwrap() > 0);
    }
}
