//! The columns of results, listed once for text, Markdown, HTML, CSV and JSON.

use super::table::TextTable;
use super::value::{Value, mean, rate, small};
use crate::bench::error::Errors;
use crate::bench::run::{Row, Spread, TraceParts};

/// A column of results.
pub(super) struct Column {
    /// Key in JSON and CSV.
    pub(super) key: &'static str,
    /// Table and title for people, if it is shown to them.
    table: Option<(Table, &'static str)>,
    value: fn(&Row, Option<f64>) -> Value,
}

/// The tables for people.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Table {
    /// One line for each accelerator.
    Accelerators,
    /// One line for each accelerator and kernel.
    Rays,
    /// The same, but only if some rows are those of sampled rays.
    SampledRays,
    Both,
}

const fn hidden(key: &'static str, value: fn(&Row, Option<f64>) -> Value) -> Column {
    Column {
        key,
        table: None,
        value,
    }
}

const fn shown(
    key: &'static str,
    table: Table,
    title: &'static str,
    value: fn(&Row, Option<f64>) -> Value,
) -> Column {
    Column {
        key,
        table: Some((table, title)),
        value,
    }
}

/// All columns in order. Values take a row and the machine's clock in MHz, if it is known.
pub(super) const COLUMNS: [Column; 34] = {
    use Table::{Accelerators, Both, Rays, SampledRays};
    use Value::{Confidence, Count, Input, Name, Real};
    [
        hidden("scene", |row, _| Name(row.scene.clone())),
        shown("accel", Both, "accel", |row, _| {
            Name(row.accelerator.to_string())
        }),
        shown("precision", Rays, "precision", |row, _| {
            Name(row.kernel.to_string())
        }),
        hidden("threads", |row, _| Count(Some(row.threads as u64))),
        hidden("simd", |row, _| Name(row.simd.name().to_owned())),
        shown("rays", SampledRays, "rays", |row, _| Count(Some(row.rays))),
        hidden("pixels", |row, _| Count(Some(row.pixels))),
        shown("load_ms", Accelerators, "load ms", |row, _| {
            Value::Spread(Some(row.load_ms))
        }),
        shown("build_ms", Accelerators, "build ms", |row, _| {
            Value::Spread(Some(row.build_ms))
        }),
        shown("trace_ms", Rays, "trace ms", |row, _| {
            Value::Spread(Some(row.trace_ms))
        }),
        hidden("trace_prepare_ms", |row, _| {
            part(row, |parts| parts.prepare)
        }),
        hidden("trace_divide_ms", |row, _| part(row, |parts| parts.divide)),
        hidden("trace_tiles_ms", |row, _| part(row, |parts| parts.tiles)),
        hidden("trace_join_ms", |row, _| part(row, |parts| parts.join)),
        hidden("trace_idle_ms", |row, _| part(row, |parts| parts.idle)),
        shown("mrays_per_s", Rays, "Mrays/s", |row, _| {
            Real(Some(row.mrays_per_s()), rate)
        }),
        shown("cycles_per_ray", Rays, "cycles/ray", |row, mhz| {
            Real(mhz.map(|mhz| row.cycles_per_ray(mhz)), mean)
        }),
        shown("nodes_per_ray", Rays, "nodes/ray", |row, _| {
            Real(row.nodes_per_ray, mean)
        }),
        shown("primitives_per_ray", Rays, "prims/ray", |row, _| {
            Real(row.primitives_per_ray, mean)
        }),
        shown("sah_cost", Accelerators, "SAH", |row, _| {
            Real(row.sah_cost.filter(|cost| cost.is_finite()), mean)
        }),
        shown("epo", Accelerators, "EPO", |row, _| Real(row.overlap, mean)),
        shown("depth", Accelerators, "depth", |row, _| {
            Count(row.depth.map(|depth| depth as u64))
        }),
        shown("bytes", Accelerators, "bytes", |row, _| {
            Count(Some(row.bytes as u64))
        }),
        hidden("input", |row, _| Input(row.input)),
        hidden("sampled_pixels", |row, _| {
            Count(row.errors().map(|errors| errors.tally.pixels))
        }),
        hidden("wrong_hits", |row, _| {
            pixels(row, |errors| errors.tally.wrong_hits())
        }),
        shown("false_hits", Rays, "false", |row, _| {
            pixels(row, |errors| errors.tally.false_hits)
        }),
        shown("missed_hits", Rays, "missed", |row, _| {
            pixels(row, |errors| errors.tally.missed_hits)
        }),
        shown("wrong_primitives", Rays, "wrong prim", |row, _| {
            pixels(row, |errors| errors.tally.wrong_primitives)
        }),
        hidden("confidence_95", |row, _| {
            Confidence(row.errors().and_then(confidence))
        }),
        shown("max_ulp", Rays, "max ulp", |row, _| {
            Count(
                row.errors()
                    .and_then(|errors| errors.tally.depths.max())
                    .map(u64::from),
            )
        }),
        shown("p99_ulp", Rays, "99 %", |row, _| {
            let percentile = |errors: &Errors| errors.tally.depths.percentile(99.0);
            Count(row.errors().and_then(percentile).map(u64::from))
        }),
        shown("mean_ulp", Rays, "mean", |row, _| {
            Real(
                row.errors().and_then(|errors| errors.tally.depths.mean()),
                small,
            )
        }),
        shown("fallback_rays", Rays, "integers", |row, _| {
            Count(row.fallback_rays)
        }),
    ]
};

fn part(row: &Row, part: fn(&TraceParts) -> Spread) -> Value {
    Value::Spread(row.trace_parts.as_ref().map(part))
}

