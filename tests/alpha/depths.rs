//! Depths of hits behind a hit that is cut away.

use crate::common::{add_triangles, agreed_picture, bits_of, judged, rendered};
use crate::grid_camera;
use feimos::accel::Precision;
use feimos::film::ChannelName;
use feimos::geometry::{Matrix, Point};
use feimos::shape::{Alpha, AlphaCutoff, Counts, Geometry};
use feimos::texture::{FloatTexture, UvMapping};
use std::sync::Arc;

/// A texture that cuts the near half of a sphere away, seen along its axis.
fn far_half() -> Alpha {
    let constant = |value| Arc::new(FloatTexture::Constant(value));
    let texture = FloatTexture::Checkerboard {
        mapping: UvMapping {
            scale: [0.0, 1.9],
            delta: [0.0, 0.05],
        },
        of: [constant(0.0), constant(1.0)],
    };
    Alpha::new(Arc::new(texture), AlphaCutoff::ZERO)
}

/// The depth of a far side lies between two `f32`, exactly in the middle: exact arithmetic has to
/// round the far root.
#[test]
fn the_depth_of_a_far_side_is_rounded_to_even() {
    for (halves, expected) in [(1.0, 7.0f32), (3.0, 7.0f32.next_up().next_up())] {
        let mut geometry = Geometry::default();
        // Half of the distance from 7 to the next f32.
        let offset = halves * 2f64.powi(-22);
        let transform = geometry.add_transform(Matrix::translate([0.0, 0.0, offset]));
        geometry.add_sphere(2.0, None, transform, 1).unwrap();
        geometry.cut_out(Counts::default(), far_half());
        let camera = grid_camera([0, 0, -5], true, 5);
        let image = agreed_picture(&camera, &geometry, Precision::Exact).image;
        assert_eq!(bits_of(&image, ChannelName::Z)[12], expected.to_bits());
        assert_eq!(rendered(&image), judged(&camera, &geometry));
    }
}

/// The far pole of a sphere lies in the plane of a triangle: the first in the file wins.
#[test]
fn a_far_side_ties_with_a_triangle() {
    for triangle_is_first in [false, true] {
        let mut geometry = Geometry::default();
        let corners = [[-9.0, -9.0, 2.0], [9.0, -9.0, 2.0], [0.0, 9.0, 2.0]].map(Point::from);
        if triangle_is_first {
            add_triangles(&mut geometry, &[corners], &Matrix::IDENTITY, 1);
        }
        let transform = geometry.add_transform(Matrix::IDENTITY);
        let before = geometry.counts();
        geometry.add_sphere(2.0, None, transform, 2).unwrap();
        geometry.cut_out(before, far_half());
        if !triangle_is_first {
            add_triangles(&mut geometry, &[corners], &Matrix::IDENTITY, 3);
        }
        let camera = grid_camera([0, 0, -5], true, 5);
        let image = agreed_picture(&camera, &geometry, Precision::Exact).image;
        let expected = if triangle_is_first { 1 } else { 2 };
        assert_eq!(bits_of(&image, ChannelName::Id)[12], expected);
        assert_eq!(rendered(&image), judged(&camera, &geometry));
    }
}
