//! The list of all shapes and instances.

use super::super::checked::Checked;
use super::super::oddities::{name, place};
use super::bounds::Bounds;
use crate::cli::terminal::words::short;
use crate::error::{grouped, printable};
use crate::survey::{Source, Visibility};
use serde::Serialize;

/// A shape in no object, or an instance.
#[derive(Debug, Serialize)]
pub(super) struct ShapeEntry<'a> {
    /// The type of the shape, or "instance".
    shape: String,
    place: Option<String>,
    /// The number in the channel `id`, of a shape.
    id: Option<u32>,
    /// The number in the channel `instance`, of an instance.
    instance: Option<usize>,
    primitives: u64,
    /// The lengths of the sides of its box.
    size: Option<[f64; 3]>,
    #[serde(flatten)]
    bounds: Option<Bounds>,
    /// What each camera may see of it.
    views: Vec<ShapeView<'a>>,
}

#[derive(Debug, Serialize)]
struct ShapeView<'a> {
    camera: Option<&'a str>,
    /// From the eye to the nearest point of the box.
    distance: Option<f64>,
    view: &'static str,
}

/// An entry for each shape and instance, in the order of the file.
pub(super) fn entries(checked: &Checked) -> Vec<ShapeEntry<'_>> {
    let places = 0..checked.survey.shapes.len();
    places
        .map(|index| ShapeEntry::new(checked, index))
        .collect()
}

impl<'a> ShapeEntry<'a> {
    fn new(checked: &'a Checked, index: usize) -> ShapeEntry<'a> {
        let shape = &checked.survey.shapes[index];
        let (id, instance) = match shape.source {
            Source::Shape(number) => (Some(number), None),
            Source::Instance(number) => (None, Some(number + 1)),
        };
        let views = checked.views.iter().map(|view| ShapeView {
            camera: view.name.as_deref(),
            distance: shape.can_be_hit().then(|| view.sight.distance(shape)),
            view: in_words(view.sight.visibility[index]),
        });
        let sides = || (shape.bounds.high - shape.bounds.low).to_array();
        ShapeEntry {
            shape: name(&checked.scene, shape.source),
            place: place(&checked.scene, shape.source).map(ToString::to_string),
            id,
            instance,
            primitives: shape.primitives,
            size: shape.can_be_hit().then(sides),
            bounds: Bounds::of(&shape.bounds),
            views: views.collect(),
        }
    }

    /// The cells of its row.
    fn cells(&self) -> Vec<String> {
        let size = self
            .size
            .map_or("-".to_owned(), |sides| sides.map(short).join(" x "));
        let bounds = self.bounds.as_ref();
        let mut cells = vec![
            printable(&self.shape),
            printable(self.place.as_deref().unwrap_or("-")),
            grouped(self.primitives),
            size,
        ];
        for ShapeView { distance, view, .. } in &self.views {
            cells.push(distance.map_or("-".to_owned(), short));
            cells.push((*view).to_owned());
        }
        cells.push(bounds.map_or("nothing that can be hit".to_owned(), ToString::to_string));
        cells
    }
}

fn in_words(visibility: Visibility) -> &'static str {
    match visibility {
        Visibility::InView => "in view",
        Visibility::Beside => "beside",
        Visibility::Behind => "behind",
        Visibility::Nothing => "never hit",
    }
}

/// A line for each entry, below titles; nothing without entries.
pub(super) fn table(entries: &[ShapeEntry]) -> Vec<String> {
    let Some(first) = entries.first() else {
        return Vec::new();
    };
    let mut titles = vec!["shape", "place", "primitives", "size"];
    for view in &first.views {
        titles.extend(["distance", view.camera.unwrap_or("view")]);
    }
    titles.push("bounds");
    let titles = titles.into_iter().map(printable).collect();
    let rows: Vec<Vec<String>> = std::iter::once(titles)
        .chain(entries.iter().map(ShapeEntry::cells))
        .collect();
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max();
    let widths: Vec<usize> = (0..rows[0].len()).filter_map(width).collect();
    let aligned = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths);
        let cells = cells.map(|(cell, width)| format!("{cell:<width$}"));
        cells.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    rows.iter().map(aligned).collect()
}
