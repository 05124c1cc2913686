//! Surfaces do not depend on how an image is rendered, and agree with its depths.

use super::*;

/// Every kind of shape, cut, mirrored, reversed and instanced; a sliver, and a triangle almost
/// parallel to the rays.
const ALL_SHAPES: &str = "
    AttributeBegin Translate -2 1.5 6 Rotate 50 1 2 3
        Shape \"sphere\" \"float zmax\" 0.6 \"float phimax\" 250 AttributeEnd
    AttributeBegin Translate 1 -1 5 Scale 1.5 0.5 -0.7 ReverseOrientation
        Shape \"sphere\" AttributeEnd
    AttributeBegin Translate 2 2 6 Rotate 60 1 0 0
        Shape \"cylinder\" \"float phimax\" 300 AttributeEnd
    AttributeBegin Translate -2 -2 5 Rotate 30 1 1 0
        Shape \"disk\" \"float innerradius\" 0.3 AttributeEnd
    Shape \"trianglemesh\" \"point3 P\" [ -9 -9 12  9 -9 12  9 9 12  -9 9 11 ]
        \"integer indices\" [ 0 1 2 0 2 3 ]
        \"point2 uv\" [ 0 0  1.5 0  1.5 -1  0 -1 ]
    Shape \"trianglemesh\" \"point3 P\" [ -3 0 4  3 0.000001 4  3 0 4
        -1 -0.3 1  1 -0.3 1  0 -0.3000001 9 ] \"integer indices\" [ 0 1 2 3 4 5 ]
    ObjectBegin \"pair\"
        Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0  1 1 0 ]
        AttributeBegin Scale -0.4 0.4 0.4
            Shape \"sphere\" Shape \"disk\" \"float height\" 2 AttributeEnd
    ObjectEnd
    AttributeBegin Translate 0.5 0.5 4 Rotate 20 0 1 0 ObjectInstance \"pair\" AttributeEnd
    AttributeBegin Translate -1 -1 4 Scale 0.5 0.5 -0.5 ObjectInstance \"pair\" AttributeEnd";

fn both_cameras() -> [Scene; 2] {
    let orthographic = "orthographic\" \"float screenwindow\" [ -4 4 -4 4 ]";
    [seen(ALL_SHAPES), seen_by(orthographic, ALL_SHAPES)]
}

#[test]
fn surfaces_do_not_depend_on_the_way_of_rendering() {
    for scene in both_cameras() {
        for precision in Precision::ALL {
            let image = agreed_picture(&scene.camera, &scene.geometry, precision).image;
            assert!(hits(&image).len() > 500);
            assert!(ChannelName::SURFACE.iter().all(|name| {
                measures(&image, *name)
                    .iter()
                    .all(|value| value.is_finite())
            }));
        }
    }
}

#[test]
fn crops_are_parts_of_the_whole() {
    let options = BuildOptions::new(SplitMethod::Sah);
    for Scene {
        camera, geometry, ..
    } in both_cameras()
    {
        let all = picture(
            &camera,
            &geometry,
            options,
            Precision::Exact,
            1,
            whole(&camera),
        )
        .image;
        for window in [
            PixelBounds {
                x0: 3,
                x1: 30,
                y0: 17,
                y1: 18,
            },
            PixelBounds {
                x0: 15,
                x1: 41,
                y0: 1,
                y1: 41,
            },
        ] {
            let part = picture(&camera, &geometry, options, Precision::Exact, 3, window).image;
            for Channel { name, .. } in part
                .channels
                .iter()
                .filter(|channel| channel.name.is_of_surface())
            {
                let (all, part) = (measures(&all, *name), measures(&part, *name));
                let rows = part.chunks_exact(window.width() as usize);
                for (row, y) in rows.zip(window.y0 as usize..) {
                    let of_whole = &all[41 * y + window.x0 as usize..41 * y + window.x1 as usize];
                    assert!(
                        row.iter()
                            .zip(of_whole)
                            .all(|(a, b)| a.to_bits() == b.to_bits()),
                        "{name}"
                    );
                }
            }
        }
    }
}

#[test]
fn misses_are_0() {
    let image = image_of(&seen("Translate 0 0 3 Shape \"sphere\""));
    let coverage = measures(&image, ChannelName::A);
    for pixel in (0..coverage.len()).filter(|pixel| coverage[*pixel] == 0.0) {
        assert!(
            ChannelName::SURFACE
                .iter()
                .all(|name| measures(&image, *name)[pixel].to_bits() == 0)
        );
    }
}

#[test]
fn points_agree_with_depths() {
    for Scene {
        camera, geometry, ..
    } in both_cameras()
    {
        let image = picture(
            &camera,
            &geometry,
            BuildOptions::new(SplitMethod::Sah),
            Precision::Exact,
            2,
            whole(&camera),
        )
        .image;
        for pixel in hits(&image) {
            let ray = camera.ray(pixel as u32 % 41, pixel as u32 / 41);
            let along =
                ray.origin + ray.direction * f64::from(measures(&image, ChannelName::Z)[pixel]);
            let point = triple(&image, POINT, pixel);
            let largest = along
                .to_array()
                .into_iter()
                .fold(0.0, |largest: f64, x| largest.max(x.abs()));
            assert!(
                (0..3).all(|k| (point[k] - along[k]).abs() <= 1e-6 * largest),
                "{point:?} is not {along:?}"
            );
            let length: f64 = triple(&image, NORMAL, pixel).map(|x| x * x).iter().sum();
            assert!((length - 1.0).abs() < 1e-6, "{length}");
        }
    }
}

#[test]
fn surfaces_of_instances_equal_those_written_out() {
    let object = format!(
        "{TRIANGLE} AttributeBegin Scale -1 1 2 Translate 0.2 0.1 0 {SPHERE} AttributeEnd \
         ReverseOrientation Shape \"disk\""
    );
    let place = "Translate 0.3 0.2 2 Rotate 33 1 2 3 Scale 0.9 1.1 1.3";
    let instanced = format!("ObjectBegin \"a\" {object} ObjectEnd {place} ObjectInstance \"a\"");
    let [mut instanced, mut written] =
        [instanced, format!("{place} {object}")].map(|world| image_of(&seen(&world)));
    for image in [&mut instanced, &mut written] {
        image
            .channels
            .retain(|channel| channel.name != ChannelName::Instance);
    }
    assert!(hits(&written).len() > 100);
    assert_same(&written, &instanced, "written out");
}
