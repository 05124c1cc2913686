//! What a person reads about a scene: a line a subject, in aligned columns.

use crate::cli::terminal::scene_summary::stored_geometry;
use crate::cli::terminal::words::counted;
use crate::cli::terminal::words::{INDENT, line};
use feimos::camera::Camera;
use feimos::error::printable;
use feimos::film::PixelBounds;
use feimos::geometry::Bounds;
use feimos::scene::{Boundary, Film, Listed, Scene, ShapeCount, UnusedObject};
use indicatif::HumanCount;
use std::fmt::{self, Display, Formatter};
use std::path::Path;

/// Characters of a line at most, unless a word is longer.
const WIDTH: usize = 100;

/// Of a type of shape, at most.
const NAME_WIDTH: usize = 40;

/// All of it.
pub(super) struct Block<'a> {
    path: &'a Path,
    scene: &'a Scene,
}

impl<'a> Block<'a> {
    pub(super) fn new(path: &'a Path, scene: &'a Scene) -> Block<'a> {
        Block { path, scene }
    }
}

impl Display for Block<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Scene {
            camera,
            film,
            geometry,
            census,
            transform_count,
            ..
        } = self.scene;
        writeln!(f, "{}", printable(&self.path.display().to_string()))?;
        line(f, "camera", &camera_in_words(camera))?;
        line(f, "film", &film_in_words(film))?;
        table(f, census.shapes())?;
        line(f, "geometry", &stored_geometry(geometry))?;
        line(f, "bounds", &bounds_in_words(&geometry.extent()))?;
        let transforms = counted(*transform_count as u64, "transform");
        line(
            f,
            "memory",
            &format!("{transforms}, {}", counted(geometry.bytes() as u64, "byte")),
        )?;
        list(f, "directives", census.obeyed())?;
        list(f, "skipped", census.skipped())?;
        list(f, "unknown", census.private())?;
        let boundary =
            |of: &Boundary| format!("{}, {}", printable(&of.shape), printable(&of.place));
        listed(
            f,
            "media",
            "rays pass through what only bounds a medium",
            census.boundaries(),
            boundary,
        )?;
        let object =
            |of: &UnusedObject| format!("{}, {}", printable(&of.name), printable(&of.place));
        listed(
            f,
            "unused",
            "no instance shows these objects",
            census.unused_objects(),
            object,
        )
    }
}

/// What there is of something that is not in the picture, a line each, if there is any.
fn listed<T>(
    f: &mut Formatter<'_>,
    subject: &str,
    what: &str,
    listed: &Listed<T>,
    in_words: impl Fn(&T) -> String,
) -> fmt::Result {
    if listed.count == 0 {
        return Ok(());
    }
    line(f, subject, &format!("{}: {what}", HumanCount(listed.count)))?;
    listed
        .first
        .iter()
        .try_for_each(|one| line(f, "", &in_words(one)))?;
    match listed.count - listed.first.len() as u64 {
        0 => Ok(()),
        more => line(f, "", &format!("and {} more", HumanCount(more))),
    }
}

/// What there is of each type of shape.
fn table<'a>(
    f: &mut Formatter<'_>,
    shapes: impl Iterator<Item = (&'a str, ShapeCount)>,
) -> fmt::Result {
    let name = |name: &str| printable(name).chars().take(NAME_WIDTH).collect::<String>();
    let rows: Vec<(String, ShapeCount)> = shapes.map(|(of, count)| (name(of), count)).collect();
    if rows.is_empty() {
        return line(f, "shapes", "none");
    }
    let width = rows
        .iter()
        .map(|(name, _)| name.chars().count())
        .max()
        .unwrap_or(0);
    line(
        f,
        "shapes",
        &format!("{:width$}  statements  primitives", ""),
    )?;
    for (
        name,
        ShapeCount {
            statements,
            primitives,
            is_left_out,
        },
    ) in rows
    {
        let primitives = if is_left_out {
            "left out".to_owned()
        } else {
            HumanCount(primitives).to_string()
        };
        let counts = format!(
            "{:>10}  {primitives:>10}",
            HumanCount(statements).to_string()
        );
        line(f, "", &format!("{name:<width$}  {counts}"))?;
    }
    Ok(())
}

/// How often each name occurs, if any does, in lines that are not too long.
fn list<'a>(
    f: &mut Formatter<'_>,
    subject: &str,
    counts: impl Iterator<Item = (&'a str, u64)>,
) -> fmt::Result {
    let mut lines: Vec<String> = Vec::new();
    for (name, count) in counts {
        let item = format!("{} {}", HumanCount(count), printable(name));
        match lines.last_mut() {
            Some(last) if INDENT + last.len() + 2 + item.len() < WIDTH => {
                last.push_str(&format!(", {item}"))
            }
            Some(last) => {
                last.push(',');
                lines.push(item);
            }
            None => lines.push(item),
        }
    }
    lines
        .iter()
        .enumerate()
        .try_for_each(|(place, text)| line(f, if place == 0 { subject } else { "" }, text))
}

fn camera_in_words(camera: &Camera) -> String {
    let kind = camera.projection.name();
    let fov = camera
        .projection
        .field_of_view()
        .map_or(String::new(), |fov| format!(", {} degrees", short(fov)));
    let (eye, direction) = (
        camera.anchor().to_array(),
        camera.view_direction().to_array(),
    );
    format!(
        "{kind}{fov}, at {}, towards {}",
        triple(eye),
        triple(direction)
    )
}

fn film_in_words(film: &Film) -> String {
    let [width, height] = film.resolution;
    let PixelBounds { x0, x1, y0, y1 } = film.crop;
    let crop = match film.crop == PixelBounds::of_film(width, height) {
        true => String::new(),
        false => format!(", of which {x0} to {x1} and {y0} to {y1}"),
    };
    let filename = film
        .filename
        .as_ref()
        .map_or(String::new(), |name| format!(", {name}"));
    format!("{width} x {height} pixels{crop}{filename}")
}

fn bounds_in_words(bounds: &Bounds) -> String {
    if bounds.is_empty() {
        return "nothing that can be hit".to_owned();
    }
    format!(
        "{} to {}",
        triple(bounds.low.to_array()),
        triple(bounds.high.to_array())
    )
}

fn triple(numbers: [f64; 3]) -> String {
    let [x, y, z] = numbers.map(short);
    format!("({x}, {y}, {z})")
}

/// Six digits, which are enough for people.
fn short(number: f64) -> String {
    let rounded: f64 = format!("{number:.5e}").parse().unwrap_or(number);
    match rounded.abs() {
        0.0 => "0".to_owned(),
        size if (1e-4..1e9).contains(&size) => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_are_short() {
        let cases = [
            (0.1 + 0.2, "0.3"),
            (-0.0, "0"),
            (1.0 / 3.0, "0.333333"),
            (123_456_789.0, "123457000"),
            (-1e300, "-1e300"),
            (1.5e-7, "1.5e-7"),
            (f64::INFINITY, "inf"),
        ];
        for (number, expected) in cases {
            assert_eq!(short(number), expected);
        }
    }
}
