//! Notes on the errors of a scene, in sentences.

use crate::accel::Accelerator;
use crate::bench::error::{Errors, InputError};
use crate::bench::run::Row;
use crate::error::grouped;

/// The notes on the rows of a scene.
pub fn notes(rows: &[Row]) -> Vec<String> {
    let input = rows.iter().find_map(|row| row.input).map(input_note);
    let mut whole = rows
        .iter()
        .filter(|row| !row.is_sampled())
        .filter_map(Row::errors);
    let pixels = whole.find(|errors| errors.is_sampled()).map(sample_note);
    let accelerators = rows.chunk_by(|a, b| a.accelerator == b.accelerator);
    let sampled = accelerators.filter_map(|rows| rows.iter().find(|row| row.is_sampled()));
    let no_errors = rows.iter().all(|row| row.errors.is_none());
    let mut notes: Vec<String> = input.into_iter().chain(pixels).collect();
    notes.extend(sampled.map(tile_note));
    notes.extend(raster_note(rows));
    notes.extend(no_errors.then(|| "errors were not measured".to_owned()));
    notes
}

/// A note on kernels that other accelerators have rows for, but bins have none.
fn raster_note(rows: &[Row]) -> Option<String> {
    let mut rows_of_bins = rows.iter().map(|row| row.accelerator);
    let has_bins = rows_of_bins.any(|accelerator| accelerator == Accelerator::Raster);
    let is_lacking = has_bins && rows.iter().any(|row| row.kernel.needs_tree());
    is_lacking.then(|| {
        "raster has rows for exact and fast only: the other kernels trace single rays, which need \
         a tree"
            .to_owned()
    })
}

fn input_note(
    InputError {
        max_ulp,
        max_pixels,
    }: InputError,
) -> String {
    format!(
        "input: rounding transforms, vertices and rays to f64 moves hits by up to {max_ulp:.1e} \
         ulp of their distance, {max_pixels:.1e} pixels"
    )
}

fn sample_note(errors: &Errors) -> String {
    format!(
        "errors are those of {} of {} pixels, chosen at random; in brackets, the upper bound of \
         the share of all pixels, with a confidence of 95 %",
        grouped(errors.tally.pixels),
        grouped(errors.of)
    )
}

fn tile_note(row: &Row) -> String {
    let compared = row.errors().map_or(String::new(), |errors| {
        format!(
            "; errors are those of {} pixels in them",
            errors.tally.pixels
        )
    });
    format!(
        "{} is sampled: {} of {} rays, in some tiles chosen at random (kernels that trace single \
         rays trace one in each){compared}",
        row.accelerator,
        grouped(row.rays),
        grouped(row.pixels)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::SplitMethod;
    use crate::bench::kernel::Kernel;
    use crate::bench::run::tests::{row, row_of};

    #[test]
    fn a_note_says_which_kernels_bins_lack() {
        let [exact, fast, single, ..] = Kernel::ALL;
        let bins = |kernel| row_of(Accelerator::Raster, kernel, 1000);
        let tree = |kernel| row(SplitMethod::Sah, kernel, 1000);
        let says_so = |rows: &[Row]| {
            notes(rows)
                .iter()
                .any(|note| note.starts_with("raster has"))
        };
        assert!(says_so(&[bins(exact), tree(exact), tree(single)]));
        assert!(!says_so(&[
            bins(exact),
            bins(fast),
            tree(exact),
            tree(fast)
        ]));
        assert!(!says_so(&[tree(exact), tree(single)]));
    }
}
