//! Random worlds of triangles and quadrics, some of them with holes.

use crate::common::add_triangles;
use feimos::geometry::{Matrix, Point};
use feimos::shape::{Alpha, AlphaCutoff, CornerUv, Cut, Disk, Form, Geometry, Revolved};
use feimos::texture::{Filter, FloatTexture, ImageTexture, Texels, UvMapping, Wrap};
use proptest::prelude::*;
use std::sync::Arc;

type Corner = [i32; 3];
/// A triangle, and u and v in quarters at its corners.
type Face = ([Corner; 3], Option<[[i8; 2]; 3]>);

#[derive(Debug, Clone)]
pub(crate) enum Surface {
    Mesh(Vec<Face>),
    Quadric(Matrix, f64, Form),
    /// A bilinear patch, and u and v in quarters at its corners.
    Patch([Corner; 4], Option<[[i8; 2]; 4]>),
}

/// Shapes, each with its alpha.
#[derive(Debug, Clone)]
pub(crate) struct World {
    pub(crate) shapes: Vec<(Surface, Option<Alpha>)>,
    /// The places of all shapes, as instances or written out.
    pub(crate) places: Vec<Matrix>,
    pub(crate) is_instanced: bool,
}

impl World {
    pub(crate) fn geometry(&self) -> Geometry {
        let mut geometry = Geometry::default();
        if self.is_instanced {
            let mut object = Geometry::default();
            self.add_shapes(&mut object, None);
            let object = geometry.add_object(object);
            for place in &self.places {
                geometry.add_instance(object, *place).unwrap();
            }
        } else {
            for place in &self.places {
                self.add_shapes(&mut geometry, Some(place));
            }
        }
        geometry
    }

    /// Adds all shapes at `place`, or as those of an object.
    fn add_shapes(&self, geometry: &mut Geometry, place: Option<&Matrix>) {
        for ((surface, alpha), shape) in self.shapes.iter().zip(1..) {
            let before = geometry.counts();
            match surface {
                Surface::Mesh(triangles) => {
                    let point = |corner: Corner| Point::from(corner.map(f64::from));
                    let corners: Vec<[Point; 3]> = triangles
                        .iter()
                        .map(|(corners, _)| corners.map(point))
                        .collect();
                    match place {
                        Some(place) => add_triangles(geometry, &corners, place, shape),
                        None => add_object_triangles(geometry, &corners, shape),
                    }
                    let uv = triangles.iter().map(|(_, uv)| uv.as_ref().map(corner_uv));
                    if let Some(uv) = uv.collect() {
                        geometry.add_uv(uv);
                    }
                }
                Surface::Quadric(matrix, radius, form) => {
                    let matrix = place.map_or(*matrix, |place| place.times(matrix));
                    let transform = geometry.add_transform(matrix);
                    geometry
                        .add_quadric(*radius, *form, transform, shape)
                        .unwrap();
                }
                Surface::Patch(corners, uv) => {
                    let corners = corners.map(|corner| Point::from(corner.map(f64::from)));
                    match place {
                        Some(place) => geometry.add_patch(corners, place, shape).unwrap(),
                        None => {
                            let transform = geometry.add_transform(Matrix::IDENTITY);
                            geometry
                                .add_object_patch(corners, transform, shape)
                                .unwrap();
                        }
                    }
                    if let Some(uv) = uv {
                        let quarters = |quarter: i8| f32::from(quarter) * 0.25;
                        geometry.add_patch_uv(uv.map(|uv| uv.map(quarters)));
                    }
                }
            }
            if let Some(alpha) = alpha {
                geometry.cut_out(before, alpha.clone());
            }
        }
    }
}

fn corner_uv(quarters: &[[i8; 2]; 3]) -> CornerUv {
    quarters.map(|uv| uv.map(|quarter| f32::from(quarter) * 0.25))
}

