//! The view of a bare mesh: from its front, as large as the film allows.

use super::parser::TransformDirective;
use super::transform_history::{TransformHistory, TransformStep};
use crate::camera::ScreenWindow;
use crate::geometry::{Bounds, Point, Transform, Vector};
use rayon::prelude::*;

/// The field of view in degrees, across the shorter side of the film.
pub(super) const FIELD_OF_VIEW: f64 = 40.0;

/// A mesh thinner than this part of its size would be hard to see along its edge.
const FLAT: f64 = 0.01;

/// The part of the film's width, or of its height, that stays free on each side of the mesh.
const MARGIN: f64 = 0.05;

/// The least distance of the eye from the nearest vertex, in radii of the mesh.
const LEAST_DISTANCE: f64 = 0.1;

/// Where the camera of a bare mesh stands.
pub(super) struct AutomaticView {
    /// Camera space from world space. Roundings count from the eye on: there it is meant to be.
    pub(super) camera_from_world: Transform,
    /// The directives that make this transform.
    directives: [TransformDirective; 2],
}

impl AutomaticView {
    /// The view of `vertices`, seen from +z with y up and x to the right: as their maker sees them,
    /// not mirrored by pbrt's left-handed camera. A mesh that is flat in x or y is seen from the
    /// side and above as well. Its image touches the margin of `window` on two opposite sides.
    ///
    /// `None` if its numbers are too large.
    pub(super) fn of(vertices: &[Point], window: &ScreenWindow) -> Option<AutomaticView> {
        let mut bounds = Bounds::of(vertices.iter().copied().filter(|vertex| vertex.is_finite()));
        if bounds.is_empty() {
            bounds = Bounds::of([Point::new(0.0, 0.0, 0.0)]);
        }
        let centre = bounds.centre();
        let half = bounds.high - centre;
        let radius = radius(half, centre);
        let is_flat = half.x.min(half.y) < FLAT * radius;
        let ahead = match is_flat {
            true => Vector::new(-1.0, -1.0, -2.0).normalized(),
            false => Vector::new(0.0, 0.0, -1.0),
        };
        let up = Vector::new(0.0, 1.0, 0.0);
        let right = up.cross(ahead).normalized();
        let axes = [right, ahead.cross(right), ahead];
        let fit = Fit {
            vertices,
            centre,
            axes,
            slopes: slopes(window),
        };
        let eye = fit.eye(LEAST_DISTANCE * radius);
        let eye = ((centre + axes[0] * eye[0]) + axes[1] * eye[1]) + axes[2] * eye[2];
        // At least 1, so that tiny meshes have a direction.
        let look = eye + ahead * radius.max(1.0);
        let mirror = [-1.0, 1.0, 1.0];
        let camera_from_world = Transform::scale(mirror).times(&Transform::look_at(eye, look, up)?);
        let look_at = [
            eye.x, eye.y, eye.z, look.x, look.y, look.z, up.x, up.y, up.z,
        ];
        let is_finite = camera_from_world.inverse.is_finite();
        is_finite.then_some(AutomaticView {
            camera_from_world,
            directives: [
                TransformDirective::Scale(mirror),
                TransformDirective::LookAt(look_at),
            ],
        })
    }

    /// The directives of a scene with this camera, and a shape under the identity.
    pub(super) fn history(&self) -> TransformHistory {
        let mut history = TransformHistory::default();
        history.shapes.push(TransformHistory::IDENTITY);
        for directive in &self.directives {
            history.camera = history.add(TransformStep::Directive(history.camera, *directive));
        }
        history
    }
}

/// Half the diagonal of a box with these half sides around `centre`. A point gets a radius that its
/// coordinates can resolve.
fn radius(half: Vector, centre: Point) -> f64 {
    const OF_POINT: f64 = 1.0 / 1024.0;
    let largest = half.x.max(half.y).max(half.z);
    if largest > 0.0 {
        // Squares of tiny numbers would be 0.
        let part = half * (1.0 / largest);
        let length = part.dot(part).sqrt() * largest;
        return if length > 0.0 { length } else { largest };
    }
    let farthest = centre
        .to_array()
        .into_iter()
        .map(f64::abs)
        .fold(0.0, f64::max);
    if farthest > 0.0 {
        OF_POINT * farthest
    } else {
        1.0
    }
}

