//! Rows for pages of text.

use crate::terminal_text;

use super::{Machine, Row, notes, ray_table, totals, tree_table};

/// The machine, all scenes together, if there are several, and of each scene its notes and its tables.
pub fn to_markdown(machine: &Machine, rows: &[Row]) -> String {
    let mut text = format!("{machine}\n");
    let scenes = rows.chunk_by(|a, b| a.scene == b.scene);
    if scenes.clone().count() > 1 {
        text += &format!(
            "\n## All scenes\n\n{}",
            ray_table(&totals(rows), machine.mhz).markdown()
        );
    }
    for rows in scenes {
        text += &format!("\n## {}\n\n", escaped(&rows[0].scene));
        notes(rows)
            .iter()
            .for_each(|note| text += &format!("- {note}\n"));
        text += &format!(
            "\n{}\n{}",
            tree_table(rows).markdown(),
            ray_table(rows, machine.mhz).markdown()
        );
    }
    text
}

/// Text as it may stand in a line, without being taken for anything but text.
fn escaped(text: &str) -> String {
    // These mean nothing in the middle of a line, and paths are full of them.
    let is_plain = |c: char| !c.is_ascii_punctuation() || "/.-,".contains(c);
    terminal_text::line(text)
        .chars()
        .map(|c| {
            if is_plain(c) {
                c.to_string()
            } else {
                format!("\\{c}")
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::SplitMethod;
    use crate::bench::Kernel;
    use crate::bench::table::tests::row;

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
            text.contains("- errors are those of 10 of 1,000 pixels")
                && text.contains("- errors were not measured")
        );
    }
}
