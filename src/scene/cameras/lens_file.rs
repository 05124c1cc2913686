//! Lens files of pbrt's realistic cameras, read as thick lenses (rule R11).

use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::input;
use std::path::Path;

/// The most surfaces of a lens.
const MOST_SURFACES: usize = 1000;

/// The most bytes of a lens file.
const MOST_BYTES: u64 = 1 << 20;

/// The paraxial properties of a lens, in millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ThickLens {
    /// The effective focal length: above 0.
    pub(super) focal_length: f64,
    /// The distance from the principal plane of the film's side to that of the scene's side.
    span: f64,
}

/// A surface of a lens, from the scene to the film; lengths in millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Surface {
    /// The radius of curvature: above 0 if the centre is on the film's side; 0 for an aperture.
    radius: f64,
    /// The distance to the next surface.
    thickness: f64,
    /// The index of refraction behind the surface.
    index: f64,
}

impl ThickLens {
    /// A thin lens of 50 mm, in place of one that is unknown.
    pub(super) const NORMAL: ThickLens = ThickLens {
        focal_length: 50.0,
        span: 0.0,
    };

    /// Reads the lens file `path`.
    ///
    /// # Errors
    /// The file cannot be read, or is no lens that makes an image.
    pub(super) fn read(path: &Path) -> Result<ThickLens> {
        input::refuse_special(path)?;
        let refuse = |message: String| {
            let diagnostic = Diagnostic::new(message).at(SourceLocation::file(path));
            let expected = "expected four numbers a surface: the radius of curvature, thickness, \
                            index of refraction and aperture, in millimetres";
            Error::bad_input(diagnostic.note(expected))
        };
        let size = std::fs::metadata(path).map_or(0, |metadata| metadata.len());
        if size > MOST_BYTES {
            return Err(refuse(format!("a lens file of {size} bytes")));
        }
        let bytes = input::read(path)?;
        ThickLens::parse(&String::from_utf8_lossy(&bytes)).map_err(refuse)
    }

    /// The lens of a file with this text.
    fn parse(text: &str) -> std::result::Result<ThickLens, String> {
        let surfaces = surfaces_of(text)?;
        ThickLens::of(&surfaces).ok_or_else(|| "this lens has no focal length above 0".to_owned())
    }

    /// Traces a paraxial ray from each side. `None` if the lens does not make an image.
    fn of(surfaces: &[Surface]) -> Option<ThickLens> {
        let [(focal_length, behind), (_, before)] = [
            trace(surfaces.iter().copied()),
            trace(turned_round(surfaces).into_iter()),
        ];
        let gaps = &surfaces[..surfaces.len().saturating_sub(1)];
        let length: f64 = gaps.iter().map(|surface| surface.thickness).sum();
        let span = (length + before) + behind;
        let is_lens = focal_length > 0.0 && focal_length.is_finite() && span.is_finite();
        is_lens.then_some(ThickLens { focal_length, span })
    }

    /// The distance from the principal plane to the film, in millimetres, if the lens is focused at
    /// a distance from the film, in metres. That of infinity if it cannot be focused so close.
    pub(super) fn image_distance(&self, focus_distance: f64) -> f64 {
        let whole = 1000.0 * focus_distance - self.span;
        let root = 1.0 - 4.0 * self.focal_length / whole;
        if whole > 0.0 && root >= 0.0 {
            2.0 * self.focal_length / (1.0 + root.sqrt())
        } else {
            self.focal_length
        }
    }
}

/// The focal length, and how far the principal plane lies behind the last surface. The ray comes in
/// parallel to the axis, at the height 1.
fn trace(surfaces: impl Iterator<Item = Surface>) -> (f64, f64) {
    let (mut height, mut slope, mut index, mut gap) = (1.0, 0.0, 1.0, 0.0);
    for surface in surfaces {
        height += gap * slope;
        if surface.radius != 0.0 {
            let power = (surface.index - index) / surface.radius;
            slope = (index * slope - height * power) / surface.index;
        }
        (index, gap) = (surface.index, surface.thickness);
    }
    let focal_length = -1.0 / slope;
    (focal_length, -height / slope - focal_length)
}

