//! Suggests the word that a misspelt one may stand for.

/// Longer words get no suggestion: comparing them would take long.
const LONGEST: usize = 40;

/// The most edits between a word and its suggestion.
const EDITS: usize = 2;

/// The word of `known` that `word` may be a misspelling of: equal but for case, or with the fewest
/// edits, which are at most two and less than half of the word. The first one if several are
/// equally close.
pub fn closest<'a>(word: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    if word.len() > LONGEST {
        return None;
    }
    let word = word.to_ascii_lowercase();
    // Each byte of difference in length is an edit.
    let known = known.filter(|k| k.len() <= LONGEST && k.len().abs_diff(word.len()) <= EDITS);
    let scored = known.map(|k| (distance(&word, &k.to_ascii_lowercase()), k));
    let close = scored.filter(|(edits, k)| *edits <= EDITS && (*edits == 0 || 2 * edits < k.len()));
    close.min_by_key(|(edits, _)| *edits).map(|(_, k)| k)
}

/// The number of bytes to insert, delete, replace or swap with their neighbour to turn `a` into `b`
/// (optimal string alignment).
fn distance(a: &str, b: &str) -> usize {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    // Rows of the table, for the prefixes of `a` that end at `i - 2`, `i - 1` and `i`.
    let mut earlier = vec![0; b.len() + 1];
    let mut previous: Vec<usize> = (0..=b.len()).collect();
    for i in 0..a.len() {
        let mut row = vec![i + 1];
        for j in 0..b.len() {
            let replaced = previous[j] + usize::from(a[i] != b[j]);
            let mut best = replaced.min(previous[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                best = best.min(earlier[j - 1] + 1);
            }
            row.push(best);
        }
        earlier = std::mem::replace(&mut previous, row);
    }
    previous[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn suggestion(word: &str) -> Option<&'static str> {
        closest(
            word,
            ["Shape", "Scale", "radius", "P", "N", "Translate"].into_iter(),
        )
    }

    #[test]
    fn suggests_close_words() {
        assert_eq!(suggestion("shape"), Some("Shape"));
        assert_eq!(suggestion("Shap"), Some("Shape"));
        assert_eq!(suggestion("raidus"), Some("radius"));
        assert_eq!(suggestion("Tranlsatee"), Some("Translate"));
        assert_eq!(suggestion("p"), Some("P"));
    }

    #[test]
    fn suggests_only_close_words() {
        assert_eq!(suggestion("Q"), None);
        assert_eq!(suggestion(""), None);
        assert_eq!(suggestion("Sphere"), None);
        assert_eq!(suggestion(&"Shape".repeat(1000)), None);
    }

    #[test]
    fn counts_edits() {
        let cases = [
            ("", "abc", 3),
            ("abc", "", 3),
            ("abc", "abc", 0),
            ("abc", "acb", 1),
            ("kitten", "sitting", 3),
        ];
        for (a, b, edits) in cases {
            assert_eq!(distance(a, b), edits, "{a} {b}");
        }
    }
}
