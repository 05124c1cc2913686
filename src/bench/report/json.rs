//! Rows as JSON, for programs.

use super::columns::COLUMNS;
use crate::bench::run::{Machine, Row};
use crate::json;
use serde::{Serialize, Serializer};

/// The document: the machine, and a row for each configuration of each scene.
#[derive(Serialize)]
struct Document<'a> {
    machine: &'a Machine,
    rows: Vec<Record<'a>>,
}

/// A row with the clock of the machine.
struct Record<'a>(&'a Row, Option<f64>);

impl Serialize for Record<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Record(row, mhz) = self;
        serializer.collect_map(
            COLUMNS
                .iter()
                .map(|column| (column.key, column.value(row, *mhz))),
        )
    }
}

/// All rows as one JSON document that ends with a line break. What was not measured, and numbers
/// that are not finite, are null.
pub fn to_json(machine: &Machine, rows: &[Row]) -> Vec<u8> {
    let rows = rows.iter().map(|row| Record(row, machine.mhz)).collect();
    json::pretty(&Document { machine, rows })
}
