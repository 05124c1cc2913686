//! The parameter `alpha` of shapes.

use super::target::ShapeTarget;
use crate::error::{Diagnostic, Error, Result};
use crate::scene::parameters::Parameters;
use crate::scene::parser::Text;
use crate::scene::spelling;
use crate::scene::textures::{Definition, Unusable};
use crate::shape::Alpha;
use std::sync::Arc;

/// Where the surface of a shape is.
pub(super) enum Cover {
    /// Everywhere.
    Solid,
    /// Nowhere: rays do not meet the shape.
    Hidden,
    /// Where its alpha exceeds the cutoff.
    CutOut(Alpha),
}

/// Reads `alpha`: a number, or the name of a texture (rule A1). A texture that cannot be used is a
/// warning, and the surface is solid.
pub(super) fn read(parameters: &mut Parameters, target: &mut ShapeTarget) -> Result<Cover> {
    if !parameters.has("alpha") || target.bounds_medium {
        return Ok(Cover::Solid);
    }
    let cutoff = target.options.alpha_cutoff;
    let of_constant = |alpha: f64| match cutoff.keeps(alpha) {
        true => Cover::Solid,
        false => Cover::Hidden,
    };
    let Some(name) = parameters.texture("alpha")? else {
        let Some(alpha) = parameters.lone_number("alpha") else {
            let message = "`alpha` takes one number or a texture: the whole surface is solid";
            parameters.warn("alpha", message, target.warnings);
            return Ok(Cover::Solid);
        };
        return Ok(of_constant(alpha));
    };
    let Some(definition) = target.alpha.textures.find(name).cloned() else {
        warn_of_missing(name, parameters, target);
        return Ok(Cover::Solid);
    };
    let was_made = definition.is_made();
    match definition.texture(target.inputs) {
        Ok(texture) => {
            if !was_made {
                target.alpha.new_texture = Some(Arc::clone(&definition));
            }
            Ok(match texture.constant() {
                Some(alpha) => of_constant(alpha),
                None => Cover::CutOut(Alpha::new(Arc::clone(&texture), cutoff)),
            })
        }
        Err(Unusable {
            fatal: Some(kind),
            diagnostic,
            ..
        }) => Err(Error::new(kind, *diagnostic)),
        Err(unusable) => {
            warn_of_unusable(&definition, unusable, parameters, target);
            Ok(Cover::Solid)
        }
    }
}

fn warn_of_missing(name: &Text, parameters: &Parameters, target: &mut ShapeTarget) {
    let message = format!(
        "there is no float texture called `{}`: the whole surface is solid",
        name.text
    );
    let names: Vec<String> = target.alpha.textures.names().collect();
    let note = match spelling::closest(&name.text, names.iter().map(String::as_str)) {
        Some(known) => format!("did you mean `{known}`?"),
        None => "expected the name of a Texture \"float\" before the shape".to_owned(),
    };
    let diagnostic = || {
        Diagnostic::new(message)
            .at(parameters.place_of("alpha"))
            .note(note)
    };
    target.warnings.add("alpha of no texture", diagnostic);
}

fn warn_of_unusable(
    definition: &Definition,
    Unusable {
        kind, diagnostic, ..
    }: Unusable,
    parameters: &Parameters,
    target: &mut ShapeTarget,
) {
    target.warnings.add(format!("alpha by {kind}"), || {
        let named = format!(
            "alpha `{}` is used in {}",
            definition.name(),
            parameters.place_of("alpha")
        );
        let outcome = "surfaces with this alpha are solid";
        let message = format!("{}: {outcome}", diagnostic.message);
        let diagnostic = Diagnostic {
            message,
            ..*diagnostic
        };
        diagnostic.note(named)
    });
}
