//! The table of `picture` in Markdown.

use super::program::{Program, Run};
use crate::programs::Agreement;
use crate::rounds::{Series, median};
use crate::table::{grouped, milliseconds};
use std::fmt::Write;

/// A program's runs.
#[derive(Debug)]
pub(super) struct Row {
    pub(super) program: Program,
    /// Whole processes, in milliseconds.
    pub(super) total: Series,
    pub(super) runs: Vec<Run>,
    pub(super) agreement: Option<Agreement>,
}

/// One line a program; ratios are medians round by round.
pub(super) fn table(rows: &[Row]) -> String {
    let baselines = baselines(rows);
    let mut table = "| program | total ms, median (min-max) |".to_owned();
    for baseline in &baselines {
        let _ = write!(table, " to {} |", baseline.program.name());
    }
    table.push_str(" CPU ms | peak MB | load | build | trace | write |");
    table.push_str(" hit or miss differs | depth differs |\n");
    let columns = 10 + baselines.len();
    let _ = writeln!(table, "|{}", "---|".repeat(columns));
    for row in rows {
        let total = &row.total;
        let [low, middle, high] = [total.min(), total.median(), total.max()].map(milliseconds);
        let name = row.program.name();
        let _ = write!(table, "| {name} | {middle} ({low}-{high}) |");
        for baseline in &baselines {
            let ratio = total.pairwise_ratio(&baseline.total);
            let _ = write!(table, " {ratio:.2} |");
        }
        let median_of = |of: &dyn Fn(&Run) -> f64| median(row.runs.iter().map(of).collect());
        let cpu = milliseconds(median_of(&|run| run.cpu_ms));
        let peak = median_of(&|run| run.peak_bytes) / 1e6;
        let _ = write!(table, " {cpu} | {peak:.0} |");
        for phase in 0..4 {
            match median_of(&|run| run.phases[phase]) {
                0.0 => table.push_str(" - |"),
                time => drop(write!(table, " {} |", milliseconds(time))),
            }
        }
        let differences = match row.agreement {
            Some(found) => format!("{} | {}", grouped(found.hit_or_miss), grouped(found.depths)),
            None => "- | -".to_owned(),
        };
        let _ = writeln!(table, " {differences} |");
    }
    table
}

/// The peers, and the first feimos if there are several.
fn baselines(rows: &[Row]) -> Vec<&Row> {
    let is_peer = |row: &&Row| !matches!(row.program, Program::Feimos { .. });
    let mut baselines: Vec<&Row> = rows.iter().filter(is_peer).collect();
    if rows.len() - baselines.len() > 1 {
        baselines.extend(rows.iter().find(|row| !is_peer(row)));
    }
    baselines
}
