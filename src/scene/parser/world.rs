//! Looks for `WorldBegin` in a text, piece by piece, even if the rest of the text is wrong.

use super::completeness::certain;
use super::lexer::Token;
use crate::error::is_line_end;

const KEYWORD: &[u8] = b"WorldBegin";

/// What a piece of a text tells about the whole.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::scene) enum WorldSearch {
    /// The text has a `WorldBegin`.
    Found,
    /// The piece has none in its first bytes, of this number. The next piece goes on behind them.
    NotWithin(usize),
}

impl WorldSearch {
    /// Searches a piece of a text; `is_last` if the text ends with it.
    pub(in crate::scene) fn of(piece: &[u8], is_last: bool) -> WorldSearch {
        let mut rest = piece;
        // The end of the next mention, perhaps in a comment. Most included files have none.
        let mut mention = 0;
        loop {
            let passed = piece.len() - rest.len();
            if mention <= passed {
                let found = rest
                    .windows(KEYWORD.len())
                    .position(|bytes| bytes == KEYWORD);
                let end = found.map_or(rest.len(), |at| at + KEYWORD.len());
                mention = piece.len() + 1;
                if found.is_some() {
                    mention = passed + end;
                }
                // No token goes on in the next line, so lines without a mention need not be read.
                let line = rest[..end].iter().rposition(is_line_end);
                rest = &rest[line.map_or(0, |end| end + 1)..];
            }
            match next(rest, is_last) {
                None => return WorldSearch::NotWithin(piece.len() - rest.len()),
                Some((Token::Keyword("WorldBegin"), _)) => return WorldSearch::Found,
                Some((_, after)) => rest = after,
            }
        }
    }
}

/// The next token, if it is certain, and the text behind it. An unclosed string ends with its
/// opening quote.
fn next(rest: &[u8], is_last: bool) -> Option<(Token<'_>, &[u8])> {
    match is_last {
        false => certain(rest),
        true => match Token::next(rest) {
            (Token::End, _) => None,
            (token, at) => Some((token, &at[token.length()..])),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FOUND: WorldSearch = WorldSearch::Found;

    #[test]
    fn worlds_begin_outside_comments_and_strings() {
        for (text, is_found) in [
            ("WorldBegin", true),
            ("\"a\" [1] WorldBegin # x", true),
            ("Scale 1 \"open\nWorldBegin", true),
            ("] \"a # b\" WorldBegin\n", true),
            ("WorldEnd \"a \\\" WorldBegin\"", false),
            ("Camera \"a\"\n  WorldBegin # here", true),
            ("# WorldBegin\nTranslate 1 2 3\n", false),
            ("# WorldBegin\nWorldBegin", true),
            ("\"WorldBegin\"", false),
            ("\"WorldBegin", true),
            ("\"a \" WorldBegin \"b\"", true),
            ("\"a\\\" WorldBegin \"", false),
            ("WorldBeginning aWorldBegin", false),
            ("] nonsense 7 WorldBegin", true),
            ("", false),
        ] {
            assert_eq!(
                WorldSearch::of(text.as_bytes(), true) == FOUND,
                is_found,
                "{text}"
            );
            // In pieces: each has one byte more than what is left of the one before.
            let mut start = 0;
            let found = (1..=text.len()).any(|end| {
                match WorldSearch::of(&text.as_bytes()[start..end], end == text.len()) {
                    WorldSearch::Found => return true,
                    WorldSearch::NotWithin(passed) => start += passed,
                }
                false
            });
            assert_eq!(found, is_found, "{text}");
        }
    }
}
