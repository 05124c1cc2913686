//! All results on one page of HTML.

use super::columns::{accelerator_table, ray_table};
use super::html::{escaped, figure, swatch, table};
use super::notes::notes;
use super::plot::to_svg;
use crate::bench::kernel::Kernel;
use crate::bench::run::{Machine, PictureFiles, Row, totals};
use crate::compare::picture;

/// The section of a scene.
#[derive(Debug)]
pub struct Section {
    /// The scene's name, its size, and how it was measured.
    pub title: String,
    /// The measurements.
    pub rows: Vec<Row>,
    /// The pictures.
    pub pictures: PictureFiles,
}

/// Distinguishes the page from others.
const TITLE: &str = "<title>feimos: speed against error</title>";

/// Returns true if `head` is the beginning of a page by [`to_html`].
pub fn is_report(head: &str) -> bool {
    head.contains(TITLE)
}

/// A page of HTML that needs no other file: the machine, and the plot, tables and pictures of each
/// scene. `command` is the command line.
pub fn to_html(machine: &Machine, command: &str, sections: &[Section]) -> String {
    let mut page =
        String::from("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
    page += &format!("<meta name=\"viewport\" content=\"width=device-width\">\n{TITLE}\n");
    page += &format!(
        "<style>\n{}</style>\n</head>\n<body>\n",
        include_str!("style.css")
    );
    page += "<h1>Speed against error</h1>\n";
    page += &format!(
        "<p class=\"quiet\">{}<br><code>{}</code></p>\n",
        escaped(&machine.to_string()),
        escaped(command)
    );
    page += READING;
    if sections.len() > 1 {
        page += &of_all(machine, sections);
    }
    sections
        .iter()
        .for_each(|section| page += &of_scene(machine, section));
    page += "</body>\n</html>\n";
    page
}

const READING: &str = "\
<p>Each accelerator is built, and each kernel traces rays through it, in turn, round after round. \
Times are medians, with the fastest and the slowest run. <code>raster</code> is no tree: it sorts \
the primitives that the view may see into bins. The other accelerators are trees over the whole \
scene. <code>exact</code> and <code>fast</code> are feimos's own kernels, which trace tiles of \
rays. The others trace one ray at a time through the same trees: <code>exact-single</code> with \
exact answers, and two f32 baselines, <code>moeller-trumbore</code> with the textbook quadratic \
formula and <code>watertight</code> with pbrt's. Errors are measured against exact arithmetic on all primitives: false and missed hits, \
wrong primitives, and for all other hits the error of the depth in units in the last place of an \
f32 (ulp). Tests of nodes and primitives are those of a ray that is traced alone through the whole \
tree. SAH is the cost of the tree by the surface area heuristic, EPO the overlap of its nodes with \
surfaces of other nodes.</p>
";

/// All scenes together.
fn of_all(machine: &Machine, sections: &[Section]) -> String {
    let rows = sections
        .iter()
        .flat_map(|section| section.rows.iter().cloned());
    let totals = totals(&rows.collect::<Vec<Row>>());
    let plot = to_svg("Error against speed, all scenes together", &totals);
    let table = table(&ray_table(&totals, machine.mhz));
    format!("<h2>All {} scenes</h2>\n{plot}{table}", sections.len())
}

fn of_scene(machine: &Machine, section: &Section) -> String {
    let Section {
        title,
        rows,
        pictures,
    } = section;
    let name = rows.first().map_or("", |row| &row.scene);
    let size = title.strip_prefix(name);
    let size = size.map_or(&title[..], |rest| rest.trim_start_matches(": "));
    let (name, size) = (escaped(name), escaped(size));
    let mut text = format!("<h2>{name}</h2>\n<p class=\"quiet\">{size}</p>\n");
    for note in notes(rows) {
        text += &format!("<p class=\"quiet\">{}</p>\n", escaped(&note));
    }
    text += &to_svg("Error against speed", rows);
    text += &table(&accelerator_table(rows));
    text += &table(&ray_table(rows, machine.mhz));
    text += &of_pictures(rows, pictures);
    text
}

fn of_pictures(rows: &[Row], pictures: &PictureFiles) -> String {
    let mut text = String::new();
    let [width, height] = pictures.size;
    if let Some(depth) = &pictures.depth {
        text += "<h3>Depth, near in red, and cost of each ray</h3>\n<p class=\"quiet\">";
        text += &format!(
            "Costs are tests of nodes and primitives, on one scale from 0 (dark) to {} and more \
             (red). {width} x {height} pixels.</p>\n<div class=\"pictures\">\n",
            pictures.highest_cost
        );
        text += &figure("depth", depth);
        pictures
            .costs
            .iter()
            .for_each(|(method, cost)| text += &figure(&format!("cost, {method}"), cost));
        text += "</div>\n";
    }
    if pictures.errors.iter().any(Option::is_some) {
        text += "<h3>Errors</h3>\n<p class=\"quiet\">";
        for (color, meaning) in [
            (picture::FALSE_HIT, "false hit"),
            (picture::MISSED_HIT, "missed hit"),
            (picture::WRONG_PRIMITIVE, "wrong primitive"),
            (picture::DEPTH[0], "small depth error"),
            (picture::DEPTH[1], "largest depth error of the row"),
            (picture::EQUAL_HIT, "correct hit"),
            (picture::EQUAL, "correct miss"),
        ] {
            text += &swatch(color, meaning);
        }
        text += "</p>\n<div class=\"pictures\">\n";
        for (caption, png) in different(rows, &pictures.errors) {
            text += &figure(&caption, png);
        }
        text += "</div>\n";
    }
    text
}

/// The different pictures, each with the names of all rows that share it: answers rarely depend on
/// the tree.
fn different<'a>(rows: &[Row], pictures: &'a [Option<Vec<u8>>]) -> Vec<(String, &'a [u8])> {
    let mut different: Vec<(Kernel, Vec<&str>, &[u8])> = Vec::new();
    for (row, picture) in rows.iter().zip(pictures) {
        let Some(picture) = picture.as_deref() else {
            continue;
        };
        let mut found = different.iter_mut();
        match found.find(|(kernel, _, other)| *kernel == row.kernel && *other == picture) {
            Some((_, accelerators, _)) => accelerators.push(row.accelerator.name()),
            None => different.push((row.kernel, vec![row.accelerator.name()], picture)),
        }
    }
    let captioned = |(kernel, accelerators, picture): (Kernel, Vec<&str>, &'a [u8])| {
        (format!("{kernel}: {}", accelerators.join(", ")), picture)
    };
    different.into_iter().map(captioned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::SplitMethod;
    use crate::bench::run::tests::row;

    fn section(name: &str) -> Section {
        let [exact, fast, ..] = Kernel::ALL;
        let rows = [
            (SplitMethod::Middle, exact),
            (SplitMethod::Middle, fast),
            (SplitMethod::Sah, exact),
            (SplitMethod::Sah, fast),
        ];
        let pictures = PictureFiles {
            depth: Some(vec![1]),
            costs: vec![(SplitMethod::Sah, vec![2])],
            highest_cost: 7.0,
            errors: vec![Some(vec![3]), Some(vec![4]), Some(vec![3]), Some(vec![5])],
            size: [3, 4],
        };
        let rows = rows
            .map(|(method, kernel)| Row {
                scene: name.into(),
                ..row(method, kernel, 1000)
            })
            .to_vec();
        Section {
            title: format!("{name}: small"),
            rows,
            pictures,
        }
    }

    #[test]
    fn a_page_holds_every_scene_and_needs_no_other_file() {
        let machine = Machine::detect("scalar");
        let page = to_html(
            &machine,
            "feimos bench <x>",
            &[section("a<b>.pbrt"), section("c.pbrt")],
        );
        assert!(
            page.contains("<h2>a&lt;b&gt;.pbrt</h2>") && page.contains("<h2>All 2 scenes</h2>")
        );
        assert_eq!(
            (
                page.matches("<svg").count(),
                page.matches("<table>").count()
            ),
            (3, 5)
        );
        assert!(
            !page.contains("src=\"http") && !page.contains("href="),
            "the page needs no other file"
        );
        let captions: Vec<&str> = page
            .split("<figcaption>")
            .skip(1)
            .map(|rest| &rest[..rest.find('<').unwrap()])
            .collect();
        let of_one = [
            "depth",
            "cost, sah",
            "exact: middle, sah",
            "fast: middle",
            "fast: sah",
        ];
        assert_eq!(captions, [of_one, of_one].concat());
    }
}
