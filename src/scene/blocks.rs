//! Blocks of the graphics state: `AttributeBegin`, `TransformBegin`, `ObjectBegin` and their ends.
//!
//! All blocks are on one stack, and each holds all of the state. An end closes the innermost block, whatever began
//! it: so pbrt-v3 reads an `AttributeEnd` before an `ObjectEnd`, and pbrt-v4 a `TransformBegin`, which is an
//! `AttributeBegin` there. What one of the two refuses is a warning.

use super::builder::Builder;
use super::graphics_state::Saved;
use super::parser::Span;
use super::source::{Place, Source};
use crate::error::{Diagnostic, SourceLocation};
use std::rc::Rc;

/// The kinds of block, each with an end of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Block {
    /// `AttributeBegin` to `AttributeEnd`.
    Attribute,
    /// `TransformBegin` to `TransformEnd`.
    Transform,
    /// `ObjectBegin` to `ObjectEnd`.
    Object,
    /// A file that is read with a state of its own.
    Import,
}

impl Block {
    /// The directive that opens it.
    pub(super) fn begin(self) -> &'static str {
        match self {
            Block::Attribute => "AttributeBegin",
            Block::Transform => "TransformBegin",
            Block::Object => "ObjectBegin",
            Block::Import => "Import",
        }
    }

    /// The directive that closes it.
    pub(super) fn end(self) -> &'static str {
        match self {
            Block::Attribute => "AttributeEnd",
            Block::Transform => "TransformEnd",
            Block::Object => "ObjectEnd",
            Block::Import => "the end of the imported file",
        }
    }
}

/// A block that is not closed yet.
pub(super) struct OpenBlock {
    pub(super) block: Block,
    /// Where it began.
    pub(super) place: Place,
    pub(super) saved: Saved,
}

impl Builder<'_> {
    /// Closes the innermost block by the end of a `block`, with a warning where that is another.
    pub(super) fn end(&mut self, block: Block, keyword: &Span, source: &Rc<Source>) {
        match self.state.end_innermost() {
            Some((open, _)) if open == block => {}
            Some((open, place)) => self.warn_of_mismatch(block, open, source.at(keyword), &place),
            None => {
                let message = format!(
                    "{} without {}: ignored, as pbrt does",
                    block.end(),
                    block.begin()
                );
                let kind = format!("{} without begin", block.end());
                self.warnings
                    .add(kind, || Diagnostic::new(message).at(source.at(keyword)));
            }
        }
    }

    fn warn_of_mismatch(&mut self, end: Block, open: Block, at: SourceLocation, began: &Place) {
        let kind = format!("{} of {}", end.end(), open.begin());
        self.warnings.add(kind, || {
            let message = format!("{} closes the block that {} began", end.end(), open.begin());
            let diagnostic = Diagnostic::new(message).at(at).note(format!("it began at {}", began.location()));
            diagnostic.note(if end == Block::Object || open == Block::Object {
                "pbrt-v3 reads it so; pbrt-v4 refuses it"
            } else {
                "pbrt-v4 reads it so; pbrt-v3 keeps transforms apart, and may place what follows elsewhere"
            })
        });
    }

    /// Closes all blocks that are open where a file or the world ends, each with a warning.
    pub(super) fn close_blocks(&mut self) {
        while let Some((block, place)) = self.state.end_innermost() {
            self.warnings
                .add(format!("{} without end", block.begin()), || {
                    let message = format!(
                        "{} without {}: it ends with the file",
                        block.begin(),
                        block.end()
                    );
                    Diagnostic::new(message)
                        .at(place.location())
                        .note("pbrt-v3 renders this; pbrt-v4 refuses it")
                });
        }
    }
}
