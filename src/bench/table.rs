//! Rows for people: a table of trees and a table of rays.

use super::text_table::{Column, name, number};
use super::{Errors, Row, TextTable};
use indicatif::HumanCount;

/// What stands in the table of trees: one line for each accelerator.
const TREES: [Column<Row>; 7] = [
    name("accel", |row| row.method.to_string()),
    number("load ms", |row| row.load_ms.to_string()),
    number("build ms", |row| row.build_ms.to_string()),
    number("SAH", |row| mean(row.sah_cost)),
    number("EPO", |row| row.overlap.map_or("-".to_owned(), mean)),
    number("depth", |row| row.depth.to_string()),
    number("tree bytes", |row| HumanCount(row.bytes as u64).to_string()),
];

/// What stands in the table of rays: one line for each accelerator and kernel.
const RAYS: [Column<RatedRow>; 14] = [
    name("accel", |RatedRow(row, _)| row.method.to_string()),
    name("precision", |RatedRow(row, _)| row.kernel.to_string()),
    number("trace ms", |RatedRow(row, _)| row.trace_ms.to_string()),
    number("Mrays/s", |RatedRow(row, _)| rate(row.mrays_per_s())),
    number("cycles/ray", |RatedRow(row, mhz)| {
        mhz.map_or("-".to_owned(), |mhz| mean(row.cycles_per_ray(mhz)))
    }),
    number("nodes/ray", |RatedRow(row, _)| mean(row.nodes_per_ray)),
    number("prims/ray", |RatedRow(row, _)| mean(row.primitives_per_ray)),
    number("false", |RatedRow(row, _)| {
        count(row, |errors| errors.tally.false_hits)
    }),
    number("missed", |RatedRow(row, _)| {
        count(row, |errors| errors.tally.missed_hits)
    }),
    number("wrong prim", |RatedRow(row, _)| {
        count(row, |errors| errors.tally.wrong_primitives)
    }),
    number("max ulp", |RatedRow(row, _)| {
        ulp(row, |errors| {
            Some(HumanCount(errors.tally.depths.max()?.into()).to_string())
        })
    }),
    number("99 %", |RatedRow(row, _)| {
        ulp(row, |errors| {
            Some(HumanCount(errors.tally.depths.percentile(99.0)?.into()).to_string())
        })
    }),
    number("mean", |RatedRow(row, _)| {
        ulp(row, |errors| Some(small(errors.tally.depths.mean()?)))
    }),
    number("integers", |RatedRow(row, _)| {
        row.fallback_rays
            .map_or("-".to_owned(), |rays| HumanCount(rays).to_string())
    }),
];

/// A row, and the machine's clock in MHz, if it tells.
struct RatedRow(Row, Option<f64>);

/// The trees of a scene: rows of one method share theirs.
pub fn tree_table(rows: &[Row]) -> TextTable {
    let of_trees = rows.chunk_by(|a, b| a.scene == b.scene && a.method == b.method);
    TextTable::new(&TREES, of_trees.map(|rows| rows[0].clone()))
}

/// The rays of a scene, on a machine with a clock of `mhz`, if that is known.
pub fn ray_table(rows: &[Row], mhz: Option<f64>) -> TextTable {
    TextTable::new(&RAYS, rows.iter().map(|row| RatedRow(row.clone(), mhz)))
}

fn mean(value: f64) -> String {
    match value {
        value if !value.is_finite() => "-".to_owned(),
        value if value < 1000.0 => format!("{value:.1}"),
        value => HumanCount(value.round() as u64).to_string(),
    }
}

/// Three digits of what may be small.
fn rate(value: f64) -> String {
    match value {
        value if value < 0.01 => format!("{value:.1e}"),
        value => format!("{value:.2}"),
    }
}

fn small(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        value if value < 0.001 => format!("{value:.0e}"),
        value if value < 1000.0 => format!("{value:.3}"),
        value => HumanCount(value.round() as u64).to_string(),
    }
}

