//! Warnings about shapes that are in odd places, and cameras that see none.

use crate::cli::terminal::words::{counted, short};
use crate::error::{Diagnostic, grouped};
use crate::scene::{Place, Scene, Warning};
use crate::survey::{Finding, Oddity, Sight, Source, Survey, Visibility};

/// Further places or cameras that a warning lists.
const MORE_PLACES: usize = 3;

/// The warnings about odd shapes, one for each kind of oddity.
pub(super) fn warnings_of_shapes(scene: &Scene, survey: &Survey) -> Vec<Warning> {
    let findings = survey.findings(scene);
    let same_kind = |a: &Finding, b: &Finding| kind(&a.oddity) == kind(&b.oddity);
    let warning = |same: &[Finding]| {
        let (oddity, source) = (&same[0].oddity, same[0].source);
        let message = message(&name(scene, source), oddity);
        let sources = same.iter().map(|finding| finding.source);
        warning(scene, kind(oddity), message, advice(oddity), sources)
    };
    findings.chunk_by(same_kind).map(warning).collect()
}

/// The warnings about what cameras see, each with its name, if it has one. Warnings of one kind
/// become one, which names the first cameras.
pub(super) fn warnings_of_views<'a>(
    scene: &Scene,
    survey: &Survey,
    views: impl Iterator<Item = (Option<&'a str>, &'a Sight)>,
) -> Vec<Warning> {
    let mut merged: Vec<(Warning, Vec<&str>)> = Vec::new();
    for (name, sight) in views {
        for warning in warnings_of_sight(scene, survey, sight, name) {
            let known = merged
                .iter_mut()
                .find(|(known, _)| known.kind == warning.kind);
            match known {
                Some((known, others)) => {
                    known.count += warning.count;
                    others.extend(name);
                }
                None => merged.push((warning, Vec::new())),
            }
        }
    }
    let warning = |(mut warning, others): (Warning, Vec<&str>)| {
        if !others.is_empty() {
            let named = others
                .iter()
                .take(MORE_PLACES)
                .map(|name| format!("`{name}`"));
            let named: Vec<String> = named.collect();
            let rest = match others.len() - named.len() {
                0 => String::new(),
                rest => format!(" and {rest} more"),
            };
            let note = format!("likewise the cameras {}{rest}", named.join(", "));
            warning.first = warning.first.note(note);
        }
        warning
    };
    merged.into_iter().map(warning).collect()
}

/// The warnings about the `sight` of a camera, which may have a name.
fn warnings_of_sight(
    scene: &Scene,
    survey: &Survey,
    sight: &Sight,
    camera: Option<&str>,
) -> Vec<Warning> {
    let camera = camera.map_or_else(
        || "the camera".to_owned(),
        |name| format!("the camera `{name}`"),
    );
    if survey.bounds.is_empty() {
        return Vec::new();
    }
    if sight.sees_nothing() {
        return vec![warning_of_nothing(sight, &camera)];
    }
    let source = |place: &usize| survey.shapes[*place].source;
    let mut warnings = Vec::new();
    if let Some(first) = sight.around_eye.first() {
        let first = name(scene, source(first));
        let message = format!("{camera} is within the bounds of this {first}");
        let advice = "it may see the inside; move the camera, or the shape";
        let sources = sight.around_eye.iter().map(source);
        warnings.push(warning(
            scene,
            "camera within a shape",
            message,
            advice,
            sources,
        ));
    }
    let behind = sight.behind(survey);
    if let (false, Some(first)) = (sight.is_surrounded, behind.first()) {
        let message = format!(
            "this {} is behind {camera}, {} away",
            name(scene, source(first)),
            counted_units(sight.distance(&survey.shapes[*first])),
        );
        let advice = "its transform may have a wrong sign";
        let sources = behind.iter().map(source);
        warnings.push(warning(
            scene,
            "shape behind the camera",
            message,
            advice,
            sources,
        ));
    }
    warnings
}

/// The warning about a camera that certainly sees nothing.
fn warning_of_nothing(sight: &Sight, camera: &str) -> Warning {
    let message = format!("{camera} sees nothing: no shape's bounds reach the picture");
    let beside = counted(sight.count(Visibility::Beside) as u64, "shape");
    let behind = grouped(sight.count(Visibility::Behind) as u64);
    let note =
        format!("{beside} beside the picture, {behind} behind the camera; --shapes lists all");
    Warning {
        kind: "camera that sees nothing".to_owned(),
        first: Diagnostic::new(message).note(note),
        count: 1,
    }
}

