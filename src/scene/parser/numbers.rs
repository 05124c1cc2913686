//! Arrays of numbers, which most bytes of a scene belong to: read by hand, and by all threads if
//! there are many.

use std::ops::Range;

use crate::parallel::CollectVec;
use rayon::prelude::*;

use super::lexer::{Parsed, is_word, separators, word};
use crate::decimal;

/// Bytes that a task reads, roughly. A shorter array is read by one thread.
const BLOCK: usize = 1 << 18;

/// What happens to values once their syntax has been checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Keep {
    /// They are handed out.
    All,
    /// They are dropped: the picture does not depend on them.
    Nothing,
}

/// Numbers and their separators, up to anything else.
pub(super) fn numbers(input: &[u8], keep: Keep) -> Parsed<'_, Vec<f64>> {
    match keep {
        Keep::All if input.len() > BLOCK => {
            in_blocks(input, BLOCK).map_or_else(|| in_order(input, keep), Ok)
        }
        _ => in_order(input, keep),
    }
}

fn in_order(input: &[u8], keep: Keep) -> Parsed<'_, Vec<f64>> {
    let mut values = Vec::new();
    let mut rest = input;
    while let Some((value, length)) = leading(rest) {
        if keep == Keep::All {
            values.push(value);
        }
        (rest, ()) = separators(&rest[length..])?;
    }
    Ok((rest, values))
}

/// The number that is the word at the start of `input`, and its length.
#[inline]
fn leading(input: &[u8]) -> Option<(f64, usize)> {
    match decimal::leading(input) {
        Some((value, length))
            if input
                .get(length)
                .is_some_and(|byte| !is_word(*byte) && *byte != b'#') =>
        {
            Some((value, length))
        }
        _ => {
            let (_, word) = word(input).ok()?;
            decimal::parse(word).map(|value| (value, word.len()))
        }
    }
}

/// Reads the numbers before the next bracket or quote with all threads. `None` if they are few, or
/// if anything else is among them.
fn in_blocks(input: &[u8], size: usize) -> Option<(&[u8], Vec<f64>)> {
    // More numbers may follow a comment.
    let (plain, rest) =
        input.split_at(end(input).filter(|end| *end > size && input[*end] != b'#')?);
    let blocks = cut(plain, size);
    let counts: Vec<usize> = blocks
        .par_iter()
        .map(|block| count_words(&plain[block.clone()]))
        .collect_vec();
    let mut values = vec![0.0; counts.iter().sum()];
    let mut rest_of_values = values.as_mut_slice();
    let mut tasks = Vec::with_capacity(blocks.len());
    for (block, count) in blocks.into_iter().zip(counts) {
        let (places, others) = std::mem::take(&mut rest_of_values).split_at_mut(count);
        tasks.push((&plain[block], places));
        rest_of_values = others;
    }
    tasks
        .into_par_iter()
        .try_for_each(|(text, places)| fill(text, places))?;
    Some((rest, values))
}

/// The index of the first byte that is neither in a word nor a separator.
fn end(input: &[u8]) -> Option<usize> {
    const AT_ONCE: usize = 64;
    let is_end = |byte: &u8| matches!(byte, b'"' | b'[' | b']' | b'#');
    // Without an early exit, the compiler turns the inner loop into vector instructions.
    let mut blocks = input.chunks(AT_ONCE);
    let block =
        blocks.position(|block| block.iter().fold(false, |found, byte| found | is_end(byte)))?;
    let start = block * AT_ONCE;
    input[start..].iter().position(is_end).map(|at| start + at)
}

/// Cuts `text` into blocks of about `size` bytes. All but the first begin with a word.
fn cut(text: &[u8], size: usize) -> Vec<Range<usize>> {
    let mut blocks = Vec::new();
    let mut start = 0;
    while start < text.len() {
        let near = text.len().min(start + size);
        let gap = text[near..]
            .iter()
            .position(|byte| !is_word(*byte))
            .map_or(text.len(), |at| near + at);
        let end = text[gap..]
            .iter()
            .position(|byte| is_word(*byte))
            .map_or(text.len(), |at| gap + at);
        blocks.push(start..end);
        start = end;
    }
    blocks
}