fn pixels(row: &Row, count: fn(&Errors) -> u64) -> Value {
    Value::Pixels(row.errors().map(|errors| {
        let count = count(errors);
        (count, errors.confidence(count))
    }))
}

fn confidence(errors: &Errors) -> Option<[[f64; 2]; 2]> {
    let wrong_hits = errors.confidence(errors.tally.wrong_hits())?;
    Some([
        wrong_hits,
        errors.confidence(errors.tally.wrong_primitives)?,
    ])
}

impl Column {
    /// The cell of a row, on a machine with a clock of `mhz`, if that is known.
    pub(super) fn value(&self, row: &Row, mhz: Option<f64>) -> Value {
        (self.value)(row, mhz)
    }
}

/// The accelerators of a scene: one line for the rows of each.
pub fn accelerator_table(rows: &[Row]) -> TextTable {
    let of_each = rows.chunk_by(|a, b| a.scene == b.scene && a.accelerator == b.accelerator);
    let accelerators: Vec<&Row> = of_each.map(|rows| &rows[0]).collect();
    table(&[Table::Accelerators, Table::Both], &accelerators, None)
}

/// The rays of a scene, on a machine with a clock of `mhz`, if that is known. Tells the number of
/// rays if some rows are those of a sample.
pub fn ray_table(rows: &[Row], mhz: Option<f64>) -> TextTable {
    let tables: &[Table] = match rows.iter().any(Row::is_sampled) {
        true => &[Table::Rays, Table::Both, Table::SampledRays],
        false => &[Table::Rays, Table::Both],
    };
    table(tables, &rows.iter().collect::<Vec<_>>(), mhz)
}

/// The columns of `tables`.
fn table(tables: &[Table], rows: &[&Row], mhz: Option<f64>) -> TextTable {
    let title = |column: &'static Column| {
        let (of, title) = column.table?;
        tables.contains(&of).then_some((column, title))
    };
    let columns: Vec<(&Column, &str)> = COLUMNS.iter().filter_map(title).collect();
    let cells = |row: &&Row| {
        columns
            .iter()
            .map(|(column, _)| column.value(row, mhz).text())
            .collect()
    };
    let titles = columns.iter().map(|(column, title)| {
        let is_name = matches!(column.key, "accel" | "precision");
        (title.to_string(), is_name)
    });
    TextTable::new(titles, rows.iter().map(cells))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::{Accelerator, SplitMethod};
    use crate::bench::kernel::Kernel;
    use crate::bench::run::tests::{row, row_of};

    #[test]
    fn accelerators_have_one_line_and_rays_one_for_each_kernel() {
        let [exact, fast, ..] = Kernel::ALL;
        let rows = [
            row_of(Accelerator::Raster, exact, 1000),
            row(SplitMethod::Sah, exact, 1000),
            row(SplitMethod::Sah, fast, 100),
            row(SplitMethod::Hlbvh, fast, 0),
        ];
        let accelerators = "\
accel            load ms       build ms   SAH  EPO  depth       bytes
raster  2.00 (1.00-3.00)  461 (415-492)     -    -      -  34,218,112
sah     2.00 (1.00-3.00)  461 (415-492)  49.1  3.2     26  34,218,112
hlbvh   2.00 (1.00-3.00)  461 (415-492)  49.1  3.2     26  34,218,112
";
        assert_eq!(accelerator_table(&rows).aligned(), accelerators);
        let titles = "accel precision trace ms Mrays/s cycles/ray nodes/ray prims/ray false missed \
                      wrong prim max ulp 99 % mean integers";
        let rays = [
            titles,
            "raster exact 50.0 (50.0-53.0) 0.02 250,000 - - 1 0 2 3 3 0.750 12,345",
            "sah exact 50.0 (50.0-53.0) 0.02 250,000 19.9 1,235 1 0 2 3 3 0.750 12,345",
            "sah fast 50.0 (50.0-53.0) 0.02 250,000 19.9 1,235 1 (<5.5 %) 0 (<3.7 %) 2 (<7.1 %) 3 \
             3 0.750 -",
            "hlbvh fast 50.0 (50.0-53.0) 0.02 250,000 19.9 1,235 - - - - - - -",
        ];
        let table = ray_table(&rows, Some(2500.0)).aligned();
        let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(table.lines().map(words).collect::<Vec<_>>(), rays);
    }

    #[test]
    fn sampled_rays_are_counted_beside_all_others() {
        let [exact, ..] = Kernel::ALL;
        let sampled = Row {
            rays: 16,
            ..row(SplitMethod::None, exact, 0)
        };
        let all = row(SplitMethod::Sah, exact, 0);
        let column = |rows: &[Row]| -> Option<Vec<String>> {
            let table = ray_table(rows, None);
            let place = table.lines()[0].iter().position(|title| title == "rays")?;
            Some(
                table
                    .lines()
                    .iter()
                    .map(|line| line[place].clone())
                    .collect(),
            )
        };
        assert_eq!(column(std::slice::from_ref(&all)), None);
        let expected = ["rays", "16", "1,000"].map(str::to_owned);
        assert_eq!(column(&[sampled, all]), Some(expected.to_vec()));
    }

    #[test]
    fn unknown_values_are_dashes() {
        let [exact, ..] = Kernel::ALL;
        let empty = Row {
            sah_cost: Some(f64::NAN),
            overlap: None,
            ..row(SplitMethod::None, exact, 0)
        };
        assert!(
            accelerator_table(&[empty])
                .aligned()
                .contains("  -    -     26")
        );
    }
}
