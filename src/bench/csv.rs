//! Rows for spreadsheets.

use super::json::Record;
use super::{Machine, Row, Spread};
use std::io;

/// A line of titles, and one a row, of what [`super::to_json`] has of rows; what was not measured is empty.
///
/// # Errors
/// None that a row could cause.
pub fn to_csv(machine: &Machine, rows: &[Row]) -> io::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for (place, row) in rows.iter().enumerate() {
        let cells = cells(&Record::new(row, machine));
        if place == 0 {
            writer.write_record(cells.iter().map(|(title, _)| title))?;
        }
        writer.write_record(cells.iter().map(|(_, cell)| cell))?;
    }
    writer.into_inner().map_err(|error| error.into_error())
}

type Cell = (String, String);

fn cell(title: &str, value: impl ToString) -> Cell {
    (title.to_owned(), value.to_string())
}

fn known<T: ToString>(title: &str, value: Option<T>) -> Cell {
    (
        title.to_owned(),
        value.map_or(String::new(), |value| value.to_string()),
    )
}

fn spread(title: &str, Spread { min, median, max }: &Spread) -> [Cell; 3] {
    [("min", min), ("median", median), ("max", max)]
        .map(|(end, value)| cell(&format!("{title}_{end}"), value))
}

/// What is nested in the record gets the names joined by underscores.
fn cells(record: &Record) -> Vec<Cell> {
    let of_input = |of: fn(&super::InputError) -> f64| record.input.as_ref().map(of);
    let confidence = record.confidence_95.as_ref();
    let first = [
        cell("scene", record.scene),
        cell("accel", record.accel),
        cell("precision", record.precision),
        cell("threads", record.threads),
        cell("rays", record.rays),
        cell("pixels", record.pixels),
    ];
    let times = [
        spread("load_ms", &record.load_ms),
        spread("build_ms", &record.build_ms),
        spread("trace_ms", &record.trace_ms),
    ];
    let rest = [
        cell("mrays_per_s", record.mrays_per_s),
        known("cycles_per_ray", record.cycles_per_ray),
        cell("nodes_per_ray", record.nodes_per_ray),
        cell("primitives_per_ray", record.primitives_per_ray),
        known(
            "sah_cost",
            Some(record.sah_cost).filter(|cost| cost.is_finite()),
        ),
        known("epo", record.epo),
        cell("depth", record.depth),
        cell("bytes", record.bytes),
        known("input_max_ulp", of_input(|input| input.max_ulp)),
        known("input_max_pixels", of_input(|input| input.max_pixels)),
        known("sampled_pixels", record.sampled_pixels),
        known("wrong_hits", record.wrong_hits),
        known("false_hits", record.false_hits),
        known("missed_hits", record.missed_hits),
        known("wrong_primitives", record.wrong_primitives),
        known(
            "wrong_hits_95_low",
            confidence.map(|confidence| confidence.wrong_hits[0]),
        ),
        known(
            "wrong_hits_95_high",
            confidence.map(|confidence| confidence.wrong_hits[1]),
        ),
        known(
            "wrong_primitives_95_low",
            confidence.map(|confidence| confidence.wrong_primitives[0]),
        ),
        known(
            "wrong_primitives_95_high",
            confidence.map(|confidence| confidence.wrong_primitives[1]),
        ),
        known("max_ulp", record.max_ulp),
        known("p99_ulp", record.p99_ulp),
        known("mean_ulp", record.mean_ulp),
        known("fallback_rays", record.fallback_rays),
    ];
    first
        .into_iter()
        .chain(times.into_iter().flatten())
        .chain(rest)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::SplitMethod;
    use crate::bench::table::tests::row;
    use crate::bench::{Kernel, Row};

    #[test]
    fn every_line_has_the_same_cells_and_odd_names_are_quoted() {
        let machine = Machine::detect("scalar");
        let [exact, fast, ..] = Kernel::ALL;
        let odd = Row {
            scene: "a, \"b\".pbrt".into(),
            ..row(SplitMethod::Sah, exact, 1000)
        };
        let rows = [
            odd,
            row(SplitMethod::None, fast, 10),
            row(SplitMethod::Sah, fast, 0),
        ];
        let csv = to_csv(&machine, &rows).unwrap();
        let mut reader = csv::Reader::from_reader(&csv[..]);
        let titles = reader.headers().unwrap().clone();
        let place = |title: &str| titles.iter().position(|other| other == title).unwrap();
        let lines: Vec<csv::StringRecord> = reader.records().collect::<Result<_, _>>().unwrap();
        assert_eq!(lines.len(), 3);
        assert_eq!(&lines[0][place("scene")], "a, \"b\".pbrt");
        assert_eq!(
            [
                &lines[0][place("wrong_hits")],
                &lines[0][place("wrong_hits_95_high")]
            ],
            ["1", ""]
        );
        assert!(
            lines[1][place("wrong_hits_95_high")]
                .parse::<f64>()
                .unwrap()
                > 0.1
        );
        assert_eq!(
            [
                &lines[2][place("max_ulp")],
                &lines[2][place("trace_ms_median")]
            ],
            ["", "50"]
        );
    }

    #[test]
    fn no_row_is_no_line() {
        assert!(to_csv(&Machine::detect("scalar"), &[]).unwrap().is_empty());
    }
}
