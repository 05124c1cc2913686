//! Normals and coordinates of cones, paraboloids, hyperboloids and bilinear patches.

use super::*;

/// Asserts `N`, `u` and `v` of all pixels of a shape at (0.5, -0.25, 6), given functions of a point
/// in its space. The normal need not have unit length.
#[track_caller]
fn assert_surface(
    shape: &str,
    normal: impl Fn([f64; 3]) -> [f64; 3],
    uv: impl Fn([f64; 3]) -> [f64; 2],
) {
    let image = image_of(&seen(&format!("Translate 0.5 -0.25 6 {shape}")));
    assert!(hits(&image).len() > 30, "{shape}: {}", hits(&image).len());
    for pixel in hits(&image) {
        let [x, y, z] = triple(&image, POINT, pixel);
        let point = [x - 0.5, y + 0.25, z - 6.0];
        let expected = normal(point);
        let length = expected.iter().map(|x| x * x).sum::<f64>().sqrt();
        let found = triple(&image, NORMAL, pixel);
        // Points are known to the last place of a coordinate up to 10.
        let is_near = (0..3).all(|k| (found[k] - expected[k] / length).abs() < 1e-5);
        assert!(is_near, "{shape} at {point:?}: {found:?}, not {expected:?}");
        let (expected, names) = (uv(point), [ChannelName::U, ChannelName::V]);
        let found = names.map(|name| f64::from(measures(&image, name)[pixel]));
        // The angles 0 and 360 are one line.
        let off = (found[0] - expected[0]).abs();
        let is_near = off.min((1.0 - off).abs()) < 1e-5 && (found[1] - expected[1]).abs() < 1e-5;
        assert!(is_near, "{shape} at {point:?}: {found:?}, not {expected:?}");
    }
}

/// The angle about the axis, in turns.
fn turn(x: f64, y: f64) -> f64 {
    (y.atan2(x) / std::f64::consts::TAU).rem_euclid(1.0)
}

#[test]
fn surfaces_of_revolution_point_away_from_the_axis() {
    let k = (2.0f64 / 3.0).powi(2);
    assert_surface(
        "Shape \"cone\" \"float radius\" 2 \"float height\" 3",
        |[x, y, z]| [x, y, k * (3.0 - z)],
        |[x, y, z]| [turn(x, y), z / 3.0],
    );
    assert_surface(
        "Shape \"paraboloid\" \"float radius\" 2 \"float zmin\" 0.5 \"float zmax\" 3",
        |[x, y, _]| [x, y, -2.0 / 3.0],
        |[x, y, z]| [turn(x, y), (z - 0.5) / 2.5],
    );
    assert_surface(
        "Shape \"paraboloid\" \"float radius\" 2 \"float phimax\" 180",
        |[x, y, _]| [x, y, -2.0],
        |[x, y, z]| [2.0 * turn(x, y), z],
    );
    assert_surface(
        "Shape \"hyperboloid\" \"point p1\" [ 2 -2 -1 ] \"point p2\" [ 2 4 2 ]",
        |[x, y, z]| [x, y, -4.0 * z],
        |[x, y, z]| {
            [
                turn(2.0 * x + 2.0 * z * y, 2.0 * y - 2.0 * z * x),
                (z + 1.0) / 3.0,
            ]
        },
    );
    // From the upper point down, v counts the other way, and the normal points to the axis.
    assert_surface(
        "Shape \"hyperboloid\" \"point p2\" [ 2 -2 -1 ] \"point p1\" [ 2 4 2 ]",
        |[x, y, z]| [-x, -y, 4.0 * z],
        |[x, y, z]| {
            [
                turn(2.0 * x + 2.0 * z * y, 2.0 * y - 2.0 * z * x),
                (2.0 - z) / 3.0,
            ]
        },
    );
}

#[test]
fn patches_have_the_coordinates_of_their_corners() {
    let saddle = "Shape \"bilinearmesh\" \"point3 P\" [ -2 -2 1  2 -2 -1  -2 2 -1  2 2 1 ]";
    let normal = |[x, y, _]: [f64; 3]| [-0.25 * y, -0.25 * x, 1.0];
    assert_surface(saddle, normal, |[x, y, _]| {
        [(x + 2.0) / 4.0, (y + 2.0) / 4.0]
    });
    let named = format!("{saddle} \"point2 uv\" [ 0 0  0.5 0  0.25 1  1 0.75 ]");
    assert_surface(&named, normal, |[x, y, _]| {
        let [u, v] = [(x + 2.0) / 4.0, (y + 2.0) / 4.0];
        let mean = |a: f64, b: f64, c: f64, d: f64| {
            (1.0 - v) * ((1.0 - u) * a + u * b) + v * ((1.0 - u) * c + u * d)
        };
        [mean(0.0, 0.5, 0.25, 1.0), mean(0.0, 0.0, 1.0, 0.75)]
    });
}

/// A patch that is hardly curved shows the side that a flat one does.
#[test]
fn sides_of_patches_are_those_of_flat_ones() {
    let patch = |bend: f64| {
        format!(
            "Shape \"bilinearmesh\" \"point3 P\" [ -1 -1 {} 1 -1 2  -1 1 2  1 1 2 ]",
            2.0 + bend
        )
    };
    let places = [
        "",
        "Scale -1 1 1",
        "ReverseOrientation",
        "Scale -1 1 1 ReverseOrientation",
    ];
    for outer in places {
        for inner in places {
            let shapes = |bend: f64| {
                let shape = patch(bend);
                [
                    format!("{outer} {inner} {shape}"),
                    format!(
                        "ObjectBegin \"a\" AttributeBegin {inner} {shape} AttributeEnd ObjectEnd \
                         {outer} ObjectInstance \"a\""
                    ),
                ]
            };
            for (flat, curved) in shapes(0.0).iter().zip(&shapes(1e-3)) {
                let z = |world: &str| triple(&image_of(&seen(world)), NORMAL, CENTRE)[2];
                assert!((z(flat) - z(curved)).abs() < 1e-3, "{curved}");
            }
        }
    }
}
