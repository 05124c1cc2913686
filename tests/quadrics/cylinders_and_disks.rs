//! Cylinders, disks, and parts of spheres.

use super::*;

/// The axis of the cylinder points down, from y = 2 to y = -3, and its angles run from x to z.
const CYLINDER: &str = "Translate 0 0 10 Rotate 90 1 0 0
    Shape \"cylinder\" \"float radius\" 5 \"float zmin\" -2 \"float zmax\" 3";

/// Pythagorean triples of 3, 4 and 5 give integers; at 5 the rays are tangents.
#[test]
fn a_cylinder_across_the_view() {
    let depth = |x: i32| f64::from(25 - x * x).sqrt();
    let is_there = |y: i32| (-3..=2).contains(&y);
    assert_grid(CYLINDER, |x, y| is_there(y).then(|| 10.0 - depth(x)));
    // The far half, which includes both tangents.
    let half = format!("{CYLINDER} \"float phimax\" 180");
    assert_grid(&half, |x, y| is_there(y).then(|| 10.0 + depth(x)));
    // The far quarter on the side of x, including its ends: the tangent at x = 5 and the line at x
    // = 0.
    let quarter = format!("{CYLINDER} \"float phimax\" 90");
    assert_grid(&quarter, |x, y| {
        (is_there(y) && x >= 0).then(|| 10.0 + depth(x))
    });
    // All but a near quarter, through which the inside shows.
    let most = format!("{CYLINDER} \"float phimax\" 270");
    let seen = |x: i32| {
        if (1..5).contains(&x) {
            10.0 + depth(x)
        } else {
            10.0 - depth(x)
        }
    };
    assert_grid(&most, |x, y| is_there(y).then(|| seen(x)));
}

#[test]
fn a_cylinder_seen_along_its_axis_is_not_seen() {
    assert_grid(
        "Translate 0 0 5 Shape \"cylinder\" \"float radius\" 5",
        |_, _| None,
    );
    assert_grid(
        "Translate 0 0 5 Scale 1 1 1e-9 Shape \"cylinder\" \"float radius\" 3",
        |_, _| None,
    );
}

/// A cylinder with equal ends is a circle, and so is a disk as wide as its hole.
#[test]
fn rays_hit_circles() {
    let circle = "Translate 0 0 10 Rotate 90 1 0 0 \
                  Shape \"cylinder\" \"float radius\" 5 \"float zmin\" 1 \"float zmax\" 1";
    assert_grid(circle, |x, y| {
        (y == -1).then(|| 10.0 - f64::from(25 - x * x).sqrt())
    });
    let rim = "Translate 0 0 7 Shape \"disk\" \"float radius\" 5 \"float innerradius\" 5";
    assert_grid(rim, |x, y| (x * x + y * y == 25).then_some(7.0));
}

#[test]
fn disks_facing_the_view() {
    let disk = "Translate 0 0 7 Shape \"disk\" \"float radius\" 5";
    assert_grid(disk, |x, y| (x * x + y * y <= 25).then_some(7.0));
    let ring = format!("{disk} \"float innerradius\" 3 \"float height\" -1.5 \"float phimax\" 270");
    let is_cut = |x: i32, y: i32| x > 0 && y < 0;
    assert_grid(&ring, |x, y| {
        ((9..=25).contains(&(x * x + y * y)) && !is_cut(x, y)).then_some(5.5)
    });
    let edge_on = "Translate 0 0 7 Rotate 90 1 0 0 Shape \"disk\" \"float radius\" 5";
    assert_grid(edge_on, |_, _| None);
    let nothing = scene_of(&format!(
        "{GRID} WorldBegin {disk} \"float innerradius\" 5.5 {disk} \"float height\" 1e999"
    ));
    let message = "a disk without points is never hit";
    assert_eq!(
        nothing
            .warnings
            .iter()
            .map(|warning| (&*warning.first.message, warning.count))
            .collect::<Vec<_>>(),
        [(message, 2)]
    );
    assert_eq!(nothing.geometry.quadric_count(), 2);
}

/// The columns of the matrix are x, y + z and z: the disk lies in the plane z = y + 5, and rays
/// have directions (+-1/2, +-1/2, 1).
#[test]
fn a_sheared_disk_in_perspective() {
    let film = "Camera \"perspective\" \"float fov\" 90 \
                Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2";
    let disk = "WorldBegin Transform [ 1 0 0 0  0 1 1 0  0 0 1 0  0 0 5 1 ] \
                Shape \"disk\" \"float radius\" 4";
    let found = answers(&format!("{film} {disk}"));
    let far = 10.0 / 3.0;
    let (z, t) = (far as f32, (far * 1.5f64.sqrt()) as f32);
    // Above the middle t is 10, so x and y are 5: farther from the middle than 4.
    assert_eq!(found, [None, None, Some((1, z, t)), Some((1, z, t))]);
}

