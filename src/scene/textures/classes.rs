//! The types of textures, and their parameters in pbrt-v3 and v4.

use super::definition::{Definition, Unusable};
use super::image_parameters;
use super::texture_parameters::TextureParameters;
use crate::error::Diagnostic;
use crate::scene::inputs::Inputs;
use crate::scene::parameters::Parameters;
use crate::texture::FloatTexture;
use std::collections::HashMap;
use std::sync::Arc;

/// The types that are supported.
const SUPPORTED: [&str; 7] = [
    "constant",
    "scale",
    "mix",
    "checkerboard",
    "dots",
    "bilerp",
    "imagemap",
];

/// The texture with these parameters. `parts` are the textures that they name.
pub(super) fn texture(
    parameters: Parameters,
    parts: &HashMap<String, Arc<Definition>>,
    inputs: &mut Inputs,
) -> Result<FloatTexture, Unusable> {
    let class = parameters.entity_name();
    let mut made = TextureParameters {
        all: parameters,
        parts,
        inputs,
    };
    match class {
        "constant" => Ok(FloatTexture::Constant(made.number("value", 1.0)?)),
        "scale" => made.scale(),
        "mix" => Ok(FloatTexture::Mix {
            of: [made.part("tex1", 0.0)?, made.part("tex2", 1.0)?],
            amount: made.part("amount", 0.5)?,
        }),
        "checkerboard" => made.checkerboard(),
        "dots" => Ok(FloatTexture::Dots {
            mapping: made.mapping()?,
            of: [made.part("inside", 1.0)?, made.part("outside", 0.0)?],
        }),
        "bilerp" => Ok(FloatTexture::Bilerp {
            mapping: made.mapping()?,
            corners: [
                made.number("v00", 0.0)?,
                made.number("v01", 1.0)?,
                made.number("v10", 0.0)?,
                made.number("v11", 1.0)?,
            ],
        }),
        "imagemap" => image_parameters::texture(&mut made),
        _ => {
            let diagnostic =
                Diagnostic::new(format!("textures of type `{class}` are not supported"));
            let diagnostic = diagnostic
                .at(made.all.place_of_name())
                .note(format!("supported are {}", SUPPORTED.join(", ")));
            Err(Unusable::new(format!("texture {class}"), diagnostic))
        }
    }
}

impl TextureParameters<'_, '_> {
    /// pbrt-v4 calls the factors `tex` and `scale`, pbrt-v3 `tex1` and `tex2`.
    fn scale(&mut self) -> Result<FloatTexture, Unusable> {
        let is_of_v3 = self.all.has("tex1") || self.all.has("tex2");
        let names = if is_of_v3 {
            ["tex1", "tex2"]
        } else {
            ["tex", "scale"]
        };
        Ok(FloatTexture::Scale([
            self.part(names[0], 1.0)?,
            self.part(names[1], 1.0)?,
        ]))
    }

    fn checkerboard(&mut self) -> Result<FloatTexture, Unusable> {
        if self.all.integer("dimension", 2, 3)? == Some(3) {
            return Err(self.unsupported("dimension", "checkerboards of three dimensions"));
        }
        Ok(FloatTexture::Checkerboard {
            mapping: self.mapping()?,
            of: [self.part("tex1", 1.0)?, self.part("tex2", 0.0)?],
        })
    }
}
