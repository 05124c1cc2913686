//! Elements of HTML.

use super::table::TextTable;
use crate::terminal_text;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;

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

/// A table with titles.
pub(super) fn table(table: &TextTable) -> String {
    let line = |cells: &Vec<String>, tag: &str| {
        let cell = |(column, cell): (usize, &String)| {
            let class = if table.is_name(column) {
                " class=\"name\""
            } else {
                ""
            };
            format!("<{tag}{class}>{}</{tag}>", escaped(cell))
        };
        format!(
            "<tr>{}</tr>\n",
            cells.iter().enumerate().map(cell).collect::<String>()
        )
    };
    let (titles, rows) = table.lines().split_first().expect("a line of titles");
    let rows: String = rows.iter().map(|cells| line(cells, "td")).collect();
    format!(
        "<div class=\"wide\"><table>\n{}{rows}</table></div>\n",
        line(titles, "th")
    )
}

/// A figure with an embedded PNG file.
pub(super) fn figure(caption: &str, png: &[u8]) -> String {
    let (caption, data) = (escaped(caption), BASE64_STANDARD.encode(png));
    format!(
        "<figure><img alt=\"{caption}\" src=\"data:image/png;base64,{data}\">\
         <figcaption>{caption}</figcaption></figure>\n"
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
        assert!(
            figure("\"<", &[0, 1])
                .contains("alt=\"&quot;&lt;\" src=\"data:image/png;base64,AAE=\"")
        );
    }
}
