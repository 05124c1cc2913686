//! Tables of text, aligned for a terminal or in Markdown.

/// What stands in a column, and over it.
pub(super) struct Column<T> {
    title: &'static str,
    /// Names stand at the left, numbers at the right.
    is_name: bool,
    cell: fn(&T) -> String,
}

/// A column of names.
pub(super) const fn name<T>(title: &'static str, cell: fn(&T) -> String) -> Column<T> {
    Column {
        title,
        is_name: true,
        cell,
    }
}

/// A column of numbers.
pub(super) const fn number<T>(title: &'static str, cell: fn(&T) -> String) -> Column<T> {
    Column {
        title,
        is_name: false,
        cell,
    }
}

/// Lines of cells, the first one of titles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextTable {
    lines: Vec<Vec<String>>,
    /// Of each column, whether it is of names.
    is_name: Vec<bool>,
}

impl TextTable {
    pub(super) fn new<T>(columns: &[Column<T>], rows: impl Iterator<Item = T>) -> TextTable {
        let titles = columns
            .iter()
            .map(|column| column.title.to_owned())
            .collect();
        let row = |row: T| columns.iter().map(|column| (column.cell)(&row)).collect();
        TextTable {
            lines: std::iter::once(titles).chain(rows.map(row)).collect(),
            is_name: columns.iter().map(|column| column.is_name).collect(),
        }
    }

    /// Titles, then rows.
    pub fn lines(&self) -> &[Vec<String>] {
        &self.lines
    }

    /// Whether a column is of names.
    pub fn is_name(&self, column: usize) -> bool {
        self.is_name[column]
    }

    /// In columns that are as wide as they need to be.
    pub fn aligned(&self) -> String {
        let width = |column: usize| {
            self.lines
                .iter()
                .map(|line| line[column].chars().count())
                .max()
                .unwrap_or(0)
        };
        let widths: Vec<usize> = (0..self.is_name.len()).map(width).collect();
        let text = |line: &Vec<String>| {
            let cells =
                line.iter()
                    .zip(&self.is_name)
                    .zip(&widths)
                    .map(|((cell, is_name), width)| match is_name {
                        true => format!("{cell:width$}"),
                        false => format!("{cell:>width$}"),
                    });
            format!("{}\n", cells.collect::<Vec<_>>().join("  ").trim_end())
        };
        self.lines.iter().map(text).collect()
    }

    /// As Markdown has tables.
    pub fn markdown(&self) -> String {
        let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        let escaped =
            |cells: &Vec<String>| line(cells.iter().map(|cell| cell.replace('|', "\\|")).collect());
        let rule = self
            .is_name
            .iter()
            .map(|is_name| if *is_name { "---" } else { "---:" }.to_owned())
            .collect();
        let (titles, rows) = self.lines.split_first().expect("a line of titles");
        escaped(titles) + &line(rule) + &rows.iter().map(escaped).collect::<String>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: [Column<(&str, u32)>; 2] = [
        name("what", |(name, _)| (*name).to_owned()),
        number("n", |(_, count)| count.to_string()),
    ];

    #[test]
    fn names_stand_left_and_numbers_right() {
        let table = TextTable::new(&COLUMNS, [("a", 1), ("long | name", 12345)].into_iter());
        assert_eq!(
            table.aligned(),
            "what             n\na                1\nlong | name  12345\n"
        );
        let expected = "| what | n |\n| --- | ---: |\n| a | 1 |\n| long \\| name | 12345 |\n";
        assert_eq!(table.markdown(), expected);
    }
}
