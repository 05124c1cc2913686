//! Reads the text of a scene: one directive at a time, with its place.
//!
//! The grammar uses nom over bytes, because a file need not be UTF-8. A parser of the grammar
//! returns the rest of the text, whose length tells where it begins. Nothing is kept of a directive
//! once it is handed out, so a file larger than memory never becomes a tree. The interpreter
//! decides what directives mean, which types and parameters exist and how many numbers make a
//! point.

mod arguments;
mod completeness;
mod diagnostics;
mod directive;
mod encoding;
mod grammar;
mod lexer;
mod numbers;
mod statement;
#[cfg(test)]
mod tests;
mod unknown;
mod values;
mod world;

pub(super) use self::arguments::{Next, end_of_arguments, is_last};
pub(super) use self::completeness::may_be_long;
pub use self::directive::{Description, Directive, KEYWORDS, Legal};
pub(super) use self::encoding::{BYTES_TO_JUDGE_BY, check as check_encoding};
pub use self::statement::{
    ActiveTransform, Entity, NUMBER_TYPES, Parameter, Statement, Text, TextureDirective,
    TransformDirective, Values,
};
pub(super) use self::values::number_in;
pub(super) use self::world::WorldSearch;

use self::completeness::{arguments_are_certain, begins_certainly, directive_is_certain, is_blank};
use self::diagnostics::Diagnostics;
use self::lexer::{Fault, Token, blanks};
use super::source_file::SourceFile;
use crate::error::{Error, Result, is_line_end};
use std::borrow::Cow;

/// The bytes that blanks and comments before a directive seldom exceed.
const NEAR: usize = 256;

/// What a piece of a scene file has next.
#[derive(Debug)]
pub(super) enum Step<'a> {
    Directive(Directive<'a>),
    Error(Error),
    /// The file ends.
    End,
    /// The piece ends within a directive, or where the next one decides what it means.
    NeedsMore,
}

/// The directives of one scene file, or of a piece of it, in order; ends after the first error.
#[derive(Debug)]
pub struct Directives<'a> {
    file: &'a SourceFile,
    /// The text that is not parsed yet; empty after an error.
    rest: &'a [u8],
    /// Directives from here on are left to the next piece.
    last_start: usize,
    /// Why the file is not text, until it has been reported.
    unreadable: Option<Error>,
    previous: Option<Cow<'a, str>>,
}

impl<'a> Directives<'a> {
    /// The directives of `file`.
    pub fn new(file: &'a SourceFile) -> Directives<'a> {
        let text = file.from(file.start());
        // The files of a spliced text have been checked.
        let mark = match file.is_spliced() {
            true => Ok(0),
            false => encoding::check(file.path(), text),
        };
        let (rest, unreadable) = match mark {
            Ok(mark) => (&text[mark..], None),
            Err(error) => (&[][..], Some(error)),
        };
        Directives {
            file,
            rest,
            last_start: usize::MAX,
            unreadable,
            previous: None,
        }
    }

    /// The directives of the piece `file` from `offset` on, after the keyword `previous`. The one
    /// at `last_start` is probably incomplete.
    pub(super) fn of_piece(
        file: &'a SourceFile,
        offset: usize,
        previous: Option<String>,
        last_start: usize,
    ) -> Directives<'a> {
        Directives {
            file,
            rest: file.from(offset),
            last_start,
            unreadable: None,
            previous: previous.map(Cow::Owned),
        }
    }

    /// Where the next directive begins in the text, or would begin.
    pub(super) fn offset(&self) -> usize {
        self.file.end() - Token::next(self.rest).1.len()
    }

    /// Continues with the directive at `offset` of the text.
    pub(super) fn go_to(&mut self, offset: usize) {
        self.rest = self.file.from(offset);
    }

    /// Where to go on in the next piece, and the keyword of the directive before that.
    pub(super) fn into_position(self) -> (usize, Option<String>) {
        let end = self.file.end();
        let at = match Token::next(self.rest) {
            // Perhaps within a comment, but tokens do not go on in the next line.
            (Token::End, _) => end - last_line(self.rest),
            (_, at) => end - at.len(),
        };
        (at, self.previous.map(Cow::into_owned))
    }

    /// The kind of token that comes next.
    pub(super) fn next_is(&self) -> Next {
        Next::of(Token::next(self.rest).0)
    }

    /// The next directive, if it is certain whatever the next piece has.
    pub(super) fn step(&mut self) -> Step<'a> {
        if let Some(error) = self.unreadable.take() {
            return Step::Error(error);
        }
        // Most directives are far from the last one.
        let near = self.last_start.saturating_sub(NEAR);
        if self.file.end() - self.rest.len() >= near && self.offset() >= self.last_start {
            return Step::NeedsMore;
        }
        let (rest, previous) = (self.rest, self.previous.clone());
        let parsed = self.directive();
        let is_certain = self.file.is_last()
            || match &parsed {
                Ok(None) => false,
                Ok(Some(directive)) => self.ends_certainly(directive),
                Err(_) => directive_is_certain(rest),
            };
        if !is_certain {
            (self.rest, self.previous) = (rest, previous);
            return Step::NeedsMore;
        }
        match parsed {
            Ok(None) => Step::End,
            Ok(Some(directive)) => Step::Directive(directive),
            Err(error) => {
                self.rest = &[];
                Step::Error(error)
            }
        }
    }

    /// Whether the `directive` before the rest ends there, whatever follows.
    fn ends_certainly(&self, directive: &Directive) -> bool {
        match directive.statement {
            // What follows may continue the last directive of the file.
            Statement::Include(_) => arguments_are_certain(self.rest),
            _ => begins_certainly(self.rest),
        }
    }

    fn directive(&mut self) -> Result<Option<Directive<'a>>> {
        let errors = Diagnostics::new(self.file);
        let previous = self.previous.as_deref();
        let parsed = blanks(self.rest).and_then(|(rest, ())| match rest {
            [] => Ok((rest, None)),
            _ => grammar::directive(errors, previous, rest)
                .map(|(rest, parsed)| (rest, Some(parsed))),
        });
        match parsed {
            Ok((rest, parsed)) => {
                self.rest = rest;
                self.previous = parsed.as_ref().map(|(name, _)| Cow::Borrowed(*name));
                Ok(parsed.map(|(_, directive)| directive))
            }
            Err(nom::Err::Failure(Fault::Wrong(error)) | nom::Err::Error(Fault::Wrong(error))) => {
                Err(error)
            }
            // The grammar reports a mismatch where it happens; this is for one it forgot.
            Err(_) => Err(errors.no_directive(previous, self.rest)),
        }
    }
}

/// The number of bytes of `gap`, which has no token, from the start of a last comment on.
fn last_line(gap: &[u8]) -> usize {
    // The line end may be the first half of CR LF.
    let whole = gap.strip_suffix(b"\r").unwrap_or(gap);
    let last = whole
        .iter()
        .rposition(is_line_end)
        .map_or(0, |last| last + 1);
    match is_blank(&whole[last..]) {
        true => gap.len() - whole.len(),
        false => gap.len() - last,
    }
}

impl<'a> Iterator for Directives<'a> {
    type Item = Result<Directive<'a>>;

    fn next(&mut self) -> Option<Result<Directive<'a>>> {
        match self.step() {
            Step::Directive(directive) => Some(Ok(directive)),
            Step::Error(error) => Some(Err(error)),
            Step::End | Step::NeedsMore => None,
        }
    }
}

impl std::iter::FusedIterator for Directives<'_> {}
