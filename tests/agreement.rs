//! Tests that every accelerator gives the image of the plain list, bit for bit.
//!
//! Coordinates are small integers, so that ties, shared edges, rays through vertices and directions
//! with zero components appear by themselves.

mod common;

use common::{
    Way, add_triangles, agreed_picture, assert_same, picture, picture_by, projections, whole,
};
use feimos::accel::{Accelerator, BuildOptions, Precision, SplitMethod};
use feimos::camera::{Camera, Projection, ScreenWindow};
use feimos::film::{ChannelName, PixelBounds};
use feimos::geometry::{Matrix, Point, Transform, Vector};
use feimos::shape::{Cut, Disk, Form, Geometry, Revolved};
use proptest::prelude::*;

type Corner = [i32; 3];

#[derive(Debug, Clone)]
struct Ball {
    centre: Corner,
    stretch: [i32; 3],
    radius: i32,
    kind: u32,
    ends: [i32; 2],
    phi_max: i32,
}

impl Ball {
    fn form(&self) -> Form {
        let ([low, high], phi_max) = (self.ends.map(f64::from), f64::from(self.phi_max));
        match self.kind {
            0 => Form::Cylinder(Cut::of_cylinder(low, high, phi_max)),
            1 => Form::Disk(Disk::new(low, high, phi_max)),
            2 => Form::Sphere(Cut::new(f64::from(self.radius), low, high, phi_max)),
            3 => Form::Revolved(Revolved::cone(high, phi_max)),
            4 => Form::Revolved(Revolved::paraboloid(low, high, phi_max)),
            5 => {
                let x = f64::from(self.radius);
                let line = [[x, -low, low], [x, high, high]];
                Form::Revolved(Revolved::hyperboloid(line[0], line[1], phi_max))
            }
            _ => Form::Sphere(None),
        }
    }
}

#[derive(Debug, Clone)]
struct Setting {
    triangles: Vec<[Corner; 3]>,
    patches: Vec<[Corner; 4]>,
    balls: Vec<Ball>,
    /// A rotation in degrees, which makes the numbers less round unless it is 0.
    turn: i32,
    eye: Corner,
    projection: Projection,
    resolution: [u32; 2],
}

fn corner(size: i32) -> impl Strategy<Value = Corner> {
    prop::array::uniform3(-size..=size)
}

fn ball() -> impl Strategy<Value = Ball> {
    let form = (
        0u32..9,
        prop::array::uniform2(-2i32..3),
        prop::sample::select(vec![0, 90, 200, 360, 360]),
    );
    (corner(4), prop::array::uniform3(-1i32..4), 0i32..4, form).prop_map(
        |(centre, stretch, radius, (kind, ends, phi_max))| Ball {
            centre,
            stretch,
            radius,
            kind,
            ends,
            phi_max,
        },
    )
}

fn setting() -> impl Strategy<Value = Setting> {
    let triangle = prop::array::uniform3(corner(4));
    (
        prop::collection::vec(triangle, 0..60),
        prop::collection::vec(prop::array::uniform4(corner(4)), 0..6),
        prop::collection::vec(ball(), 0..12),
        prop::sample::select(vec![0, 0, 90, 37]),
        corner(6),
        prop::sample::select(projections()),
        prop::sample::select(vec![[9, 9], [17, 5], [1, 1], [8, 8]]),
    )
        .prop_map(
            |(triangles, patches, balls, turn, eye, projection, resolution)| Setting {
                triangles,
                patches,
                balls,
                turn,
                eye,
                projection,
                resolution,
            },
        )
}

impl Setting {
    fn geometry(&self) -> Geometry {
        let turn = Transform::rotate(f64::from(self.turn), Vector::new(1.0, 2.0, 3.0)).matrix;
        let mut geometry = Geometry::default();
        let (first, second) = self.triangles.split_at(self.triangles.len() / 2);
        add_mesh(&mut geometry, first, &turn, 1);
        for patch in &self.patches {
            let corners = patch.map(|corner| Point::from(corner.map(f64::from)));
            geometry.add_patch(corners, &turn, 1).unwrap();
        }
        for (ball, shape) in self.balls.iter().zip(2..) {
            let place = Matrix::translate(ball.centre.map(f64::from)).times(&turn);
            let transform =
                geometry.add_transform(place.times(&Matrix::scale(ball.stretch.map(f64::from))));
            geometry
                .add_quadric(f64::from(ball.radius), ball.form(), transform, shape)
                .unwrap();
        }
        add_mesh(&mut geometry, second, &turn, 100);
        geometry
    }

    fn camera(&self) -> Camera {
        let eye = Point::from(self.eye.map(f64::from));
        let look_at = Transform::look_at(eye, Point::default(), Vector::new(0.0, 1.0, 0.0));
        let is_orthographic = self.projection == Projection::Orthographic;
        let size = if is_orthographic { 6.0 } else { 1.0 };
        Camera {
            world_from_camera: look_at
                .unwrap_or(Transform::translate([0.0, 0.0, 5.0]))
                .inverse,
            projection: self.projection,
            screen_window: ScreenWindow {
                x0: -size,
                x1: size,
                y0: -size,
                y1: size,
            },
            resolution: self.resolution,
        }
    }
}

