//! Curves with hits computed by hand, and by the formula of the curve.

use super::common::{agreed_picture, bits_of, picture, scene_of, whole};
use feimos::accel::{BuildOptions, Precision, SplitMethod};
use feimos::film::ChannelName;

/// Pixels at integer coordinates from -5 to 5, seen along z from z = 0.
const GRID: &str = "Camera \"orthographic\" \"float screenwindow\" [ -5.5 5.5 -5.5 5.5 ]
    Film \"image\" \"integer xresolution\" 11 \"integer yresolution\" 11 WorldBegin ";

/// Z at each (x, y) of the grid; `None` where nothing is hit.
fn grid(text: &str) -> impl Fn(i32, i32) -> Option<f32> + use<> {
    let scene = scene_of(&format!("{GRID} {text}"));
    assert!(scene.warnings.is_empty(), "{text}");
    let image = agreed_picture(&scene.camera, &scene.geometry, Precision::Exact).image;
    let [hit, z] = [ChannelName::A, ChannelName::Z].map(|name| bits_of(&image, name));
    move |x, y| {
        let k = ((5 - y) * 11 + x + 5) as usize;
        (f32::from_bits(hit[k]) > 0.0).then(|| f32::from_bits(z[k]))
    }
}

/// Both sides and both ends of a straight curve belong to it, and its depth is that of its axis.
#[test]
fn a_straight_curve_is_a_strip() {
    let text = "Shape \"curve\" \"point3 P\" [ -3 0 7  -1 0 7  1 0 7  3 0 7 ] \"float width\" 4";
    let found = grid(text);
    for y in -5..=5 {
        for x in -5..=5 {
            let is_there = (-3..=3).contains(&x) && (-2..=2).contains(&y);
            assert_eq!(found(x, y), is_there.then_some(7.0), "{x} {y}");
        }
    }
}

/// Half of the width shrinks from 3 to 0, and depth grows along the axis.
#[test]
fn widths_and_depths_change_along_a_curve() {
    let text = "Shape \"curve\" \"point3 P\" [ -3 0 6  -1 0 7  1 0 8  3 0 9 ]
        \"float width0\" 6 \"float width1\" 0 \"string type\" \"cylinder\"";
    let found = grid(text);
    for y in -5i32..=5 {
        for x in -5i32..=5 {
            // 3 - |y| >= (x + 3) / 2
            let is_there = (-3..=3).contains(&x) && 2 * (3 - y.abs()) >= x + 3;
            let z = 7.5 + f64::from(x) / 2.0;
            assert_eq!(found(x, y), is_there.then_some(z as f32), "{x} {y}");
        }
    }
}

/// A curve along the view has no side to see, and one behind the eye is not seen.
#[test]
fn what_is_seen_along_its_axis_is_not_seen() {
    for text in [
        "Shape \"curve\" \"point3 P\" [ 0 0 4  0 0 5  0 0 6  0 0 7 ] \"float width\" 4",
        "Shape \"curve\" \"point3 P\" [ -3 0 -4  0 0 -4  1 0 -4  3 0 -4 ] \"float width\" 4",
    ] {
        let found = grid(text);
        assert!((-5..=5).all(|x| (-5..=5).all(|y| found(x, y).is_none())));
    }
}

/// In object space the strip faces the ray, and its width is measured there.
#[test]
fn transforms_stretch_a_strip() {
    let text = "Scale 1 2 1 Shape \"curve\" \"point3 P\" [ -3 0 7  -1 0 7  1 0 7  3 0 7 ]
        \"float width\" 2";
    let found = grid(text);
    assert_eq!(
        (found(0, 2), found(0, -2), found(0, 3)),
        (Some(7.0), Some(7.0), None)
    );
    assert_eq!((found(3, 0), found(4, 0)), (Some(7.0), None));
}

/// A curve that bends by a right angle has no gap on the outside and ends where its plane of
/// symmetry is.
#[test]
fn smooth_joints_have_no_gaps() {
    let bent = "Shape \"curve\" \"point3 P\" [ -4 -4 7  -4 4 7  -4 4 7  4 4 7 ] \"float width\" 3";
    let scene = scene_of(&format!("{GRID} {bent}"));
    assert!(scene.geometry.segment_count() >= 4);
    let found = grid(bent);
    // The curve at its parameter 1/2 is (-3, 3), and at 1/4 (-3.75, 1.0).
    assert!(found(-3, 3).is_some() && found(-4, 1).is_some() && found(0, 4).is_some());
}