/// How fast the usable width and height of the view grow with the distance from the eye.
fn slopes(window: &ScreenWindow) -> [f64; 2] {
    let tangent = (FIELD_OF_VIEW / 2.0).to_radians().tan();
    let usable = tangent * (1.0 - 2.0 * MARGIN);
    [window.x1 * usable, window.y1 * usable]
}

/// A mesh as seen along an axis.
struct Fit<'a> {
    vertices: &'a [Point],
    /// The middle of the mesh: the origin of all coordinates here.
    centre: Point,
    /// Right, up and ahead.
    axes: [Vector; 3],
    /// See [`slopes`].
    slopes: [f64; 2],
}

/// A vertex as the eye sees it along right or up: the tangent, the coordinate, and the distance
/// ahead of the eye.
type Seen = [f64; 3];

impl Fit<'_> {
    /// The coordinates of all finite vertices along the axes.
    fn coordinates(&self) -> impl ParallelIterator<Item = [f64; 3]> {
        let finite = self.vertices.par_iter().filter(|vertex| vertex.is_finite());
        finite.map(|vertex| self.axes.map(|axis| axis.dot(*vertex - self.centre)))
    }

    /// The coordinates of the eye that is as near as possible, but `least` away from the vertices.
    ///
    /// A side of the view is a plane that rises with a slope. The nearest one that has all vertices
    /// on one side, and that on the other side of the view, meet where the eye may be at most.
    fn eye(&self, least: f64) -> [f64; 3] {
        let larger = |a: [f64; 5], b: [f64; 5]| std::array::from_fn(|k| a[k].max(b[k]));
        let of_vertex = |[x, y, depth]: [f64; 3]| {
            let [wide, high] = self.slopes.map(|slope| slope * depth);
            [x - wide, -x - wide, y - high, -y - high, -depth]
        };
        let offsets = self.coordinates().map(of_vertex);
        let [right, left, above, below, back] = offsets.reduce(|| [f64::NEG_INFINITY; 5], larger);
        if !back.is_finite() {
            return [0.0, 0.0, -least];
        }
        let [x, y] = [[right, left], [above, below]].map(|[high, low]| 0.5 * (high - low));
        let depths = [right + left, above + below];
        let depths = [0, 1].map(|k| -0.5 * depths[k] / self.slopes[k]);
        let depth = depths[0].min(depths[1]).min(-back - least);
        let at = |k: usize, place: f64| match depth < depths[k] {
            true => self.centred(k, place, depth),
            false => place,
        };
        [at(0, x), at(1, y), depth]
    }

    /// The coordinate of the eye along axis `k` at which the mesh is in the middle of the film, for
    /// an eye at `depth`. Starts at `place`, and stays there if it does not come nearer.
    fn centred(&self, k: usize, mut place: f64, depth: f64) -> f64 {
        const PASSES: usize = 4;
        let mut best = (f64::INFINITY, place);
        for _ in 0..PASSES {
            let seen = |at: [f64; 3]| [(at[k] - place) / (at[2] - depth), at[k], at[2] - depth];
            let [low, high] = self.coordinates().map(seen).map(|seen| [seen; 2]).reduce(
                || [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]],
                |a, b| [lower(a[0], b[0]), higher(a[1], b[1])],
            );
            let reach = high[0].max(-low[0]);
            if reach.is_nan() || reach >= best.0 {
                break;
            }
            best = (reach, place);
            // Here these two vertices are equally far from the middle.
            let weight = low[2] / (high[2] + low[2]);
            place = high[1] * weight + low[1] * (1.0 - weight);
        }
        best.1
    }
}

/// The one of two vertices with the lower tangent. The others decide ties, so that the order of the
/// vertices never matters.
fn lower(a: Seen, b: Seen) -> Seen {
    if b < a { b } else { a }
}

