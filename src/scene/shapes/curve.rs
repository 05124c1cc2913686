//! `Shape "curve"`.

use super::arrays::vertices_of;
use super::target::{ShapeRefusal, ShapeResult, ShapeTarget};
use crate::error::Diagnostic;
use crate::geometry::{Point, Vector};
use crate::mesh::curve::{self, Basis, BezierPiece};
use crate::scene::parameters::{DeclaredType, Parameters};
use crate::scene::spelling;
use crate::shape::CurvePoint;

/// What of a curve is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum CurveType {
    /// A strip that faces the ray.
    Flat,
    /// The same; only its normals are those of a tube.
    Cylinder,
    /// A strip across the normals of the file.
    Ribbon,
}

/// Adds a curve as pbrt reads it (rules R13 and E12).
pub(super) fn add(parameters: &mut Parameters, target: &mut ShapeTarget) -> ShapeResult<()> {
    parameters.ignore(&["splitdepth"]);
    let width = parameters.number("width")?.unwrap_or(1.0);
    let widths = [
        parameters.number("width0")?.unwrap_or(width),
        parameters.number("width1")?.unwrap_or(width),
    ];
    let degree = degree_of(parameters)?;
    let basis = basis_of(parameters)?;
    let control = vertices_of(parameters, "a curve")?;
    let count = piece_count(parameters, basis, degree, control.len())?;
    let curve_type = type_of(parameters, target)?;
    let normals = normals_of(parameters, target, curve_type, count)?;
    let pieces = curve::pieces(&control, degree, basis, widths);
    warn_if_never_hit(parameters, target, widths, &control);
    match normals {
        Some(normals) => add_ribbon(parameters, target, &pieces, &normals),
        None => add_segments(
            parameters,
            target,
            &pieces,
            curve_type == CurveType::Cylinder,
        ),
    }
}

fn degree_of(parameters: &mut Parameters) -> ShapeResult<usize> {
    match parameters.fixed_numbers("degree", DeclaredType::INTEGER)? {
        None => Ok(3),
        Some([degree]) if degree == 2.0 || degree == 3.0 => Ok(degree as usize),
        Some([degree]) => {
            let message = format!("`degree` is {degree}, expected 2 or 3");
            let error = parameters.error_at("degree", message);
            Err(ShapeRefusal::shape("of another degree", error))
        }
    }
}

fn basis_of(parameters: &mut Parameters) -> ShapeResult<Basis> {
    match parameters.string("basis")? {
        None | Some("bezier") => Ok(Basis::Bezier),
        Some("bspline") => Ok(Basis::BSpline),
        Some(other) => {
            let message = format!("`basis` is `{other}`, expected `bezier` or `bspline`");
            let error = parameters.error_at("basis", message);
            Err(ShapeRefusal::shape("of another basis", error))
        }
    }
}

fn piece_count(
    parameters: &Parameters,
    basis: Basis,
    degree: usize,
    points: usize,
) -> ShapeResult<usize> {
    basis.piece_count(degree, points).ok_or_else(|| {
        let expected = match basis {
            Basis::Bezier => format!(
                "{} of them, or {degree} more for each further piece",
                degree + 1
            ),
            Basis::BSpline => format!("at least {}", degree + 1),
        };
        let message = format!("a curve of degree {degree} has {points} control points");
        let error = parameters
            .error_at("P", message)
            .note(format!("expected {expected}"));
        ShapeRefusal::shape("with parts of pieces", error)
    })
}

/// The type of the curve. pbrt takes an unknown one for a cylinder.
fn type_of(parameters: &mut Parameters, target: &mut ShapeTarget) -> ShapeResult<CurveType> {
    const TYPES: [(&str, CurveType); 3] = [
        ("flat", CurveType::Flat),
        ("cylinder", CurveType::Cylinder),
        ("ribbon", CurveType::Ribbon),
    ];
    let Some(name) = parameters.string("type")? else {
        return Ok(CurveType::Flat);
    };
    if let Some((_, found)) = TYPES.iter().find(|(known, _)| *known == name) {
        return Ok(*found);
    }
    let note = match spelling::closest(name, TYPES.iter().map(|(known, _)| *known)) {
        Some(known) => format!("did you mean `{known}`?"),
        None => "expected `flat`, `cylinder` or `ribbon`".to_owned(),
    };
    let place = parameters.place_of("type");
    target.warnings.add("type of curve", || {
        let message = format!("a curve of the type `{name}` is taken for a `cylinder`, as in pbrt");
        Diagnostic::new(message).at(place).note(note)
    });
    Ok(CurveType::Cylinder)
}

