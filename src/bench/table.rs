//! Rows for people.

use super::Row;
use indicatif::HumanCount;
use std::fmt;

/// The rows of one scene, in columns that are as wide as they need to be.
#[derive(Debug, Clone, Copy)]
pub struct Table<'a>(pub &'a [Row]);

/// What stands in a column, and over it.
struct Column {
    title: &'static str,
    cell: fn(&Row) -> String,
}

const COLUMNS: [Column; 11] = [
    Column { title: "accel", cell: |row| row.method.to_string() },
    Column { title: "precision", cell: |row| row.precision.to_string() },
    Column { title: "build ms", cell: |row| row.build_ms.to_string() },
    Column { title: "trace ms", cell: |row| row.trace_ms.to_string() },
    Column { title: "Mrays/s", cell: |row| format!("{:.2}", row.mrays_per_s()) },
    Column { title: "nodes/ray", cell: |row| mean(row.nodes_per_ray()) },
    Column { title: "prims/ray", cell: |row| mean(row.primitives_per_ray()) },
    Column { title: "SAH", cell: |row| mean(row.sah_cost) },
    Column { title: "depth", cell: |row| row.depth.to_string() },
    Column { title: "tree bytes", cell: |row| HumanCount(row.bytes as u64).to_string() },
    Column { title: "fallbacks", cell: |row| row.fallback_rays.map_or("-".to_owned(), |n| HumanCount(n).to_string()) },
];

/// Columns of names, which stand at the left; numbers stand at the right.
const NAMES: usize = 2;

fn mean(value: f64) -> String {
    match value {
        value if !value.is_finite() => "-".to_owned(),
        value if value < 1000.0 => format!("{value:.1}"),
        value => HumanCount(value.round() as u64).to_string(),
    }
}

impl fmt::Display for Table<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let titles = COLUMNS.map(|column| column.title.to_owned());
        let rows = self.0.iter().map(|row| COLUMNS.map(|column| (column.cell)(row)));
        let lines: Vec<[String; COLUMNS.len()]> = std::iter::once(titles).chain(rows).collect();
        let width = |place: usize| lines.iter().map(|line| line[place].len()).max().unwrap_or(0);
        let widths: [usize; COLUMNS.len()] = std::array::from_fn(width);
        for line in &lines {
            let cells = line.iter().zip(widths).enumerate().map(|(place, (cell, width))| match place {
                0..NAMES => format!("{cell:width$}"),
                _ => format!("{cell:>width$}"),
            });
            writeln!(f, "{}", cells.collect::<Vec<_>>().join("  ").trim_end())?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::{Precision, SplitMethod};
    use crate::bench::Spread;

    fn row(method: SplitMethod, precision: Precision) -> Row {
        Row {
            scene: "a.pbrt".into(),
            method,
            precision,
            threads: 2,
            rays: 1000,
            build_ms: Spread { min: 415.2, median: 461.1, max: 491.9 },
            trace_ms: Spread { min: 49.96, median: 50.0, max: 53.04 },
            nodes: 19_890,
            primitives: 1_234_567,
            sah_cost: 49.13,
            depth: 26,
            bytes: 34_218_112,
            errors: None,
            fallback_rays: (precision == Precision::Exact).then_some(12_345),
        }
    }

    #[test]
    fn names_stand_left_and_numbers_right() {
        let rows = [row(SplitMethod::Sah, Precision::Exact), row(SplitMethod::Hlbvh, Precision::Fast)];
        let expected = "\
accel  precision       build ms          trace ms  Mrays/s  nodes/ray  prims/ray   SAH  depth  tree bytes  fallbacks
sah    exact      461 (415-492)  50.0 (50.0-53.0)     0.02       19.9      1,235  49.1     26  34,218,112     12,345
hlbvh  fast       461 (415-492)  50.0 (50.0-53.0)     0.02       19.9      1,235  49.1     26  34,218,112          -
";
        assert_eq!(Table(&rows).to_string(), expected);
    }

    #[test]
    fn what_is_no_number_is_a_dash() {
        let empty = Row { sah_cost: f64::NAN, ..row(SplitMethod::None, Precision::Exact) };
        assert!(Table(&[empty]).to_string().contains("  -     26"));
    }
}
