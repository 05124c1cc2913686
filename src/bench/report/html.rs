//! Elements of HTML.

use super::table::TextTable;
use crate::terminal_text;

/// Escapes text for content and attributes.
pub(super) fn escaped(text: &str) -> String {
    let escape = |c: char| match c {
        '&' => "&amp;".to_owned(),
        '<' => "&lt;".to_owned(),
        '>' => "&gt;".to_owned(),
        '"' => "&quot;".to_owned(),
        '\'' => "&#39;".to_owned(),
        c => c.to_string(),
    };
    terminal_text::line(text).chars().map(escape).collect()
}

/// A table with titles. A line above separates rows that begin with another name.
pub(super) fn table(table: &TextTable) -> String {
    let line = |cells: &Vec<String>, tag: &str, class: &str| {
        let cell = |(column, cell): (usize, &String)| {
            let class = if table.is_name(column) {
                " class=\"name\""
            } else {
                ""
            };
            format!("<{tag}{class}>{}</{tag}>", escaped(cell))
        };
        format!(
            "<tr{class}>{}</tr>\n",
            cells.iter().enumerate().map(cell).collect::<String>()
        )
    };
    let (titles, rows) = table.lines().split_first().expect("a line of titles");
    let groups = rows.chunk_by(|a, b| a.first() == b.first());
    let group = |rows: &[Vec<String>]| -> String {
        let class = |index| if index == 0 { " class=\"first\"" } else { "" };
        let rows = rows.iter().enumerate();
        rows.map(|(index, cells)| line(cells, "td", class(index)))
            .collect()
    };
    format!(
        "<div class=\"wide\"><table>\n{}{}</table></div>\n",
        line(titles, "th", ""),
        groups.map(group).collect::<String>()
    )
}

/// A colour and its meaning.
pub(super) fn swatch([red, green, blue]: [u8; 3], meaning: &str) -> String {
    format!(
        "<span class=\"swatch\" style=\"background: rgb({red} {green} {blue})\"></span>{}",
        escaped(meaning)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::report::table::tests::table as cells;

    #[test]
    fn text_never_becomes_a_tag() {
        let table = table(&cells(["a", "<b>"], &[["\"c\" & 'd'", "1"]]));
        assert!(
            table.contains("<th class=\"name\">a</th><th>&lt;b&gt;</th>"),
            "{table}"
        );
        assert!(
            table.contains("<td class=\"name\">&quot;c&quot; &amp; &#39;d&#39;</td><td>1</td>"),
            "{table}"
        );
    }

    #[test]
    fn a_line_separates_rows_of_different_names() {
        let table = table(&cells(["a", "b"], &[["x", "1"], ["x", "2"], ["y", "3"]]));
        let is_first = table
            .lines()
            .filter(|line| line.starts_with("<tr class=\"first\""));
        assert_eq!(is_first.count(), 2, "{table}");
    }
}
