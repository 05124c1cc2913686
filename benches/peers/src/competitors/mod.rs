//! The competitors.

mod bvh_crate;
pub(crate) mod embree;
mod feimos;
mod obvhs;
mod solid;

pub(crate) use embree::Device;

use self::feimos::Feimos;
use self::obvhs::{Obvhs, Width};
use crate::competitor::Competitor;
use crate::geometry::Geometry;
use crate::view::View;
use ::feimos::accel::{Accelerator, SplitMethod};
use ::feimos::simd::Level;
use bvh_crate::BvhCrate;
use embree::{Embree, Quality};
use solid::{Ball, Solid, Triangle};

/// All competitors for one view, in the order in which they run: feimos with the instructions of `level`, Embree with
/// the threads and instructions of `device`.
pub(crate) fn all<'a>(
    view: &'a View,
    level: Level,
    device: &'a Device,
) -> Vec<Box<dyn Competitor + 'a>> {
    match view.geometry {
        Geometry::Triangles { .. } => of_solids::<Triangle>(view, level, device),
        Geometry::Spheres(_) => of_solids::<Ball>(view, level, device),
    }
}

fn of_solids<'a, S: Solid + 'a>(
    view: &'a View,
    level: Level,
    device: &'a Device,
) -> Vec<Box<dyn Competitor + 'a>> {
    let embree_input = embree::input(view);
    vec![
        Box::new(Feimos::new(
            view,
            Accelerator::Tree(SplitMethod::Sah),
            level,
        )),
        Box::new(Embree::new(view, device, &embree_input, Quality::Medium)),
        Box::new(Obvhs::<S>::new(view, Width::Wide)),
        Box::new(Feimos::new(view, Accelerator::Raster, level)),
        Box::new(Feimos::new(
            view,
            Accelerator::Tree(SplitMethod::Hlbvh),
            level,
        )),
        Box::new(Embree::new(view, device, &embree_input, Quality::Low)),
        Box::new(Obvhs::<S>::new(view, Width::Binary)),
        Box::new(BvhCrate::<S>::new(view)),
    ]
}
