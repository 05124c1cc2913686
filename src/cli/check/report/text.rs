//! The report on a scene as text.

use super::{CameraContent, FilmContent, Item, List, Report, ShapeContent, shape_list};
use crate::cli::terminal::words::{INDENT, counted, line, lines, short, triple};
use crate::error::{grouped, printable};
use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};

/// Width of text, unless a word is longer.
const WIDTH: usize = 100;

/// The cameras whose views are shown.
const SHOWN_VIEWS: usize = 10;

/// Width of the name of a shape type.
const NAME_WIDTH: usize = 40;

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
        if content.never_hit > 0 {
            let count = counted(content.never_hit as u64, "primitive");
            line(f, "never hit", &format!("{count}: no area, or not finite"))?;
        }
        let bounds = content.bounds.as_ref().map(ToString::to_string);
        line(
            f,
            "bounds",
            bounds.as_deref().unwrap_or("nothing that can be hit"),
        )?;
        for view in content.views.iter().take(SHOWN_VIEWS) {
            lines(f, "view", view.lines())?;
        }
        if content.views.len() > SHOWN_VIEWS {
            let more = counted((content.views.len() - SHOWN_VIEWS) as u64, "more camera");
            line(f, "view", &format!("and {more}; --json lists all"))?;
        }
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
        )?;
        let textures = "textures that cut holes into shapes: their alpha";
        lines(f, "alpha", content.alpha_textures.lines(textures))?;
        let hidden = "shapes that their alpha hides";
        lines(f, "hidden", content.hidden_shapes.lines(hidden))?;
        let listed = content.listed_shapes.as_deref().unwrap_or_default();
        lines(f, "listed", shape_list::table(listed))
    }
}

impl Display for CameraContent {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(self.projection)?;
        if let Some(mapping) = self.mapping {
            write!(f, ", {mapping}")?;
        }
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

impl List<'_> {
    /// The items below a line with their count and `noun`; nothing if there are none.
    fn lines(&self, noun: &str) -> Vec<String> {
        if self.count == 0 {
            return Vec::new();
        }
        let mut lines = vec![format!("{} {noun}", grouped(self.count))];
        let item =
            |Item { name, place }: &Item| format!("{}, {}", printable(name), printable(place));
        lines.extend(self.first.iter().map(item));
        let more = self.count - self.first.len() as u64;
        lines.extend((more > 0).then(|| format!("and {} more", grouped(more))));
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
        let statements = grouped(shape.statements);
        let primitives = grouped(shape.primitives);
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
        let item = format!("{} {}", grouped(*count), printable(name));
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
