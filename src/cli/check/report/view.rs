//! What a camera may see, in numbers and in words.

use super::super::checked::{Checked, View};
use super::super::oddities::{counted_units, name, place};
use crate::cli::terminal::words::counted;
use crate::error::{grouped, printable};
use crate::survey::Visibility;
use serde::Serialize;

/// Shapes behind the camera that the report names.
const NAMED: usize = 3;

#[derive(Debug, Serialize)]
pub(super) struct ViewContent<'a> {
    /// The camera's name, if it has one.
    camera: Option<&'a str>,
    /// Shapes and instances whose bounds reach the picture: they may be seen.
    in_view: usize,
    /// Those beside the picture.
    beside: usize,
    /// Those behind the camera.
    behind: usize,
    /// Those that no ray can hit.
    never_hit: usize,
    /// Whether the camera is within the bounds of the scene.
    is_within_bounds: bool,
    /// The first shapes behind the camera.
    first_behind: Vec<ShapeBehind>,
}

#[derive(Debug, Serialize)]
struct ShapeBehind {
    shape: String,
    place: Option<String>,
    distance: f64,
}

/// The contents of all views.
pub(super) fn contents(checked: &Checked) -> Vec<ViewContent<'_>> {
    let views = checked.views.iter();
    views.map(|view| ViewContent::new(checked, view)).collect()
}

impl<'a> ViewContent<'a> {
    fn new(checked: &'a Checked, view: &'a View) -> ViewContent<'a> {
        let sight = &view.sight;
        let behind = |place_in_survey: &usize| {
            let shape = &checked.survey.shapes[*place_in_survey];
            ShapeBehind {
                shape: name(&checked.scene, shape.source),
                place: place(&checked.scene, shape.source).map(ToString::to_string),
                distance: sight.distance(shape),
            }
        };
        let first_behind = sight.behind(&checked.survey);
        ViewContent {
            camera: view.name.as_deref(),
            in_view: sight.count(Visibility::InView),
            beside: sight.count(Visibility::Beside),
            behind: sight.count(Visibility::Behind),
            never_hit: sight.count(Visibility::Nothing),
            is_within_bounds: sight.is_within_bounds,
            first_behind: first_behind.iter().take(NAMED).map(behind).collect(),
        }
    }

    /// The text: a line of counts, and lines of shapes behind the camera.
    pub(super) fn lines(&self) -> Vec<String> {
        let camera = self
            .camera
            .map_or(String::new(), |name| format!("{name}: "));
        let all = self.in_view + self.beside + self.behind + self.never_hit;
        if all == 0 {
            return Vec::new();
        }
        let (in_view, of_all) = (grouped(self.in_view as u64), counted(all as u64, "shape"));
        let mut counts = vec![format!("{in_view} of {of_all} may be in view")];
        for (count, what) in [
            (self.beside, "beside the picture"),
            (self.behind, "behind the camera"),
            (self.never_hit, "never hit"),
        ] {
            counts.extend((count > 0).then(|| format!("{} {what}", grouped(count as u64))));
        }
        let within = match self.is_within_bounds {
            true => "; the camera is within the bounds",
            false => "",
        };
        let counts = counts.join(", ");
        let mut lines = vec![format!("{}{counts}{within}", printable(&camera))];
        lines.extend(self.first_behind.iter().map(ShapeBehind::line));
        let more = self.behind.saturating_sub(self.first_behind.len());
        if more > 0 && !self.first_behind.is_empty() {
            let more = grouped(more as u64);
            lines.push(format!("and {more} more; --shapes lists all"));
        }
        lines
    }
}

impl ShapeBehind {
    fn line(&self) -> String {
        let place = self.place.as_deref().unwrap_or("an unknown place");
        let distance = counted_units(self.distance);
        format!("behind: {}, {place}, {distance} away", self.shape)
    }
}
