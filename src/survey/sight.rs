//! What a camera may see of the surveyed shapes.

use super::oddity::is_flat;
use super::shapes::{Survey, SurveyedShape, distance};
use super::view_volume::{ViewVolume, Visibility};
use crate::camera::Camera;
use crate::film::PixelBounds;
use crate::geometry::Point;

/// What a camera may see.
#[derive(Debug, Clone, PartialEq)]
pub struct Sight {
    /// What the camera may see of each shape, in the order of the survey.
    pub visibility: Vec<Visibility>,
    /// Whether the eye is within the box around all shapes.
    pub is_within_bounds: bool,
    /// Whether shapes surround the eye, as the walls of a room do: then it is usual that some are
    /// behind it.
    pub is_surrounded: bool,
    /// The places in the survey of the shapes whose boxes hold the eye and less than half of the
    /// other shapes: they are no rooms and no skies. None for a spherical camera, which is often
    /// in the middle of something.
    pub around_eye: Vec<usize>,
    eye: Point,
}

impl Survey {
    /// What the pixels `window` of a camera's film may show.
    pub fn seen_by(&self, camera: &Camera, window: &PixelBounds) -> Sight {
        let volume = ViewVolume::new(camera, window);
        let visibility = self
            .shapes
            .iter()
            .map(|shape| volume.visibility(&shape.bounds));
        let eye = camera.anchor();
        let around_eye = if camera.projection.is_linear() {
            around(&self.shapes, eye)
        } else {
            Vec::new()
        };
        Sight {
            visibility: visibility.collect(),
            is_within_bounds: !self.bounds.is_empty() && distance(&self.bounds, eye) == 0.0,
            is_surrounded: surround(&self.shapes, eye),
            around_eye,
            eye,
        }
    }
}

impl Sight {
    /// Whether the picture is certainly empty: no shape's box reaches it.
    pub fn sees_nothing(&self) -> bool {
        self.count(Visibility::InView) == 0
    }

    /// The number of shapes that the camera sees in this way.
    pub fn count(&self, visibility: Visibility) -> usize {
        self.visibility
            .iter()
            .filter(|seen| **seen == visibility)
            .count()
    }

    /// The distance of the eye from the nearest point of a shape's box.
    pub fn distance(&self, shape: &SurveyedShape) -> f64 {
        distance(&shape.bounds, self.eye)
    }

    /// The places in the survey of the shapes that are behind the camera, but not of area lights.
    pub fn behind(&self, survey: &Survey) -> Vec<usize> {
        let shapes = survey.shapes.iter().zip(&self.visibility).enumerate();
        let behind =
            shapes.filter(|(_, (shape, seen))| **seen == Visibility::Behind && !shape.is_light);
        behind.map(|(place, _)| place).collect()
    }
}

/// Whether the eye is within the box of a shape that is no plane, or has shapes on both sides along
/// two axes.
fn surround(shapes: &[SurveyedShape], eye: Point) -> bool {
    let mut sides = [[false; 2]; 3];
    for shape in shapes.iter().filter(|shape| shape.can_be_hit()) {
        if distance(&shape.bounds, eye) == 0.0 && !is_flat(&shape.bounds) {
            return true;
        }
        let towards = shape.bounds.centre() - eye;
        let axis = towards.largest_axis();
        sides[axis][usize::from(towards[axis] > 0.0)] = true;
    }
    sides.iter().filter(|sides| **sides == [true; 2]).count() >= 2
}

/// Shapes around the eye that are compared with all others.
const MOST_AROUND: usize = 64;

/// The places of the shapes around the eye that hold less than half of the others; the first ones,
/// if many shapes are around it.
fn around(shapes: &[SurveyedShape], eye: Point) -> Vec<usize> {
    let is_within = |shape: &SurveyedShape, point: Point| {
        shape.can_be_hit() && distance(&shape.bounds, point) == 0.0
    };
    let around = |place: &usize| {
        let shape = &shapes[*place];
        is_within(shape, eye) && !is_flat(&shape.bounds)
    };
    let visible = || shapes.iter().filter(|shape| shape.can_be_hit());
    let others = visible().count().saturating_sub(1);
    let is_small = |place: &usize| {
        let holds = |other: &&SurveyedShape| is_within(&shapes[*place], other.bounds.centre());
        // One of those that it holds is itself.
        2 * visible().filter(holds).count().saturating_sub(1) < others
    };
    let around = (0..shapes.len()).filter(around).take(MOST_AROUND);
    around.filter(is_small).collect()
}
