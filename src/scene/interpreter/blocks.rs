//! The kinds of block, and the warnings about blocks that do not match.

use crate::error::Diagnostic;
use crate::scene::source_span::SourceSpan;
use crate::scene::warnings::Warnings;

/// A kind of block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Block {
    /// `AttributeBegin` to `AttributeEnd`.
    Attribute,
    /// `TransformBegin` to `TransformEnd`.
    Transform,
    /// `ObjectBegin` to `ObjectEnd`.
    Object,
    /// An imported file.
    Import,
}

impl Block {
    /// The directive that opens it.
    fn begin(self) -> &'static str {
        match self {
            Block::Attribute => "AttributeBegin",
            Block::Transform => "TransformBegin",
            Block::Object => "ObjectBegin",
            Block::Import => "Import",
        }
    }

    /// The directive that closes it.
    fn end(self) -> &'static str {
        match self {
            Block::Attribute => "AttributeEnd",
            Block::Transform => "TransformEnd",
            Block::Object => "ObjectEnd",
            Block::Import => "the end of the imported file",
        }
    }

    /// The end of this block, at `at`, closed the `open` block that began at `began`.
    pub(super) fn warn_of_mismatch(
        self,
        open: Block,
        at: &SourceSpan,
        began: &SourceSpan,
        warnings: &mut Warnings,
    ) {
        let (end, begin) = (self.end(), open.begin());
        warnings.add(format!("{end} of {begin}"), || {
            let diagnostic = at.diagnostic(format!("{end} closes the block that {begin} began"));
            let diagnostic = diagnostic.note(format!("it began at {}", began.location()));
            diagnostic.note(if self == Block::Object || open == Block::Object {
                "pbrt-v3 reads it so; pbrt-v4 refuses it"
            } else {
                "pbrt-v4 reads it so; pbrt-v3 keeps transforms apart, \
                 and may place what follows elsewhere"
            })
        });
    }

    /// No block was open at `at`, where this one should end.
    pub(super) fn warn_of_missing_begin(self, at: &SourceSpan, warnings: &mut Warnings) {
        let (end, begin) = (self.end(), self.begin());
        warnings.add(format!("{end} without begin"), || {
            at.diagnostic(format!("{end} without {begin}: ignored, as pbrt does"))
        });
    }

    /// The block that began at `began` was open when a file or the world ended.
    pub(super) fn warn_of_missing_end(self, began: &SourceSpan, warnings: &mut Warnings) {
        let (begin, end) = (self.begin(), self.end());
        warnings.add(format!("{begin} without end"), || -> Diagnostic {
            let message = format!("{begin} without {end}: it ends with the file");
            began
                .diagnostic(message)
                .note("pbrt-v3 renders this; pbrt-v4 refuses it")
        });
    }
}
