//! The arrays of meshes: `P`, `indices`, `uv` and `N`.

use super::target::{ShapeRefusal, ShapeResult};
use crate::error::{Diagnostic, Result};
use crate::geometry::Point;
use crate::parallel::CollectVec;
use crate::scene::parameters::{DeclaredType, Parameters};
use crate::scene::warnings::Warnings;
use rayon::prelude::*;

/// The points of `P`, three numbers each. Errors call their shape `mesh`, with its article.
pub(super) fn vertices_of(parameters: &mut Parameters, mesh: &str) -> ShapeResult<Vec<Point>> {
    let Some(coordinates) = parameters.numbers("P", DeclaredType::POINT)? else {
        let error = parameters.missing("P", format!("{mesh} without vertices"));
        return Err(ShapeRefusal::shape(
            "without vertices",
            error.note("expected \"point3 P\" [ ... ]"),
        ));
    };
    if !coordinates.len().is_multiple_of(3) {
        let message = format!(
            "`P` has {} numbers, expected three a vertex",
            coordinates.len()
        );
        return Err(ShapeRefusal::shape(
            "with parts of vertices",
            parameters.error_at("P", message),
        ));
    }
    Ok(coordinates
        .par_chunks_exact(3)
        .map(|p| Point::new(p[0], p[1], p[2]))
        .collect_vec())
}

/// The faces of `indices`, N vertices each; `None` without the parameter. Errors say that they
/// `expected` numbers like `three a triangle`. Excess numbers are dropped with a warning, as in
/// pbrt.
pub(super) fn faces_of<const N: usize>(
    parameters: &mut Parameters,
    vertex_count: usize,
    expected: &str,
    warnings: &mut Warnings,
) -> ShapeResult<Option<Vec<[u32; N]>>> {
    let Some(indices) = parameters.numbers("indices", DeclaredType::INTEGER)? else {
        return Ok(None);
    };
    let excess = indices.len() % N;
    if excess > 0 {
        let message = format!(
            "`indices` has {} numbers, expected {expected}: the last {excess} are dropped",
            indices.len()
        );
        let kind = format!("{} with excess indices", parameters.entity_name());
        warnings.add(kind, || {
            Diagnostic::new(message).at(parameters.place_of("indices"))
        });
    }
    let indices = &indices[..indices.len() - excess];
    let is_wrong = |index: &f64| !is_index(*index, vertex_count);
    if indices.par_iter().any(is_wrong)
        && let Some(place) = indices.iter().position(is_wrong)
    {
        let (index, position) = (indices[place], place + 1);
        let message = format!("index {index}, number {position} of `indices`, names no vertex");
        let expected = match vertex_count {
            0 => "the mesh has no vertices".to_owned(),
            count => format!("expected an integer from 0 to {}", count - 1),
        };
        let error = parameters
            .error_at_number("indices", place, message)
            .note(expected);
        return Err(ShapeRefusal::shape("with indices out of range", error));
    }
    let face = |corners: &[f64]| std::array::from_fn(|k| corners[k] as u32);
    Ok(Some(indices.par_chunks_exact(N).map(face).collect_vec()))
}

/// The two coordinates of each vertex in `uv`, or `st` in pbrt-v3. `None` without the parameter or,
/// with a warning, if it has too few numbers. Excess numbers are dropped.
pub(super) fn uv_of(
    parameters: &mut Parameters,
    vertex_count: usize,
    warnings: &mut Warnings,
) -> Result<Option<Vec<[f32; 2]>>> {
    for name in ["uv", "st"] {
        let Some(numbers) = parameters.numbers(name, DeclaredType::POINT2)? else {
            continue;
        };
        if numbers.len() != 2 * vertex_count {
            let (found, expected) = (numbers.len(), 2 * vertex_count);
            let outcome = if found < expected {
                "they are ignored"
            } else {
                "the rest are dropped"
            };
            let message = format!(
                "`{name}` has {found} numbers, expected two a vertex: {expected}; {outcome}"
            );
            parameters.warn(name, message, warnings);
        }
        let numbers = numbers.get(..2 * vertex_count);
        let uv = numbers.map(|numbers| {
            numbers
                .par_chunks_exact(2)
                .map(|uv| [uv[0] as f32, uv[1] as f32])
                .collect_vec()
        });
        return Ok(uv);
    }
    Ok(None)
}

/// The vertex normals of `N`. `None` without the parameter or, with a warning, if it has another
/// number of normals than there are vertices, as in pbrt.
pub(super) fn normals_of(
    parameters: &mut Parameters,
    vertex_count: usize,
    warnings: &mut Warnings,
) -> Result<Option<Vec<[f32; 3]>>> {
    let Some(numbers) = parameters.numbers("N", DeclaredType::NORMAL)? else {
        return Ok(None);
    };
    if numbers.len() != 3 * vertex_count {
        let (found, expected) = (numbers.len(), 3 * vertex_count);
        let message = format!(
            "`N` has {found} numbers, expected three a vertex: {expected}; they are ignored"
        );
        parameters.warn("N", message, warnings);
        return Ok(None);
    }
    let normal = |n: &[f64]| [n[0] as f32, n[1] as f32, n[2] as f32];
    Ok(Some(numbers.par_chunks_exact(3).map(normal).collect_vec()))
}

/// Whether `index` is an integer below `vertex_count` that fits 32 bits: only then does a
/// conversion there and back change nothing.
fn is_index(index: f64, vertex_count: usize) -> bool {
    let whole = index as u32;
    f64::from(whole) == index && (whole as usize) < vertex_count
}

#[cfg(test)]
mod tests {
    use super::is_index;

    #[test]
    fn indices_are_whole_and_in_range() {
        for index in [0.0, -0.0, 1.0, 4_294_967_295.0] {
            assert!(is_index(index, 1 << 32), "{index}");
        }
        for index in [
            -1.0,
            0.5,
            1e300,
            4_294_967_296.0,
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
        ] {
            assert!(!is_index(index, usize::MAX), "{index}");
        }
        assert!(is_index(6.0, 7) && !is_index(7.0, 7) && !is_index(0.0, 0));
    }
}
