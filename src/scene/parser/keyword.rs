//! The names of directives.

/// Every keyword of pbrt-v2, v3 and v4, sorted.
pub const KEYWORDS: [&str; 45] = [
    "Accelerator",
    "ActiveTransform",
    "AreaLightSource",
    "Attribute",
    "AttributeBegin",
    "AttributeEnd",
    "Camera",
    "ColorSpace",
    "ConcatTransform",
    "CoordSysTransform",
    "CoordinateSystem",
    "Film",
    "Identity",
    "Import",
    "Include",
    "Integrator",
    "LightSource",
    "LookAt",
    "MakeNamedMaterial",
    "MakeNamedMedium",
    "Material",
    "MediumInterface",
    "NamedMaterial",
    "ObjectBegin",
    "ObjectEnd",
    "ObjectInstance",
    "Option",
    "PixelFilter",
    "Renderer",
    "ReverseOrientation",
    "Rotate",
    "Sampler",
    "Scale",
    "Shape",
    "SurfaceIntegrator",
    "Texture",
    "Transform",
    "TransformBegin",
    "TransformEnd",
    "TransformTimes",
    "Translate",
    "Volume",
    "VolumeIntegrator",
    "WorldBegin",
    "WorldEnd",
];

/// A keyword in the text, for the messages about its arguments.
#[derive(Debug, Clone, Copy)]
pub(super) struct Keyword<'a> {
    pub(super) name: &'static str,
    /// What is left of the text from the keyword on.
    pub(super) at: &'a [u8],
}

/// The place of the keyword that `word` is.
pub(super) fn number(word: &[u8]) -> Option<usize> {
    KEYWORDS
        .binary_search_by(|keyword| keyword.as_bytes().cmp(word))
        .ok()
}

/// The keyword that `word` is.
pub(super) fn known(word: &[u8]) -> Option<&'static str> {
    number(word).map(|number| KEYWORDS[number])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_every_keyword() {
        assert!(KEYWORDS.is_sorted());
        for keyword in KEYWORDS {
            assert_eq!(known(keyword.as_bytes()), Some(keyword));
        }
        assert_eq!(known(b"shape"), None);
    }
}
