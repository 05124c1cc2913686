//! The graphics state: what directives set for those that follow, until the block ends.
//!
//! All blocks are on one stack, and each saves the whole state, as in pbrt-v4. In pbrt-v3 a block
//! of transforms does not save `ReverseOrientation`. An end closes the innermost block, whatever
//! began it: so pbrt-v3 reads an `AttributeEnd` before an `ObjectEnd`, and pbrt-v4 a
//! `TransformBegin`, which is an `AttributeBegin` there. What one of the two refuses is a warning.

use super::blocks::Block;
use super::current_transform::{self, CurrentTransform};
use super::materials::Material;
use crate::error::Result;
use crate::scene::LoadOptions;
use crate::scene::parameters::{MAX_DEFAULTS, Parameters, ShapeDefaults};
use crate::scene::parser::Entity;
use crate::scene::source_file::SourceFile;
use crate::scene::source_span::SourceSpan;
use crate::scene::spelling;
use crate::scene::textures::Textures;
use crate::scene::warnings::Warnings;

/// The state and the blocks around it.
pub(super) struct GraphicsState {
    pub(super) transform: CurrentTransform,
    /// Whether `ReverseOrientation` occurred an odd number of times.
    pub(super) reverses_orientation: bool,
    /// The parameters that `Attribute "shape"` has set.
    pub(super) defaults: ShapeDefaults,
    pub(super) material: Material,
    pub(super) textures: Textures,
    /// Whether shapes emit light: `AreaLightSource`.
    pub(super) is_light: bool,
    open: Vec<OpenBlock>,
    /// The blocks, from the outermost on, that hold no piece of the text.
    settled: usize,
}

/// A block that is not closed yet, with the state before it.
struct OpenBlock {
    block: Block,
    began: SourceSpan,
    transform: current_transform::Saved,
    reverses_orientation: bool,
    material: Material,
    is_light: bool,
    /// The number of defaults.
    defaults: usize,
    /// The number of textures that were replaced before.
    textures: usize,
}

impl GraphicsState {
    pub(super) fn new(options: &LoadOptions) -> GraphicsState {
        GraphicsState {
            transform: CurrentTransform::new(options),
            reverses_orientation: false,
            defaults: ShapeDefaults::default(),
            material: Material::default(),
            textures: Textures::default(),
            is_light: false,
            open: Vec::new(),
            settled: 0,
        }
    }

    /// Resets what `WorldBegin` resets.
    pub(super) fn begin_world(&mut self) {
        self.transform.begin_world();
        self.reverses_orientation = false;
        (self.material, self.is_light) = (Material::default(), false);
    }

    /// Opens a block.
    pub(super) fn begin(&mut self, block: Block, began: &SourceSpan) {
        if block == Block::Import {
            self.transform.begin_import();
        }
        self.open.push(OpenBlock {
            block,
            began: began.clone(),
            transform: self.transform.save(),
            reverses_orientation: self.reverses_orientation,
            material: self.material.clone(),
            is_light: self.is_light,
            defaults: self.defaults.len(),
            textures: self.textures.save(),
        });
    }

    /// Lets go of the piece of the text that has been read.
    pub(super) fn settle(&mut self) {
        for block in &mut self.open[self.settled..] {
            block.began = block.began.kept();
        }
        self.settled = self.open.len();
    }

    /// Closes the innermost block, with a warning if it is not a `block`.
    pub(super) fn end(&mut self, block: Block, at: &SourceSpan, warnings: &mut Warnings) {
        match self.end_innermost() {
            Some((open, _)) if open == block => {}
            Some((open, began)) => block.warn_of_mismatch(open, at, &began, warnings),
            None => block.warn_of_missing_begin(at, warnings),
        }
    }

    /// Closes all blocks that are open where a file or the world ends, each with a warning.
    pub(super) fn close_blocks(&mut self, warnings: &mut Warnings) {
        while let Some((block, began)) = self.end_innermost() {
            block.warn_of_missing_end(&began, warnings);
        }
    }

    /// Closes the innermost block. An import only ends with its file.
    fn end_innermost(&mut self) -> Option<(Block, SourceSpan)> {
        let open = self.open.pop_if(|open| open.block != Block::Import)?;
        let (block, began) = (open.block, open.began.clone());
        self.restore(open);
        Some((block, began))
    }

    /// Closes the import that is the innermost block.
    pub(super) fn end_import(&mut self) {
        if let Some(open) = self.open.pop() {
            self.restore(open);
        }
        self.transform.end_import();
    }

    fn restore(&mut self, before: OpenBlock) {
        self.settled = self.settled.min(self.open.len());
        self.transform.restore(before.transform);
        self.reverses_orientation = before.reverses_orientation;
        (self.material, self.is_light) = (before.material, before.is_light);
        self.defaults.truncate(before.defaults);
        self.textures.restore(before.textures);
    }

    /// Sets defaults by pbrt-v4's `Attribute`. Only those of shapes matter.
    pub(super) fn set_defaults(&mut self, entity: &Entity, at: &SourceSpan) -> Result<()> {
        const TARGETS: [&str; 5] = ["shape", "light", "material", "medium", "texture"];
        let parameters = Parameters::new("Attribute", entity, at.file())?;
        let target = parameters.entity_name();
        if target == "shape" {
            let end = entity
                .parameters
                .last()
                .map_or(at.start(), |last| last.values_span.end);
            let kept = SourceFile::kept(at.file(), &(at.start()..end));
            if self.defaults.add(&entity.parameters, &kept) {
                return Ok(());
            }
            let message = format!(
                "more than {MAX_DEFAULTS} parameters of shapes are set by Attribute at a time"
            );
            return Err(parameters.error_at_name(message));
        }
        if TARGETS.contains(&target) {
            return Ok(());
        }
        let error = parameters.error_at_name(format!("Attribute sets nothing for `{target}`"));
        Err(match spelling::closest(target, TARGETS.into_iter()) {
            Some(known) => error.note(format!("did you mean `{known}`?")),
            None => error.note(format!("expected one of {}", TARGETS.join(", "))),
        })
    }
}
