//! All of it on one page.

mod html;

use super::{
    InputError, Kernel, Machine, PictureFiles, Row, ray_table, to_svg, totals, tree_table,
};
use crate::compare::picture;
use html::{escaped, figure, swatch, table};
use indicatif::HumanCount;

/// What the page says of a scene.
#[derive(Debug)]
pub struct Section {
    /// The scene's name, its size and how it was measured.
    pub title: String,
    /// What was measured.
    pub rows: Vec<Row>,
    /// What there is to see.
    pub pictures: PictureFiles,
}

/// Tells the page from others.
const TITLE: &str = "<title>feimos: speed against error</title>";

/// Returns true if `head`, the beginning of a page, is that of a page by [`to_html`].
pub fn is_report(head: &str) -> bool {
    head.contains(TITLE)
}

/// A page of HTML that needs no other file: the machine, and of each scene the plot, the tables, and the pictures. `command` is what was
/// typed.
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
<p>Each accelerator is built and its rays are traced by each kernel, in turn, round after round; times are medians with the fastest and \
the slowest run. <code>exact</code> and <code>fast</code> are feimos's own, which trace tiles of rays together. <code>exact-single</code> \
gives the exact answers a ray at a time, as do, through the same trees, the two yardsticks in f32: <code>moeller-trumbore</code> with the \
quadratic equation of school, <code>watertight</code> with pbrt's. Errors are those against exact arithmetic on all primitives: false and \
missed hits, hits of the wrong primitive, and of all other hits the error of the depth in units of the last place of an f32 (ulp). Tests \
of nodes and primitives are those of a ray alone in the whole tree. SAH is the tree's cost by the surface area heuristic, EPO the \
overlap of its nodes with what is not theirs.</p>
";

/// All scenes together.
fn of_all(machine: &Machine, sections: &[Section]) -> String {
    let rows: Vec<Row> = sections
        .iter()
        .flat_map(|section| section.rows.iter().cloned())
        .collect();
    let totals = totals(&rows);
    let mut text = format!(
        "<h2>All {} scenes</h2>\n{}",
        sections.len(),
        to_svg("Error against speed, all scenes together", &totals)
    );
    text += &table(&ray_table(&totals, machine.mhz));
    text
}

fn of_scene(machine: &Machine, section: &Section) -> String {
    let Section {
        title,
        rows,
        pictures,
    } = section;
    let name = rows.first().map_or("", |row| &row.scene);
    let size = title
        .strip_prefix(name)
        .map_or(&title[..], |rest| rest.trim_start_matches(": "));
    let mut text = format!(
        "<h2>{}</h2>\n<p class=\"quiet\">{}</p>\n",
        escaped(name),
        escaped(size)
    );
    for note in notes(rows) {
        text += &format!("<p class=\"quiet\">{}</p>\n", escaped(&note));
    }
    text += &to_svg("Error against speed", rows);
    text += &table(&tree_table(rows));
    text += &table(&ray_table(rows, machine.mhz));
    text += &of_pictures(rows, pictures);
    text
}

/// What there is to say of a scene's errors, in sentences.
pub fn notes(rows: &[Row]) -> Vec<String> {
    let mut notes = Vec::new();
    if let Some(InputError {
        max_ulp,
        max_pixels,
    }) = rows.iter().find_map(|row| row.input)
    {
        notes.push(format!(
            "input: rounding transforms, vertices and rays to f64 moves what is seen by at most {max_ulp:.1e} ulp of its \
             distance, {max_pixels:.1e} pixels"
        ));
    }
    let is_sampled = |row: &&Row| {
        !row.is_sampled()
            && row
                .errors
                .as_ref()
                .is_some_and(|errors| errors.is_sampled())
    };
    if let Some(errors) = rows
        .iter()
        .find(is_sampled)
        .and_then(|row| row.errors.as_ref())
    {
        notes.push(format!(
            "errors are those of {} of {} pixels, chosen at random; in brackets, what the share of all pixels is below, with a \
             confidence of 95 %",
            HumanCount(errors.tally.pixels),
            HumanCount(errors.of)
        ));
    }
    for row in rows
        .chunk_by(|a, b| a.method == b.method)
        .filter_map(|rows| rows.iter().find(|row| row.is_sampled()))
    {
        let judged = row.errors.as_ref().map_or(String::new(), |errors| {
            format!(
                "; errors are those of {} pixels in them",
                errors.tally.pixels
            )
        });
        notes.push(format!(
            "{} is sampled: {} of {} rays, some tiles chosen at random (of kernels that trace rays alone, a ray of each){judged}",
            row.method,
            HumanCount(row.rays),
            HumanCount(row.pixels)
        ));
    }
    if rows.iter().all(|row| row.errors.is_none()) {
        notes.push("errors were not measured".to_owned());
    }
    notes
}

fn of_pictures(rows: &[Row], pictures: &PictureFiles) -> String {
    let mut text = String::new();
    let [width, height] = pictures.size;
    if let Some(depth) = &pictures.depth {
        text += "<h3>Depth, near in red, and what a ray costs</h3>\n<p class=\"quiet\">";
        text += &format!(
            "Costs are tests of nodes and primitives, from 0 (dark) to {} (red) and more, on one scale. {width} x {height} \
             pixels.</p>\n<div class=\"pictures\">\n",
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
            (picture::DEPTH[0], "depth off by little"),
            (picture::DEPTH[1], "by the most of the row"),
            (picture::EQUAL_HIT, "right hit"),
            (picture::EQUAL, "right miss"),
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

/// Each picture once, with the names of all rows that share it: answers mostly do not depend on the tree.
fn different<'a>(rows: &[Row], pictures: &'a [Option<Vec<u8>>]) -> Vec<(String, &'a [u8])> {
    let mut different: Vec<(Kernel, Vec<&str>, &[u8])> = Vec::new();
    for (row, picture) in rows.iter().zip(pictures) {
        let Some(picture) = picture.as_deref() else {
            continue;
        };
        match different
            .iter_mut()
            .find(|(kernel, _, other)| *kernel == row.kernel && *other == picture)
        {
            Some((_, methods, _)) => methods.push(row.method.name()),
            None => different.push((row.kernel, vec![row.method.name()], picture)),
        }
    }
    different
        .into_iter()
        .map(|(kernel, methods, picture)| (format!("{kernel}: {}", methods.join(", ")), picture))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::SplitMethod;
    use crate::bench::table::tests::row;

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
    fn a_page_holds_every_scene_and_nothing_from_elsewhere() {
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
            "everything is on the page"
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
