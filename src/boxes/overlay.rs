//! Edges of boxes over a depth picture.

use super::film_projection::{FilmPlace, FilmProjection};
use super::palette::{Palette, Rgb};
use crate::accel::NodeBox;
use crate::camera::Camera;
use crate::film::{ChannelName, ColorMap, ColorRange, Image, PixelBounds, view};
use std::io;

/// The edges of a box by its corners, as [`crate::geometry::Bounds::corners`] numbers them.
const EDGES: [[usize; 2]; 12] = [
    [0, 1],
    [2, 3],
    [4, 5],
    [6, 7],
    [0, 2],
    [1, 3],
    [4, 6],
    [5, 7],
    [0, 4],
    [1, 5],
    [2, 6],
    [3, 7],
];

/// The weight of the colour of an edge behind a surface.
const HIDDEN: f64 = 0.35;

/// The brightness of the depth picture: edges have to stand out against the nearest surface, which
/// would be white.
const DIMMED: f64 = 0.6;

/// An edge on a surface is in front of it: depths differ by more than this part.
const SLACK: f64 = 1e-3;

/// The colours of a depth picture in gray with the edges of `boxes` in the colours of `palette`,
/// row by row from the top. Edges behind surfaces are faint. Edges of nodes higher in the tree are
/// drawn over those of nodes below.
///
/// # Errors
/// The camera is spherical, or the image lacks `Z` or `A`.
pub fn draw_boxes(
    image: &Image,
    camera: &Camera,
    boxes: &[NodeBox],
    palette: &Palette,
) -> io::Result<Vec<Rgb>> {
    let invalid = |problem: &str| io::Error::new(io::ErrorKind::InvalidInput, problem);
    let film = FilmProjection::of(camera)
        .ok_or_else(|| invalid("edges are curves on the film of a spherical camera"))?;
    let range = ColorRange::of_depths(image).unwrap_or(ColorRange {
        start: 0.0,
        end: 0.0,
    });
    let dim = |pixel: Rgb| pixel.map(|x| (f64::from(x) * DIMMED).round() as u8);
    let pixels = view::depth(image, ColorMap::Gray, range)?;
    let pixels = pixels.into_iter().map(dim).collect();
    let depths = image.measures(ChannelName::Z);
    let depths = depths.ok_or_else(|| invalid("the image has no depths"))?;
    let mut picture = Picture {
        film,
        window: image.data_window,
        depths,
        pixels,
    };
    let mut deepest_first: Vec<&NodeBox> = boxes.iter().collect();
    deepest_first.sort_by_key(|one| std::cmp::Reverse(one.depth));
    for one in deepest_first {
        let corners = one.bounds.corners();
        for edge in EDGES {
            let ends = edge.map(|corner| corners[corner]);
            if let Some(ends) = picture.film.segment(ends) {
                picture.draw(ends, palette.color(one.depth));
            }
        }
    }
    Ok(picture.pixels)
}

/// A picture that edges are drawn over.
struct Picture<'a> {
    film: FilmProjection,
    window: PixelBounds,
    depths: &'a [f32],
    pixels: Vec<Rgb>,
}

impl Picture<'_> {
    /// Draws a segment, a pixel wide.
    fn draw(&mut self, ends: [FilmPlace; 2], color: Rgb) {
        let Some([start, end]) = clipped(&ends, &self.window) else {
            return;
        };
        let [from, to] = ends;
        let at = |part: f64| {
            let between = |a: f64, b: f64| a + (b - a) * part;
            FilmPlace {
                pixel: [0, 1].map(|k| between(from.pixel[k], to.pixel[k])),
                nearness: between(from.nearness, to.nearness),
            }
        };
        let (first, last) = (at(start).pixel, at(end).pixel);
        let length = (last[0] - first[0]).abs().max((last[1] - first[1]).abs());
        let steps = length.ceil().max(1.0);
        for step in 0..=steps as u32 {
            let place = at(start + (end - start) * f64::from(step) / steps);
            self.dot(&place, color);
        }
    }

    fn dot(&mut self, place: &FilmPlace, color: Rgb) {
        let window = self.window;
        let [x, y] = place.pixel.map(f64::floor);
        let (columns, rows) = (window.x0..window.x1, window.y0..window.y1);
        let (x, y) = (x as u32, y as u32);
        if !columns.contains(&x) || !rows.contains(&y) {
            return;
        }
        let index = (y - window.y0) as usize * window.width() as usize + (x - window.x0) as usize;
        let depth = self.film.depth(place.nearness);
        let is_hidden = f64::from(self.depths[index]) < depth * (1.0 - SLACK);
        let weight = if is_hidden { HIDDEN } else { 1.0 };
        let under = self.pixels[index];
        self.pixels[index] = std::array::from_fn(|k| {
            let (under, over) = (f64::from(under[k]), f64::from(color[k]));
            (under + (over - under) * weight).round() as u8
        });
    }
}