/// A number of pixels; of a sample, the most that it may stand for in all of the picture, too.
fn count(row: &Row, of: fn(&Errors) -> u64) -> String {
    let Some(errors) = &row.errors else {
        return "-".to_owned();
    };
    let count = of(errors);
    match errors.confidence(count) {
        None => HumanCount(count).to_string(),
        Some([_, high]) => format!("{} (<{:.2}%)", HumanCount(count), 100.0 * high),
    }
}

fn ulp(row: &Row, of: fn(&Errors) -> Option<String>) -> String {
    row.errors
        .as_ref()
        .and_then(of)
        .unwrap_or_else(|| "-".to_owned())
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::accel::SplitMethod;
    use crate::bench::{Kernel, Spread};
    use crate::compare::{Tally, Ulps};

    /// A row of a picture of 1000 pixels, of which `judged` were looked at: a false hit and an error of 3 among them.
    pub(in crate::bench) fn row(method: SplitMethod, kernel: Kernel, judged: u64) -> Row {
        let mut depths = Ulps::default();
        [0, 0, 0, 3].iter().for_each(|error| depths.add(*error));
        let tally = Tally {
            pixels: judged,
            false_hits: 1,
            missed_hits: 0,
            wrong_primitives: 2,
            depths,
            ..Tally::default()
        };
        Row {
            scene: "a.pbrt".into(),
            method,
            kernel,
            threads: 2,
            rays: 1000,
            pixels: 1000,
            load_ms: Spread {
                min: 1.0,
                median: 2.0,
                max: 3.0,
            },
            build_ms: Spread {
                min: 415.2,
                median: 461.1,
                max: 491.9,
            },
            trace_ms: Spread {
                min: 49.96,
                median: 50.0,
                max: 53.04,
            },
            nodes_per_ray: 19.89,
            primitives_per_ray: 1234.567,
            sah_cost: 49.13,
            overlap: Some(3.25),
            depth: 26,
            bytes: 34_218_112,
            input: None,
            errors: (judged > 0).then_some(Errors { tally, of: 1000 }),
            fallback_rays: kernel.is_exact().then_some(12_345),
        }
    }

    #[test]
    fn trees_are_told_once_and_rays_by_kernel() {
        let [exact, fast, ..] = Kernel::ALL;
        let rows = [
            row(SplitMethod::Sah, exact, 1000),
            row(SplitMethod::Sah, fast, 100),
            row(SplitMethod::Hlbvh, fast, 0),
        ];
        let trees = "\
accel           load ms       build ms   SAH  EPO  depth  tree bytes
sah    2.00 (1.00-3.00)  461 (415-492)  49.1  3.2     26  34,218,112
hlbvh  2.00 (1.00-3.00)  461 (415-492)  49.1  3.2     26  34,218,112
";
        assert_eq!(tree_table(&rows).aligned(), trees);
        let rays = "\
accel  precision          trace ms  Mrays/s  cycles/ray  nodes/ray  prims/ray      false     missed wrong prim  max ulp  99 %   mean  integers
sah    exact      50.0 (50.0-53.0)     0.02     250,000       19.9      1,235          1          0          2        3     3  0.750    12,345
sah    fast       50.0 (50.0-53.0)     0.02     250,000       19.9      1,235  1 (<5.45%)  0 (<3.70%)  2 (<7.00%)        3     3  0.750         -
hlbvh  fast       50.0 (50.0-53.0)     0.02     250,000       19.9      1,235          -          -          -        -     -      -         -
";
        let words = |text: &str| {
            text.split_whitespace()
                .map(str::to_owned)
                .collect::<Vec<_>>()
        };
        assert_eq!(
            words(&ray_table(&rows, Some(2500.0)).aligned()),
            words(rays)
        );
    }

    #[test]
    fn what_is_no_number_is_a_dash() {
        let [exact, ..] = Kernel::ALL;
        let empty = Row {
            sah_cost: f64::NAN,
            overlap: None,
            ..row(SplitMethod::None, exact, 0)
        };
        assert!(tree_table(&[empty]).aligned().contains("  -    -     26"));
    }
}
