//! Tells what is certain of a text whose end is not known yet.

use super::arguments::Next;
use super::lexer::{Token, blanks, is_word};
use crate::error::{SHOWN_BYTES, is_line_end};

/// The first token of `rest` and the text behind it. `None` if they depend on what follows, or if a
/// message about the token would.
pub(super) fn certain(rest: &[u8]) -> Option<(Token<'_>, &[u8])> {
    let (token, at) = Token::next(rest);
    let (length, after) = (token.length(), &at[token.length()..]);
    let is_certain = match token {
        Token::End => false,
        Token::Open | Token::Close | Token::Comma => true,
        Token::Quoted(inside) => length > 1 || has_line_end(inside),
        Token::Number(_) | Token::Keyword(_) | Token::Word(_) => word_ends(after),
    };
    (is_certain && is_shown(at, after)).then_some((token, after))
}

/// Whether the first token of `rest` is certain.
pub(super) fn begins_certainly(rest: &[u8]) -> bool {
    let at = blanks(rest).map_or(rest, |(rest, ())| rest);
    // Mostly it is a keyword, which need not be looked up.
    if at.len() > SHOWN_BYTES
        && at[0].is_ascii_alphabetic()
        && let Some(end) = at[..SHOWN_BYTES].iter().position(|byte| !is_word(*byte))
        && at[end] != b'#'
    {
        return true;
    }
    certain(rest).is_some()
}

/// Whether the arguments at the start of `rest` and the token behind them are certain.
pub(super) fn arguments_are_certain(rest: &[u8]) -> bool {
    let mut rest = rest;
    while let Some((token, after)) = certain(rest) {
        // No parser reads on behind an unclosed string.
        let is_unclosed = matches!(token, Token::Quoted(_)) && token.length() == 1;
        if Next::of(token) != Next::Argument || is_unclosed {
            return true;
        }
        rest = after;
    }
    false
}

/// Whether the directive at the start of `rest` and the token behind it are certain.
pub(super) fn directive_is_certain(rest: &[u8]) -> bool {
    match certain(rest) {
        None => false,
        Some((Token::Keyword(_) | Token::Word(_), after)) => arguments_are_certain(after),
        // No directive begins with it.
        Some(_) => true,
    }
}

/// Whether the text may begin with a long directive. If not, its start is worth being parsed.
pub(in crate::scene) fn may_be_long(text: &[u8]) -> bool {
    match certain(text) {
        Some((Token::Keyword(_), _)) => true,
        Some((Token::Word(word), _)) => word[0].is_ascii_uppercase(),
        Some(_) => false,
        // Blanks are dropped, and comments line by line.
        None => !has_line_end(text) && !is_blank(text),
    }
}

/// Whether the text has neither a token nor a comment.
pub(super) fn is_blank(text: &[u8]) -> bool {
    blanks(text).is_ok_and(|(rest, ())| rest.is_empty()) && !text.contains(&b'#')
}

/// Whether the word before `after` ends, whatever follows. A number may go on behind a `#`, in its
/// line.
fn word_ends(after: &[u8]) -> bool {
    match after.first() {
        None => false,
        Some(b'#') => has_line_end(after),
        Some(_) => true,
    }
}

/// Whether the text has all that a message about the token at `at` shows. `after` is behind it.
fn is_shown(at: &[u8], after: &[u8]) -> bool {
    at.len() >= SHOWN_BYTES || has_line_end(after)
}

fn has_line_end(text: &[u8]) -> bool {
    text.iter().any(is_line_end)
}
