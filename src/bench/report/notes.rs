//! Notes on the errors of a scene, in sentences.

use super::table::grouped;
use crate::bench::error::{Errors, InputError};
use crate::bench::run::Row;

/// The notes on the rows of a scene.
pub fn notes(rows: &[Row]) -> Vec<String> {
    let input = rows.iter().find_map(|row| row.input).map(input_note);
    let mut whole = rows
        .iter()
        .filter(|row| !row.is_sampled())
        .filter_map(Row::errors);
    let pixels = whole.find(|errors| errors.is_sampled()).map(sample_note);
    let methods = rows.chunk_by(|a, b| a.method == b.method);
    let sampled = methods.filter_map(|rows| rows.iter().find(|row| row.is_sampled()));
    let no_errors = rows.iter().all(|row| row.errors.is_none());
    let mut notes: Vec<String> = input.into_iter().chain(pixels).collect();
    notes.extend(sampled.map(tile_note));
    notes.extend(no_errors.then(|| "errors were not measured".to_owned()));
    notes
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
        row.method,
        grouped(row.rays),
        grouped(row.pixels)
    )
}
