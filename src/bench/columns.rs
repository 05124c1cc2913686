//! Tables of text, aligned for a terminal or in Markdown.

/// What stands in a column, and over it.
pub(super) struct Column<T> {
    pub(super) title: &'static str,
    /// Names stand at the left, numbers at the right.
    pub(super) is_name: bool,
    pub(super) cell: fn(&T) -> String,
}

/// A column of names.
pub(super) const fn name<T>(title: &'static str, cell: fn(&T) -> String) -> Column<T> {
    Column { title, is_name: true, cell }
}

/// A column of numbers.
pub(super) const fn number<T>(title: &'static str, cell: fn(&T) -> String) -> Column<T> {
    Column { title, is_name: false, cell }
}

/// In columns that are as wide as they need to be.
pub(super) fn aligned<T>(columns: &[Column<T>], rows: &[T]) -> String {
    let lines = lines(columns, rows);
    let width = |place: usize| lines.iter().map(|line| line[place].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns.len()).map(width).collect();
    let text = |line: &Vec<String>| {
        let cells = line.iter().zip(columns).zip(&widths).map(|((cell, column), width)| match column.is_name {
            true => format!("{cell:width$}"),
            false => format!("{cell:>width$}"),
        });
        format!("{}\n", cells.collect::<Vec<_>>().join("  ").trim_end())
    };
    lines.iter().map(text).collect()
}

/// As Markdown has tables.
pub(super) fn markdown<T>(columns: &[Column<T>], rows: &[T]) -> String {
    let line = |cells: &Vec<String>| format!("| {} |\n", cells.join(" | "));
    let rule: Vec<String> =
        columns.iter().map(|column| if column.is_name { "---" } else { "---:" }.to_owned()).collect();
    let lines = lines(columns, rows);
    let escaped = lines[1..].iter().map(|cells| cells.iter().map(|cell| cell.replace('|', "\\|")).collect());
    line(&lines[0]) + &line(&rule) + &escaped.map(|cells| line(&cells)).collect::<String>()
}

/// Titles, then rows.
pub(super) fn lines<T>(columns: &[Column<T>], rows: &[T]) -> Vec<Vec<String>> {
    let titles = columns.iter().map(|column| column.title.to_owned()).collect();
    let row = |row: &T| columns.iter().map(|column| (column.cell)(row)).collect();
    std::iter::once(titles).chain(rows.iter().map(row)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: [Column<(&str, u32)>; 2] =
        [name("what", |(name, _)| (*name).to_owned()), number("n", |(_, count)| count.to_string())];

    #[test]
    fn names_stand_left_and_numbers_right() {
        let rows = [("a", 1), ("long | name", 12345)];
        assert_eq!(aligned(&COLUMNS, &rows), "what             n\na                1\nlong | name  12345\n");
        let expected = "| what | n |\n| --- | ---: |\n| a | 1 |\n| long \\| name | 12345 |\n";
        assert_eq!(markdown(&COLUMNS, &rows), expected);
    }
}
