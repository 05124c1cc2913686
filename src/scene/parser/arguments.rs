//! Tells where the arguments of a directive end.

use super::lexer::{Token, word};
use crate::scene::source_file::SourceFile;

/// What follows a directive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::scene) enum Next {
    /// The end of the text.
    End,
    /// An argument of the directive before it.
    Argument,
    /// Another directive, or a word that cannot be an argument.
    Directive,
}

impl Next {
    /// The kind of `token`.
    pub(super) fn of(token: Token) -> Next {
        match token {
            Token::End => Next::End,
            Token::Keyword(_) => Next::Directive,
            Token::Word(word) if !matches!(word, b"true" | b"false") => Next::Directive,
            _ => Next::Argument,
        }
    }
}

/// The end of the arguments at `start` of `file`: the next directive or the end of the text.
pub(in crate::scene) fn end_of_arguments(file: &SourceFile, start: usize) -> usize {
    let mut rest = file.from(start);
    loop {
        let (token, at) = Token::next(rest);
        // The parser reports an unclosed string, and has to see its quote.
        let is_unclosed = matches!(token, Token::Quoted(_)) && token.length() == 1;
        if Next::of(token) != Next::Argument || is_unclosed {
            return file.end() - at.len() + usize::from(is_unclosed);
        }
        rest = &at[token.length()..];
    }
}

/// Whether the directive at `start` of `file`, which may be incomplete, seems to be the last one.
pub(in crate::scene) fn is_last(file: &SourceFile, start: usize) -> bool {
    let after = match word(file.from(start)) {
        Ok((rest, _)) => file.end() - rest.len(),
        Err(_) => return false,
    };
    file.is_last() && end_of_arguments(file, after) == file.end()
}