/// A warning about the first of several sources, which names the next ones.
fn warning(
    scene: &Scene,
    kind: &str,
    message: String,
    advice: &str,
    mut sources: impl ExactSizeIterator<Item = Source>,
) -> Warning {
    let count = sources.len();
    let place = sources.next().and_then(|source| place(scene, source));
    let mut first = Diagnostic::new(message).note(advice);
    first.location = place.map(Place::location);
    let more = sources.by_ref().take(MORE_PLACES);
    let more: Vec<String> = more
        .filter_map(|source| place_in_words(scene, source))
        .collect();
    if !more.is_empty() {
        let rest = match sources.len() {
            0 => String::new(),
            rest => format!(" and {rest} more; --shapes lists all"),
        };
        first = first.note(format!("likewise {}{rest}", more.join(", ")));
    }
    Warning {
        kind: kind.to_owned(),
        first,
        count: count as u64,
    }
}

/// The place of a statement, if the scene has kept it.
pub(super) fn place(scene: &Scene, source: Source) -> Option<&Place> {
    let locations = scene.locations.as_ref()?;
    match source {
        Source::Shape(number) => locations.shape(number).map(|(_, place)| place),
        Source::Instance(number) => locations.instance(number),
    }
}

fn place_in_words(scene: &Scene, source: Source) -> Option<String> {
    place(scene, source).map(ToString::to_string)
}

/// The type of a shape, or "instance".
pub(super) fn name(scene: &Scene, source: Source) -> String {
    let locations = scene.locations.as_ref();
    let shape = match source {
        Source::Instance(_) => return "instance".to_owned(),
        Source::Shape(number) => locations.and_then(|locations| locations.shape(number)),
    };
    shape.map_or_else(|| "shape".to_owned(), |(name, _)| name.to_owned())
}

fn kind(oddity: &Oddity) -> &'static str {
    match oddity {
        Oddity::Far { .. } => "shape far away",
        Oddity::Large { .. } => "large shape",
        Oddity::Small { .. } => "small shape",
        Oddity::Stretched { .. } => "stretched shape",
    }
}

fn message(name: &str, oddity: &Oddity) -> String {
    match oddity {
        Oddity::Far { distance, usual } => format!(
            "this {name} is {} away from the middle of the shapes, of which most are within {}",
            counted_units(*distance),
            counted_units(*usual),
        ),
        Oddity::Large { size, usual } => format!(
            "this {name} is {} across, and most shapes about {}",
            counted_units(*size),
            counted_units(*usual),
        ),
        Oddity::Small { size, usual } => format!(
            "this {name} is only {} across, and most shapes about {}",
            counted_units(*size),
            counted_units(*usual),
        ),
        Oddity::Stretched { stretch } => format!(
            "the transform of this {name} scales one direction {} times as much as another",
            short(*stretch),
        ),
    }
}

fn advice(oddity: &Oddity) -> &'static str {
    match oddity {
        Oddity::Far { .. } => "a Translate may be wrong, or scaled by a transform before it",
        Oddity::Large { .. } | Oddity::Small { .. } => {
            "a Scale may be wrong, or the units of a mesh file"
        }
        Oddity::Stretched { .. } => "a factor of a Scale may be wrong",
    }
}

/// A length in units of the scene.
pub(super) fn counted_units(length: f64) -> String {
    let plural = if length == 1.0 { "" } else { "s" };
    format!("{} unit{plural}", short(length))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{LoadOptions, parse};
    use std::path::Path;

    #[test]
    fn cameras_share_a_warning() {
        let text = "WorldBegin Translate 0 0 -9 Shape \"sphere\"";
        let options = LoadOptions {
            locations: true,
            ..LoadOptions::default()
        };
        let scene = parse(Path::new("a.pbrt"), text.into(), &options).unwrap();
        let survey = Survey::of(&scene);
        let sight = survey.seen_by(&scene.camera, &scene.film.crop);
        let of = |names: &[&'static str]| {
            let views = names.iter().map(|name| (Some(*name), &sight));
            let warnings = warnings_of_views(&scene, &survey, views);
            let [warning] = &warnings[..] else {
                panic!("{warnings:?}")
            };
            (warning.count, warning.first.to_string())
        };
        let (count, text) = of(&["left"]);
        assert!(
            count == 1 && text.starts_with("the camera `left` sees nothing"),
            "{text}"
        );
        let (count, text) = of(&["left", "b", "c", "d", "e", "f"]);
        let more = "\n   = likewise the cameras `b`, `c`, `d` and 2 more";
        assert!(count == 6 && text.ends_with(more), "{text}");
    }
}
