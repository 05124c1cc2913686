//! Rows as Markdown.

use super::columns::{accelerator_table, ray_table};
use super::notes::notes;
use super::summary::Summary;
use crate::bench::run::{Machine, Row, totals};
use crate::terminal_text;

/// The machine, the totals if there are several scenes, and the notes and tables of each scene.
pub fn to_markdown(machine: &Machine, rows: &[Row]) -> String {
    let mut text = format!("{machine}\n");
    let scenes = rows.chunk_by(|a, b| a.scene == b.scene);
    if scenes.clone().count() > 1 {
        let totals = totals(rows);
        text += "\n## All scenes\n\n";
        summaries(&totals).for_each(|line| text += &format!("- {line}\n"));
        text += &format!("\n{}", ray_table(&totals, machine.mhz).markdown());
    }
    for rows in scenes {
        text += &format!("\n## {}\n\n", escaped(&rows[0].scene));
        summaries(rows)
            .chain(notes(rows))
            .for_each(|note| text += &format!("- {note}\n"));
        let (accelerators, rays) = (accelerator_table(rows), ray_table(rows, machine.mhz));
        text += &format!("\n{}\n{}", accelerators.markdown(), rays.markdown());
    }
    text
}

/// The results in sentences.
fn summaries(rows: &[Row]) -> impl Iterator<Item = String> {
    let bold = |name: &str| format!("**{name}**");
    let summaries = [Summary::of_wrong_pixels(rows), Summary::of_depths(rows)];
    summaries
        .into_iter()
        .flatten()
        .map(move |summary| summary.text(bold))
}

/// Escapes everything in a line that Markdown could take for markup.
fn escaped(text: &str) -> String {
    // Harmless in the middle of a line, and frequent in paths.
    let is_plain = |c: char| !c.is_ascii_punctuation() || "/.-,".contains(c);
    let escape = |c: char| {
        if is_plain(c) {
            c.to_string()
        } else {
            format!("\\{c}")
        }
    };
    terminal_text::line(text).chars().map(escape).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::SplitMethod;
    use crate::bench::kernel::Kernel;
    use crate::bench::run::tests::row;

    #[test]
    fn a_scene_may_have_any_name() {
        let name = "<img src=x onerror=alert(1)>|`*a*`\n# [b](c).pbrt";
        let row = Row {
            scene: name.into(),
            ..row(SplitMethod::Sah, Kernel::ALL[0], 0)
        };
        let text = to_markdown(&Machine::detect("scalar"), &[row]);
        let heading = text.lines().find(|line| line.starts_with("## ")).unwrap();
        let expected = [
            "## \\<img src\\=x onerror\\=alert\\(1\\)\\>\\|\\`\\*a\\*\\`",
            "\\# \\[b\\]\\(c\\).pbrt",
        ];
        assert_eq!(heading, expected.join("\u{fffd}"));
    }

    #[test]
    fn every_scene_has_its_heading_and_its_tables() {
        let [exact, fast, ..] = Kernel::ALL;
        let other = Row {
            scene: "b.pbrt".into(),
            ..row(SplitMethod::Sah, exact, 0)
        };
        let rows = [
            row(SplitMethod::Sah, exact, 10),
            row(SplitMethod::Sah, fast, 10),
            other,
        ];
        let text = to_markdown(&Machine::detect("scalar"), &rows);
        let headings: Vec<&str> = text
            .lines()
            .filter(|line| line.starts_with("## "))
            .collect();
        assert_eq!(headings, ["## All scenes", "## a.pbrt", "## b.pbrt"]);
        assert_eq!(
            text.lines()
                .filter(|line| line.starts_with("| ---"))
                .count(),
            5
        );
        assert!(
            text.contains("- **exact**: 3 wrong (30 %, below ")
                && text.contains("- errors are those of 10 of 1,000 pixels")
                && text.contains("- errors were not measured")
        );
    }
}
