//! A program around Embree: a tree of low quality, coherent packets of 16 rays.

use super::loader::{self, Scene as LoadedScene};
use super::report::{Clock, Report};
use crate::Result;
use crate::args::{Isa, ProgramOptions};
use crate::camera_rays::CameraRays;
use crate::competitors::Device;
use crate::competitors::embree::{Input, Packets, Quality, Question, Scene};
use crate::geometry::Geometry;
use crate::picture::Picture;
use std::sync::Arc;

/// Renders a scene from each of its cameras, and prints a [`Report`].
pub(crate) fn run(options: &ProgramOptions) -> Result<()> {
    let mut clock = Clock::start();
    let mut report = Report::default();
    let LoadedScene { cameras, geometry } =
        loader::load(&options.scene, options.cameras.as_deref())?;
    report.load = clock.lap();
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads)
        .build()?;
    let device = Device::new(options.threads, options.isa.map(Isa::name))?;
    let scene = Scene::build(&device, &Arc::new(input(geometry)), Quality::Low);
    report.build = clock.lap();
    let mut picture = Picture::new(0, 0);
    for (name, camera) in &cameras {
        let [width, height] = camera.resolution.map(|side| side as usize);
        if picture.depths.len() != width * height {
            picture = Picture::new(width, height);
        }
        let rays = CameraRays::new(camera);
        let packets = Packets {
            scene: &scene,
            rays: &rays,
            question: Question::Depth,
        };
        pool.install(|| picture.fill_bands(|band| packets.fill(band)));
        report.trace += clock.lap();
        report.compare(&picture.depths, options, name)?;
        clock.lap();
    }
    report.print_and_exit()
}

/// The arrays as they are, which Embree reads in place.
fn input(geometry: Geometry) -> Input {
    match geometry {
        Geometry::Triangles {
            mut vertices,
            triangles,
        } => {
            vertices.push([0.0; 3]);
            Input::Triangles {
                padded_vertices: vertices,
                triangles,
            }
        }
        Geometry::Spheres(spheres) => Input::Spheres(spheres),
    }
}