fn higher(a: Seen, b: Seen) -> Seen {
    if b > a { b } else { a }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The image of `vertices` on a film of `width` by `height`, each from -1 to 1: lowest and
    /// highest x and y.
    fn seen(vertices: &[Point], width: f64, height: f64) -> [[f64; 2]; 2] {
        let window = ScreenWindow::of_aspect(width / height);
        let view = AutomaticView::of(vertices, &window).unwrap();
        let tangent = (FIELD_OF_VIEW / 2.0).to_radians().tan();
        let mut range = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        for vertex in vertices {
            let [x, y, z] = view.camera_from_world.matrix.apply(*vertex).to_array();
            assert!(z > 0.0, "{vertex:?} is behind the eye");
            for (k, (a, side)) in [(x, window.x1), (y, window.y1)].into_iter().enumerate() {
                let at = a / z / (tangent * side);
                range[k] = [range[k][0].min(at), range[k][1].max(at)];
            }
        }
        range
    }

    /// Corners of a box.
    fn corners(low: [f64; 3], high: [f64; 3]) -> Vec<Point> {
        let side = |bit: usize, k: usize| if bit >> k & 1 == 0 { low[k] } else { high[k] };
        (0..8)
            .map(|bit| Point::new(side(bit, 0), side(bit, 1), side(bit, 2)))
            .collect()
    }

    #[test]
    fn the_tighter_side_of_the_film_is_filled() {
        let spread = 1.0 - 2.0 * MARGIN;
        let is_near = |a: f64, b: f64| (a - b).abs() < 1e-6;
        for scale in [1.0, 1e-300, 3e100, 1e-12] {
            for (low, high) in [
                ([-1.0, 2.0, -3.0], [5.0, 4.0, 1.0]),
                ([0.0, 0.0, 0.0], [1.0, 9.0, 1.0]),
                ([-1.0, -1.0, 0.0], [1.0, 1.0, 0.0]),
                ([-3.0, 0.0, -1.0], [1.0, 0.0, 1.0]),
                ([7.0, 7.0, -8.0], [7.0, 7.0, 8.0]),
            ] {
                let vertices = corners(low.map(|a| scale * a), high.map(|a| scale * a));
                for (width, height) in [(1280.0, 720.0), (300.0, 1000.0), (1.0, 1.0)] {
                    let range = seen(&vertices, width, height);
                    let fills =
                        |k: usize| is_near(range[k][0], -spread) && is_near(range[k][1], spread);
                    let fits =
                        |k: usize| range[k][0] > -spread - 1e-6 && range[k][1] < spread + 1e-6;
                    let context = format!("{low:?} {high:?} * {scale} {width} {height} {range:?}");
                    assert!(fills(0) || fills(1), "{context}");
                    let is_centred = |k: usize| is_near(range[k][0], -range[k][1]);
                    assert!(is_centred(0) && is_centred(1), "{context}");
                    assert!(fits(0) && fits(1), "{context}");
                }
            }
        }
    }

    #[test]
    fn x_points_right_and_y_up() {
        let range = |vertices: &[Point]| {
            let window = ScreenWindow::of_aspect(1.0);
            AutomaticView::of(vertices, &window)
                .unwrap()
                .camera_from_world
                .inverse
        };
        let camera = range(&corners([-1.0, 2.0, -3.0], [5.0, 4.0, 1.0]));
        let [eye_x, eye_y, eye_z] = camera.column(3);
        assert_eq!((eye_x, eye_y), (2.0, 3.0));
        assert!(eye_z > 1.0);
        assert_eq!(camera.column(0), [1.0, 0.0, 0.0]);
        assert_eq!(camera.column(1), [0.0, 1.0, 0.0]);
        assert_eq!(camera.column(2), [0.0, 0.0, -1.0]);
    }

    #[test]
    fn points_have_a_view_and_huge_boxes_have_none() {
        let has_view = |vertices: &[Point]| {
            AutomaticView::of(vertices, &ScreenWindow::of_aspect(1.0)).is_some()
        };
        assert!(has_view(&[]));
        assert!(has_view(&[Point::new(f64::NAN, 0.0, 0.0)]));
        for at in [0.0, 1.0, -1e15, 1e-310, 1e150] {
            assert!(has_view(&[Point::new(at, at, at)]), "{at}");
        }
        assert!(!has_view(&corners([-1e308, 0.0, 0.0], [1e308, 1.0, 1.0])));
    }
}
