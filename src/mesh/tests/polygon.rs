use std::f64::consts::TAU;

use proptest::prelude::*;

use super::obj;
use crate::error::Result;
use crate::geometry::Point;
use crate::mesh::TriangleMesh;
use crate::mesh::polygon::{Clipper, triangulate};

fn flat(outline: &[[f64; 2]]) -> Vec<Point> {
    outline
        .iter()
        .map(|[x, y]| Point::new(*x, *y, 0.0))
        .collect()
}

fn cut_points(vertices: &[Point]) -> Result<Vec<[u32; 3]>> {
    let corners: Vec<u32> = (0..vertices.len() as u32).collect();
    let mut triangles = Vec::new();
    triangulate(&corners, vertices, &mut Clipper::default(), &mut triangles)?;
    assert_eq!(triangles.len(), vertices.len() - 2);
    Ok(triangles)
}

fn cut(outline: &[[f64; 2]]) -> Vec<[u32; 3]> {
    cut_points(&flat(outline)).expect("few corners")
}

fn fan(corners: u32) -> Vec<[u32; 3]> {
    (1..corners - 1).map(|k| [0, k, k + 1]).collect()
}

/// Twice the area, signed; of points in the plane of x and y.
fn area([a, b, c]: [u32; 3], vertices: &[Point]) -> f64 {
    let [a, b, c] = [a, b, c].map(|at| vertices[at as usize]);
    (b - a).cross(c - a).z
}

fn outline_area(vertices: &[Point]) -> f64 {
    fan(vertices.len() as u32)
        .into_iter()
        .map(|triangle| area(triangle, vertices))
        .sum()
}

/// No triangle lies outside of the outline: then the areas without their signs would add up to
/// more.
fn assert_covers(triangles: &[[u32; 3]], vertices: &[Point]) {
    let sum: f64 = triangles
        .iter()
        .map(|triangle| area(*triangle, vertices).abs())
        .sum();
    let expected = outline_area(vertices).abs();
    assert!(
        (sum - expected).abs() <= 1e-9 * expected,
        "{sum} instead of {expected}"
    );
}

fn covers(outline: &[[f64; 2]]) {
    assert_covers(&cut(outline), &flat(outline));
}

#[test]
fn cuts_convex_outlines_as_fans() {
    let octagon: Vec<_> = (0..8)
        .map(|k| f64::from(k) * TAU / 8.0)
        .map(|angle| [angle.cos(), angle.sin()])
        .collect();
    assert_eq!(cut(&octagon), fan(8));
    let reversed: Vec<_> = octagon.iter().rev().copied().collect();
    assert_eq!(cut(&reversed), fan(8));
    // Corners within the sides, and one twice.
    assert_eq!(
        cut(&[
            [0., 0.],
            [1., 0.],
            [2., 0.],
            [2., 0.],
            [2., 2.],
            [0., 2.],
            [0., 1.]
        ]),
        fan(7)
    );
}

#[test]
fn never_looks_at_triangles_and_quads() {
    assert_eq!(
        cut(&[[0., 0.], [2., 0.], [0.5, 0.5], [0., 2.]]),
        [[0, 1, 2], [0, 2, 3]]
    );
    assert_eq!(cut(&[[0., 0.], [0., 0.], [0., 0.]]), [[0, 1, 2]]);
}

/// A square with a dent at corner 3.
const DENTED: [[f64; 2]; 5] = [[0., 0.], [2., 0.], [2., 2.], [1., 0.5], [0., 2.]];

/// The documented order, by hand: 3 blocks 0 and 1, so that 2 is the first ear; then 3 bends to the
/// right, and 4 is one.
const DENTED_CUT: [[u32; 3]; 3] = [[1, 2, 3], [3, 4, 0], [0, 1, 3]];

#[test]
fn cuts_ears_in_the_documented_order() {
    assert_eq!(cut(&DENTED), DENTED_CUT);
    covers(&DENTED);
}

#[test]
fn covers_concave_outlines() {
    covers(&[[0., 0.], [2., 0.], [2., 1.], [1., 1.], [1., 2.], [0., 2.]]);
    // With corners within the sides.
    covers(&[
        [0., 0.],
        [1., 0.],
        [2., 0.],
        [2., 1.],
        [1.5, 1.],
        [1., 1.],
        [1., 2.],
        [0., 2.],
        [0., 1.],
    ]);
    // A square with a square hole, joined by a bridge.
    let hole = [
        [0., 0.],
        [4., 0.],
        [4., 4.],
        [0., 4.],
        [0., 0.],
        [1., 1.],
        [1., 3.],
        [3., 3.],
        [3., 1.],
        [1., 1.],
    ];
    covers(&hole);
}

#[test]
fn does_not_depend_on_the_direction_of_the_plane() {
    let planes: [fn(f64, f64) -> Point; 4] = [
        |u, v| Point::new(u, v, 1.0),
        |u, v| Point::new(v, u, 1.0),
        |u, v| Point::new(5.0, u, v),
        |u, v| Point::new(v, 3.0, -u),
    ];
    for plane in planes {
        let vertices: Vec<_> = DENTED.iter().map(|[u, v]| plane(*u, *v)).collect();
        assert_eq!(cut_points(&vertices), Ok(DENTED_CUT.to_vec()));
    }
}

