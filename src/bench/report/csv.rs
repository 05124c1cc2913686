//! Rows as comma-separated values, for spreadsheets.

use super::columns::{COLUMNS, Column};
use crate::bench::run::{Machine, Row};
use std::io;

/// A line of titles and a line for each row, with the content of [`super::to_json`]; what was not
/// measured is empty.
///
/// # Errors
/// None that a row could cause.
pub fn to_csv(machine: &Machine, rows: &[Row]) -> io::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for (place, row) in rows.iter().enumerate() {
        let cells = |column: &Column| column.value(row, machine.mhz).cells(column.key);
        let cells: Vec<(String, String)> = COLUMNS.iter().flat_map(cells).collect();
        if place == 0 {
            writer.write_record(cells.iter().map(|(title, _)| title))?;
        }
        writer.write_record(cells.iter().map(|(_, cell)| cell))?;
    }
    writer.into_inner().map_err(|error| error.into_error())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::SplitMethod;
    use crate::bench::kernel::Kernel;
    use crate::bench::run::tests::row;

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
        let cell = |line: usize, title: &str| &lines[line][place(title)];
        assert_eq!(cell(0, "scene"), "a, \"b\".pbrt");
        assert_eq!(
            [cell(0, "wrong_hits"), cell(0, "wrong_hits_95_high")],
            ["1", ""]
        );
        assert!(cell(1, "wrong_hits_95_high").parse::<f64>().unwrap() > 0.1);
        assert_eq!([cell(2, "max_ulp"), cell(2, "trace_ms_median")], ["", "50"]);
    }

    #[test]
    fn without_rows_there_is_no_line() {
        assert!(to_csv(&Machine::detect("scalar"), &[]).unwrap().is_empty());
    }
}
