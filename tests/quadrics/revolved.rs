//! Cones, paraboloids and hyperboloids.

use super::*;

/// A cone around the view, whose apex is at z = 5, and whose circle at z = 10. At distance d from
/// the axis it is at z = 5 + d.
const CONE: &str = "Translate 0 0 10 Scale 1 1 -1 \
                    Shape \"cone\" \"float radius\" 5 \"float height\" 5";

fn from_axis(x: i32, y: i32) -> f64 {
    f64::from(x * x + y * y).sqrt()
}

#[test]
fn a_cone_seen_from_its_apex() {
    let is_there = |x: i32, y: i32| x * x + y * y <= 25;
    let z = |x: i32, y: i32| 5.0 + from_axis(x, y);
    assert_grid(CONE, |x, y| is_there(x, y).then(|| z(x, y)));
    // The mirror keeps the angles about the axis.
    let three_quarters = format!("{CONE} \"float phimax\" 270");
    assert_grid(&three_quarters, |x, y| {
        (is_there(x, y) && !(x > 0 && y < 0)).then(|| z(x, y))
    });
    // The apex has the angle 0.
    let half_line = format!("{CONE} \"float phimax\" 0");
    assert_grid(&half_line, |x, y| {
        (y == 0 && (0..=5).contains(&x)).then(|| z(x, y))
    });
}

/// The axis is across the view: rays meet the equation x^2 + (z - 10)^2 = (y + 3)^2 for y from -3
/// to 2.
#[test]
fn a_cone_seen_from_the_side() {
    let cone = "Translate 0 2 10 Rotate 90 1 0 0 \
                Shape \"cone\" \"float radius\" 5 \"float height\" 5";
    let z = |x: i32, y: i32| {
        let wide = y + 3;
        (wide * wide >= x * x).then(|| 10.0 - f64::from(wide * wide - x * x).sqrt())
    };
    // Below the apex, only its own row is left; beside it the rays miss.
    assert_grid(
        cone,
        |x, y| if (-3..=2).contains(&y) { z(x, y) } else { None },
    );
    // The far half.
    let half = format!("{cone} \"float phimax\" 180");
    assert_grid(&half, |x, y| {
        if (-3..=2).contains(&y) {
            z(x, y).map(|z| 20.0 - z)
        } else {
            None
        }
    });
}

/// Rays parallel to the lines of a cone meet it once.
#[test]
fn rays_along_the_lines_of_a_cone() {
    // In object space rays run along (0, -1, 1) and meet x^2 + y^2 = (z - 4)^2 at one t.
    let cone = "Transform [ 1 0 0 0  0 1 0 0  0 1 1 0  0 0 10 1 ] \
                Shape \"cone\" \"float radius\" 4 \"float height\" 4";
    // q = (x, y - w, w) where z = 10 + w: x^2 + (y - w)^2 = (w - 4)^2.
    assert_grid(cone, |x, y| {
        let (x, y) = (f64::from(x), f64::from(y));
        let (a, b) = (16.0 - x * x - y * y, 8.0 - 2.0 * y);
        let w = a / b;
        (b != 0.0 && (0.0..=4.0).contains(&w)).then_some(10.0 + w)
    });
}

#[test]
fn the_sign_of_a_radius_does_not_matter() {
    for shape in ["cone", "paraboloid"] {
        for rest in ["", "\"float phimax\" 100"] {
            let of = |radius: i32| format!("Shape \"{shape}\" \"float radius\" {radius} {rest}");
            assert_alike(&of(-4), &of(4));
        }
    }
}

/// z = 10 - (x^2 + y^2) / 5, open towards the viewer, from z = 5 to 10.
#[test]
fn a_paraboloid_seen_along_its_axis() {
    let paraboloid = "Translate 0 0 10 Scale 1 1 -1 \
                      Shape \"paraboloid\" \"float radius\" 5 \"float zmax\" 5";
    let z = |x: i32, y: i32| 10.0 - f64::from(x * x + y * y) / 5.0;
    assert_grid(paraboloid, |x, y| (x * x + y * y <= 25).then(|| z(x, y)));
    let ring = format!("{paraboloid} \"float zmin\" 2 \"float phimax\" 90");
    assert_grid(&ring, |x, y| {
        ((10..=25).contains(&(x * x + y * y)) && x >= 0 && y >= 0).then(|| z(x, y))
    });
    // The ends may be in either order, and both may be below 0: then it opens downwards.
    let exchanged = "Translate 0 0 10 Scale 1 1 -1 Shape \"paraboloid\" \"float radius\" 5 \
                     \"float zmin\" 5 \"float zmax\" 2 \"float phimax\" 90";
    assert_grid(exchanged, |x, y| {
        ((10..=25).contains(&(x * x + y * y)) && x >= 0 && y >= 0).then(|| z(x, y))
    });
    let downwards = "Translate 0 0 10 Shape \"paraboloid\" \"float radius\" 1 \
                     \"float zmin\" -5 \"float zmax\" -1";
    assert_grid(downwards, |x, y| {
        let square = x * x + y * y;
        (1..=5).contains(&square).then(|| 10.0 - f64::from(square))
    });
}