/// Counts the words of `text`, which consists of words and separators.
fn count_words(text: &[u8]) -> usize {
    /// The most ones that a byte can sum up: byte sums become vector instructions.
    const AT_ONCE: usize = u8::MAX as usize;
    let followed = &text[..text.len().saturating_sub(1)];
    let ends = followed
        .chunks(AT_ONCE)
        .zip(text[text.len().min(1)..].chunks(AT_ONCE));
    let count = |(bytes, next): (&[u8], &[u8])| {
        let is_end =
            |(byte, next): (&u8, &u8)| u8::from(!is_separator(*byte) & is_separator(*next));
        usize::from(bytes.iter().zip(next).map(is_end).sum::<u8>())
    };
    ends.map(count).sum::<usize>()
        + usize::from(text.last().is_some_and(|byte| !is_separator(*byte)))
}

/// Whether `byte` separates words, apart from brackets, quotes and comments.
#[inline]
fn is_separator(byte: u8) -> bool {
    (byte == b' ') | (byte == b',') | ((b'\t'..=b'\r').contains(&byte))
}

/// Reads `text`, which must have one number for each of `places`.
fn fill(text: &[u8], places: &mut [f64]) -> Option<()> {
    let mut rest = text;
    for place in places {
        let (value, length) = leading(rest)?;
        *place = value;
        (rest, ()) = separators(&rest[length..]).ok()?;
    }
    rest.is_empty().then_some(())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn blocks_give_the_same_numbers(
            words in proptest::collection::vec("(-?[0-9]{1,3}|-?[0-9]{1,2}[.][0-9]{1,6}|[+]?[0-9]{1,9}e[0-9]{1,3}|nan)", 1..40),
            odd in "(|x|1x|,,|\u{0}|# 1\n2)",
            gap in "[ ,\n\t]{1,3}",
            end in "( \\]|\\]|\"|)( 7)?",
            size in 1..60_usize,
        ) {
            let text = [words.join(&gap), odd, end].concat();
            let expected = in_order(text.as_bytes(), Keep::All).expect("numbers never fail");
            if let Some((rest, values)) = in_blocks(text.as_bytes(), size) {
                let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
                prop_assert_eq!((rest, bits(&values)), (expected.0, bits(&expected.1)));
            }
        }
    }

    #[test]
    fn separators_are_what_words_end_with() {
        for byte in 0..=u8::MAX {
            assert_eq!(
                is_separator(byte),
                !is_word(byte) && !matches!(byte, b'"' | b'[' | b']' | b'#'),
                "{byte}"
            );
        }
        for (text, words) in [
            ("", 0),
            ("1", 1),
            (" ", 0),
            ("1 ", 1),
            (" 1,,2", 2),
            ("1 2 3\n", 3),
        ] {
            assert_eq!(count_words(text.as_bytes()), words, "{text:?}");
        }
        assert_eq!(count_words("1 ".repeat(1000).as_bytes()), 1000);
    }

    #[test]
    fn blocks_are_used_where_they_can() {
        let text = b"1 2.5,3\n-4   5] 6";
        for size in 1..14 {
            assert_eq!(
                in_blocks(text, size),
                Some((&b"] 6"[..], vec![1.0, 2.5, 3.0, -4.0, 5.0]))
            );
        }
        assert_eq!(in_blocks(text, 14), None, "few");
        assert_eq!(in_blocks(b"1 2 3 x 4 5]", 2), None, "not all numbers");
        assert_eq!(in_blocks(b"1 2 3 4 5", 2), None, "no end");
        assert_eq!(
            in_blocks(b"1 2 3 4 # and\n 5]", 2),
            None,
            "more after a comment"
        );
        let long = format!("{}]", "0.25 ".repeat(BLOCK));
        let (rest, values) = numbers(long.as_bytes(), Keep::All).expect("numbers");
        assert!(rest == b"]" && values.len() == BLOCK && values.iter().all(|value| *value == 0.25));
    }
}
