//! Tables of text, aligned for a terminal or in Markdown.

/// Lines of cells below titles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextTable {
    /// The titles come first.
    lines: Vec<Vec<String>>,
    /// True for columns of names, which are aligned left; numbers are aligned right.
    is_name: Vec<bool>,
}

impl TextTable {
    /// A table with `titles`, each with a flag for names, and `rows` of as many cells.
    pub(super) fn new(
        titles: impl Iterator<Item = (String, bool)>,
        rows: impl Iterator<Item = Vec<String>>,
    ) -> TextTable {
        let (titles, is_name) = titles.unzip();
        let lines = std::iter::once(titles).chain(rows).collect();
        TextTable { lines, is_name }
    }

    /// The titles, then the rows.
    pub fn lines(&self) -> &[Vec<String>] {
        &self.lines
    }

    /// Returns true for a column of names.
    pub fn is_name(&self, column: usize) -> bool {
        self.is_name[column]
    }

    /// Text in columns as wide as they need to be.
    pub fn aligned(&self) -> String {
        let length = |line: &Vec<String>, column: usize| line[column].chars().count();
        let width = |column| {
            self.lines
                .iter()
                .map(|line| length(line, column))
                .max()
                .unwrap_or(0)
        };
        let widths: Vec<usize> = (0..self.is_name.len()).map(width).collect();
        let cell = |(column, cell): (usize, &String)| {
            let width = widths[column];
            if self.is_name[column] {
                format!("{cell:width$}")
            } else {
                format!("{cell:>width$}")
            }
        };
        let text = |line: &Vec<String>| {
            let cells: Vec<String> = line.iter().enumerate().map(cell).collect();
            format!("{}\n", cells.join("  ").trim_end())
        };
        self.lines.iter().map(text).collect()
    }

    /// A table in Markdown.
    pub fn markdown(&self) -> String {
        let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        let escaped =
            |cells: &Vec<String>| line(cells.iter().map(|cell| cell.replace('|', "\\|")).collect());
        let rule = |is_name: &bool| if *is_name { "---" } else { "---:" }.to_owned();
        let rule = self.is_name.iter().map(rule).collect();
        let (titles, rows) = self.lines.split_first().expect("a line of titles");
        escaped(titles) + &line(rule) + &rows.iter().map(escaped).collect::<String>()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A table of names and numbers.
    pub(in crate::bench::report) fn table(titles: [&str; 2], rows: &[[&str; 2]]) -> TextTable {
        let [name, number] = titles.map(str::to_owned);
        let rows = rows.iter().map(|row| row.map(str::to_owned).to_vec());
        TextTable::new([(name, true), (number, false)].into_iter(), rows)
    }

    #[test]
    fn names_stand_left_and_numbers_right() {
        let table = table(["what", "n"], &[["a", "1"], ["long | name", "12345"]]);
        let expected = "what             n\na                1\nlong | name  12345\n";
        assert_eq!(table.aligned(), expected);
        let expected = "| what | n |\n| --- | ---: |\n| a | 1 |\n| long \\| name | 12345 |\n";
        assert_eq!(table.markdown(), expected);
    }
}