fn add_object_triangles(geometry: &mut Geometry, triangles: &[[Point; 3]], shape: u32) {
    let vertices = triangles.iter().flatten().copied().collect();
    let indices = (0..triangles.len() as u32)
        .map(|k| [3 * k, 3 * k + 1, 3 * k + 2])
        .collect();
    let transform = geometry.add_transform(Matrix::IDENTITY);
    geometry
        .add_object_mesh(vertices, indices, transform, shape)
        .unwrap();
}

fn texture() -> impl Strategy<Value = FloatTexture> {
    let mapping = (
        prop::array::uniform2(prop::sample::select(vec![1.0, 2.0, -3.0, 0.5])),
        prop::array::uniform2(prop::sample::select(vec![0.0, 0.25, -7.5])),
    );
    let mapping = mapping.prop_map(|(scale, delta)| UvMapping { scale, delta });
    let constant = |value| Arc::new(FloatTexture::Constant(value));
    let board = mapping
        .clone()
        .prop_map(move |mapping| FloatTexture::Checkerboard {
            mapping,
            of: [constant(1.0), constant(0.0)],
        });
    let dots = mapping.clone().prop_map(move |mapping| FloatTexture::Dots {
        mapping,
        of: [constant(0.0), constant(0.5)],
    });
    let side = 1u32..4;
    let image = (
        mapping,
        side.clone(),
        side,
        any::<[bool; 9]>(),
        any::<bool>(),
        0usize..3,
    );
    let image = image.prop_map(|(mapping, width, height, set, is_point, wrap)| {
        let values = set.iter().map(|set| f32::from(u8::from(*set)));
        let values = values.take((width * height) as usize).collect();
        FloatTexture::Image(ImageTexture {
            mapping,
            texels: Arc::new(Texels::of_floats([width, height], values).unwrap()),
            wrap: [Wrap::Repeat, Wrap::Black, Wrap::Clamp][wrap],
            filter: match is_point {
                true => Filter::Point,
                false => Filter::Bilinear,
            },
            scale: 1.0,
            is_inverted: false,
        })
    });
    prop_oneof![2 => board, 1 => dots, 3 => image]
}

fn alpha() -> impl Strategy<Value = Option<Alpha>> {
    let cutoff = prop::sample::select(vec![0.0, 0.5]);
    let alpha = (texture(), cutoff).prop_map(|(texture, cutoff)| {
        Alpha::new(Arc::new(texture), AlphaCutoff::new(cutoff).unwrap())
    });
    prop_oneof![1 => Just(None), 3 => alpha.prop_map(Some)]
}

fn mesh() -> impl Strategy<Value = Surface> {
    let corner = || prop::array::uniform3(-3i32..4);
    let uv = || prop::array::uniform3(prop::array::uniform2(-4i8..9));
    let with_uv =
        prop::collection::vec((prop::array::uniform3(corner()), uv().prop_map(Some)), 1..4);
    let without = prop::collection::vec((prop::array::uniform3(corner()), Just(None)), 1..4);
    // Two halves of a square that covers the view: shared edges.
    let square = (-3i32..4, any::<bool>()).prop_map(|(z, is_turned)| {
        let at = |k: usize| [[-3, -3, z], [3, -3, z], [3, 3, z], [-3, 3, z]][k];
        let uv = |k: usize| [[0, 0], [4, 0], [4, 4], [0, 4]][k];
        let order = if is_turned {
            [[1, 2, 3], [1, 3, 0]]
        } else {
            [[0, 1, 2], [0, 2, 3]]
        };
        order
            .map(|corners| (corners.map(at), Some(corners.map(uv))))
            .to_vec()
    });
    prop_oneof![with_uv, without, square].prop_map(Surface::Mesh)
}

