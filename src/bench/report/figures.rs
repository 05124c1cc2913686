//! The pictures of a scene: depths, costs and errors, with colour bars.

use super::html::{escaped, swatch};
use crate::bench::kernel::Kernel;
use crate::bench::run::{PictureFiles, Row};
use crate::compare::picture;
use crate::error::grouped;
use crate::film::ColorMap;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;

/// The colours of a gradient in a style sheet: enough for any colour map.
const STOPS: usize = 17;

/// A picture with its caption.
struct Figure<'a> {
    caption: String,
    png: &'a [u8],
    bar: Option<Bar>,
}

/// A colour bar.
struct Bar {
    /// In equal steps.
    colors: Vec<[u8; 3]>,
    /// The values at both ends.
    ends: [String; 2],
}

/// All pictures of a scene, which `id` names on the page.
pub(super) fn figures(id: &str, rows: &[Row], pictures: &PictureFiles) -> String {
    let depths_and_costs = depths_and_costs(pictures);
    let mut text = String::new();
    if !depths_and_costs.is_empty() {
        let [width, height] = pictures.size;
        text += &format!("<h3 id=\"{id}-pictures\">Depths, and costs of rays</h3>\n");
        text += &format!(
            "<p class=\"quiet\">Costs are tests of nodes and primitives, all on one scale. \
             {width} x {height} pixels. Click a picture to enlarge it.</p>\n"
        );
        text += &elements(&format!("{id}-pictures"), &depths_and_costs);
    }
    let errors = errors(rows, &pictures.errors);
    if !errors.is_empty() {
        text += &format!("<h3 id=\"{id}-errors\">Errors</h3>\n<p class=\"quiet\">");
        for (color, meaning) in [
            (picture::FALSE_HIT, "false hit"),
            (picture::MISSED_HIT, "missed hit"),
            (picture::WRONG_PRIMITIVE, "wrong primitive"),
            (picture::EQUAL_HIT, "correct hit"),
            (picture::EQUAL, "correct miss"),
        ] {
            text += &swatch(color, meaning);
        }
        text += "</p>\n";
        text += &elements(&format!("{id}-errors"), &errors);
    }
    text
}

fn depths_and_costs(pictures: &PictureFiles) -> Vec<Figure<'_>> {
    let near_to_far = ColorMap::Turbo.stops(STOPS);
    let mut cheap_to_costly = near_to_far.clone();
    cheap_to_costly.reverse();
    let depth = pictures.depth.as_ref().map(|png| Figure {
        caption: "depth".to_owned(),
        png,
        bar: pictures.depth_range.map(|range| Bar {
            colors: near_to_far,
            ends: [
                format!("{} near", range.start),
                format!("far {}", range.end),
            ],
        }),
    });
    let cost = |(method, png)| Figure {
        caption: format!("cost, {method}"),
        png,
        bar: Some(Bar {
            colors: cheap_to_costly.clone(),
            ends: [
                "0".to_owned(),
                format!("{} and more", pictures.highest_cost),
            ],
        }),
    };
    let costs = pictures
        .costs
        .iter()
        .map(|(method, png)| (method, &png[..]));
    depth.into_iter().chain(costs.map(cost)).collect()
}

/// The different pictures of errors, each with the names of all rows that share it: answers rarely
/// depend on the tree.
fn errors<'a>(rows: &[Row], pictures: &'a [Option<Vec<u8>>]) -> Vec<Figure<'a>> {
    let mut different: Vec<(&Row, Vec<&str>, &[u8])> = Vec::new();
    for (row, picture) in rows.iter().zip(pictures) {
        let Some(picture) = picture.as_deref() else {
            continue;
        };
        let is_same = |(other, _, png): &&mut (&Row, Vec<&str>, &[u8])| {
            other.kernel == row.kernel && *png == picture
        };
        match different.iter_mut().find(is_same) {
            Some((_, accelerators, _)) => accelerators.push(row.accelerator.name()),
            None => different.push((row, vec![row.accelerator.name()], picture)),
        }
    }
    let figure = |(row, accelerators, png): (&Row, Vec<&str>, &'a [u8])| Figure {
        caption: caption(row.kernel, &accelerators),
        png,
        bar: depth_errors(row),
    };
    different.into_iter().map(figure).collect()
}

