//! Helpers of several test files: rendering to memory, and comparing images by their bits.
// Each test file is a crate of its own and uses some of this.
#![allow(dead_code, unused_imports)]

mod images;
mod single_rays;

pub(crate) use images::{assert_same, bits_of, judged, rendered};
use single_rays::assert_single_rays_agree;

use feimos::accel::{
    Accelerator, Aggregate, Bins, BuildOptions, Precision, SplitMethod, Structure,
};
use feimos::camera::{
    Camera, Distortion, Fisheye, Projection, RadialTangential, ScreenWindow, SphereMapping,
};
use feimos::film::{ChannelName, Image, PixelBounds};
use feimos::geometry::{Matrix, Point};
use feimos::progress::Progress;
use feimos::render::{RenderOptions, Rendering, render};
use feimos::scene::{LoadOptions, Scene, load};
use feimos::shape::Geometry;
use feimos::simd::Level;
use proptest::test_runner::Config as ProptestConfig;
use std::path::Path;

/// `in_ci` random cases of each kind, or the number in the environment variable `FEIMOS_CASES`.
pub(crate) fn cases(in_ci: u32) -> ProptestConfig {
    let cases = std::env::var("FEIMOS_CASES")
        .ok()
        .map(|cases| cases.parse().expect("a number of cases"));
    ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(cases.unwrap_or(in_ci))
    }
}

/// Loads a scene that must load.
pub(crate) fn scene(path: &Path) -> Scene {
    load(path, &LoadOptions::default(), Progress::SILENT).unwrap_or_else(|error| panic!("{error}"))
}

/// A way to render an image. None of it affects the image.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Way {
    pub(crate) build: BuildOptions,
    pub(crate) threads: usize,
    pub(crate) level: Level,
    pub(crate) tree: Tree,
}

impl Way {
    /// The way of an accelerator of the command line, with the best instructions.
    pub(crate) fn of(accelerator: Accelerator, threads: usize) -> Way {
        let (method, tree) = match accelerator {
            Accelerator::Raster => (SplitMethod::Sah, Tree::Bins),
            Accelerator::Tree(method) => (method, Tree::OfAll),
        };
        Way {
            build: BuildOptions::new(method),
            threads,
            level: Level::detect(),
            tree,
        }
    }
}

/// The structure: a tree with its contents and its anchor, or bins.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Tree {
    /// None: bins of what the view may see. Views that have no bins get a tree of all primitives.
    Bins,
    /// All primitives; anchored at the eye.
    OfAll,
    /// All primitives; anchored at the middle of the scene, for many views. Hits in `f32` differ
    /// from those of other anchors.
    Shared,
}

/// Builds and validates the tree, and renders every channel of `window` that does not depend on the
/// accelerator, on `threads` threads.
pub(crate) fn picture(
    camera: &Camera,
    geometry: &Geometry,
    build: BuildOptions,
    precision: Precision,
    threads: usize,
    window: PixelBounds,
) -> Rendering {
    picture_by(
        camera,
        geometry,
        Way {
            build,
            threads,
            level: Level::detect(),
            tree: Tree::OfAll,
        },
        precision,
        window,
    )
}

/// Like [`picture`], in a given way.
pub(crate) fn picture_by(
    camera: &Camera,
    geometry: &Geometry,
    way: Way,
    precision: Precision,
    window: PixelBounds,
) -> Rendering {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(way.threads)
        .build()
        .unwrap();
    pool.install(|| {
        let of_all = |anchor: Point| {
            let aggregate = Aggregate::build(geometry, anchor, way.build, Progress::SILENT);
            aggregate
                .validate(geometry)
                .unwrap_or_else(|wrong| panic!("{way:?}: {wrong}"));
            aggregate
        };
        let bins = match way.tree {
            Tree::Bins => bins_of(camera, geometry, &way, &window),
            Tree::OfAll | Tree::Shared => None,
        };
        let aggregate = match way.tree {
            _ if bins.is_some() => None,
            Tree::Shared => Some(of_all(middle(geometry))),
            Tree::Bins | Tree::OfAll => Some(of_all(camera.anchor())),
        };
        let of_bins = bins.as_ref().map(Structure::Bins);
        let structure = of_bins.or(aggregate.as_ref().map(Structure::Tree)).unwrap();
        let channels = ChannelName::ALL
            .into_iter()
            .filter(|name| *name != ChannelName::Cost)
            .collect();
        let (miss, level) = (f32::INFINITY, way.level);
        let options = RenderOptions {
            data_window: window,
            channels,
            miss,
            precision,
            level,
        };
        let rendering = render(camera, geometry, structure, &options, Progress::SILENT).unwrap();
        // Other code runs if only hit or miss is requested.
        let options = RenderOptions {
            channels: vec![ChannelName::A],
            ..options
        };
        let hits = render(camera, geometry, structure, &options, Progress::SILENT).unwrap();
        if let Some(aggregate) = &aggregate {
            let (image, way) = (&rendering.image, (precision, way.level));
            assert_single_rays_agree(camera, geometry, aggregate, way, &window, image);
        }
        let hit = |image: &Image| bits_of(image, ChannelName::A);
        assert_eq!(
            hit(&rendering.image),
            hit(&hits.image),
            "{way:?}: hit or miss alone"
        );
        rendering
    })
}