/// The normals of a ribbon: one for the beginning of each piece, and one for the end.
fn normals_of(
    parameters: &mut Parameters,
    target: &mut ShapeTarget,
    curve_type: CurveType,
    pieces: usize,
) -> ShapeResult<Option<Vec<Vector>>> {
    if curve_type != CurveType::Ribbon {
        if parameters.has("N") {
            let message = "normals are ignored, as in pbrt: only a `ribbon` has normals of its own";
            parameters.warn("N", message, target.warnings);
        }
        return Ok(None);
    }
    let expected = format!("expected \"normal N\" with {} normals", pieces + 1);
    let Some(numbers) = parameters.numbers("N", DeclaredType::NORMAL)? else {
        let error = parameters
            .missing("N", "a ribbon without normals")
            .note(expected);
        return Err(ShapeRefusal::shape("without normals", error));
    };
    if numbers.len() != 3 * (pieces + 1) {
        let message = format!("`N` has {} numbers", numbers.len());
        let error = parameters.error_at("N", message).note(expected);
        return Err(ShapeRefusal::shape("with another number of normals", error));
    }
    let normal = |n: &[f64]| Vector::new(n[0], n[1], n[2]);
    Ok(Some(numbers.chunks_exact(3).map(normal).collect()))
}

fn warn_if_never_hit(
    parameters: &Parameters,
    target: &mut ShapeTarget,
    widths: [f64; 2],
    control: &[Point],
) {
    let matrix = &target.world_from_object;
    let message = if widths == [0.0; 2] {
        "a curve without a width is never hit"
    } else if !control.iter().all(|point| point.is_finite())
        || !widths.iter().all(|width| width.is_finite())
    {
        "parts of a curve that are infinite or not a number are never hit"
    } else if !matrix.is_finite() || matrix.is_singular() {
        "a curve under a singular or infinite transform is never hit"
    } else {
        return;
    };
    parameters.warn_at_name(message, Diagnostic::new(message), target.warnings);
}

fn add_ribbon(
    parameters: &Parameters,
    target: &mut ShapeTarget,
    pieces: &[BezierPiece],
    normals: &[Vector],
) -> ShapeResult<()> {
    // Two corners and two triangles a part, with their coordinates.
    const BYTES: u64 = (size_of::<Point>() + size_of::<[u32; 3]>() + 24) as u64;
    let count = curve::triangle_count(pieces, normals);
    check_room(parameters, target, count, BYTES)?;
    let mut mesh = curve::ribbon(pieces, normals);
    if !target.keeps_uv {
        mesh.uv = None;
    }
    Ok(target.add_mesh(parameters, mesh)?)
}

fn add_segments(
    parameters: &Parameters,
    target: &mut ShapeTarget,
    pieces: &[BezierPiece],
    is_round: bool,
) -> ShapeResult<()> {
    const BYTES: u64 = size_of::<CurvePoint>() as u64 + 8;
    let count = pieces.iter().map(|piece| 1u64 << piece.halvings()).sum();
    check_room(parameters, target, count, BYTES)?;
    let diced = curve::dice(pieces, is_round);
    Ok(target.add_curves(parameters, diced, count)?)
}

/// Charges the primitives before they are made: a few numbers can make a thousand of them.
fn check_room(
    parameters: &Parameters,
    target: &mut ShapeTarget,
    count: u64,
    bytes: u64,
) -> ShapeResult<()> {
    let charged = target
        .inputs
        .budget()
        .charge_stored(count.saturating_mul(bytes));
    Ok(charged.map_err(|error| error.or_at(|| parameters.place_of_name()))?)
}