fn caption(kernel: Kernel, accelerators: &[&str]) -> String {
    format!("{kernel}: {}", accelerators.join(", "))
}

/// The colour bar of depth errors, if the row has any.
fn depth_errors(row: &Row) -> Option<Bar> {
    let largest = row.errors()?.tally.depths.max().filter(|max| *max > 0)?;
    Some(Bar {
        colors: picture::DEPTH.to_vec(),
        ends: [
            "1 ulp".to_owned(),
            format!("{} ulp", grouped(largest.into())),
        ],
    })
}

/// The pictures, each a link to itself. The style sheet shows the target of a link enlarged, with a
/// link back to the heading `back`.
fn elements(back: &str, figures: &[Figure]) -> String {
    let element = |(index, figure): (usize, &Figure)| {
        let id = format!("{back}-{}", index + 1);
        let (caption, data) = (escaped(&figure.caption), BASE64_STANDARD.encode(figure.png));
        let bar = figure.bar.as_ref().map_or(String::new(), Bar::element);
        format!(
            "<figure id=\"{id}\"><a href=\"#{id}\"><img alt=\"{caption}\" \
             src=\"data:image/png;base64,{data}\"></a><figcaption>{caption}{bar}</figcaption>\
             <a class=\"close\" href=\"#{back}\">close</a></figure>\n"
        )
    };
    let elements: String = figures.iter().enumerate().map(element).collect();
    format!("<div class=\"pictures\">\n{elements}</div>\n")
}

impl Bar {
    fn element(&self) -> String {
        let color = |[red, green, blue]: &[u8; 3]| format!("rgb({red} {green} {blue})");
        let colors: Vec<String> = self.colors.iter().map(color).collect();
        let [low, high] = self.ends.each_ref().map(|end| escaped(end));
        format!(
            "<span class=\"bar\" style=\"background: linear-gradient(to right, {})\"></span>\
             <span class=\"ends\"><span>{low}</span><span>{high}</span></span>",
            colors.join(", ")
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::SplitMethod;
    use crate::bench::run::tests::row;
    use crate::film::ColorRange;

    fn pictures() -> PictureFiles {
        PictureFiles {
            depth: Some(vec![0, 1]),
            depth_range: Some(ColorRange {
                start: 1.5,
                end: 4.0,
            }),
            costs: vec![(SplitMethod::Sah, vec![2])],
            highest_cost: 7.0,
            errors: vec![Some(vec![3]), Some(vec![4]), Some(vec![3]), None],
            size: [3, 4],
        }
    }

    #[test]
    fn equal_pictures_are_shown_once_and_each_is_a_link_to_itself() {
        let [exact, fast, ..] = Kernel::ALL;
        let rows = [
            row(SplitMethod::Middle, exact, 1000),
            row(SplitMethod::Middle, fast, 1000),
            row(SplitMethod::Sah, exact, 1000),
            row(SplitMethod::Sah, fast, 1000),
        ];
        let text = figures("scene-1", &rows, &pictures());
        let captions: Vec<&str> = text
            .split("<figcaption>")
            .skip(1)
            .map(|rest| &rest[..rest.find('<').unwrap()])
            .collect();
        assert_eq!(
            captions,
            ["depth", "cost, sah", "exact: middle, sah", "fast: middle"]
        );
        for id in ["scene-1-pictures-2", "scene-1-errors-1"] {
            let link = format!("<figure id=\"{id}\"><a href=\"#{id}\"><img");
            assert!(text.contains(&link), "{text}");
        }
        assert!(text.contains("src=\"data:image/png;base64,AAE=\""));
    }

    #[test]
    fn colour_bars_name_their_ends() {
        let rows = [row(SplitMethod::Middle, Kernel::ALL[1], 1000)];
        let text = figures("scene-1", &rows, &pictures());
        for [low, high] in [
            ["1.5 near", "far 4"],
            ["0", "7 and more"],
            ["1 ulp", "3 ulp"],
        ] {
            let ends = format!("<span>{low}</span><span>{high}</span>");
            assert!(text.contains(&ends), "{ends} in {text}");
        }
    }
}