/// From the side, tangents touch where x^2 = 5 (y + 2).
#[test]
fn a_paraboloid_seen_from_the_side() {
    let paraboloid = "Translate 0 -2 10 Rotate -90 1 0 0 \
                      Shape \"paraboloid\" \"float radius\" 5 \"float zmax\" 5";
    assert_grid(paraboloid, |x, y| {
        let under = 5 * (y + 2) - x * x;
        ((-2..=3).contains(&y) && under >= 0).then(|| 10.0 - f64::from(under).sqrt())
    });
}

/// x^2 + y^2 - z^2 = 1 about an axis across the view: the line from (1, -2, -2) to (1, 2, 2).
#[test]
fn a_hyperboloid_seen_from_the_side() {
    let hyperboloid = "Translate 0 0 10 Rotate -90 1 0 0 \
                       Shape \"hyperboloid\" \"point p1\" [ 1 -2 -2 ] \"point p2\" [ 1 2 2 ]";
    assert_grid(hyperboloid, |x, y| {
        let under = 1 + y * y - x * x;
        ((-2..=2).contains(&y) && under >= 0).then(|| 10.0 - f64::from(under).sqrt())
    });
}

/// Angles count from the line, which turns with the height. pbrt's loop computes 1 for both of its
/// coefficients, without an error.
#[test]
fn the_sector_of_a_hyperboloid_turns_with_its_line() {
    let along = "Translate 0 0 10 Shape \"hyperboloid\" \"point p1\" [ 1 -4 -4 ] \
                 \"point p2\" [ 1 1 1 ]";
    // Seen along the axis: z^2 = x^2 + y^2 - 1, so the nearer point is at z < 0.
    let heights = |x: i32, y: i32| {
        let height = f64::from(x * x + y * y - 1).sqrt();
        [-height, height]
            .into_iter()
            .filter(|z| (-4.0..=1.0).contains(z))
    };
    assert_grid(along, |x, y| heights(x, y).next().map(|z| 10.0 + z));
    // The line is at (1, z): its angle, and the one opposite to it, bound the half.
    let half = format!("{along} \"float phimax\" 180");
    assert_grid(&half, |x, y| {
        let is_within = |z: &f64| f64::from(y) - f64::from(x) * z >= 0.0;
        heights(x, y).find(is_within).map(|z| 10.0 + z)
    });
    // Only the line itself: (1, z, z).
    let line = format!("{along} \"float phimax\" 0");
    assert_grid(&line, |x, y| {
        (x == 1 && (-4..=1).contains(&y)).then(|| 10.0 + f64::from(y))
    });
}

/// The messages about some shapes, with their notes, and how often each occurs.
fn warnings(shapes: &[&str]) -> Vec<(String, u64)> {
    let text: String = shapes
        .iter()
        .map(|shape| format!("Shape {shape} "))
        .collect();
    let scene = scene_of(&format!("{GRID} WorldBegin {text}"));
    assert_eq!(scene.geometry.quadric_count(), shapes.len());
    let all = scene.warnings.iter();
    let text = |warning: &feimos::scene::Warning| {
        let notes = warning.first.notes.join("; ");
        (
            format!("{} ({notes})", warning.first.message),
            warning.count,
        )
    };
    all.map(text).collect()
}

/// Messages about shapes that are never hit, in the order of the file.
#[test]
fn shapes_without_points_are_named() {
    let cones = [
        "\"cone\" \"float radius\" 0",
        "\"cone\" \"float height\" 0",
        "\"cone\" \"float height\" -1",
        "\"cone\" \"float height\" 1e999",
    ];
    assert_eq!(
        warnings(&cones),
        [
            ("a cone of radius 0 is never hit ()".to_owned(), 1),
            (
                "a cone without points is never hit (expected a finite `height` above 0)"
                    .to_owned(),
                3
            ),
        ]
    );
    let paraboloids = [
        "\"paraboloid\" \"float zmax\" 0",
        "\"paraboloid\" \"float zmin\" nan",
    ];
    let expected = "a paraboloid without points is never hit (expected finite `zmin` and `zmax`, \
                    the larger of which is not 0)";
    assert_eq!(warnings(&paraboloids), [(expected.to_owned(), 2)]);
    let hyperboloids = [
        "\"hyperboloid\"",
        "\"hyperboloid\" \"point p1\" [ 1 0 1 ] \"point p2\" [ 2 0 1 ]",
        "\"hyperboloid\" \"point3 p1\" [ 1 0 3 ] \"point3 p2\" [ 2 0 1 ]",
    ];
    let expected = "a hyperboloid without points is never hit (expected points at different \
                    finite z, whose line does not meet the axis at z = 0)";
    assert_eq!(warnings(&hyperboloids), [(expected.to_owned(), 3)]);
}

#[test]
fn surfaces_under_a_singular_transform_are_named() {
    let singular = scene_of(&format!(
        "{GRID} WorldBegin Scale 1 0 1 Shape \"cone\" Shape \"paraboloid\""
    ));
    let messages: Vec<&str> = singular
        .warnings
        .iter()
        .map(|warning| &*warning.first.message)
        .collect();
    assert_eq!(
        messages,
        [
            "a cone under a singular or infinite transform is never hit",
            "a paraboloid under a singular or infinite transform is never hit"
        ]
    );
}
