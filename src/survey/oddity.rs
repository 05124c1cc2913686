//! Shapes that are unlike the others: far away, of another size, or stretched.

use super::shapes::{Source, Survey, SurveyedShape, diagonal, distance, reach};
use crate::geometry::{Bounds, Point};
use crate::per_axis::per_axis;
use crate::scene::Scene;

/// What is odd about a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Oddity {
    /// It is far from all others.
    Far {
        /// Its distance from the middle of the shapes.
        distance: f64,
        /// Most shapes are within this distance.
        usual: f64,
    },
    /// It is much larger than the others, without enclosing them.
    Large {
        /// The diagonal of its box.
        size: f64,
        /// The median of all shapes.
        usual: f64,
    },
    /// It is much smaller than the others.
    Small {
        /// The diagonal of its box.
        size: f64,
        /// The median of all shapes.
        usual: f64,
    },
    /// Its transform scales directions by very different factors.
    Stretched {
        /// The ratio of the largest to the smallest factor.
        stretch: f64,
    },
}

impl Oddity {
    /// The place of its kind among all kinds.
    fn rank(&self) -> u8 {
        match self {
            Oddity::Far { .. } => 0,
            Oddity::Large { .. } => 1,
            Oddity::Small { .. } => 2,
            Oddity::Stretched { .. } => 3,
        }
    }
}

/// An odd shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Finding {
    /// Its statement. It may be in an object.
    pub source: Source,
    /// What is odd about it.
    pub oddity: Oddity,
}

/// A shape is far if it is this many times as far away as most reach.
const FAR: f64 = 30.0;
/// A shape is large or small if its size and the median have this ratio.
const ODD_SIZE: f64 = 1e3;
/// A transform is stretched if its factors have more than this ratio.
const MOST_STRETCH: f64 = 1e4;
/// A box is flat if one side is less than this part of the longest.
const FLAT: f64 = 1e-3;
/// Of fewer shapes, none is unlike the others.
const FEWEST: usize = 3;

impl Survey {
    /// The odd shapes of the surveyed `scene`, kind by kind. Area lights are often far away or
    /// small, and planes large: neither is odd.
    pub fn findings(&self, scene: &Scene) -> Vec<Finding> {
        let mut findings = self.far_shapes(scene.camera.anchor());
        findings.extend(self.odd_sizes());
        findings.extend(self.stretched(scene));
        findings.sort_by_key(|finding| finding.oddity.rank());
        findings
    }

    /// The shapes that can be hit.
    fn visible(&self) -> Vec<&SurveyedShape> {
        let finite =
            |shape: &&SurveyedShape| shape.can_be_hit() && diagonal(&shape.bounds).is_finite();
        self.shapes.iter().filter(finite).collect()
    }

    /// The camera counts like a shape: it is where something is to be seen.
    fn far_shapes(&self, eye: Point) -> Vec<Finding> {
        let shapes = self.visible();
        if shapes.len() + 1 < FEWEST {
            return Vec::new();
        }
        let centres = shapes.iter().map(|shape| shape.bounds.centre());
        let middle = median(centres.chain([eye]));
        let camera = Bounds::of([eye]);
        let boxes = shapes.iter().map(|shape| &shape.bounds).chain([&camera]);
        let usual = quantile(boxes.map(|bounds| reach(bounds, middle)).collect(), 0.75);
        let far = shapes.iter().filter(|shape| !shape.is_light);
        let far = far.filter_map(|shape| {
            let distance = distance(&shape.bounds, middle);
            let oddity = Oddity::Far { distance, usual };
            (distance > FAR * usual).then_some(Finding {
                source: shape.source,
                oddity,
            })
        });
        far.collect()
    }

    fn odd_sizes(&self) -> Vec<Finding> {
        let shapes = self.visible();
        if shapes.len() < FEWEST {
            return Vec::new();
        }
        let middle = median(shapes.iter().map(|shape| shape.bounds.centre()));
        let usual = quantile(
            shapes.iter().map(|shape| diagonal(&shape.bounds)).collect(),
            0.5,
        );
        let odd = shapes.iter().filter(|shape| !shape.is_light);
        let odd = odd.filter_map(|shape| {
            let size = diagonal(&shape.bounds);
            let encloses = distance(&shape.bounds, middle) == 0.0;
            let oddity = if size > ODD_SIZE * usual && !encloses && !is_flat(&shape.bounds) {
                Oddity::Large { size, usual }
            } else if size * ODD_SIZE < usual {
                Oddity::Small { size, usual }
            } else {
                return None;
            };
            Some(Finding {
                source: shape.source,
                oddity,
            })
        });
        odd.collect()
    }

    fn stretched(&self, scene: &Scene) -> Vec<Finding> {
        let stated = scene.locations.iter().flat_map(|all| all.stated_shapes());
        let shapes = stated.map(|(number, shape)| (Source::Shape(number), shape.stretch));
        let instances = self.shapes.iter().filter_map(|shape| {
            let is_instance = matches!(shape.source, Source::Instance(_));
            is_instance.then_some((shape.source, shape.stretch))
        });
        // Flat space has a warning of its own when the scene is read.
        let odd = shapes
            .chain(instances)
            .filter(|(_, stretch)| *stretch > MOST_STRETCH && stretch.is_finite());
        let finding = |(source, stretch)| Finding {
            source,
            oddity: Oddity::Stretched { stretch },
        };
        odd.map(finding).collect()
    }
}

/// The point of the median coordinates. There is at least one point.
fn median(points: impl Iterator<Item = Point> + Clone) -> Point {
    let median = |k: usize| quantile(points.clone().map(|point| point[k]).collect(), 0.5);
    per_axis(median).into()
}

/// The number that `part` of all others do not exceed. There is at least one.
fn quantile(mut numbers: Vec<f64>, part: f64) -> f64 {
    let place = ((numbers.len() - 1) as f64 * part) as usize;
    *numbers.select_nth_unstable_by(place, f64::total_cmp).1
}

/// Whether a box is that of a plane.
pub(super) fn is_flat(bounds: &Bounds) -> bool {
    let sides = (bounds.high - bounds.low).to_array();
    let longest = sides.into_iter().fold(0.0, f64::max);
    sides.into_iter().any(|side| side <= FLAT * longest)
}
