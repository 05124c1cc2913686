//! Matrices in JSON, as lists of rows or as flat lists.

use serde::Deserialize;
use serde::de::{Deserializer, Error, SeqAccess, Visitor};
use std::fmt::{self, Formatter};

/// A matrix of `R` rows and `C` columns: a list of rows, or of all numbers row by row.
///
/// A column vector is a list of numbers, or of lists of one number: NumPy writes it so, and
/// OpenCV's `solvePnP` returns t as one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Grid<const R: usize, const C: usize>(pub(super) [[f64; C]; R]);

/// The upper three rows of an affine matrix, which may have a fourth row: 0 0 0 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Affine(pub(super) [[f64; 4]; 3]);

/// The most numbers of a matrix.
const MOST: usize = 16;

/// An item of a list: a number, or a row of numbers.
#[derive(Deserialize)]
#[serde(untagged, expecting = "expected a number, or a list of numbers")]
enum Item {
    Number(f64),
    Row(Vec<f64>),
}

/// The numbers of a list, row by row, and the length of its rows if it has any.
struct Numbers {
    values: Vec<f64>,
    columns: Option<usize>,
}

impl Numbers {
    /// The numbers as rows of `columns`; `None` if there are others.
    fn rows(&self, rows: usize, columns: usize) -> Option<Vec<&[f64]>> {
        let fits = self.columns.is_none_or(|found| found == columns);
        let whole = self.values.len() == rows * columns;
        (fits && whole).then(|| self.values.chunks_exact(columns).collect())
    }
}

/// Reads numbers, and says what was `expected` where there are none.
struct NumbersVisitor<'a>(&'a str);

impl<'de> Visitor<'de> for NumbersVisitor<'_> {
    type Value = Numbers;

    fn expecting(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Numbers, A::Error> {
        let mut numbers = Numbers {
            values: Vec::new(),
            columns: None,
        };
        while let Some(item) = list.next_element()? {
            let is_first = numbers.values.is_empty();
            let (row, columns) = match item {
                Item::Number(number) => (vec![number], None),
                Item::Row(row) => {
                    let length = row.len();
                    (row, Some(length))
                }
            };
            if is_first {
                numbers.columns = columns;
            }
            let count = numbers.values.len() + row.len();
            if numbers.columns != columns {
                return Err(Error::custom("rows of different lengths"));
            }
            if columns == Some(0) || count > MOST {
                return Err(Error::invalid_length(count, &self));
            }
            numbers.values.extend(row);
        }
        Ok(numbers)
    }
}

/// Numbers in rows of one length; `fit` makes what they stand for.
fn read<'de, D: Deserializer<'de>, T>(
    deserializer: D,
    expected: &str,
    fit: impl Fn(&Numbers) -> Option<T>,
) -> Result<T, D::Error> {
    let numbers = deserializer.deserialize_seq(NumbersVisitor(expected))?;
    let wrong = || Error::invalid_length(numbers.values.len(), &NumbersVisitor(expected));
    fit(&numbers).ok_or_else(wrong)
}

impl<'de, const R: usize, const C: usize> Deserialize<'de> for Grid<R, C> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Grid<R, C>, D::Error> {
        let expected = match C {
            1 => format!("{R} numbers, or {R} lists of one number"),
            _ => format!("{R} rows of {C} numbers, or {} numbers", R * C),
        };
        read(deserializer, &expected, |numbers| {
            let mut grid = [[0.0; C]; R];
            for (row, found) in grid.iter_mut().zip(numbers.rows(R, C)?) {
                row.copy_from_slice(found);
            }
            Some(Grid(grid))
        })
    }
}

impl<'de> Deserialize<'de> for Affine {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Affine, D::Error> {
        let expected = "3 or 4 rows of 4 numbers, or 12 or 16 numbers; a fourth row is 0 0 0 1";
        read(deserializer, expected, |numbers| {
            let rows = numbers.rows(4, 4).or_else(|| numbers.rows(3, 4))?;
            let is_affine = rows.get(3).is_none_or(|last| *last == [0.0, 0.0, 0.0, 1.0]);
            let mut matrix = [[0.0; 4]; 3];
            for (row, found) in matrix.iter_mut().zip(rows) {
                row.copy_from_slice(found);
            }
            is_affine.then_some(Affine(matrix))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid<const R: usize, const C: usize>(text: &str) -> Option<[[f64; C]; R]> {
        serde_json::from_str(text).ok().map(|Grid(rows)| rows)
    }

    #[test]
    fn rows_and_flat_lists_are_the_same() {
        assert_eq!(grid("[[1, 2], [3, 4]]"), Some([[1.0, 2.0], [3.0, 4.0]]));
        assert_eq!(grid("[1, 2, 3, 4e0]"), Some([[1.0, 2.0], [3.0, 4.0]]));
        assert_eq!(grid("[[1], [2]]"), Some([[1.0], [2.0]]));
        assert_eq!(grid("[1, -2]"), Some([[1.0], [-2.0]]));
    }

    #[test]
    fn other_shapes_are_refused() {
        for text in [
            "[]",
            "[1, 2, 3]",
            "[[1, 2, 3, 4]]",
            "[[1, 2], 3, 4]",
            "[[1], [2], [3], [4]]",
        ] {
            assert_eq!(grid::<2, 2>(text), None, "{text}");
        }
        assert_eq!(grid::<2, 2>("[[], []]"), None);
        assert_eq!(grid::<2, 2>(&format!("[{}1]", "1,".repeat(1000))), None);
        assert_eq!(grid::<2, 2>("{}"), None);
    }

    #[test]
    fn a_fourth_row_is_that_of_affine_matrices() {
        let affine = |text: &str| serde_json::from_str::<Affine>(text).ok();
        let three = affine("[[1,2,3,4], [5,6,7,8], [9,10,11,12]]");
        assert!(three.is_some());
        assert_eq!(affine("[1,2,3,4, 5,6,7,8, 9,10,11,12, 0,0,0,1]"), three);
        assert_eq!(affine("[1,2,3,4, 5,6,7,8, 9,10,11,12]"), three);
        assert_eq!(affine("[1,2,3,4, 5,6,7,8, 9,10,11,12, 0,0,1,1]"), None);
    }
}
