//! Embree 3: robust, coherent, 16 rays at a time, 4 by 4 pixels, or one after the other; all in Embree's favour where there was a choice: it
//! reads arrays in place instead of copying them, and rays are computed, which is quicker than reading them.

mod packet;
mod rtcore;

pub(crate) use packet::{Packets, Question};
pub(crate) use rtcore::{Device, Input, Quality, Scene};

use crate::competitor::Competitor;
use crate::picture::Picture;
use crate::single_rays;
use crate::view::View;
use std::sync::Arc;
use std::time::{Duration, Instant};

const MODES: [Mode; 3] = [
    Mode::Packets(Question::ClosestHit),
    Mode::Packets(Question::AnyHit),
    Mode::SingleRays,
];
const MODE_NAMES: [&str; 3] = ["packets", "packets, hit or miss", "single rays"];

/// How rays are traced.
enum Mode {
    Packets(Question),
    /// One ray after the other: depth and primitive.
    SingleRays,
}

/// Embree with one build quality.
pub(crate) struct Embree<'a> {
    view: &'a View,
    device: &'a Device,
    quality: Quality,
    input: Arc<Input>,
    scene: Option<Scene>,
}

impl<'a> Embree<'a> {
    pub(crate) fn new(
        view: &'a View,
        device: &'a Device,
        input: &Arc<Input>,
        quality: Quality,
    ) -> Embree<'a> {
        Embree {
            view,
            device,
            quality,
            input: Arc::clone(input),
            scene: None,
        }
    }
}

/// The arrays for all qualities.
pub(crate) fn input(view: &View) -> Arc<Input> {
    Arc::new(Input::new(&view.geometry))
}

impl Competitor for Embree<'_> {
    fn name(&self) -> String {
        format!("embree {}", self.quality.name())
    }

    fn discard(&mut self) {
        self.scene = None;
    }

    fn build(&mut self) {
        self.scene = Some(Scene::build(self.device, &self.input, self.quality));
    }

    fn modes(&self) -> &[&'static str] {
        &MODE_NAMES
    }

    fn trace(&self, mode: usize, picture: &mut Picture) -> Duration {
        let scene = self.scene.as_ref().expect("built before it is traced");
        let start = Instant::now();
        let rays = &self.view.rays;
        match MODES[mode] {
            Mode::Packets(question) => picture.fill_bands(|band| {
                Packets {
                    scene,
                    rays,
                    question,
                }
                .fill(band)
            }),
            Mode::SingleRays => {
                single_rays::trace(rays, picture, |ray| rtcore::closest_hit(scene, ray))
            }
        }
        start.elapsed()
    }
}
