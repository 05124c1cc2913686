//! The report on a scene: one struct for `--json`, whose keys are its field names, and for text.

use crate::cli::terminal::scene_summary::StoredGeometry;
use crate::cli::terminal::words::{INDENT, counted, line, lines};
use feimos::camera::Camera;
use feimos::error::{Diagnostic, Error, printable};
use feimos::film::PixelBounds;
use feimos::scene::{AcceleratorParameters, Film, Listed, Scene, ShapeCount, Warning};
use indicatif::HumanCount;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};
use std::path::Path;

/// Width of text, unless a word is longer.
const WIDTH: usize = 100;

/// Width of the name of a shape type.
const NAME_WIDTH: usize = 40;

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
    transforms: usize,
    bytes: usize,
    bounds: Option<Bounds>,
    directives: BTreeMap<&'a str, u64>,
    skipped: BTreeMap<&'a str, u64>,
    unknown: BTreeMap<&'a str, u64>,
    /// Shapes that only bound a medium, which rays pass through.
    medium_boundaries: List<'a>,
    /// Objects without an instance.
    unused_objects: List<'a>,
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
struct Bounds {
    low: [f64; 3],
    high: [f64; 3],
}

#[derive(Debug, Serialize)]
struct CameraContent {
    projection: &'static str,
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
    pub(super) fn new(path: &Path, exit_code: u8, result: &'a Result<Scene, Error>) -> Report<'a> {
        let warnings = result.iter().flat_map(|scene| scene.warnings.iter());
        Report {
            scene: path.display().to_string(),
            exit_code,
            error: result
                .as_ref()
                .err()
                .map(|error| Message::new(error.diagnostic())),
            warnings: warnings.map(CountedWarning::new).collect(),
            content: result.as_ref().ok().map(Content::new),
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
    fn new(scene: &'a Scene) -> Content<'a> {
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
        let extent = geometry.extent();
        let bounds = Bounds {
            low: extent.low.to_array(),
            high: extent.high.to_array(),
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
            transforms: scene.transform_count,
            bytes: geometry.bytes(),
            bounds: (!extent.is_empty()).then_some(bounds),
            directives: census.executed().collect(),
            skipped: census.skipped().collect(),
            unknown: census.unknown().collect(),
            medium_boundaries: List::new(census.boundaries(), |of| (&of.shape, &of.place)),
            unused_objects: List::new(census.unused_objects(), |of| (&of.name, &of.place)),
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

/// The text of a scene that could be read.
impl Display for Report<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Some(content) = &self.content else {
            return Ok(());
        };
        writeln!(f, "{}", printable(&self.scene))?;
        line(f, "camera", &content.camera.to_string())?;
        line(f, "film", &content.film.to_string())?;
        lines(f, "shapes", shape_table(&content.shapes))?;
        line(f, "geometry", &content.geometry.to_string())?;
        let bounds = content.bounds.as_ref().map(ToString::to_string);
        line(
            f,
            "bounds",
            bounds.as_deref().unwrap_or("nothing that can be hit"),
        )?;
        let transforms = counted(content.transforms as u64, "transform");
        let bytes = counted(content.bytes as u64, "byte");
        line(f, "memory", &format!("{transforms}, {bytes}"))?;
        lines(f, "directives", wrapped(&content.directives))?;
        lines(f, "skipped", wrapped(&content.skipped))?;
        lines(f, "unknown", wrapped(&content.unknown))?;
        let media = "shapes that only bound a medium: rays pass through them";
        lines(f, "media", content.medium_boundaries.lines(media))?;
        lines(
            f,
            "unused",
            content.unused_objects.lines("objects without an instance"),
        )
    }
}

impl Display for CameraContent {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(self.projection)?;
        if let Some(fov) = self.fov {
            write!(f, ", {} degrees", short(fov))?;
        }
        write!(
            f,
            ", at {}, towards {}",
            triple(self.eye),
            triple(self.direction)
        )
    }
}

impl Display for FilmContent<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let FilmContent {
            width,
            height,
            crop,
            filename,
        } = self;
        write!(f, "{width} x {height} pixels")?;
        let [x0, x1, y0, y1] = crop;
        if [*x0, *x1, *y0, *y1] != [0, *width, 0, *height] {
            write!(f, ", cropped to x {x0} to {x1}, y {y0} to {y1}")?;
        }
        filename.map_or(Ok(()), |name| write!(f, ", {name}"))
    }
}

impl Display for Bounds {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} to {}", triple(self.low), triple(self.high))
    }
}

impl List<'_> {
    /// The items below a line with their count and `noun`; nothing if there are none.
    fn lines(&self, noun: &str) -> Vec<String> {
        if self.count == 0 {
            return Vec::new();
        }
        let mut lines = vec![format!("{} {noun}", HumanCount(self.count))];
        let item =
            |Item { name, place }: &Item| format!("{}, {}", printable(name), printable(place));
        lines.extend(self.first.iter().map(item));
        let more = self.count - self.first.len() as u64;
        lines.extend((more > 0).then(|| format!("and {} more", HumanCount(more))));
        lines
    }
}

/// A line for each type of shape, below titles.
fn shape_table(shapes: &BTreeMap<&str, ShapeContent>) -> Vec<String> {
    let name = |name: &str| printable(name).chars().take(NAME_WIDTH).collect::<String>();
    let names: Vec<String> = shapes.keys().map(|of| name(of)).collect();
    let Some(width) = names.iter().map(|name| name.chars().count()).max() else {
        return vec!["none".to_owned()];
    };
    let row = |(name, shape): (&String, &ShapeContent)| {
        let statements = HumanCount(shape.statements).to_string();
        let primitives = HumanCount(shape.primitives).to_string();
        let primitives = if shape.left_out {
            "left out"
        } else {
            &primitives
        };
        format!("{name:<width$}  {statements:>10}  {primitives:>10}")
    };
    let titles = format!("{:width$}  statements  primitives", "");
    std::iter::once(titles)
        .chain(names.iter().zip(shapes.values()).map(row))
        .collect()
}

/// The count of each name, in lines of limited width.
fn wrapped(counts: &BTreeMap<&str, u64>) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for (name, count) in counts {
        let item = format!("{} {}", HumanCount(*count), printable(name));
        match lines.last_mut() {
            Some(last) if INDENT + last.len() + 2 + item.len() < WIDTH => {
                last.push_str(&format!(", {item}"));
            }
            Some(last) => {
                last.push(',');
                lines.push(item);
            }
            None => lines.push(item),
        }
    }
    lines
}

fn triple(numbers: [f64; 3]) -> String {
    let [x, y, z] = numbers.map(short);
    format!("({x}, {y}, {z})")
}

/// A number in six digits.
fn short(number: f64) -> String {
    let rounded: f64 = format!("{number:.5e}").parse().unwrap_or(number);
    match rounded.abs() {
        0.0 => "0".to_owned(),
        size if (1e-4..1e9).contains(&size) => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_have_six_digits() {
        let cases = [
            (0.1 + 0.2, "0.3"),
            (-0.0, "0"),
            (1.0 / 3.0, "0.333333"),
            (123_456_789.0, "123457000"),
            (-1e300, "-1e300"),
            (1.5e-7, "1.5e-7"),
            (f64::INFINITY, "inf"),
        ];
        for (number, expected) in cases {
            assert_eq!(short(number), expected);
        }
    }
}
