//! The text of a scene to directives with their places, one at a time.
//!
//! The grammar is nom's, over bytes, because a file need not be UTF-8. A parser of the grammar hands back
//! what is left of the text, whose length says where it stands. Nothing is kept of a directive that has been
//! handed out, so that a file larger than the memory for its arrays never builds up as a tree. What the
//! directives mean, which types and parameters there are and how many numbers make a point, is left to
//! whoever takes them.

mod complaint;
mod directive;
mod encoding;
mod keyword;
mod numbers;
mod parameter;
mod private;
mod source;
mod statement;
#[cfg(test)]
mod tests;
mod token;
mod value;

use std::path::Path;

pub use self::keyword::KEYWORDS;
pub use self::parameter::NUMBER_TYPES;
use self::source::{Fault, Source};
pub(super) use self::source::{Piece, locate};
pub use self::statement::{
    ActiveTransform, Directive, Entity, Parameter, Span, Statement, Text, Values,
};
use self::token::{Token, blanks, word};
pub use self::value::number_in;
use crate::error::{Error, Result};

/// Whether there is a `WorldBegin` in the text of a scene file, which need not be right in all else.
pub fn begins_world(text: &[u8]) -> bool {
    const KEYWORD: &[u8] = b"WorldBegin";
    // Most files that are parts of others do not even have it in a comment.
    if !text.windows(KEYWORD.len()).any(|bytes| bytes == KEYWORD) {
        return false;
    }
    let mut rest = text;
    loop {
        match Token::next(rest) {
            (Token::End, _) => return false,
            (Token::Keyword("WorldBegin"), _) => return true,
            // A string that is not closed ends with its quote.
            (token, at) => rest = &at[token.length()..],
        }
    }
}

/// What may follow a directive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Next {
    /// The end of the text.
    End,
    /// What belongs to the directive before it.
    Argument,
    /// Another directive, or a word that is nothing else.
    Directive,
}

impl Next {
    fn of(token: Token) -> Next {
        match token {
            Token::End => Next::End,
            Token::Keyword(_) => Next::Directive,
            Token::Word(word) if !matches!(word, b"true" | b"false") => Next::Directive,
            _ => Next::Argument,
        }
    }
}

/// Where the arguments at `start` of `text` end: before the next directive, or where the text does.
pub(super) fn end_of_arguments(text: &[u8], start: usize) -> usize {
    let mut rest = &text[start..];
    loop {
        let (token, at) = Token::next(rest);
        // A string that is not closed is an error for who parses it.
        let is_unclosed = matches!(token, Token::Quoted(_)) && token.length() == 1;
        if Next::of(token) != Next::Argument || is_unclosed {
            // An error of the directive, which has to see the quote.
            return text.len() - at.len() + usize::from(is_unclosed);
        }
        rest = &at[token.length()..];
    }
}

/// Whether no directive follows the one at `start` of `text`, as far as that can be told of one that is not whole.
pub(super) fn is_last(text: &[u8], start: usize) -> bool {
    let after = match word(&text[start..]) {
        Ok((rest, _)) => text.len() - rest.len(),
        Err(_) => return false,
    };
    end_of_arguments(text, after) == text.len()
}

/// The directives of one scene file, in order; ends after the first error.
#[derive(Debug, Clone)]
pub struct Directives<'a> {
    source: Source<'a>,
    /// What is left of the text: after an error nothing.
    rest: &'a [u8],
    /// Why this is no text at all, until it has been told.
    unreadable: Option<Error>,
    previous: Option<&'a str>,
}

impl<'a> Directives<'a> {
    /// The directives of `source`, which errors call `path`.
    pub fn new(path: &Path, source: &'a [u8]) -> Directives<'a> {
        let source = Source::new(path, source);
        let (rest, unreadable) = match encoding::text(&source) {
            Ok(text) => (text, None),
            Err(error) => (&[][..], Some(error)),
        };
        Directives {
            source,
            rest,
            unreadable,
            previous: None,
        }
    }

    /// The directives of a text that is put together from `pieces`, which errors name.
    pub(super) fn of_pieces(pieces: Vec<Piece<'a>>, text: &'a [u8]) -> Directives<'a> {
        Directives {
            source: Source::of_pieces(pieces, text),
            rest: text,
            unreadable: None,
            previous: None,
        }
    }

    /// Where the next directive begins, or would, in the text.
    pub(super) fn offset(&self) -> usize {
        self.source.bytes.len() - Token::next(self.rest).1.len()
    }

    /// Goes on with the directive at `offset` of the text.
    pub(super) fn go_to(&mut self, offset: usize) {
        self.rest = &self.source.bytes[offset..];
    }

    /// What comes next.
    pub(super) fn next_is(&self) -> Next {
        Next::of(Token::next(self.rest).0)
    }

    fn directive(&mut self) -> Result<Option<Directive<'a>>> {
        let parsed = blanks(self.rest).and_then(|(rest, ())| match rest {
            [] => Ok((rest, None)),
            _ => self
                .source
                .directive(self.previous, rest)
                .map(|(rest, parsed)| (rest, Some(parsed))),
        });
        match parsed {
            Ok((rest, parsed)) => {
                self.rest = rest;
                self.previous = parsed.as_ref().map(|(name, _)| *name);
                Ok(parsed.map(|(_, directive)| directive))
            }
            Err(nom::Err::Failure(Fault::Wrong(error)) | nom::Err::Error(Fault::Wrong(error))) => {
                Err(error)
            }
            // The grammar turns a mismatch into a message where it is expected; this is for the one forgotten.
            Err(_) => Err(self.source.no_directive(self.previous, self.rest)),
        }
    }
}

impl<'a> Iterator for Directives<'a> {
    type Item = Result<Directive<'a>>;

    fn next(&mut self) -> Option<Result<Directive<'a>>> {
        let directive = match self.unreadable.take() {
            Some(error) => Err(error),
            None => self.directive(),
        };
        if directive.is_err() {
            self.rest = &[];
        }
        directive.transpose()
    }
}

impl std::iter::FusedIterator for Directives<'_> {}
