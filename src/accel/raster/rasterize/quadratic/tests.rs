//! What is sure in lanes, against exact arithmetic.

use super::*;
use crate::accel::raster::tests::camera;
use crate::accel::space::AnchorSpace;
use crate::accel::view::CameraView;
use crate::camera::Camera;
use crate::geometry::{Matrix, Point, Transform, Vector};
use crate::shape::{Form, Quadric, Revolved};
use crate::simd::{Level, SimdKernel};
use proptest::prelude::*;

/// A surface, a camera, and the first pixel of a tile.
#[derive(Debug, Clone)]
struct Scene {
    camera: Camera,
    quadric: Quadric,
    first: [u32; 2],
}

fn revolved(kind: u32, [low, high]: [f64; 2], phi_max: f64) -> Revolved {
    match kind {
        0 => Revolved::cone(high.abs() + 0.1, phi_max),
        1 => Revolved::paraboloid(low, high, phi_max),
        _ => Revolved::hyperboloid([0.7, low, low], [0.7, high, high], phi_max),
    }
}

fn quadric() -> impl Strategy<Value = Quadric> {
    let corner = || prop::array::uniform3(-1.0..1.0f64).prop_map(Point::from);
    let patch = prop::array::uniform4(corner()).prop_map(Quadric::of_patch);
    let turn = (
        -180.0..180.0f64,
        prop::array::uniform3(-1.0..1.0f64),
        prop::array::uniform3(prop::sample::select(vec![1.0, -1.0, 0.3, 2.0])),
    );
    let phi_max = prop::sample::select(vec![360.0, 360.0, 360.0, 100.0]);
    let ends = prop::array::uniform2(-1.0..1.0f64);
    let round =
        (turn, 0u32..3, ends, phi_max).prop_map(|((angle, axis, stretch), kind, ends, phi_max)| {
            let turn = Transform::rotate(angle, Vector::from(axis)).matrix;
            Quadric {
                world_from_object: turn.times(&Matrix::scale(stretch)),
                radius: if kind == 2 { 1.0 } else { 0.8 },
                form: Form::Revolved(revolved(kind, ends, phi_max)),
            }
        });
    prop_oneof![3 => round, 1 => patch]
}

/// The eye is near the surface, or so far away that it is seen by a few pixels.
fn scene() -> impl Strategy<Value = Scene> {
    let eye = (
        prop::array::uniform3(0.2..1.0f64),
        prop::sample::select(vec![2.0, 9.0, 300.0]),
    );
    let tile = prop::array::uniform2(prop_oneof![3 => 7u32..9, 1 => 0u32..16]);
    let degrees = prop::sample::select(vec![0.5, 5.0, 40.0]);
    (quadric(), eye, tile, degrees).prop_map(|(quadric, (eye, distance), tile, degrees)| {
        let eye = Point::from(eye.map(|x| x * distance));
        Scene {
            camera: camera(eye, Point::new(0.1, 0.2, 0.1), true, degrees),
            quadric,
            first: tile.map(|k| 16 * k),
        }
    })
}

/// The numbers of lanes that are sure to be hit, sure to be missed, and in all.
struct Check<'a>(&'a Scene);

impl SimdKernel for Check<'_> {
    type Output = [u32; 3];

    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) -> [u32; 3] {
        let Scene {
            camera,
            quadric,
            first,
        } = self.0;
        let view = CameraView::new(camera, &AnchorSpace::new(camera.anchor(), 512.0)).unwrap();
        let frame = TileFrame::new(&view, *first);
        let surface = quadric
            .seen_from(frame.eye())
            .and_then(|equation| TileQuadratic::of(&frame, &equation));
        let Some(surface) = surface else {
            return [0; 3];
        };
        let mut counts = [0; 3];
        for block in 0..16 {
            let samples = surface.samples(simd, &frame, block);
            let mut nearness = [0.0; LANES];
            samples.nearness.store(&mut nearness);
            let (sure, possible) = (samples.sure.bits(), samples.possible.bits());
            for (lane, nearness) in nearness.iter().enumerate() {
                let pixel = [COLUMNS[block][lane] as u32, ROWS[block][lane] as u32];
                let ray = camera.ray(first[0] + pixel[0], first[1] + pixel[1]);
                let is_sure = sure >> lane & 1 != 0;
                let is_missed = possible >> lane & 1 == 0;
                counts[0] += u32::from(is_sure);
                counts[1] += u32::from(is_missed);
                counts[2] += 1;
                if !(is_sure || is_missed) {
                    continue;
                }
                let t = quadric.exact(&ray).map(|t| t.bracket());
                assert!(!is_missed || t.is_none(), "{pixel:?}: {t:?} is not missed");
                if is_sure {
                    let t = t.expect("what is sure to be hit is hit");
                    let off = (f64::from(*nearness) * t.low - 1.0).abs();
                    let allowed = 0.9 * f64::from(view.tolerance);
                    assert!(off <= allowed, "{pixel:?}: {nearness} is not 1 / {t:?}");
                }
            }
        }
        counts
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(150)
    })]

    #[test]
    fn sure_lanes_are_right(scene in scene()) {
        prop_assume!(scene.quadric.can_be_hit());
        for level in Level::available() {
            level.run(Check(&scene));
        }
    }
}

/// Nearly all pixels of an ordinary surface are sure.
#[test]
fn few_lanes_are_unsure() {
    let corners = [
        [-1.0, -1.0, 0.4],
        [1.0, -1.0, -0.3],
        [-1.0, 1.0, -0.2],
        [1.0, 1.0, 0.5],
    ];
    let round = |form: Revolved, radius: f64| Quadric {
        world_from_object: Transform::rotate(40.0, Vector::new(1.0, 2.0, 3.0)).matrix,
        radius,
        form: Form::Revolved(form),
    };
    for quadric in [
        round(Revolved::cone(1.0, 360.0), 0.8),
        round(Revolved::paraboloid(0.0, 1.0, 360.0), 0.8),
        round(
            Revolved::hyperboloid([0.5, -0.5, -0.5], [0.5, 0.5, 0.5], 360.0),
            1.0,
        ),
        Quadric::of_patch(corners.map(Point::from)),
    ] {
        let scene = Scene {
            camera: camera(
                Point::new(60.0, 50.0, 70.0),
                Point::new(0.0, 0.0, 0.2),
                true,
                3.0,
            ),
            quadric,
            first: [112, 112],
        };
        for level in Level::available() {
            let [hit, missed, all] = level.run(Check(&scene));
            assert!(
                hit > 10 && hit + missed + 5 > all,
                "{quadric:?}: {hit} {missed} of {all}"
            );
        }
    }
}
