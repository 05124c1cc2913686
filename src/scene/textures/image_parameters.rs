//! The parameters of `imagemap` textures.

use super::definition::Unusable;
use super::encoding::Encoding;
use super::image_refusal::ImageRefusal;
use super::texture_parameters::TextureParameters;
use crate::texture::{Filter, FloatTexture, ImageTexture, Wrap};
use std::path::Path;

/// The image texture with these parameters.
pub(super) fn texture(parameters: &mut TextureParameters) -> Result<FloatTexture, Unusable> {
    let mapping = parameters.mapping()?;
    let Some(filename) = parameters.all.path("filename")? else {
        let error = parameters
            .all
            .missing("filename", "an image texture without a file name");
        return Err(error
            .note("expected \"string filename\" \"leaf.png\"")
            .into());
    };
    let (wrap, filter) = (wrap(parameters)?, filter(parameters)?);
    let scale = parameters.number("scale", 1.0)?;
    let is_inverted = parameters.all.boolean("invert")?.unwrap_or(false);
    let encoding = encoding(parameters, &filename)?;
    let path = parameters.inputs.resolve(&filename);
    let texels = parameters.inputs.read_texels(&path, encoding).map_err(
        |ImageRefusal { diagnostic, fatal }| Unusable {
            kind: format!("image {}", path.display()),
            diagnostic: Box::new(
                diagnostic.note(format!("named in {}", parameters.all.place_of("filename"))),
            ),
            fatal,
        },
    )?;
    Ok(FloatTexture::Image(ImageTexture {
        mapping,
        texels,
        wrap,
        filter,
        scale,
        is_inverted,
    }))
}

fn wrap(parameters: &mut TextureParameters) -> Result<Wrap, Unusable> {
    match parameters.all.string("wrap")? {
        None | Some("repeat") => Ok(Wrap::Repeat),
        Some("black") => Ok(Wrap::Black),
        Some("clamp") => Ok(Wrap::Clamp),
        Some(other) => {
            let unusable = parameters.unsupported("wrap", &format!("`{other}` wraps of textures"));
            Err(unusable.note("supported are `repeat`, `black` and `clamp`"))
        }
    }
}

/// A ray has no width, so all filters but `point` are bilinear.
fn filter(parameters: &mut TextureParameters) -> Result<Filter, Unusable> {
    let name = parameters.all.string("filter")?;
    Ok(if name == Some("point") {
        Filter::Point
    } else {
        Filter::Bilinear
    })
}

/// `encoding` of pbrt-v4, `gamma` of pbrt-v3; by default sRGB for formats of bytes.
fn encoding(parameters: &mut TextureParameters, filename: &Path) -> Result<Encoding, Unusable> {
    if let Some(name) = parameters.all.string("encoding")? {
        return Encoding::of_name(name).ok_or_else(|| {
            let message = format!("`{name}` is not an encoding");
            let error = parameters.all.error_at("encoding", message);
            error
                .note("expected `linear`, `sRGB` or `gamma` and a number")
                .into()
        });
    }
    match parameters.all.boolean("gamma")? {
        Some(true) => return Ok(Encoding::Srgb),
        Some(false) => return Ok(Encoding::Linear),
        None => {}
    }
    let extension = filename.extension().unwrap_or_default();
    Ok(if extension.eq_ignore_ascii_case("exr") {
        Encoding::Linear
    } else {
        Encoding::Srgb
    })
}
