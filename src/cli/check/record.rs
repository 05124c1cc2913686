//! What `--json` prints of a scene.

use feimos::camera::Camera;
use feimos::error::{Diagnostic, Error};
use feimos::film::PixelBounds;
use feimos::geometry::Bounds;
use feimos::scene::{AcceleratorParameters, Census, Film, Listed, Scene, ShapeCount, Warning};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// One line.
#[derive(Debug, Serialize)]
pub(super) struct Record<'a> {
    scene: String,
    exit_code: u8,
    /// Why there is nothing below.
    error: Option<Message<'a>>,
    warnings: Vec<Counted<'a>>,
    /// What the scene holds, unless it failed.
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
struct Counted<'a> {
    kind: &'a str,
    #[serde(flatten)]
    first: Message<'a>,
    count: u64,
}

#[derive(Debug, Serialize)]
struct Content<'a> {
    camera: CameraRecord,
    film: FilmRecord<'a>,
    accelerator: AcceleratorRecord<'a>,
    /// `Shape` statements.
    statements: u32,
    shapes: BTreeMap<&'a str, ShapeRecord>,
    triangles: usize,
    spheres: usize,
    objects: usize,
    instances: usize,
    primitives: u64,
    transforms: usize,
    bytes: usize,
    bounds: Option<BoundsRecord>,
    directives: BTreeMap<&'a str, u64>,
    skipped: BTreeMap<&'a str, u64>,
    unknown: BTreeMap<&'a str, u64>,
    /// Shapes that only bound a medium, which no ray meets.
    medium_boundaries: ListRecord<'a>,
    /// Objects that no instance shows.
    unused_objects: ListRecord<'a>,
}

#[derive(Debug, Serialize)]
struct ListRecord<'a> {
    count: u64,
    /// The first of them.
    first: Vec<PlacedRecord<'a>>,
}

#[derive(Debug, Serialize)]
struct PlacedRecord<'a> {
    name: &'a str,
    place: &'a str,
}

#[derive(Debug, Serialize)]
struct ShapeRecord {
    statements: u64,
    primitives: u64,
    left_out: bool,
}

#[derive(Debug, Serialize)]
struct BoundsRecord {
    low: [f64; 3],
    high: [f64; 3],
}

#[derive(Debug, Serialize)]
struct CameraRecord {
    projection: &'static str,
    /// In degrees, across the shorter side of the screen window that is usual.
    fov: Option<f64>,
    eye: [f64; 3],
    direction: [f64; 3],
    screen_window: [f64; 4],
}

#[derive(Debug, Serialize)]
struct FilmRecord<'a> {
    width: u32,
    height: u32,
    crop: [u32; 4],
    filename: Option<&'a str>,
}

#[derive(Debug, Serialize)]
struct AcceleratorRecord<'a> {
    name: Option<&'a str>,
    splitmethod: Option<&'a str>,
    maxnodeprims: Option<u32>,
}

impl From<ShapeCount> for ShapeRecord {
    fn from(count: ShapeCount) -> ShapeRecord {
        let ShapeCount {
            statements,
            primitives,
            is_left_out: left_out,
        } = count;
        ShapeRecord {
            statements,
            primitives,
            left_out,
        }
    }
}

impl<'a> Record<'a> {
    pub(super) fn new(path: &Path, exit_code: u8, result: &'a Result<Scene, Error>) -> Record<'a> {
        let scene = path.display().to_string();
        match result {
            Ok(content) => {
                let warnings = content.warnings.iter().map(Counted::new).collect();
                Record {
                    scene,
                    exit_code,
                    error: None,
                    warnings,
                    content: Some(Content::new(content)),
                }
            }
            Err(error) => {
                let error = Some(Message::new(error.diagnostic()));
                Record {
                    scene,
                    exit_code,
                    error,
                    warnings: Vec::new(),
                    content: None,
                }
            }
        }
    }
}

impl<'a> Message<'a> {
    fn new(diagnostic: &'a Diagnostic) -> Message<'a> {
        let place = diagnostic.location.as_ref().map(ToString::to_string);
        Message {
            message: &diagnostic.message,
            place,
            notes: &diagnostic.notes,
        }
    }
}

impl<'a> Counted<'a> {
    fn new(warning: &'a Warning) -> Counted<'a> {
        Counted {
            kind: &warning.kind,
            first: Message::new(&warning.first),
            count: warning.count,
        }
    }
}

impl<'a> Content<'a> {
    fn new(scene: &'a Scene) -> Content<'a> {
        let (geometry, census): (_, &Census) = (&scene.geometry, &scene.census);
        let AcceleratorParameters {
            name,
            split_method,
            max_leaf,
        } = &scene.accelerator;
        let of_type = census
            .shapes()
            .map(|(name, count)| (name, ShapeRecord::from(count)));
        let bounds = geometry.extent();
        Content {
            camera: CameraRecord::new(&scene.camera),
            film: FilmRecord::new(&scene.film),
            accelerator: AcceleratorRecord {
                name: name.as_deref(),
                splitmethod: split_method.as_deref(),
                maxnodeprims: *max_leaf,
            },
            statements: scene.shape_count,
            shapes: of_type.collect(),
            triangles: geometry.stored_triangles(),
            spheres: geometry.stored_quadrics(),
            objects: geometry.objects().len(),
            instances: geometry.instances().len(),
            primitives: geometry.primitive_count(),
            transforms: scene.transform_count,
            bytes: geometry.bytes(),
            bounds: (!bounds.is_empty()).then(|| BoundsRecord::new(&bounds)),
            directives: census.executed().collect(),
            skipped: census.skipped().collect(),
            unknown: census.unknown().collect(),
            medium_boundaries: ListRecord::new(census.boundaries(), |of| (&of.shape, &of.place)),
            unused_objects: ListRecord::new(census.unused_objects(), |of| (&of.name, &of.place)),
        }
    }
}

impl<'a> ListRecord<'a> {
    fn new<T>(
        listed: &'a Listed<T>,
        name_and_place: impl Fn(&'a T) -> (&'a String, &'a String),
    ) -> ListRecord<'a> {
        let record = |of| {
            let (name, place) = name_and_place(of);
            PlacedRecord { name, place }
        };
        ListRecord {
            count: listed.count,
            first: listed.first.iter().map(record).collect(),
        }
    }
}

impl BoundsRecord {
    fn new(bounds: &Bounds) -> BoundsRecord {
        BoundsRecord {
            low: bounds.low.to_array(),
            high: bounds.high.to_array(),
        }
    }
}

impl CameraRecord {
    fn new(camera: &Camera) -> CameraRecord {
        let window = &camera.screen_window;
        CameraRecord {
            projection: camera.projection.name(),
            fov: camera.projection.field_of_view(),
            eye: camera.anchor().to_array(),
            direction: camera.view_direction().to_array(),
            screen_window: [window.x0, window.x1, window.y0, window.y1],
        }
    }
}

impl<'a> FilmRecord<'a> {
    fn new(film: &'a Film) -> FilmRecord<'a> {
        let [width, height] = film.resolution;
        let PixelBounds { x0, x1, y0, y1 } = film.crop;
        FilmRecord {
            width,
            height,
            crop: [x0, x1, y0, y1],
            filename: film.filename.as_deref(),
        }
    }
}