/// The same lens, from the film to the scene.
fn turned_round(surfaces: &[Surface]) -> Vec<Surface> {
    let turned = |k: usize| {
        let next = k.checked_sub(1).map(|k| surfaces[k]);
        Surface {
            radius: -surfaces[k].radius,
            thickness: next.map_or(0.0, |next| next.thickness),
            index: next.map_or(1.0, |next| next.index),
        }
    };
    (0..surfaces.len()).rev().map(turned).collect()
}

/// The surfaces of a file: four numbers each, with comments from `#` to the end of the line.
fn surfaces_of(text: &str) -> std::result::Result<Vec<Surface>, String> {
    let lines = text
        .lines()
        .map(|line| line.split('#').next().unwrap_or(""));
    let words = lines.flat_map(str::split_whitespace);
    let mut numbers: Vec<f64> = Vec::new();
    for word in words.take(4 * MOST_SURFACES + 1) {
        let number = word.parse().ok().filter(|number: &f64| number.is_finite());
        let shown: String = word.chars().take(40).collect();
        numbers.push(number.ok_or_else(|| format!("`{shown}` is not a number"))?);
    }
    let count = numbers.len();
    if count == 0 || !count.is_multiple_of(4) || count > 4 * MOST_SURFACES {
        return Err(format!("{count} numbers in a lens file"));
    }
    let surface = |numbers: &[f64]| Surface {
        radius: numbers[0],
        thickness: numbers[1],
        // pbrt writes air as 0.
        index: if numbers[2] == 0.0 { 1.0 } else { numbers[2] },
    };
    Ok(numbers.chunks_exact(4).map(surface).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_close(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
    }

    /// Two equal surfaces of radius r around glass of index n and thickness d: the lensmaker's
    /// equation.
    #[test]
    fn a_thick_lens_has_the_lensmakers_focal_length() {
        let (r, d, n) = (60.0, 9.0, 1.5);
        let lens = ThickLens::parse(&format!("# Glass\n{r} {d} {n} 20\n-{r} 0 0 20 # rear\n"));
        let lens = lens.unwrap();
        let power = (n - 1.0) * (2.0 / r - (n - 1.0) * d / (n * r * r));
        assert_close(lens.focal_length, 1.0 / power);
        // Each principal plane is d (n-1) f / (n r) inside.
        let inside = d * (n - 1.0) * lens.focal_length / (n * r);
        assert_close(lens.span, d - 2.0 * inside);
    }

    #[test]
    fn an_aperture_only_takes_room() {
        let plain = ThickLens::parse("60 1 1.5 20  -60 5 1 20").unwrap();
        let stopped = ThickLens::parse("0 7 0 9  60 1 1.5 20  -60 5 1 20").unwrap();
        assert_close(stopped.focal_length, plain.focal_length);
        assert_close(stopped.span, plain.span);
    }

    /// 1/s + 1/(T - s) = 1/f, with the film and the object T apart, but for the span.
    #[test]
    fn the_image_is_at_the_distance_of_the_lens_equation() {
        let lens = ThickLens {
            focal_length: 50.0,
            span: 8.0,
        };
        for focus in [0.25, 1.0, 10.0, 1e30] {
            let s = lens.image_distance(focus);
            let whole = 1000.0 * focus - 8.0;
            assert_close(1.0 / s + 1.0 / (whole - s), 1.0 / 50.0);
            assert!((50.0..=whole / 2.0).contains(&s));
        }
        assert_eq!(lens.image_distance(f64::INFINITY), 50.0);
        for close in [0.2, 0.0, -1.0, f64::NAN] {
            assert_eq!(lens.image_distance(close), 50.0, "{close}");
        }
    }

    #[test]
    fn other_files_are_refused() {
        let cases = [
            ("", "0 numbers in a lens file"),
            ("1 2 3", "3 numbers in a lens file"),
            ("1 2 3 wide", "`wide` is not a number"),
            ("1 2 3 inf", "`inf` is not a number"),
            ("0 1 0 9", "this lens has no focal length above 0"),
            (
                "-60 1 1.5 20  60 5 1 20",
                "this lens has no focal length above 0",
            ),
        ];
        for (text, message) in cases {
            assert_eq!(ThickLens::parse(text), Err(message.to_owned()), "{text}");
        }
        let many = "1 1 1 1 ".repeat(MOST_SURFACES + 1);
        assert_eq!(
            ThickLens::parse(&many),
            Err("4001 numbers in a lens file".to_owned())
        );
    }
}
