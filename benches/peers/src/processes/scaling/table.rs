//! The table of `scaling` in Markdown.

use super::amdahl::{predicted, serial_part};
use crate::table::milliseconds;
use std::fmt::Write;

/// The threads that the last column predicts.
const PREDICTED: usize = 16;

/// Something that takes time, and the milliseconds that each number of threads takes for it.
#[derive(Debug)]
pub(super) struct Row {
    pub(super) name: String,
    pub(super) times: Vec<f64>,
}

/// Times, each with its ratio to that of one thread, the serial part that follows from the times of
/// one thread and two, and the time that it predicts.
pub(super) fn markdown(threads: &[usize], rows: &[Row]) -> String {
    let mut table = "| |".to_owned();
    for &count in threads {
        let ratio = if count == 1 { "" } else { " (to 1)" };
        let _ = write!(table, " {count}{ratio} |");
    }
    let _ = writeln!(table, " serial part | {PREDICTED} predicted |");
    let _ = writeln!(table, "|{}", "---|".repeat(3 + threads.len()));
    for row in rows {
        let _ = writeln!(table, "{}", line(threads, row));
    }
    table
}

fn line(threads: &[usize], row: &Row) -> String {
    let of = |wanted: usize| {
        let place = threads.iter().position(|&count| count == wanted)?;
        Some(row.times[place]).filter(|time| *time > 0.0)
    };
    let one = of(1);
    let mut line = format!("| {} |", row.name);
    for (&count, &time) in threads.iter().zip(&row.times) {
        let _ = match one {
            Some(one) if count != 1 => {
                write!(line, " {} ({:.2}) |", milliseconds(time), time / one)
            }
            _ => write!(line, " {} |", milliseconds(time)),
        };
    }
    let _ = match (one, of(2)) {
        (Some(one), Some(two)) => {
            let serial = serial_part(one, two);
            let time = predicted(one, serial, PREDICTED as f64);
            write!(line, " {serial:.2} | {} |", milliseconds(time))
        }
        _ => write!(line, " - | - |"),
    };
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(times: &[f64]) -> Row {
        Row {
            name: "sah, trace".to_owned(),
            times: times.to_vec(),
        }
    }

    #[test]
    fn a_line_has_ratios_and_a_prediction() {
        let expected = "\
| | 1 | 2 (to 1) | 4 (to 1) | serial part | 16 predicted |
|---|---|---|---|---|---|
| sah, trace | 10.0 | 7.00 (0.70) | 5.50 (0.55) | 0.40 | 4.38 |
";
        assert_eq!(markdown(&[1, 2, 4], &[row(&[10.0, 7.0, 5.5])]), expected);
    }

    #[test]
    fn nothing_is_predicted_without_one_thread_and_two() {
        assert_eq!(line(&[4], &row(&[5.5])), "| sah, trace | 5.50 | - | - |");
        let without_two = line(&[1, 4], &row(&[10.0, 5.5]));
        assert_eq!(without_two, "| sah, trace | 10.0 | 5.50 (0.55) | - | - |");
        assert!(line(&[1, 2], &row(&[0.0, 0.0])).ends_with("| - | - |"));
    }
}
