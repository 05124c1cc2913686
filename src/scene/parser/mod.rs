//! Reads the text of a scene: one directive at a time, with its place.
//!
//! The grammar uses nom over bytes, because a file need not be UTF-8. A parser of the grammar
//! returns the rest of the text, whose length tells where it begins. Nothing is kept of a directive
//! once it is handed out, so a file larger than memory never becomes a tree. The interpreter
//! decides what directives mean, which types and parameters exist and how many numbers make a
//! point.

mod diagnostics;
mod directive;
mod encoding;
mod grammar;
mod lexer;
mod numbers;
mod statement;
#[cfg(test)]
mod tests;
mod values;

pub use self::directive::{Description, Directive, KEYWORDS, Legal};
pub use self::statement::{
    ActiveTransform, Entity, NUMBER_TYPES, Parameter, Statement, Text, TransformDirective, Values,
};
pub(super) use self::values::number_in;

use self::diagnostics::Diagnostics;
use self::lexer::{Fault, Token, blanks, word};
use super::source_file::SourceFile;
use crate::error::{Error, Result};

/// Whether the text of a scene file has a `WorldBegin`, even if the rest of it is wrong.
pub fn begins_world(text: &[u8]) -> bool {
    const KEYWORD: &[u8] = b"WorldBegin";
    // Most included files do not even mention it in a comment.
    if !text.windows(KEYWORD.len()).any(|bytes| bytes == KEYWORD) {
        return false;
    }
    let mut rest = text;
    loop {
        match Token::next(rest) {
            (Token::End, _) => return false,
            (Token::Keyword("WorldBegin"), _) => return true,
            // An unclosed string ends with its opening quote.
            (token, at) => rest = &at[token.length()..],
        }
    }
}

/// What follows a directive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Next {
    /// The end of the text.
    End,
    /// An argument of the directive before it.
    Argument,
    /// Another directive, or a word that cannot be an argument.
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

/// The end of the arguments at `start` of `text`: the next directive or the end of the text.
pub(super) fn end_of_arguments(text: &[u8], start: usize) -> usize {
    let mut rest = &text[start..];
    loop {
        let (token, at) = Token::next(rest);
        // The parser reports an unclosed string, and has to see its quote.
        let is_unclosed = matches!(token, Token::Quoted(_)) && token.length() == 1;
        if Next::of(token) != Next::Argument || is_unclosed {
            return text.len() - at.len() + usize::from(is_unclosed);
        }
        rest = &at[token.length()..];
    }
}

/// Whether the directive at `start` of `text`, which may be incomplete, seems to be the last one.
pub(super) fn is_last(text: &[u8], start: usize) -> bool {
    let after = match word(&text[start..]) {
        Ok((rest, _)) => text.len() - rest.len(),
        Err(_) => return false,
    };
    end_of_arguments(text, after) == text.len()
}

/// The directives of one scene file, in order; ends after the first error.
#[derive(Debug)]
pub struct Directives<'a> {
    file: &'a SourceFile,
    /// The text that is not parsed yet; empty after an error.
    rest: &'a [u8],
    /// Why the file is not text, until it has been reported.
    unreadable: Option<Error>,
    previous: Option<&'a str>,
}

impl<'a> Directives<'a> {
    /// The directives of `file`.
    pub fn new(file: &'a SourceFile) -> Directives<'a> {
        // The files of a spliced text have been checked.
        let text = if file.is_spliced() {
            Ok(file.text())
        } else {
            encoding::check(file)
        };
        let (rest, unreadable) = match text {
            Ok(text) => (text, None),
            Err(error) => (&[][..], Some(error)),
        };
        Directives {
            file,
            rest,
            unreadable,
            previous: None,
        }
    }

    /// Where the next directive begins in the text, or would begin.
    pub(super) fn offset(&self) -> usize {
        self.file.text().len() - Token::next(self.rest).1.len()
    }

    /// Continues with the directive at `offset` of the text.
    pub(super) fn go_to(&mut self, offset: usize) {
        self.rest = &self.file.text()[offset..];
    }

    /// The kind of token that comes next.
    pub(super) fn next_is(&self) -> Next {
        Next::of(Token::next(self.rest).0)
    }

    fn directive(&mut self) -> Result<Option<Directive<'a>>> {
        let errors = Diagnostics::new(self.file);
        let parsed = blanks(self.rest).and_then(|(rest, ())| match rest {
            [] => Ok((rest, None)),
            _ => grammar::directive(errors, self.previous, rest)
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
            // The grammar reports a mismatch where it happens; this is for one it forgot.
            Err(_) => Err(errors.no_directive(self.previous, self.rest)),
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
