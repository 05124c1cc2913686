//! Elements of SVG. Colours are left to the style sheet.

use crate::bench::report::html::escaped;
use std::fmt::Write;

/// The elements of a drawing, in pixels from the upper left corner.
#[derive(Debug, Default)]
pub(super) struct Svg {
    elements: String,
}

/// The place of a text beside its point.
#[derive(Debug, Clone, Copy)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Svg {
    /// A straight line.
    pub(super) fn line(&mut self, class: &str, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) {
        self.add(format_args!(
            "<line class=\"{class}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>"
        ));
    }

    /// A rectangle from its upper left corner.
    pub(super) fn rectangle(&mut self, class: &str, [x, y]: [f64; 2], [width, height]: [f64; 2]) {
        self.add(format_args!(
            "<rect class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" \
             height=\"{height:.1}\"/>"
        ));
    }

    pub(super) fn circle(&mut self, class: &str, [x, y]: [f64; 2], radius: f64) {
        self.add(format_args!(
            "<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\"/>"
        ));
    }

    /// A closed polygon.
    pub(super) fn polygon(&mut self, class: &str, corners: &[[f64; 2]]) {
        let corners = joined(corners);
        self.add(format_args!(
            "<polygon class=\"{class}\" points=\"{corners}\"/>"
        ));
    }

    /// A chain of straight lines.
    pub(super) fn polyline(&mut self, class: &str, corners: &[[f64; 2]]) {
        let corners = joined(corners);
        self.add(format_args!(
            "<polyline class=\"{class}\" points=\"{corners}\"/>"
        ));
    }

    /// Text on the base line `y`.
    pub(super) fn text(&mut self, class: &str, [x, y]: [f64; 2], anchor: Anchor, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        self.add(format_args!(
            "<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{}</text>",
            escaped(text)
        ));
    }

    /// A bold text and another one behind it, on the base line `y`.
    pub(super) fn text_pair(&mut self, class: &str, [x, y]: [f64; 2], bold: &str, text: &str) {
        self.add(format_args!(
            "<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\"><tspan class=\"name\">{}</tspan> \
             {}</text>",
            escaped(bold),
            escaped(text)
        ));
    }

    /// A group of elements; browsers show its `title` when the mouse points at it.
    pub(super) fn group(&mut self, class: &str, title: &str, content: Svg) {
        self.add(format_args!(
            "<g class=\"{class}\"><title>{}</title>\n{}</g>",
            escaped(title),
            content.elements
        ));
    }

    /// The drawing with its upper left corner at `place`, inside another one.
    pub(super) fn nested(&mut self, place: [f64; 2], size: [f64; 2], label: &str, content: Svg) {
        let [x, y] = place;
        let place = format!(" x=\"{x:.1}\" y=\"{y:.1}\"");
        self.add(format_args!("{}", content.wrapped(&place, size, label)));
    }

    /// The drawing as an element of HTML, with a `label` for screen readers.
    pub(super) fn element(self, size: [f64; 2], label: &str) -> String {
        self.wrapped("", size, label)
    }

    /// The drawing as a file, with its style sheet.
    pub(super) fn file(self, size: [f64; 2], label: &str, style: &str) -> String {
        let attributes = " xmlns=\"http://www.w3.org/2000/svg\"";
        let mut content = Svg::default();
        content.add(format_args!("<style>\n{style}</style>"));
        content.add(format_args!(
            "<rect class=\"paper\" width=\"100%\" height=\"100%\"/>"
        ));
        content.elements += &self.elements;
        content.wrapped(attributes, size, label)
    }

    fn wrapped(self, attributes: &str, [width, height]: [f64; 2], label: &str) -> String {
        format!(
            "<svg{attributes} class=\"plot\" width=\"{width:.0}\" height=\"{height:.0}\" \
             viewBox=\"0 0 {width:.0} {height:.0}\" role=\"img\" aria-label=\"{}\">\n{}</svg>\n",
            escaped(label),
            self.elements
        )
    }

    fn add(&mut self, element: std::fmt::Arguments) {
        writeln!(self.elements, "{element}").expect("writing to a string does not fail");
    }
}

fn joined(corners: &[[f64; 2]]) -> String {
    let corner = |[x, y]: &[f64; 2]| format!("{x:.1},{y:.1}");
    corners.iter().map(corner).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_never_become_elements() {
        let mut svg = Svg::default();
        svg.text("label", [1.0, 2.5], Anchor::End, "<b> & c");
        svg.group("k", "\"<", Svg::default());
        let file = svg.file([10.0, 20.0], "a < b", "text { fill: red; }\n");
        assert!(
            file.contains("text-anchor=\"end\">&lt;b&gt; &amp; c</text>"),
            "{file}"
        );
        assert!(file.contains("<title>&quot;&lt;</title>"), "{file}");
        assert!(file.contains("aria-label=\"a &lt; b\""), "{file}");
        assert!(
            file.starts_with("<svg xmlns=") && file.ends_with("</svg>\n"),
            "{file}"
        );
    }
}
