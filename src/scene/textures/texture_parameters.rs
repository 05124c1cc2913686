//! Parameters that many textures have.

use super::definition::{Definition, Unusable};
use crate::error::Diagnostic;
use crate::scene::inputs::Inputs;
use crate::scene::parameters::Parameters;
use crate::texture::{FloatTexture, UvMapping};
use std::collections::HashMap;
use std::sync::Arc;

/// The parameters of a texture, and what they name.
pub(super) struct TextureParameters<'a, 'i> {
    pub(super) all: Parameters<'a>,
    pub(super) parts: &'a HashMap<String, Arc<Definition>>,
    pub(super) inputs: &'a mut Inputs<'i>,
}

impl TextureParameters<'_, '_> {
    pub(super) fn number(&mut self, name: &'static str, default: f64) -> Result<f64, Unusable> {
        Ok(self.all.number(name)?.unwrap_or(default))
    }

    /// A texture, or a number that stands for one.
    pub(super) fn part(
        &mut self,
        name: &'static str,
        default: f64,
    ) -> Result<Arc<FloatTexture>, Unusable> {
        let Some(called) = self.all.texture(name)? else {
            return Ok(Arc::new(FloatTexture::Constant(
                self.number(name, default)?,
            )));
        };
        match self.parts.get(name) {
            Some(part) => part.texture(self.inputs),
            None => {
                let message = format!("there is no float texture called `{}`", called.text);
                let error = self.all.error_at(name, message);
                Err(error
                    .note("expected a texture that is defined before this one")
                    .into())
            }
        }
    }

    /// The mapping from u and v to s and t.
    pub(super) fn mapping(&mut self) -> Result<UvMapping, Unusable> {
        match self.all.string("mapping")? {
            None | Some("uv") => Ok(UvMapping {
                scale: [self.number("uscale", 1.0)?, self.number("vscale", 1.0)?],
                delta: [self.number("udelta", 0.0)?, self.number("vdelta", 0.0)?],
            }),
            Some(other) => {
                let unusable = self.unsupported("mapping", &format!("`{other}` mappings"));
                Err(unusable.note("supported is `uv`"))
            }
        }
    }

    /// `what`, which the parameter `name` asks for, is not supported.
    pub(super) fn unsupported(&self, name: &str, what: &str) -> Unusable {
        let diagnostic = Diagnostic::new(format!("{what} are not supported"));
        Unusable::new(what, diagnostic.at(self.all.place_of(name)))
    }
}
