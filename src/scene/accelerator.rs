//! The `Accelerator` directive.

use super::parameters::Parameters;
use crate::error::Result;

/// The accelerator that the scene asks for, in its own words: a scene does not know the methods.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct AcceleratorParameters {
    /// The type of the accelerator, such as `bvh`.
    pub name: Option<String>,
    /// `splitmethod`.
    pub split_method: Option<String>,
    /// `maxnodeprims`: the most primitives in a leaf.
    pub max_leaf: Option<u32>,
}

impl AcceleratorParameters {
    pub(super) fn read(parameters: &mut Parameters) -> Result<AcceleratorParameters> {
        let name = Some(parameters.entity_name().to_owned());
        // Accelerators that feimos does not have may have any parameters.
        if parameters.entity_name() != "bvh" {
            return Ok(AcceleratorParameters {
                name,
                ..AcceleratorParameters::default()
            });
        }
        let split_method = parameters.string("splitmethod")?.map(str::to_owned);
        // Larger values are clamped, as in pbrt.
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
