//! `Shape "nurbs"` and `Shape "heightfield"` of pbrt-v3: meshes over grids.

use super::target::{ShapeRefusal, ShapeResult, ShapeTarget};
use crate::error::{Error, Result};
use crate::mesh::height_field;
use crate::mesh::nurbs::{Direction, Homogeneous, MOST_ORDER, Mistake, Nurbs};
use crate::scene::parameters::{DeclaredType, Parameters};

/// The most points along a side.
const MOST_POINTS: i64 = 1 << 24;

/// The most heights of a field.
const MOST_HEIGHTS: usize = 1 << 30;

/// Adds the triangles of a NURBS surface (rule R8).
pub(super) fn add_nurbs(parameters: &mut Parameters, target: &mut ShapeTarget) -> ShapeResult<()> {
    let counts = [count_of(parameters, "nu")?, count_of(parameters, "nv")?];
    let u = direction(parameters, counts[0], ["uorder", "uknots", "u0", "u1"])?;
    let v = direction(parameters, counts[1], ["vorder", "vknots", "v0", "v1"])?;
    let control = control_points(parameters, counts)?;
    let mesh = Nurbs { u, v, control }.diced(target.corners());
    Ok(target.add_mesh(parameters, mesh)?)
}

/// Adds the triangles of heights over a grid (rule R9).
pub(super) fn add_height_field(
    parameters: &mut Parameters,
    target: &mut ShapeTarget,
) -> ShapeResult<()> {
    let [width, height] = [count_of(parameters, "nu")?, count_of(parameters, "nv")?];
    let Some(heights) = parameters.numbers("Pz", DeclaredType::FLOAT)? else {
        let error = parameters.missing("Pz", "a height field without heights");
        let error = error.note("expected \"float Pz\" [ ... ]");
        return Err(ShapeRefusal::shape("without heights", error));
    };
    let expected = width.saturating_mul(height);
    if expected > MOST_HEIGHTS {
        let message = format!("a height field of {width} times {height} heights");
        let error = parameters.error_at("nu", message);
        let error = error.note(format!("at most {MOST_HEIGHTS} are supported"));
        return Err(ShapeRefusal::shape("too large", error));
    }
    if heights.len() != expected {
        let found = heights.len();
        let message =
            format!("`Pz` has {found} heights, expected {expected}: {width} times {height}");
        let error = parameters.error_at("Pz", message);
        return Err(ShapeRefusal::shape("with another number of heights", error));
    }
    // As long as the array of heights: both sides fit 32 bits.
    let size = [width as u32, height as u32];
    let mesh = height_field::height_field(heights, size, target.keeps_uv);
    Ok(target.add_mesh(parameters, mesh)?)
}

/// A number of points, at least two: without it, pbrt leaves the shape out.
fn count_of(parameters: &mut Parameters, name: &'static str) -> ShapeResult<usize> {
    required(parameters, name, 2, MOST_POINTS)
}

fn required(
    parameters: &mut Parameters,
    name: &'static str,
    least: i64,
    most: i64,
) -> ShapeResult<usize> {
    match parameters.integer(name, least, most)? {
        Some(number) => Ok(number as usize),
        None => {
            let shape = parameters.entity_name();
            let error = parameters.missing(name, format!("a {shape} without `{name}`"));
            let error = error.note(format!("expected \"integer {name}\""));
            Err(ShapeRefusal::shape("without counts", error))
        }
    }
}

/// A direction with `count` control points: its order, knots, and the ends of its parameter.
fn direction(
    parameters: &mut Parameters,
    count: usize,
    [order_name, knots_name, from, to]: [&'static str; 4],
) -> ShapeResult<Direction> {
    let order = required(parameters, order_name, 2, MOST_ORDER as i64)?;
    let Some(knots) = parameters.numbers(knots_name, DeclaredType::FLOAT)? else {
        let error = parameters.missing(knots_name, format!("a nurbs without `{knots_name}`"));
        let error = error.note(format!("expected \"float {knots_name}\" [ ... ]"));
        return Err(ShapeRefusal::shape("without knots", error));
    };
    let range = [parameters.number(from)?, parameters.number(to)?];
    Direction::new(count, order, knots, range).map_err(|mistake| {
        let (error, advice): (Error, &str) = match mistake {
            Mistake::Knots(message) => (
                parameters.error_at(knots_name, message),
                "expected as many knots as control points and the order together",
            ),
            Mistake::Knot(place, message) => (
                parameters.error_at_number(knots_name, place, message),
                "expected finite numbers that never decrease",
            ),
            Mistake::Range(end, message) => (
                parameters.error_at([from, to][end], message),
                "expected a part of the surface",
            ),
        };
        ShapeRefusal::shape("that is no surface", error.note(advice))
    })
}

/// The control points of `P`, or of `Pw` with their weights.
fn control_points(
    parameters: &mut Parameters,
    [columns, rows]: [usize; 2],
) -> ShapeResult<Vec<Homogeneous>> {
    let points = parameters.numbers("P", DeclaredType::POINT)?;
    let (name, numbers, size) = match points {
        Some(numbers) => ("P", numbers, 3),
        None => match weighted_points(parameters)? {
            Some(numbers) => ("Pw", numbers, 4),
            None => {
                let error = parameters.missing("P", "a nurbs without control points");
                let error = error.note("expected \"point3 P\" or \"float Pw\"");
                return Err(ShapeRefusal::shape("without control points", error));
            }
        },
    };
    let expected = columns.saturating_mul(rows).saturating_mul(size);
    if numbers.len() != expected {
        let found = numbers.len();
        let message = format!(
            "`{name}` has {found} numbers, expected {expected}: {size} for each of {columns} times \
             {rows} points"
        );
        let error = parameters.error_at(name, message);
        return Err(ShapeRefusal::shape("with another number of points", error));
    }
    let point = |p: &[f64]| [p[0], p[1], p[2], p.get(3).copied().unwrap_or(1.0)];
    Ok(numbers.chunks_exact(size).map(point).collect())
}

fn weighted_points<'a>(parameters: &mut Parameters<'a>) -> Result<Option<&'a [f64]>> {
    parameters.numbers("Pw", DeclaredType::FLOAT)
}
