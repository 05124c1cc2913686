//! The report on a scene: one struct for `--json`, whose keys are its field names, and for text.

mod bounds;
mod shape_list;
mod text;
mod view;

use super::checked::Checked;
use crate::camera::{Camera, SphereMapping};
use crate::cli::terminal::scene_summary::StoredGeometry;
use crate::error::{Diagnostic, Error};
use crate::film::PixelBounds;
use crate::scene::{AcceleratorParameters, Film, Listed, ShapeCount, Warning};
use bounds::Bounds;
use serde::Serialize;
use shape_list::ShapeEntry;
use std::collections::BTreeMap;
use std::path::Path;
use view::ViewContent;

#[derive(Debug, Serialize)]
pub(super) struct Report<'a> {
    scene: String,
    exit_code: u8,
    /// The error, if the scene could not be read.
    error: Option<Message<'a>>,
    warnings: Vec<CountedWarning<'a>>,
    #[serde(flatten)]
    content: Option<Content<'a>>,
}

#[derive(Debug, Serialize)]
struct Message<'a> {
    message: &'a str,
    place: Option<String>,
    notes: &'a [String],
}

#[derive(Debug, Serialize)]
struct CountedWarning<'a> {
    kind: &'a str,
    #[serde(flatten)]
    first: Message<'a>,
    count: u64,
}

/// The content of a scene.
#[derive(Debug, Serialize)]
struct Content<'a> {
    camera: CameraContent,
    film: FilmContent<'a>,
    accelerator: AcceleratorContent<'a>,
    /// `Shape` statements.
    statements: u32,
    shapes: BTreeMap<&'a str, ShapeContent>,
    #[serde(flatten)]
    geometry: StoredGeometry,
    /// Primitives in no instance that no ray can hit.
    never_hit: usize,
    transforms: usize,
    bytes: usize,
    bounds: Option<Bounds>,
    /// What each camera may see.
    views: Vec<ViewContent<'a>>,
    /// Each shape and instance, if the user asks for them.
    #[serde(skip_serializing_if = "Option::is_none")]
    listed_shapes: Option<Vec<ShapeEntry<'a>>>,
    directives: BTreeMap<&'a str, u64>,
    skipped: BTreeMap<&'a str, u64>,
    unknown: BTreeMap<&'a str, u64>,
    /// Shapes that only bound a medium, which rays pass through.
    medium_boundaries: List<'a>,
    /// Objects without an instance.
    unused_objects: List<'a>,
    /// Textures that cut holes into shapes.
    alpha_textures: List<'a>,
    /// Shapes that their alpha hides.
    hidden_shapes: List<'a>,
}

#[derive(Debug, Serialize)]
struct List<'a> {
    count: u64,
    /// The first items.
    first: Vec<Item<'a>>,
}

#[derive(Debug, Serialize)]
struct Item<'a> {
    name: &'a str,
    place: &'a str,
}

#[derive(Debug, Serialize)]
struct ShapeContent {
    statements: u64,
    primitives: u64,
    left_out: bool,
}

#[derive(Debug, Serialize)]
struct CameraContent {
    projection: &'static str,
    /// How a spherical camera maps directions to the film.
    mapping: Option<&'static str>,
    /// The coefficients of a lens that distorts.
    distortion: Option<Vec<f64>>,
    /// Degrees, across the shorter side of the usual screen window.
    fov: Option<f64>,
    eye: [f64; 3],
    direction: [f64; 3],
    screen_window: [f64; 4],
}

#[derive(Debug, Serialize)]
struct FilmContent<'a> {
    width: u32,
    height: u32,
    /// x0, x1, y0, y1, in pixels; upper ends exclusive.
    crop: [u32; 4],
    filename: Option<&'a str>,
}

#[derive(Debug, Serialize)]
struct AcceleratorContent<'a> {
    name: Option<&'a str>,
    splitmethod: Option<&'a str>,
    maxnodeprims: Option<u32>,
}

