//! The table of contents of a page: scenes, and the wrong pixels of each kernel.

use super::html::escaped;
use super::section::Section;
use super::summary::{compared_rows, wrong_with_share};
use super::value::rate;
use crate::bench::kernel::Kernel;
use crate::bench::run::Row;

/// The anchor of the table.
pub(super) const ID: &str = "contents";

/// The anchor of the section with this index.
pub(super) fn section_id(index: usize) -> String {
    format!("scene-{}", index + 1)
}

/// A line for each scene, with a link to its section.
pub(super) fn contents(sections: &[Section]) -> String {
    let rows = || sections.iter().flat_map(|section| &section.rows);
    let is_measured = |kernel: &Kernel| rows().any(|row| row.kernel == *kernel);
    let kernels: Vec<Kernel> = Kernel::ALL.into_iter().filter(is_measured).collect();
    let titles = kernels.iter().map(|kernel| format!("<th>{kernel}</th>"));
    let mut text = format!(
        "<h2 id=\"{ID}\">Contents</h2>\n<p class=\"quiet\">Wrong pixels of each kernel, and the \
         speed of the first one.</p>\n<div class=\"wide\"><table>\n<tr><th class=\"name\">scene\
         </th>{}<th>Mrays/s</th></tr>\n",
        titles.collect::<String>()
    );
    for (index, section) in sections.iter().enumerate() {
        let compared = compared_rows(&section.rows);
        let cells = kernels.iter().map(|kernel| wrong_cell(&compared, *kernel));
        let name = section.rows.first().map_or("", |row| &row.scene);
        let speed = compared
            .first()
            .map_or("-".to_owned(), |row| rate(row.mrays_per_s()));
        text += &format!(
            "<tr><td class=\"name\"><a href=\"#{}\">{}</a></td>{}<td>{speed}</td></tr>\n",
            section_id(index),
            escaped(name),
            cells.collect::<String>()
        );
    }
    text + "</table></div>\n"
}

fn wrong_cell(rows: &[&Row], kernel: Kernel) -> String {
    let row = rows.iter().find(|row| row.kernel == kernel);
    let Some(errors) = row.and_then(|row| row.errors()) else {
        return "<td>-</td>".to_owned();
    };
    let class = match errors.tally.wrong_decisions() {
        0 => "",
        _ => " class=\"wrong\"",
    };
    format!("<td{class}>{}</td>", wrong_with_share(errors).concat())
}
