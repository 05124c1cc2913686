//! Makes textures, and reads their images, when they are first needed.

use super::classes;
use super::definition::{Definition, MAX_SIZE, MAX_TEXT, Unusable};
use crate::scene::inputs::Inputs;
use crate::scene::parameters::Parameters;
use crate::texture::FloatTexture;
use std::sync::Arc;

impl Definition {
    /// The texture; reads its images if this is the first call.
    pub(crate) fn texture(&self, inputs: &mut Inputs) -> Result<Arc<FloatTexture>, Unusable> {
        self.made.get_or_init(|| self.make(inputs)).clone()
    }

    fn make(&self, inputs: &mut Inputs) -> Result<Arc<FloatTexture>, Unusable> {
        let Some(entity) = &self.entity else {
            let message = format!(
                "the texture `{}` is too large: it has more than {MAX_SIZE} textures in it, \
                 or {MAX_TEXT} bytes",
                self.name
            );
            return Err(Unusable::new("large texture", self.at.diagnostic(message)));
        };
        let parameters = Parameters::new("Texture", entity, &self.file)?;
        let made = classes::texture(parameters, &self.parts, inputs)?;
        Ok(made.constant().map_or_else(
            || Arc::new(made),
            |value| Arc::new(FloatTexture::Constant(value)),
        ))
    }
}