/// The bins of a view, if it has any. Asserts that they count what can never be hit.
fn bins_of(camera: &Camera, geometry: &Geometry, way: &Way, window: &PixelBounds) -> Option<Bins> {
    let silent = Progress::SILENT;
    let bins = Bins::new(geometry, camera, window, way.build, way.level, silent)?;
    assert_eq!(bins.never_hit(), geometry.never_hit(), "{way:?}");
    Some(bins)
}

/// The middle of the box around everything, or the origin if the scene is empty.
fn middle(geometry: &Geometry) -> Point {
    let middle = geometry.extent().centre();
    if middle.is_finite() {
        middle
    } else {
        Point::default()
    }
}

/// All pixels of the film.
pub(crate) fn whole(camera: &Camera) -> PixelBounds {
    let [width, height] = camera.resolution;
    PixelBounds::of_film(width, height)
}

/// Renders with every accelerator, three leaf sizes, several numbers of threads, all SIMD levels of
/// the machine, and all kinds of trees. Asserts that no bit differs from the plain list on one
/// thread, and returns that image.
pub(crate) fn agreed_picture(
    camera: &Camera,
    geometry: &Geometry,
    precision: Precision,
) -> Rendering {
    let window = whole(camera);
    let levels: Vec<Level> = Level::available().collect();
    let way = Way {
        build: BuildOptions::new(SplitMethod::None),
        threads: 1,
        level: Level::Portable,
        tree: Tree::OfAll,
    };
    let reference = picture_by(camera, geometry, way, precision, window);
    let trees: &[Tree] = match precision {
        Precision::Exact => &[Tree::Bins, Tree::Shared, Tree::OfAll],
        _ => &[Tree::Bins, Tree::OfAll],
    };
    let mut turn = 0;
    for method in SplitMethod::ALL {
        for (max_leaf, threads) in [(4, 2), (1, 1), (16, 3)] {
            // Combines every level with every accelerator, leaf size and kind of tree.
            let (level, tree) = (
                levels[turn % levels.len()],
                trees[turn / levels.len() % trees.len()],
            );
            turn += 1;
            let way = Way {
                build: BuildOptions { method, max_leaf },
                threads,
                level,
                tree,
            };
            let other = picture_by(camera, geometry, way, precision, window);
            assert_same(&reference.image, &other.image, &format!("{way:?}"));
            assert_eq!(reference.traced.hits, other.traced.hits);
        }
    }
    reference
}

/// Adds a mesh of triangles that share no vertices.
pub(crate) fn add_triangles(
    geometry: &mut Geometry,
    triangles: &[[Point; 3]],
    world_from_object: &Matrix,
    shape: u32,
) {
    let vertices = triangles.iter().flatten().copied().collect();
    let indices = (0..triangles.len() as u32)
        .map(|k| [3 * k, 3 * k + 1, 3 * k + 2])
        .collect();
    geometry
        .add_mesh(vertices, indices, world_from_object, shape)
        .unwrap();
}

/// A camera whose rays pass through the points of an integer grid.
pub(crate) fn grid_camera(world_from_camera: Matrix, projection: Projection, size: u32) -> Camera {
    let half = f64::from(size) / 2.0;
    let screen_window = ScreenWindow {
        x0: -half,
        x1: half,
        y0: -half,
        y1: half,
    };
    Camera {
        world_from_camera,
        projection,
        screen_window,
        resolution: [size, size],
    }
}

/// Cameras of every kind. The lens of one folds back within the film of most tests, and that of
/// another sees behind the eye.
pub(crate) fn projections() -> Vec<Projection> {
    let mut projections = vec![
        Projection::Perspective { tangent: 1.0 },
        Projection::Orthographic,
    ];
    projections.extend(SphereMapping::ALL.map(Projection::Spherical));
    projections.extend([wide_angle(), fisheye()].map(Projection::Distorted));
    projections
}

fn wide_angle() -> Distortion {
    let lens = RadialTangential::new([-0.25, 0.0, 0.0, 0.0], [0.0; 3], [0.01, -0.02]);
    Distortion::RadialTangential(lens.unwrap())
}

fn fisheye() -> Distortion {
    Distortion::Fisheye(Fisheye::new([-0.05, 0.01, 0.0, 0.0]).unwrap())
}

/// The scene of a file with this text, which must load.
pub(crate) fn scene_of(text: &str) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.pbrt");
    std::fs::write(&path, text).unwrap();
    scene(&path)
}