impl<'a> Report<'a> {
    /// The report on the scene `path`, with a list of all shapes if `lists_shapes`.
    pub(super) fn new(
        path: &Path,
        exit_code: u8,
        result: &'a Result<Checked, Error>,
        lists_shapes: bool,
    ) -> Report<'a> {
        let warnings = result.iter().flat_map(|checked| checked.warnings.iter());
        let content = |checked| Content::new(checked, lists_shapes);
        Report {
            scene: path.display().to_string(),
            exit_code,
            error: result
                .as_ref()
                .err()
                .map(|error| Message::new(error.diagnostic())),
            warnings: warnings.map(CountedWarning::new).collect(),
            content: result.as_ref().ok().map(content),
        }
    }
}

impl<'a> Message<'a> {
    fn new(diagnostic: &'a Diagnostic) -> Message<'a> {
        Message {
            message: &diagnostic.message,
            place: diagnostic.location.as_ref().map(ToString::to_string),
            notes: &diagnostic.notes,
        }
    }
}

impl<'a> CountedWarning<'a> {
    fn new(warning: &'a Warning) -> CountedWarning<'a> {
        CountedWarning {
            kind: &warning.kind,
            first: Message::new(&warning.first),
            count: warning.count,
        }
    }
}

impl<'a> Content<'a> {
    fn new(checked: &'a Checked, lists_shapes: bool) -> Content<'a> {
        let scene = &checked.scene;
        let (geometry, census) = (&scene.geometry, &scene.census);
        let AcceleratorParameters {
            name,
            split_method,
            max_leaf,
        } = &scene.accelerator;
        let shape = |(name, count): (&'a str, ShapeCount)| {
            let ShapeCount {
                statements,
                primitives,
                is_left_out: left_out,
            } = count;
            (
                name,
                ShapeContent {
                    statements,
                    primitives,
                    left_out,
                },
            )
        };
        Content {
            camera: CameraContent::new(&scene.camera),
            film: FilmContent::new(&scene.film),
            accelerator: AcceleratorContent {
                name: name.as_deref(),
                splitmethod: split_method.as_deref(),
                maxnodeprims: *max_leaf,
            },
            statements: scene.shape_count,
            shapes: census.shapes().map(shape).collect(),
            geometry: StoredGeometry::of(geometry),
            never_hit: geometry.never_hit(),
            transforms: scene.transform_count,
            bytes: geometry.bytes(),
            bounds: Bounds::of(&checked.survey.bounds),
            views: view::contents(checked),
            listed_shapes: lists_shapes.then(|| shape_list::entries(checked)),
            directives: census.executed().collect(),
            skipped: census.skipped().collect(),
            unknown: census.unknown().collect(),
            medium_boundaries: List::new(census.boundaries(), |of| (&of.shape, &of.place)),
            unused_objects: List::new(census.unused_objects(), |of| (&of.name, &of.place)),
            alpha_textures: List::new(census.textures(), |of| (&of.name, &of.place)),
            hidden_shapes: List::new(census.hidden(), |of| (&of.shape, &of.place)),
        }
    }
}

impl<'a> List<'a> {
    fn new<T>(listed: &'a Listed<T>, item: impl Fn(&'a T) -> (&'a String, &'a String)) -> List<'a> {
        let item = |of| {
            let (name, place) = item(of);
            Item { name, place }
        };
        List {
            count: listed.count,
            first: listed.first.iter().map(item).collect(),
        }
    }
}

impl CameraContent {
    fn new(camera: &Camera) -> CameraContent {
        let window = &camera.screen_window;
        CameraContent {
            projection: camera.projection.name(),
            mapping: camera.projection.sphere_mapping().map(SphereMapping::name),
            distortion: camera
                .projection
                .distortion()
                .map(|lens| lens.coefficients()),
            fov: camera.projection.field_of_view(),
            eye: camera.anchor().to_array(),
            direction: camera.view_direction().to_array(),
            screen_window: [window.x0, window.x1, window.y0, window.y1],
        }
    }
}

impl<'a> FilmContent<'a> {
    fn new(film: &'a Film) -> FilmContent<'a> {
        let [width, height] = film.resolution;
        let PixelBounds { x0, x1, y0, y1 } = film.crop;
        FilmContent {
            width,
            height,
            crop: [x0, x1, y0, y1],
            filename: film.filename.as_deref(),
        }
    }
}
