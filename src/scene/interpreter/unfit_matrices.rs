//! Why a directive's matrix cannot be used, in words for messages.

use crate::scene::parser::TransformDirective;

/// Why the matrix of a directive, or its inverse, is not finite.
pub(super) fn why_not_finite(directive: &TransformDirective) -> &'static str {
    match directive {
        TransformDirective::Rotate([angle, ..]) if angle.is_finite() => {
            "the axis of this Rotate has no length, or one whose square is out of range"
        }
        TransformDirective::LookAt(_) => {
            "this LookAt has no direction: eye and look are one point, or up has no length"
        }
        TransformDirective::Scale(factors) if factors.contains(&0.0) => {
            "this Scale by 0 cannot be undone"
        }
        TransformDirective::Transform(_) | TransformDirective::ConcatTransform(_) => {
            "this matrix has no finite inverse"
        }
        _ => "the numbers of this transform are beyond the range of f64, or no numbers",
    }
}

/// Why 16 numbers are not an affine transform.
pub(super) fn why_unusable(m: &[f64; 16]) -> String {
    if m.iter().all(|entry| *entry == 0.0) {
        return "this matrix is 0 everywhere".to_owned();
    }
    format!(
        "the last row of this matrix is {} {} {} {}",
        m[3], m[7], m[11], m[15]
    )
}