#[test]
fn ends_on_every_kind_of_nonsense() {
    let star: Vec<_> = (0..5)
        .map(|k| f64::from(k) * TAU * 2.0 / 5.0)
        .map(|angle| [angle.cos(), angle.sin()])
        .collect();
    assert_ne!(
        cut(&star),
        fan(5),
        "a pentagram turns left everywhere, but twice around"
    );
    cut(&[[1., 1.]; 7]);
    cut(&[[0., 0.], [1., 0.], [2., 0.], [1., 0.], [3., 0.], [0.5, 0.]]);
    cut(&[[0., 0.], [1., 1.], [1., 0.], [0., 1.], [0., 0.5]]);
    assert_eq!(
        cut(&[[0., 0.], [1., 0.], [f64::NAN, 0.], [0., 1.], [0., 2.]]),
        fan(5)
    );
    assert_eq!(
        cut(&[
            [0., 0.],
            [1e308, 0.],
            [1e308, 1e308],
            [0.5, 0.5],
            [0., 1e308]
        ]),
        fan(5)
    );
}

fn star(corners: usize, radius: impl Fn(usize) -> f64) -> Vec<Point> {
    let at = |k: usize| (k as f64 * TAU / corners as f64, radius(k));
    (0..corners)
        .map(at)
        .map(|(angle, radius)| Point::new(radius * angle.cos(), radius * angle.sin(), 0.0))
        .collect()
}

/// A band that winds inwards: hard for a search for ears, since few corners can be cut at a time.
fn spiral(corners: usize) -> Vec<Point> {
    let half = corners / 2;
    let at = |k: usize, width: f64| {
        let angle = k as f64 * 0.1;
        let radius = 1.0 + 0.2 * angle + width;
        Point::new(radius * angle.cos(), radius * angle.sin(), 0.0)
    };
    (0..half)
        .map(|k| at(k, 0.0))
        .chain((0..half).rev().map(|k| at(k, 0.6)))
        .collect()
}

#[test]
fn cuts_large_outlines_in_a_moment() {
    for vertices in [
        spiral(10_000),
        star(10_000, |k| [1.0, 0.2][k % 2]),
        star(10_000, |k| 1.0 + (k as f64 * 0.37).sin() / 2.0),
    ] {
        assert_covers(&cut_points(&vertices).expect("simple outlines"), &vertices);
    }
}

#[test]
fn refuses_large_outlines_that_are_not_convex() {
    let message = |vertices: &[Point]| {
        cut_points(vertices)
            .expect_err("too many corners")
            .to_string()
    };
    let dented = star(10_001, |k| [1.0, 0.9][usize::from(k == 7)]);
    let expected =
        "a face of 10001 corners that is not convex\n   = at most 10000 corners are supported";
    assert_eq!(message(&dented), expected);
    assert_eq!(
        cut_points(&star(10_001, |_| 1.0)).map(|triangles| triangles.len()),
        Ok(9_999)
    );
}

fn mesh(name: &str) -> TriangleMesh {
    let path = format!("{}/tests/meshes/{name}", env!("CARGO_MANIFEST_DIR"));
    obj(std::fs::read(path).expect("part of the repository"))
        .expect("a good mesh")
        .mesh
}

#[test]
fn covers_outlines_that_other_programs_wrote() {
    let concave = mesh("concave_polygon.obj");
    assert_eq!((concave.vertices.len(), concave.triangles.len()), (64, 64));
    let wall = mesh("wallhole.obj");
    assert_eq!((wall.vertices.len(), wall.triangles.len()), (92, 66));
    // The areas of the outlines themselves.
    assert!((doubled_area(&concave) - 0.490_993_374_4).abs() < 1e-9);
    assert!((doubled_area(&wall) - 1_442.842_712_474_619_5).abs() < 1e-9);
}

fn doubled_area(mesh: &TriangleMesh) -> f64 {
    let corners = |triangle: &[u32; 3]| triangle.map(|at| mesh.vertices[at as usize]);
    let normal = |[a, b, c]: [Point; 3]| (b - a).cross(c - a);
    mesh.triangles
        .iter()
        .map(|triangle| normal(corners(triangle)))
        .map(|normal| normal.dot(normal).sqrt())
        .sum()
}

proptest! {
    #[test]
    fn covers_stars(radii in proptest::collection::vec(0.1..1.0, 5..40)) {
        let vertices = star(radii.len(), |k| radii[k]);
        assert_covers(&cut_points(&vertices).expect("few corners"), &vertices);
    }

    /// Points of a small grid: collinear, repeated and crossing in every way.
    #[test]
    fn ends_on_a_grid(outline in proptest::collection::vec((0..4_i32, 0..4_i32), 5..30)) {
        let outline: Vec<_> = outline.into_iter().map(|(x, y)| [f64::from(x), f64::from(y)]).collect();
        cut(&outline);
    }
}