/// Among coplanar shapes the first in the file wins, whatever its kind.
#[test]
fn ties_go_to_the_first_in_the_file() {
    let disk = "Shape \"disk\" \"float radius\" 4";
    let plate = "Shape \"trianglemesh\" \"point3 P\" [ -9 -9 0  9 -9 0  0 9 0 ]";
    let seen = |text: &str| answers(&format!("{GRID} WorldBegin Translate 0 0 7 {text}"))[60];
    assert_eq!(seen(&format!("{disk} {plate}")), Some((1, 7.0, 7.0)));
    assert_eq!(seen(&format!("{plate} {disk}")), Some((1, 7.0, 7.0)));
    assert_eq!(seen(&format!("{plate} {disk} {disk}")), Some((1, 7.0, 7.0)));
    // A tube that touches the plane along a line, which the middle ray meets.
    let tube = "AttributeBegin Translate 0 0 2 Rotate 90 1 0 0 \
                Shape \"cylinder\" \"float radius\" 2 AttributeEnd";
    assert_eq!(seen(&format!("{tube} {disk}")), Some((1, 7.0, 7.0)));
    assert_eq!(seen(&format!("{disk} {tube}")), Some((1, 7.0, 7.0)));
}

/// pbrt squares the radius. Before it computes the angle, it mirrors a sphere's point at the
/// centre, and a cylinder's at the axis.
#[test]
fn a_negative_radius_equals_a_positive_one() {
    for rest in [
        "",
        "\"float innerradius\" 2",
        "\"float innerradius\" -2",
        "\"float phimax\" 100",
        "\"float height\" -1",
    ] {
        let disk = |radius: i32| format!("Shape \"disk\" \"float radius\" {radius} {rest}");
        assert_alike(&disk(-4), &disk(4));
    }
    for rest in ["", "\"float phimax\" 100", "\"float phimax\" 200"] {
        let sphere = |radius: i32| format!("Shape \"sphere\" \"float radius\" {radius} {rest}");
        assert_alike(&sphere(-4), &format!("Scale -1 -1 -1 {}", sphere(4)));
        let cylinder = |radius: i32| {
            format!("Shape \"cylinder\" \"float radius\" {radius} {rest} \"float zmax\" 3")
        };
        assert_alike(&cylinder(-4), &format!("Scale -1 -1 1 {}", cylinder(4)));
    }
}

/// Both are clamped to a range that ends before it begins.
#[test]
fn ends_do_not_cut_a_sphere_of_negative_radius() {
    let sphere = "WorldBegin Translate 0 0 9 Shape \"sphere\" \"float radius\"";
    let whole = answers(&format!("{GRID} {sphere} 4"));
    for ends in [
        "\"float zmin\" 0",
        "\"float zmax\" -1",
        "\"float zmin\" 1 \"float zmax\" 2",
    ] {
        let scene = scene_of(&format!("{GRID} {sphere} -4 {ends}"));
        let messages: Vec<&str> = scene
            .warnings
            .iter()
            .map(|warning| &*warning.first.message)
            .collect();
        assert_eq!(
            messages,
            ["`zmin` and `zmax` are ignored, as in pbrt: the radius is below 0"]
        );
        let prim = bits_of(
            &agreed_picture(&scene.camera, &scene.geometry, Precision::Exact).image,
            ChannelName::Prim,
        );
        assert!(
            prim.iter()
                .zip(&whole)
                .all(|(prim, pixel)| (*prim > 0) == pixel.is_some()),
            "{ends}"
        );
    }
}

/// Below 1.4e-322 degrees the sine of a positive end is rounded to 0. No number lies between, so
/// the end behaves like 0.
#[test]
fn the_least_angles_keep_one_side() {
    for phi_max in ["0", "1e-322", "5e-324", "1e-300", "1e-40", "-0", "-30"] {
        let cut = format!("\"float phimax\" {phi_max}");
        let sphere = format!("Translate 0 0 9 Shape \"sphere\" \"float radius\" 5 {cut}");
        let z = |x: i32| 9.0 - f64::from(25 - x * x).sqrt();
        assert_grid(&sphere, |x, y| (y == 0 && x >= 0).then(|| z(x)));
        assert_grid(
            &format!("Translate 0 0 9 Shape \"disk\" \"float radius\" 5 {cut}"),
            |x, y| (y == 0 && x >= 0).then_some(9.0),
        );
        // The axis points down in the image, and the angle 0 is on the side of x.
        let cylinder = format!("{CYLINDER} {cut}");
        assert_grid(&cylinder, |x, y| {
            (x == 5 && (-3..=2).contains(&y)).then_some(10.0)
        });
    }
    for (phi_max, keeps_180) in [
        (180f64.next_down(), false),
        (180.0, true),
        (180f64.next_up(), true),
    ] {
        let disk = format!(
            "Translate 0 0 9 Shape \"disk\" \"float radius\" 5 \"float phimax\" {phi_max:?}"
        );
        let is_there = |x: i32, y: i32| y > 0 || y == 0 && (x >= 0 || keeps_180);
        assert_grid(&disk, |x, y| {
            (x * x + y * y <= 25 && is_there(x, y)).then_some(9.0)
        });
    }
    let most = format!(
        "Translate 0 0 9 Shape \"disk\" \"float radius\" 5 \"float phimax\" {:?}",
        360f64.next_down()
    );
    assert_grid(&most, |x, y| (x * x + y * y <= 25).then_some(9.0));
}