fn add_mesh(
    geometry: &mut Geometry,
    triangles: &[[Corner; 3]],
    world_from_object: &Matrix,
    shape: u32,
) {
    let point = |corner: Corner| Point::from(corner.map(f64::from));
    let triangles: Vec<[Point; 3]> = triangles
        .iter()
        .map(|triangle| triangle.map(point))
        .collect();
    add_triangles(geometry, &triangles, world_from_object, shape);
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(400)
    })]

    #[test]
    fn accelerators_agree(setting in setting()) {
        for precision in Precision::ALL {
            agreed_picture(&setting.camera(), &setting.geometry(), precision);
        }
    }

    /// The pixels of a crop equal those of the whole image.
    #[test]
    fn crops_agree(setting in setting(), x in 0u32..9, y in 0u32..9) {
        let (camera, geometry) = (setting.camera(), setting.geometry());
        let [width, height] = camera.resolution;
        let crop = PixelBounds { x0: x % width, x1: width, y0: y % height, y1: height };
        let options = BuildOptions::new(SplitMethod::Sah);
        let image = picture(&camera, &geometry, options, Precision::Exact, 2, whole(&camera)).image;
        let part = picture(&camera, &geometry, options, Precision::Exact, 1, crop).image;
        let way = Way::of(Accelerator::Raster, 2);
        let binned = picture_by(&camera, &geometry, way, Precision::Exact, crop).image;
        assert_same(&part, &binned, "bins");
        let prim = image.numbers(ChannelName::Prim).unwrap();
        let part = part.numbers(ChannelName::Prim).unwrap();
        for (row, y) in (crop.y0..crop.y1).enumerate() {
            let of_whole = &prim[(y * width + crop.x0) as usize..(y * width + crop.x1) as usize];
            let columns = crop.width() as usize;
            prop_assert_eq!(of_whole, &part[row * columns..(row + 1) * columns]);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(24)
    })]

    /// On films of many bins, which have several levels.
    #[test]
    fn accelerators_agree_on_wide_films(
        setting in setting(),
        resolution in prop::sample::select(vec![[300, 40], [150, 97], [33, 310]]),
    ) {
        let setting = Setting { resolution, ..setting };
        agreed_picture(&setting.camera(), &setting.geometry(), Precision::Exact);
    }
}

#[test]
fn trees_do_not_depend_on_the_number_of_threads() {
    // Enough for threads to share every part of a build.
    let grid: Vec<[Corner; 3]> = (0..50_000)
        .map(|k| {
            [
                [k % 100, k / 100 % 100, k / 10_000],
                [k % 100 + 1, k / 100 % 100, 3],
                [k % 100, k / 100 % 100 + 1, 1],
            ]
        })
        .collect();
    let mut geometry = Geometry::default();
    add_mesh(&mut geometry, &grid, &Matrix::IDENTITY, 1);
    for method in SplitMethod::ALL {
        let trees = [1, 2, 5].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            let options = BuildOptions::new(method);
            pool.install(|| {
                feimos::accel::Aggregate::build(
                    &geometry,
                    Point::default(),
                    options,
                    feimos::progress::Progress::SILENT,
                )
            })
        });
        assert!(trees[0] == trees[1] && trees[0] == trees[2], "{method}");
    }
}

/// The eye lies in the plane of a triangle: its edge functions are 0 along a row of pixels, and its
/// nearness is NaN.
#[test]
fn a_triangle_seen_edge_on_is_not_hit() {
    let mut geometry = Geometry::default();
    add_mesh(
        &mut geometry,
        &[[[-4, 0, 2], [4, 0, 2], [0, 0, 4]]],
        &Matrix::IDENTITY,
        1,
    );
    let camera = Camera {
        world_from_camera: Matrix::IDENTITY,
        projection: Projection::perspective(90.0),
        screen_window: ScreenWindow::of_aspect(1.0),
        resolution: [9, 9],
    };
    for precision in Precision::ALL {
        assert_eq!(
            agreed_picture(&camera, &geometry, precision).traced.hits,
            0,
            "{precision}"
        );
    }
}

/// A triangle ties with a sphere, and triangles of two meshes tie: the first in the file wins.
#[test]
fn ties_go_to_the_first_in_the_file() {
    let mut geometry = Geometry::default();
    let plate = [[[-9, -9, 2], [9, -9, 2], [0, 9, 2]]];
    let transform = geometry.add_transform(Matrix::translate([0.0, 0.0, 3.0]));
    let camera = Camera {
        world_from_camera: Matrix::IDENTITY,
        projection: Projection::perspective(90.0),
        screen_window: ScreenWindow::of_aspect(1.0),
        resolution: [1, 1],
    };
    let first = |geometry: &Geometry| {
        agreed_picture(&camera, geometry, Precision::Exact)
            .image
            .numbers(ChannelName::Prim)
            .unwrap()[0]
    };
    geometry.add_sphere(1.0, None, transform, 1).unwrap();
    add_mesh(&mut geometry, &plate, &Matrix::IDENTITY, 2);
    assert_eq!(first(&geometry), 1);
    let mut reversed = Geometry::default();
    add_mesh(&mut reversed, &plate, &Matrix::IDENTITY, 1);
    add_mesh(&mut reversed, &plate, &Matrix::IDENTITY, 2);
    let transform = reversed.add_transform(Matrix::translate([0.0, 0.0, 3.0]));
    reversed.add_sphere(1.0, None, transform, 3).unwrap();
    assert_eq!(first(&reversed), 1);
}
