//! Any bytes as two crops to be merged: the first bytes tell how long the first is.
#![no_main]

use feimos::input::BudgetFactor;
use feimos::merge::merge;
use feimos::progress::Progress;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: (bool, u16, &[u8])| {
    let (partial, cut, bytes) = input;
    let (first, second) = bytes.split_at(usize::from(cut).min(bytes.len()));
    let folder = tempfile::tempdir().expect("a folder");
    let crops = [folder.path().join("a.exr"), folder.path().join("b.exr")];
    for (path, bytes) in crops.iter().zip([first, second]) {
        std::fs::write(path, bytes).expect("room");
    }
    for crops in [&crops[..], &crops[..1]] {
        if let Ok(merged) = merge(crops, partial, BudgetFactor::ONCE, Progress::SILENT) {
            assert_eq!(merged.image.validate(), Ok(()));
        }
    }
});