/// pbrt's two bases, both degrees: the same parabola and the same straight line.
#[test]
fn bases_and_degrees_agree() {
    let curve = |parameters: &str| {
        let found = grid(&format!("Shape \"curve\" \"float width\" 3 {parameters}"));
        let rows = (-5..=5).map(|y| (-5..=5).map(|x| found(x, y).is_some()).collect::<Vec<_>>());
        rows.collect::<Vec<_>>()
    };
    let cubic =
        curve("\"point3 P\" [ -4 -4 7  -1.3333333333333333 4 7  1.3333333333333333 4 7  4 -4 7 ]");
    let quadratic = curve("\"integer degree\" 2 \"point3 P\" [ -4 -4 7  0 8 7  4 -4 7 ]");
    assert_eq!(cubic, quadratic);
    // A B-spline of degree 2 begins and ends in the middle of its outer legs.
    let spline = curve(
        "\"integer degree\" 2 \"string basis\" \"bspline\" \"point3 P\" [ -8 -16 7  0 8 7  8 -16 7 ]",
    );
    assert_eq!(spline, quadratic);
    let line = curve("\"point3 P\" [ -2 0 7  -1 0 7  0 0 7  1 0 7 ]");
    let cubic_spline =
        curve("\"string basis\" \"bspline\" \"point3 P\" [ -5 0 7  -2 0 7  1 0 7  4 0 7 ]");
    assert_eq!(line, cubic_spline);
}

/// A ribbon is a surface of its own: seen from the side it is narrow.
#[test]
fn ribbons_have_an_orientation() {
    let ribbon = |normals: &str| {
        let text = format!(
            "Shape \"curve\" \"string type\" \"ribbon\" \"normal N\" [ {normals} ] \"float width\" 4
                \"point3 P\" [ -3 0 7  -1 0 7  1 0 7  3 0 7 ]"
        );
        grid(&text)
    };
    let facing = ribbon("0 0 -1  0 0 -1");
    assert_eq!(
        (facing(0, 2), facing(3, -2), facing(0, 3)),
        (Some(7.0), Some(7.0), None)
    );
    let slanted = ribbon("0 -3 -4  0 -3 -4");
    // 2 * 4/5 = 1.6 up, and depth changes by 3/4 of the height.
    assert_eq!(
        (slanted(0, 1), slanted(0, -1), slanted(0, 2)),
        (Some(6.25), Some(7.75), None)
    );
    let edge_on = ribbon("0 1 0  0 1 0");
    assert!((-5..=5).all(|x| (-5..=5).all(|y| edge_on(x, y).is_none())));
    let twisted = ribbon("0 1 0  0 0 -1");
    assert!(twisted(3, 2).is_some() && twisted(-3, 1).is_none());
}

/// Every ray that passes the curve itself within half of its width hits it, but for what dicing and
/// the flat ends change.
#[test]
fn rays_hit_where_the_curve_is() {
    let control = [[-4.0, -3.0], [-2.0, 6.0], [2.0, -6.0], [4.0, 3.0f64]];
    let bezier = |t: f64| {
        let s = 1.0 - t;
        let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
        [0, 1].map(|k| (0..4).map(|i| weights[i] * control[i][k]).sum::<f64>())
    };
    let width = 0.8;
    let points: Vec<String> = control.iter().map(|[x, y]| format!("{x} {y} 7")).collect();
    let text = format!(
        "Camera \"orthographic\" \"float screenwindow\" [ -5 5 -5 5 ]
        Film \"image\" \"integer xresolution\" 100 \"integer yresolution\" 100 WorldBegin
        Shape \"curve\" \"point3 P\" [ {} ] \"float width\" {width}",
        points.join(" ")
    );
    let scene = scene_of(&text);
    let window = whole(&scene.camera);
    let options = BuildOptions::new(SplitMethod::Sah);
    let image = picture(
        &scene.camera,
        &scene.geometry,
        options,
        Precision::Exact,
        1,
        window,
    )
    .image;
    let hits = bits_of(&image, ChannelName::A);
    let mut inside = 0;
    for (k, hit) in hits.iter().enumerate() {
        let [x, y] = [k % 100, k / 100].map(|k| (k as f64 + 0.5) / 10.0 - 5.0);
        let distance = |t: u32| {
            let [a, b] = bezier(f64::from(t) / 4000.0);
            (a - x).hypot(b + y)
        };
        let nearest = (0..=4000)
            .min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
            .unwrap();
        let is_end = nearest == 0 || nearest == 4000;
        let off = distance(nearest) - width / 2.0;
        // A twentieth of the width, and half as much for the tilt of the width.
        if !is_end && off.abs() > 0.075 * width {
            assert_eq!(f32::from_bits(*hit) > 0.0, off < 0.0, "{x} {y}");
            inside += i32::from(off < 0.0);
        }
    }
    assert!(inside > 600, "{inside}");
}
