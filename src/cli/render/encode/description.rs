//! The meaning of a view's colours in words. These words are part of files.

use super::view_file::{NO_COST, SHOWN_PER_MILLE, ViewFile};
use crate::film::view::Depth16;
use crate::film::{ColorRange, View};

impl ViewFile {
    /// The meaning of the colours.
    pub(super) fn description(&self) -> String {
        let misses = |usual: &str| match &self.background {
            Some(background) => format!("misses {background}"),
            None => format!("misses {usual}"),
        };
        match self.view {
            View::Depth => format!("{}{}", self.depths(""), misses("pale blue")),
            View::Shaded => {
                let light = "darker where surfaces turn away, ";
                format!("{}{}", self.depths(light), misses("pale blue"))
            }
            View::Hit => format!("hits red, {}", misses("yellow")),
            View::Mask => "hits 255, misses 0".to_owned(),
            View::Normal => {
                let axes = "x, y and z of normals from -1 to 1 as red, green and blue";
                format!("{axes}, {}", misses("black"))
            }
            View::Id => format!("a colour for each shape, {}", misses("black")),
            View::Prim => format!("a colour for each primitive, {}", misses("black")),
            View::Instance => {
                let misses = misses("black");
                format!("a colour for each instance, outside of instances black, {misses}")
            }
            View::Cost => self.costs(),
            View::Depth16 => {
                let Depth16 { scale, miss } = self.depth16;
                format!("{scale} steps a unit of depth, misses {miss}")
            }
            View::Id16 => "the number of each shape, misses 0".to_owned(),
            View::Instance16 => {
                "the number of each instance, misses and outside of instances 0".to_owned()
            }
        }
    }

    /// The colours of depths, if there is a hit, and `light`.
    fn depths(&self, light: &str) -> String {
        let Some(ColorRange { start, end }) = self.range else {
            return String::new();
        };
        let [near, far] = self.colors.ends();
        format!("depth {start} ({near}) to {end} ({far}), {light}")
    }

    fn costs(&self) -> String {
        let ColorRange { start, end } = self.range.unwrap_or(NO_COST);
        let [near, far] = self.colors.ends();
        let beyond = self.beyond.map_or(String::new(), |largest| {
            let percent = SHOWN_PER_MILLE as f64 / 10.0;
            format!(", which {percent} % of the rays do not exceed; the largest is {largest}")
        });
        format!("cost {start} ({far}) to {end} ({near}){beyond}")
    }
}
