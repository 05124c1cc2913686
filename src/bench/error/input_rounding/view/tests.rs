//! Tests of the bounds with a thousand bits, and with films whose pixels are easy to measure.

use super::super::high_precision::{self, High, chain};
use super::*;
use crate::camera::{Distortion, Fisheye, RadialTangential, ScreenWindow};
use proptest::prelude::*;

fn camera(rounded: &RoundedTransform, projection: Projection) -> Camera {
    let screen_window = ScreenWindow {
        x0: -1.7,
        x1: 1.3,
        y0: -0.9,
        y1: 1.1,
    };
    Camera {
        world_from_camera: rounded.transform.inverse,
        projection,
        screen_window,
        resolution: [160, 91],
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    /// With an exact window, as from a file, and a field of view of 90 degrees.
    #[test]
    fn errors_of_rays_are_within_their_bounds(
        chain in chain(),
        pixel in (0u32..160, 0u32..91),
        is_perspective: bool,
        z in 1e-3f32..1e6,
    ) {
        let (rounded, meant) = chain;
        let perspective = Projection::Perspective { tangent: 1.0 };
        let projection = if is_perspective { perspective } else { Projection::Orthographic };
        let camera = camera(&rounded, projection);
        let view = View { camera: &camera, rounded: &rounded };
        let ray = camera.ray(pixel.0, pixel.1);
        prop_assume!(ray.can_hit());
        let window = &camera.screen_window;
        let centre = |first: f64, last: f64, i: u32, count: u32| {
            let (before, after) = (f64::from(2 * (count - i) - 1), f64::from(2 * i + 1));
            let [first, last] = [first, last].map(High::from);
            let sum = first.times(&before.into()).plus(&last.times(&after.into()));
            sum.over(&f64::from(2 * count).into())
        };
        let x = centre(window.x0, window.x1, pixel.0, 160);
        let y = centre(window.y1, window.y0, pixel.1, 91);
        let at_z = High::from(f64::from(z));
        let off = std::array::from_fn(|k| {
            let c = &meant.inverse[k];
            let in_plane = c[0].times(&x).plus(&c[1].times(&y));
            let meant = match is_perspective {
                true => in_plane.plus(&c[2]).times(&at_z).plus(&c[3]),
                false => in_plane.plus(&c[3]).plus(&c[2].times(&at_z)),
            };
            meant.minus(&at_z.times(&ray.direction[k].into()).plus(&ray.origin[k].into()))
        });
        let bound = view.displacement([pixel.0, pixel.1], z);
        prop_assert!(high_precision::length(&off).is_within(bound));
    }
}

#[test]
fn displacements_are_measured_on_the_film() {
    let rounded = RoundedTransform::translate([0.0, 0.0, 5.0]);
    let mut camera = camera(&rounded, Projection::Perspective { tangent: 1.0 });
    camera.screen_window = ScreenWindow {
        x0: -1.0,
        x1: 1.0,
        y0: -1.0,
        y1: 1.0,
    };
    camera.resolution = [100, 100];
    let pixels = |camera: &Camera, displacement: f64, pixel: [u32; 2], z: f32| {
        View {
            camera,
            rounded: &rounded,
        }
        .in_pixels(displacement, pixel, z)
    };
    // A pixel is 0.02 wide at distance 1: at 10, 1e-6 is 5e-6 of one, in either direction.
    let middle = pixels(&camera, 1e-6, [50, 50], 10.0);
    assert!(
        (middle / (5e-6 * 2f64.sqrt()) - 1.0).abs() < 1e-3,
        "{middle}"
    );
    assert!(
        pixels(&camera, 1e-6, [99, 50], 10.0) > 1.1 * middle,
        "a step away from the eye moves the point, too"
    );
    assert_eq!(
        pixels(&camera, 11.0, [50, 50], 10.0),
        f64::INFINITY,
        "the point may be behind the eye"
    );
    camera.projection = Projection::Orthographic;
    let middle = pixels(&camera, 1e-6, [50, 50], 10.0);
    assert!(
        (middle / (5e-5 * 2f64.sqrt()) - 1.0).abs() < 1e-3,
        "{middle}"
    );
    camera.screen_window.x0 = 1.0;
    assert_eq!(
        pixels(&camera, 1e-6, [50, 50], 10.0),
        f64::INFINITY,
        "pixels without width"
    );
}

/// A view of 64 x 33 pixels, or of 64 x 64.
fn all_around(mapping: SphereMapping) -> [u32; 2] {
    match mapping {
        SphereMapping::EqualArea => [64, 64],
        SphereMapping::Equirectangular => [64, 33],
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// With the directions in camera space as they are: their own errors are added to the bound.
    #[test]
    fn errors_of_rays_around_the_eye_are_within_their_bounds(
        chain in chain(),
        pixel in (0u32..64, 0u32..33),
        mapping in prop::sample::select(SphereMapping::ALL.to_vec()),
        z in 1e-3f32..1e6,
    ) {
        let (rounded, meant) = chain;
        let mut camera = camera(&rounded, Projection::Spherical(mapping));
        camera.resolution = all_around(mapping);
        let pixel = [pixel.0, pixel.1];
        let ray = camera.ray(pixel[0], pixel[1]);
        prop_assume!(ray.can_hit());
        let view = View { camera: &camera, rounded: &rounded };
        let t = High::from(f64::from(z) / view.ray_length(pixel));
        let direction = mapping.direction(pixel, camera.resolution).map(High::from);
        let off = std::array::from_fn(|k| {
            let c = &meant.inverse[k];
            let meant = high_precision::dot(&c[..3], &direction).times(&t).plus(&c[3]);
            meant.minus(&t.times(&ray.direction[k].into()).plus(&ray.origin[k].into()))
        });
        prop_assert!(high_precision::length(&off).is_within(view.displacement(pixel, z)));
    }
}

#[test]
fn directions_around_the_eye_turn_by_pixels_at_most_as_bounded() {
    let rounded = RoundedTransform::translate([0.0; 3]);
    for mapping in SphereMapping::ALL {
        let mut camera = camera(&rounded, Projection::Spherical(mapping));
        camera.resolution = all_around(mapping);
        let [width, height] = camera.resolution;
        let view = View {
            camera: &camera,
            rounded: &rounded,
        };
        let direction = |pixel| mapping.direction(pixel, camera.resolution);
        let mut least = f64::INFINITY;
        for (i, j) in (0..height - 1).flat_map(|j| (0..width - 1).map(move |i| (i, j))) {
            for (step, pixels) in [([1, 0], 1.0), ([0, 1], 1.0), ([1, 1], 2f64.sqrt())] {
                let [from, to] = [[i, j], [i + step[0], j + step[1]]];
                for [from, to] in [[from, to], [to, from]] {
                    let (a, b) = (direction(from), direction(to));
                    let moved = length([0, 1, 2].map(|k| (a[k] - b[k]).abs()));
                    let bound = view.turn_in_pixels(mapping, moved, from);
                    assert!(
                        bound >= pixels,
                        "{mapping:?}: {from:?} to {to:?}: {bound} is less than {pixels}"
                    );
                    least = least.min(bound / pixels);
                }
            }
        }
        assert!(least < 2.5, "{mapping:?}: {least} times too large");
    }
}

#[test]
fn displacements_are_measured_around_the_eye() {
    let rounded = RoundedTransform::translate([0.0; 3]);
    let mapping = SphereMapping::Equirectangular;
    let mut camera = camera(&rounded, Projection::Spherical(mapping));
    camera.resolution = [400, 200];
    let pixels = |displacement: f64, pixel: [u32; 2], z: f32| {
        View {
            camera: &camera,
            rounded: &rounded,
        }
        .in_pixels(displacement, pixel, z)
    };
    // On the horizon, a pixel is pi/200 of the distance wide and high; sines are bounded by half
    // of pi, and three components by the root of 3.
    let pixel = PI / 200.0;
    let expected = 1e-6 / 10.0 / pixel * FRAC_PI_2 * 6f64.sqrt();
    let middle = pixels(1e-6, [200, 100], 10.0);
    assert!((middle / expected - 1.0).abs() < 1e-3, "{middle}");
    assert!(
        pixels(1e-6, [200, 0], 10.0) > 10.0 * middle,
        "meridians are close to each other at a pole"
    );
    assert_eq!(
        pixels(11.0, [200, 100], 10.0),
        f64::INFINITY,
        "the point may be in any direction"
    );
}

#[test]
fn steps_on_the_film_of_a_lens_are_pixels_at_most_as_bounded() {
    let rounded = RoundedTransform::translate([0.0; 3]);
    let brown = RadialTangential::new([-0.25, 0.0, 0.0, 0.0], [0.0; 3], [0.01, -0.02]);
    let lenses = [
        Distortion::RadialTangential(brown.unwrap()),
        Distortion::Fisheye(Fisheye::new([-0.05, 0.01, 0.0, 0.0]).unwrap()),
    ];
    for lens in lenses {
        let camera = camera(&rounded, Projection::Distorted(lens));
        let view = View {
            camera: &camera,
            rounded: &rounded,
        };
        let direction = |[x, y]: [u32; 2]| lens.direction(camera.plane_coordinates(x, y));
        let mut least = f64::INFINITY;
        let mut steps = 0;
        for from in (0..90).flat_map(|y| (0..159).map(move |x| [x, y])) {
            let Some(a) = direction(from) else { continue };
            let seen = view.plane_coordinates(from);
            for (to, pixels) in [([from[0] + 1, from[1]], 1.0), ([from[0], from[1] + 1], 1.0)] {
                let Some(b) = direction(to) else { continue };
                let moved = length([0, 1, 2].map(|k| (a[k] - b[k]).abs()));
                let shift = Shift {
                    in_plane: moved,
                    around: moved,
                };
                let bound = bent_in_pixels(&lens, seen.map(|x| x.value), view.pixel_sizes(), shift);
                assert!(bound >= pixels, "{lens:?}: {from:?} to {to:?}: {bound}");
                least = least.min(bound / pixels);
                steps += 1;
            }
        }
        assert!(least < 3.0 && steps > 5_000, "{lens:?}: {least}, {steps}");
    }
}
