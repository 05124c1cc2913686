//! Totals of several scenes.

use super::row::Row;
use super::spread::Spread;
use crate::bench::error::Errors;
use crate::compare::Tally;

/// A row for each accelerator and kernel over all scenes, with times added up, in the order in
/// which they first occur. Leaves out those that a scene lacks or traces only some tiles of: they
/// would not be comparable.
pub fn totals(rows: &[Row]) -> Vec<Row> {
    let of_first_scene = rows.iter().take_while(|row| row.scene == rows[0].scene);
    let scenes = rows.chunk_by(|a, b| a.scene == b.scene).count();
    let total = |first: &Row| {
        let alike = |row: &&Row| row.accelerator == first.accelerator && row.kernel == first.kernel;
        let all: Vec<&Row> = rows.iter().filter(alike).collect();
        (all.len() == scenes && !all.iter().any(|row| row.is_sampled())).then(|| sum(&all, scenes))
    };
    of_first_scene.filter_map(total).collect()
}

fn sum(rows: &[&Row], scenes: usize) -> Row {
    let first = rows[0];
    let rays = rows.iter().map(|row| row.rays).sum();
    let per_ray = |of: fn(&Row) -> Option<f64>| {
        let counts = rows.iter().map(|row| Some(of(row)? * row.rays as f64));
        counts.sum::<Option<f64>>().map(|count| count / rays as f64)
    };
    let spread = |of: fn(&Row) -> Spread| Spread {
        min: rows.iter().map(|row| of(row).min).sum(),
        median: rows.iter().map(|row| of(row).median).sum(),
        max: rows.iter().map(|row| of(row).max).sum(),
    };
    let parts = rows.iter().map(|row| row.trace_parts);
    Row {
        scene: format!("all {scenes} scenes"),
        rays,
        pixels: rows.iter().map(|row| row.pixels).sum(),
        load_ms: spread(|row| row.load_ms),
        build_ms: spread(|row| row.build_ms),
        trace_ms: spread(|row| row.trace_ms),
        trace_parts: parts.reduce(|sum, parts| Some(sum?.plus(parts?))).flatten(),
        nodes_per_ray: per_ray(|row| row.nodes_per_ray),
        primitives_per_ray: per_ray(|row| row.primitives_per_ray),
        // Costs of different trees cannot be added.
        sah_cost: None,
        overlap: None,
        depth: rows.iter().filter_map(|row| row.depth).max(),
        bytes: rows.iter().map(|row| row.bytes).sum(),
        input: None,
        errors: rows
            .iter()
            .map(|row| row.errors())
            .collect::<Option<_>>()
            .map(merged),
        fallback_rays: rows.iter().map(|row| row.fallback_rays).sum(),
        ..first.clone()
    }
}

fn merged(all: Vec<&Errors>) -> Errors {
    let mut tally = Tally::default();
    all.iter().for_each(|errors| tally.merge(&errors.tally));
    Errors {
        tally,
        of: all.iter().map(|errors| errors.of).sum(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::{Accelerator, SplitMethod};
    use crate::bench::kernel::Kernel;
    use crate::bench::run::tests::{row, row_of};

    #[test]
    fn counts_add_up_and_incomplete_rows_are_left_out() {
        let [exact, fast, ..] = Kernel::ALL;
        let of = |scene: &str, row: Row| Row {
            scene: scene.into(),
            ..row
        };
        let rows = [
            of("a", row(SplitMethod::None, exact, 1000)),
            of("a", row(SplitMethod::Sah, exact, 1000)),
            of("a", row(SplitMethod::Sah, fast, 1000)),
            of(
                "b",
                Row {
                    rays: 10,
                    ..row(SplitMethod::None, exact, 1000)
                },
            ),
            of(
                "b",
                Row {
                    trace_ms: Spread {
                        min: 1.0,
                        median: 2.0,
                        max: 3.0,
                    },
                    ..row(SplitMethod::Sah, exact, 500)
                },
            ),
        ];
        let totals = totals(&rows);
        let [total] = &totals[..] else {
            panic!("{totals:?}")
        };
        assert_eq!(
            (total.accelerator, total.kernel, total.rays),
            (Accelerator::Tree(SplitMethod::Sah), exact, 2000)
        );
        assert_eq!(total.trace_ms.median, 52.0);
        let errors = total.errors.as_ref().unwrap();
        assert_eq!(
            (
                errors.tally.pixels,
                errors.of,
                errors.tally.wrong_primitives
            ),
            (1500, 2000, 4)
        );
        assert_eq!(
            (errors.tally.depths.total(), errors.tally.depths.above(0)),
            (8, 2)
        );
    }

    #[test]
    fn totals_of_bins_have_no_figures_of_trees() {
        let bins = |scene: &str| Row {
            scene: scene.into(),
            ..row_of(Accelerator::Raster, Kernel::ALL[0], 1000)
        };
        let totals = totals(&[bins("a"), bins("b")]);
        assert_eq!((totals[0].depth, totals[0].nodes_per_ray), (None, None));
        assert_eq!(totals[0].bytes, 2 * bins("a").bytes);
    }
}
