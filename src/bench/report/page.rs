//! All results on one page of HTML.

use super::columns::{accelerator_table, ray_table};
use super::contents::{self, contents, section_id};
use super::figures::figures;
use super::html::{escaped, table};
use super::notes::notes;
use super::plot;
use super::section::Section;
use super::summary::Summary;
use crate::accel::Accelerator;
use crate::bench::run::{Machine, Row, totals};

/// Distinguishes the page from others.
const TITLE: &str = "<title>feimos: speed against error</title>";

/// Returns true if `head` is the beginning of a page by [`to_html`].
pub fn is_report(head: &str) -> bool {
    head.contains(TITLE)
}

/// A page of HTML that needs no other file and no script: the machine, and the result in sentences,
/// the plots, tables and pictures of each scene. `command` is the command line.
pub fn to_html(machine: &Machine, command: &str, sections: &[Section]) -> String {
    let mut page =
        String::from("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
    page += &format!("<meta name=\"viewport\" content=\"width=device-width\">\n{TITLE}\n");
    page += &format!(
        "<style>\n{}{}</style>\n</head>\n<body>\n",
        include_str!("style.css"),
        plot::STYLE
    );
    page += "<h1>Speed against error</h1>\n";
    page += "<p>How fast feimos and two baseline kernels find what each pixel shows, and how often \
             they are wrong.</p>\n";
    page += &format!(
        "<p class=\"quiet\">Measured on {}.</p>\n",
        escaped(&machine.to_string())
    );
    page += READING;
    page += &format!(
        "<details><summary>The command</summary>\n<p><code>{}</code></p>\n</details>\n",
        escaped(command)
    );
    if sections.len() > 1 {
        page += &of_all(machine, sections);
        page += &contents(sections);
    }
    for (index, section) in sections.iter().enumerate() {
        page += &of_scene(machine, section, &section_id(index), sections.len() > 1);
    }
    page += "</body>\n</html>\n";
    page
}

const READING: &str = "\
<details><summary>How to read this page</summary>
<p>Each accelerator is built, and each kernel traces rays through it, in turn, round after round. \
Times are medians, with the fastest and the slowest run. <code>raster</code> is no tree: it sorts \
the primitives that the view may see into bins. The other accelerators are trees over the whole \
scene; <code>none</code> is a list of all primitives in one leaf.</p>
<p><code>exact</code> and <code>fast</code> are feimos's own kernels, which trace tiles of rays. \
The others trace one ray at a time through the same trees: <code>exact-single</code> with exact \
answers, and two f32 baselines, <code>moeller-trumbore</code> with the textbook quadratic formula \
and <code>watertight</code> with pbrt's.</p>
<p>Errors are measured against exact arithmetic on all primitives. A pixel is wrong if it is a \
false hit, a missed hit or shows the wrong primitive. For all other hits, the error of the depth \
is measured in units in the last place of an f32 (ulp). Where only a sample of the pixels is \
compared, brackets have an upper bound of the share of all pixels, with a confidence of 95 %.</p>
<p>Tests of nodes and primitives are those of \
a ray that is traced alone through the whole tree. SAH is the cost of the tree by the surface area \
heuristic, EPO the overlap of its nodes with surfaces of other nodes.</p>
</details>
";

/// All scenes together.
fn of_all(machine: &Machine, sections: &[Section]) -> String {
    let rows = sections
        .iter()
        .flat_map(|section| section.rows.iter().cloned());
    let rows: Vec<Row> = rows.collect();
    let totals = totals(&rows);
    format!(
        "<p><a href=\"#{}\">Contents: {count} scenes</a></p>\n<h2>All {count} scenes</h2>\n{}{}{}",
        contents::ID,
        plots(&totals),
        without_total(&rows, &totals),
        table(&ray_table(&totals, machine.mhz)),
        count = sections.len()
    )
}

/// Names the accelerators of `rows` that have no row among the `totals`.
fn without_total(rows: &[Row], totals: &[Row]) -> String {
    let has_row = |rows: &[Row], accelerator| rows.iter().any(|row| row.accelerator == accelerator);
    let lacks = |one: &Accelerator| has_row(rows, *one) && !has_row(totals, *one);
    let names: Vec<&str> = Accelerator::ALL
        .iter()
        .filter(|one| lacks(one))
        .map(|one| one.name())
        .collect();
    if names.is_empty() {
        return String::new();
    }
    format!(
        "<p class=\"quiet\">Not among the totals: {}, which some scenes lack, or of whose rays \
         they trace only a sample.</p>\n",
        names.join(", ")
    )
}

/// The section of a scene, with the anchor `id` and perhaps a link to the contents.
fn of_scene(machine: &Machine, section: &Section, id: &str, has_contents: bool) -> String {
    let Section {
        title,
        rows,
        pictures,
    } = section;
    let name = rows.first().map_or("", |row| &row.scene);
    let size = title.strip_prefix(name);
    let size = size.map_or(&title[..], |rest| rest.trim_start_matches(": "));
    let (name, size) = (escaped(name), escaped(size));
    let up = match has_contents {
        true => format!(" <a class=\"up\" href=\"#{}\">contents</a>", contents::ID),
        false => String::new(),
    };
    let mut text = format!("<h2 id=\"{id}\">{name}{up}</h2>\n<p class=\"quiet\">{size}</p>\n");
    text += &plots(rows);
    let notes: String = notes(rows)
        .iter()
        .map(|note| format!("<li>{}</li>\n", escaped(note)))
        .collect();
    text += &format!("<ul class=\"quiet\">\n{notes}</ul>\n");
    text += &table(&accelerator_table(rows));
    text += &table(&ray_table(rows, machine.mhz));
    text += &figures(id, rows, pictures);
    text
}

/// Both plots, each below its result in a sentence, and their explanation.
fn plots(rows: &[Row]) -> String {
    let summaries = [Summary::of_wrong_pixels(rows), Summary::of_depths(rows)];
    let mut text = "<div class=\"plots\">\n".to_owned();
    for (summary, element) in summaries.into_iter().zip(plot::elements(rows)) {
        let bold = |name: &str| format!("<b>{}</b>", escaped(name));
        let summary = summary.map(|summary| format!("<p>{}</p>\n", summary.text(bold)));
        let parts: String = summary.into_iter().chain(element).collect();
        if !parts.is_empty() {
            text += &format!("<div>{parts}</div>\n");
        }
    }
    let legend: Vec<String> = plot::legend(rows)
        .iter()
        .map(|line| escaped(line))
        .collect();
    text + &format!("</div>\n<p class=\"quiet\">{}</p>\n", legend.join("<br>\n"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::SplitMethod;
    use crate::bench::kernel::Kernel;
    use crate::bench::run::PictureFiles;
    use crate::bench::run::tests::row;

    fn section(name: &str) -> Section {
        let [exact, fast, ..] = Kernel::ALL;
        let rows = [exact, fast].map(|kernel| Row {
            scene: name.into(),
            ..row(SplitMethod::Sah, kernel, 1000)
        });
        let pictures = PictureFiles {
            depth: Some(vec![1]),
            depth_range: None,
            costs: vec![(SplitMethod::Sah, vec![2])],
            highest_cost: 7.0,
            errors: vec![Some(vec![3]), None],
            size: [3, 4],
        };
        Section {
            title: format!("{name}: small"),
            rows: rows.to_vec(),
            pictures,
        }
    }

    fn page(sections: &[Section]) -> String {
        to_html(&Machine::detect("scalar"), "feimos bench <x>", sections)
    }

    #[test]
    fn a_page_holds_every_scene_and_needs_no_other_file() {
        let page = page(&[section("a<b>.pbrt"), section("c.pbrt")]);
        assert!(
            page.contains("<h2 id=\"scene-1\">a&lt;b&gt;.pbrt "),
            "{page}"
        );
        assert!(page.contains("<h2>All 2 scenes</h2>"), "{page}");
        let count = |text: &str| page.matches(text).count();
        // Two plots of all scenes and of each; a table of all scenes, the contents, two of each.
        assert_eq!(
            (count("<svg"), count("<table>"), count("<figure")),
            (6, 6, 6)
        );
        let links = page.split("href=\"").skip(1);
        let targets: Vec<&str> = links.filter_map(|rest| rest.split('"').next()).collect();
        for target in &targets {
            let id = target.strip_prefix('#').expect("a link within the page");
            assert!(page.contains(&format!("id=\"{id}\"")), "{target}");
        }
        assert!(targets.contains(&"#scene-2") && targets.contains(&"#contents"));
        assert!(!page.contains("src=\"http") && !page.contains("<script"));
    }

    #[test]
    fn accelerators_without_totals_are_named() {
        let (mut a, b) = (section("a.pbrt"), section("b.pbrt"));
        assert!(!page(&[section("a.pbrt"), section("b.pbrt")]).contains("Not among the totals"));
        let exact = Kernel::ALL[0];
        a.rows.push(row(SplitMethod::Hlbvh, exact, 1000));
        assert!(page(&[a, b]).contains("Not among the totals: hlbvh, which some scenes lack"));
    }

    #[test]
    fn a_sentence_above_each_plot_says_the_result() {
        let page = page(&[section("a.pbrt")]);
        let sentence = "<p><b>exact</b>: 3 wrong (0.30 %) of 1,000 pixels at 0.02 (0.02-0.02) \
                        Mrays/s; <b>fast</b>: 3 wrong (0.30 %), about as fast (all with sah).</p>\n\
                        <svg";
        assert!(page.contains(sentence), "{page}");
        assert!(
            page.contains("off by up to 3 ulp (where the hit is right).</p>\n<svg"),
            "{page}"
        );
        assert!(!page.contains("Contents"), "one scene needs no contents");
    }

    #[test]
    fn the_contents_have_the_wrong_pixels_of_each_kernel() {
        let page = page(&[section("a.pbrt"), section("b.pbrt")]);
        let line = "<a href=\"#scene-2\">b.pbrt</a></td><td class=\"wrong\">3 (0.30 %)</td>\
                    <td class=\"wrong\">3 (0.30 %)</td><td>0.02</td></tr>";
        assert!(page.contains(line), "{page}");
    }
}