/// The parts of a segment, from 0 to 1, at which it enters and leaves the window (Liang and Barsky,
/// 1984).
fn clipped(ends: &[FilmPlace; 2], window: &PixelBounds) -> Option<[f64; 2]> {
    let limits = [[window.x0, window.x1], [window.y0, window.y1]].map(|ends| ends.map(f64::from));
    let (mut enters, mut leaves) = (0.0, 1.0);
    for (axis, [low, high]) in limits.into_iter().enumerate() {
        let (from, to) = (ends[0].pixel[axis], ends[1].pixel[axis]);
        let along = to - from;
        if along == 0.0 {
            if from < low || from > high {
                return None;
            }
            continue;
        }
        let parts = [(low - from) / along, (high - from) / along];
        enters = f64::max(enters, parts[0].min(parts[1]));
        leaves = f64::min(leaves, parts[0].max(parts[1]));
    }
    (enters <= leaves).then_some([enters, leaves])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Projection, ScreenWindow};
    use crate::film::{Channel, Samples};
    use crate::geometry::{Bounds, Matrix};

    const SIDE: u32 = 20;

    /// The picture of a box from -0.5 to 0.5 in x and y at these depths, over a wall of depth 2.
    fn picture(near: f64, far: f64) -> Vec<Rgb> {
        let channel = |name, value| Channel {
            name,
            samples: Samples::F32(vec![value; (SIDE * SIDE) as usize]),
        };
        let image = Image {
            display_window: (SIDE, SIDE),
            data_window: PixelBounds::of_film(SIDE, SIDE),
            channels: vec![channel(ChannelName::Z, 2.0), channel(ChannelName::A, 1.0)],
        };
        let camera = Camera {
            world_from_camera: Matrix::IDENTITY,
            projection: Projection::Orthographic,
            screen_window: ScreenWindow::of_aspect(1.0),
            resolution: [SIDE; 2],
        };
        let bounds = Bounds {
            low: [-0.48, -0.48, near].into(),
            high: [0.48, 0.48, far].into(),
        };
        let one = NodeBox {
            bounds,
            depth: 0,
            is_leaf: true,
        };
        draw_boxes(&image, &camera, &[one], &Palette::new(0..=1)).unwrap()
    }

    #[test]
    fn edges_are_drawn_and_hidden_ones_are_faint() {
        let at = |pixels: &[Rgb], x: usize, y: usize| pixels[y * SIDE as usize + x];
        let color = Palette::new(0..=1).color(0);
        let (front, behind) = (picture(1.0, 1.5), picture(3.0, 4.0));
        let wall = at(&front, 10, 10);
        assert_eq!(wall, [153; 3], "the only depth is the nearest");
        for (x, y) in [(5, 5), (14, 5), (5, 14), (10, 5), (14, 9)] {
            assert_eq!(at(&front, x, y), color, "{x},{y}");
            let faint = at(&behind, x, y);
            assert!(faint != color && faint != wall, "{x},{y}");
        }
        let changed = front.iter().filter(|pixel| **pixel != wall).count();
        assert_eq!(changed, 4 * 9, "the outline of a square of ten pixels");
    }

    #[test]
    fn segments_are_cut_at_the_window() {
        let place = |x: f64, y: f64| FilmPlace {
            pixel: [x, y],
            nearness: 1.0,
        };
        let window = PixelBounds {
            x0: 10,
            x1: 20,
            y0: 0,
            y1: 10,
        };
        let parts = |a, b| clipped(&[a, b], &window);
        assert_eq!(parts(place(0.0, 5.0), place(40.0, 5.0)), Some([0.25, 0.5]));
        assert_eq!(parts(place(12.0, 5.0), place(13.0, 6.0)), Some([0.0, 1.0]));
        assert_eq!(parts(place(0.0, 5.0), place(0.0, 6.0)), None);
        assert_eq!(parts(place(0.0, 0.0), place(12.0, 20.0)), None);
        assert_eq!(
            parts(place(1e300, 5.0), place(-1e300, 5.0)).map(|p| p[0] <= p[1]),
            Some(true)
        );
    }
}
