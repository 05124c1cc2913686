//! The `Accelerator` directive.

use super::parameters::Parameters;
use crate::error::Result;

/// What the scene says about its aggregate; names are kept as written, since a scene does not know the methods.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct AcceleratorParameters {
    /// The name of the accelerator, where the scene has one.
    pub name: Option<String>,
    /// How to split.
    pub split_method: Option<String>,
    /// Primitives in a leaf at most.
    pub max_leaf: Option<u32>,
}

impl AcceleratorParameters {
    pub(super) fn read(parameters: &mut Parameters) -> Result<AcceleratorParameters> {
        let name = Some(parameters.entity_name().to_owned());
        // Parameters of accelerators that feimos does not have are no concern of anyone.
        if parameters.entity_name() != "bvh" {
            return Ok(AcceleratorParameters {
                name,
                ..AcceleratorParameters::default()
            });
        }
        let split_method = parameters.string("splitmethod")?.map(str::to_owned);
        // Larger ones are clamped, as in pbrt.
        let max_leaf = parameters
            .integer("maxnodeprims", 1, i32::MAX.into())?
            .map(|count| count.min(255) as u32);
        Ok(AcceleratorParameters {
            name,
            split_method,
            max_leaf,
        })
    }
}