fn quadric() -> impl Strategy<Value = Surface> {
    let phi = || prop::sample::select(vec![90.0, 217.5, 360.0, 360.0]);
    let end = || (-3i32..4).prop_map(f64::from);
    let form = prop_oneof![
        2 => Just(Form::Sphere(None)),
        1 => (end(), end(), phi()).prop_map(|(low, high, phi)| {
            Form::Sphere(Cut::new(2.0, low, high, phi))
        }),
        1 => (end(), end(), phi()).prop_map(|(low, high, phi)| {
            Form::Cylinder(Cut::of_cylinder(low, high, phi))
        }),
        1 => (end(), phi()).prop_map(|(height, phi)| Form::Disk(Disk::new(height, 0.5, phi))),
        1 => (1i32..4, phi()).prop_map(|(height, phi)| {
            Form::Revolved(Revolved::cone(height.into(), phi))
        }),
        1 => (end(), 1i32..4, phi()).prop_map(|(low, high, phi)| {
            Form::Revolved(Revolved::paraboloid(low, high.into(), phi))
        }),
    ];
    let turns = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [[1.0, 0.0, 1.0], [0.0, -1.0, 0.0], [-1.0, 0.0, 1.0]],
    ];
    let turn = prop::sample::select(turns.to_vec()).prop_map(|turn| Matrix {
        rows: turn.map(|[x, y, z]| [x, y, z, 0.0]),
    });
    // Few places, so that some surfaces are the same.
    let centre = prop::array::uniform3(prop::sample::select(vec![0.0, 0.0, 1.0]));
    (form, turn, centre).prop_map(|(form, turn, centre)| {
        Surface::Quadric(Matrix::translate(centre).times(&turn), 2.0, form)
    })
}

fn patch() -> impl Strategy<Value = Surface> {
    let corner = || prop::array::uniform3(-3i32..4);
    let uv = prop::array::uniform4(prop::array::uniform2(-4i8..9));
    (prop::array::uniform4(corner()), prop::option::of(uv))
        .prop_map(|(corners, uv)| Surface::Patch(corners, uv))
}

pub(crate) fn world() -> impl Strategy<Value = World> {
    let surface = prop_oneof![2 => mesh(), 2 => quadric(), 1 => patch()];
    let shapes = prop::collection::vec((surface, alpha()), 1..6);
    let places = vec![
        Matrix::IDENTITY,
        Matrix::translate([1.0, 0.0, 2.0]),
        Matrix::scale([-1.0, 1.0, 0.5]),
    ];
    let places = prop::collection::vec(prop::sample::select(places), 1..3);
    (shapes, places, any::<bool>()).prop_map(|(shapes, places, is_instanced)| World {
        shapes,
        places,
        is_instanced,
    })
}

/// Quadrics that are all the same, or parts of the same, with holes of their own. Some are away
/// from the grid by half a unit in the last place of their depth.
pub(crate) fn shells() -> impl Strategy<Value = World> {
    let whole_sphere = Form::Sphere(None);
    let forms = vec![
        vec![whole_sphere],
        vec![
            whole_sphere,
            Form::Sphere(Cut::new(2.0, -1.0, 2.0, 360.0)),
            Form::Sphere(Cut::new(2.0, -2.0, 2.0, 90.0)),
        ],
        vec![Form::Cylinder(Cut::of_cylinder(-3.0, 3.0, 360.0))],
        vec![
            Form::Cylinder(Cut::of_cylinder(-3.0, 3.0, 360.0)),
            Form::Cylinder(Cut::of_cylinder(-3.0, 1.0, 180.0)),
        ],
    ];
    let turn = prop::sample::select(vec![
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
    ]);
    let offset = prop::sample::select(vec![0.0, 2f64.powi(-24), 2f64.powi(-23), 2f64.powi(-22)]);
    let shells = prop::collection::vec((any::<prop::sample::Index>(), alpha()), 2..5);
    let world = (prop::sample::select(forms), turn, offset, shells);
    world.prop_map(|(forms, turn, offset, shells)| {
        let turn = Matrix {
            rows: turn.map(|[x, y, z]| [x, y, z, 0.0]),
        };
        let place = Matrix::translate([0.0, 0.0, offset]).times(&turn);
        let shell = |(form, alpha): (prop::sample::Index, Option<Alpha>)| {
            let form = *form.get(&forms);
            (Surface::Quadric(place, 2.0, form), alpha)
        };
        World {
            shapes: shells.into_iter().map(shell).collect(),
            places: vec![Matrix::IDENTITY],
            is_instanced: false,
        }
    })
}
