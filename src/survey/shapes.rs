//! The shapes and instances of a scene with their boxes in the world.

use crate::geometry::{Bounds, Point};
use crate::parallel::CollectVec;
use crate::per_axis::per_axis;
use crate::scene::{Locations, Scene};
use crate::shape::{Geometry, InstancedId};
use rayon::prelude::*;

/// The statement that a surveyed shape comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// `Shape` statement number, counted from 1.
    Shape(u32),
    /// `ObjectInstance` statement number, counted from 0.
    Instance(usize),
}

/// A shape in no object, or an instance of an object.
#[derive(Debug, Clone, PartialEq)]
pub struct SurveyedShape {
    /// Its statement.
    pub source: Source,
    /// The box in the world around everything of it that can be hit; empty if nothing can. That of
    /// an instance is the box around the box of its object.
    pub bounds: Bounds,
    /// The number of its primitives.
    pub primitives: u64,
    /// The [stretch](crate::geometry::Matrix::stretch) of its transform; 1 if the scene has kept no
    /// [locations](Scene::locations).
    pub stretch: f64,
    /// Whether it is the shape of an area light.
    pub is_light: bool,
}

/// All shapes in no object and all instances of a scene, in the order of the file. Shapes that have
/// no primitives are left out.
#[derive(Debug, Clone, PartialEq)]
pub struct Survey {
    /// The shapes and instances.
    pub shapes: Vec<SurveyedShape>,
    /// The box around all of them, as [`Geometry::extent`] defines it.
    pub bounds: Bounds,
}

impl Survey {
    /// Surveys a scene on the threads of the current rayon pool. The scene has to keep its
    /// [locations](Scene::locations), or stretches and lights are unknown.
    pub fn of(scene: &Scene) -> Survey {
        let geometry = &scene.geometry;
        let mut shapes = own_shapes(geometry, scene.locations.as_ref());
        shapes.extend(instances(geometry));
        shapes.sort_by_key(|(number, _)| *number);
        let shapes: Vec<SurveyedShape> = shapes.into_iter().map(|(_, shape)| shape).collect();
        let boxes = shapes.iter().map(|shape| shape.bounds);
        let bounds = boxes.fold(Bounds::EMPTY, Bounds::union);
        Survey { shapes, bounds }
    }
}

impl SurveyedShape {
    /// Whether anything of it can be hit.
    pub fn can_be_hit(&self) -> bool {
        !self.bounds.is_empty()
    }
}

/// The shapes in no object, each with the number of its first primitive.
fn own_shapes(geometry: &Geometry, locations: Option<&Locations>) -> Vec<(u64, SurveyedShape)> {
    let runs = geometry.shape_runs();
    let boxes = runs.par_iter().map(|run| geometry.extent_of_run(run));
    let boxes: Vec<Bounds> = boxes.collect_vec();
    let shapes = runs.iter().zip(boxes).map(|(run, bounds)| {
        let stated = locations.and_then(|locations| locations.stated_shape(run.shape));
        let shape = SurveyedShape {
            source: Source::Shape(run.shape),
            bounds,
            primitives: run.count() as u64,
            stretch: stated.map_or(1.0, |stated| stated.stretch),
            is_light: stated.is_some_and(|stated| stated.is_light),
        };
        (geometry.number(InstancedId::alone(run.first())), shape)
    });
    let mut shapes: Vec<(u64, SurveyedShape)> = shapes.collect();
    // Runs of one shape follow each other in the order of their numbers.
    shapes.sort_by_key(|(number, _)| *number);
    shapes.dedup_by(|(_, next), (_, shape)| {
        let is_same = next.source == shape.source;
        if is_same {
            shape.bounds = shape.bounds.union(next.bounds);
            shape.primitives += next.primitives;
        }
        is_same
    });
    shapes
}

/// The instances, each with the number of its first primitive.
fn instances(geometry: &Geometry) -> Vec<(u64, SurveyedShape)> {
    let objects = geometry.extents_of_objects();
    let counts: Vec<u64> = geometry.objects().iter().map(count).collect();
    let instance = |index: usize| {
        let instance = &geometry.instances()[index];
        let shape = SurveyedShape {
            source: Source::Instance(index),
            bounds: geometry.extent_of_instance(index, &objects),
            primitives: counts[instance.object()],
            stretch: instance.world_from_instance().stretch(),
            is_light: false,
        };
        (instance.first_number(), shape)
    };
    let indices = (0..geometry.instances().len()).into_par_iter();
    indices.map(instance).collect_vec()
}

fn count(object: &Geometry) -> u64 {
    object.own_count() as u64
}

/// The distance of a box from a point: 0 inside.
pub(super) fn distance(bounds: &Bounds, point: Point) -> f64 {
    length(per_axis(|k| {
        let (below, above) = (bounds.low[k] - point[k], point[k] - bounds.high[k]);
        below.max(above).max(0.0)
    }))
}

/// The distance of the farthest corner of a box from a point.
pub(super) fn reach(bounds: &Bounds, point: Point) -> f64 {
    length(per_axis(|k| {
        let (low, high) = (point[k] - bounds.low[k], bounds.high[k] - point[k]);
        low.max(high)
    }))
}

/// The length of the diagonal of a box.
pub(super) fn diagonal(bounds: &Bounds) -> f64 {
    length((bounds.high - bounds.low).to_array())
}

/// The length of a vector, without overflow.
fn length([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).hypot(z)
}
