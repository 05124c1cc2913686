//! Rows for pages of text.

use super::{Machine, Row, notes, ray_table, totals, tree_table};

/// The machine, all scenes together, if there are several, and of each scene its notes and its tables.
pub fn to_markdown(machine: &Machine, rows: &[Row]) -> String {
    let mut text = format!("{machine}\n");
    let scenes = rows.chunk_by(|a, b| a.scene == b.scene);
    if scenes.clone().count() > 1 {
        text += &format!("\n## All scenes\n\n{}", ray_table(&totals(rows), machine.mhz).markdown());
    }
    for rows in scenes {
        text += &format!("\n## {}\n\n", rows[0].scene.replace('\n', " "));
        notes(rows).iter().for_each(|note| text += &format!("- {note}\n"));
        text += &format!("\n{}\n{}", tree_table(rows).markdown(), ray_table(rows, machine.mhz).markdown());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::SplitMethod;
    use crate::bench::Kernel;
    use crate::bench::table::tests::row;

    #[test]
    fn every_scene_has_its_heading_and_its_tables() {
        let [exact, fast, ..] = Kernel::ALL;
        let other = Row { scene: "b.pbrt".into(), ..row(SplitMethod::Sah, exact, 0) };
        let rows = [row(SplitMethod::Sah, exact, 10), row(SplitMethod::Sah, fast, 10), other];
        let text = to_markdown(&Machine::detect("scalar"), &rows);
        let headings: Vec<&str> = text.lines().filter(|line| line.starts_with("## ")).collect();
        assert_eq!(headings, ["## All scenes", "## a.pbrt", "## b.pbrt"]);
        assert_eq!(text.lines().filter(|line| line.starts_with("| ---")).count(), 5);
        assert!(
            text.contains("- errors are those of 10 of 1,000 pixels") && text.contains("- errors were not measured")
        );
    }
}
