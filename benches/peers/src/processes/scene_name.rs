//! What there is to render, by name.

use crate::table::grouped;
use crate::views::ViewName;
use clap::ValueEnum;
use std::fmt;

/// A view, or something that only whole processes render.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SceneName {
    /// As for `compare`.
    View(ViewName),
    /// A bumpy sphere of so many million triangles.
    Sphere { millions: u64 },
    /// The dragon from so many cameras around it.
    Cameras { count: u32 },
}

impl SceneName {
    /// All that the README states.
    pub(super) fn all() -> Vec<SceneName> {
        let views = ViewName::value_variants().iter().copied();
        let spheres = [16, 64].map(|millions| SceneName::Sphere { millions });
        let cameras = [20, 100].map(|count| SceneName::Cameras { count });
        let all = views.map(SceneName::View).chain(spheres);
        all.chain(cameras).collect()
    }

    /// Parses `a`, `16m` or `20cameras`.
    pub(crate) fn parse(text: &str) -> Result<SceneName, String> {
        let number = |suffix| text.strip_suffix(suffix).and_then(|n| n.parse().ok());
        if let Some(count) = number("cameras").filter(|count| (1..=10_000).contains(count)) {
            return Ok(SceneName::Cameras { count });
        }
        if let Some(millions) = number("m").filter(|millions| (1..=4_000).contains(millions)) {
            let millions = u64::from(millions);
            return Ok(SceneName::Sphere { millions });
        }
        let view = ViewName::from_str(text, true);
        view.map(SceneName::View).map_err(|_| {
            let all = SceneName::all();
            let names: Vec<String> = all.iter().map(SceneName::to_string).collect();
            format!("expected one of {}", names.join(", "))
        })
    }

    /// For a heading.
    pub(super) fn title(self) -> String {
        match self {
            SceneName::View(view) => view.title().to_owned(),
            SceneName::Sphere { millions } => {
                format!("{} triangles", grouped(millions * 1_000_000))
            }
            SceneName::Cameras { count } => format!("{count} cameras"),
        }
    }

    /// Primitives, at most.
    pub(super) fn primitives(self) -> u64 {
        match self {
            SceneName::Sphere { millions } => millions * 1_000_000,
            SceneName::View(_) | SceneName::Cameras { .. } => 1_000_002,
        }
    }

    pub(super) fn has_only_spheres(self) -> bool {
        self == SceneName::View(ViewName::Spheres)
    }
}

/// As `--views` takes it.
impl fmt::Display for SceneName {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        match self {
            SceneName::View(view) => out.write_str(&view.title().to_lowercase()),
            SceneName::Sphere { millions } => write!(out, "{millions}m"),
            SceneName::Cameras { count } => write!(out, "{count}cameras"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_they_are_written() {
        for name in SceneName::all() {
            assert_eq!(SceneName::parse(&name.to_string()), Ok(name));
        }
        for text in ["", "m", "0m", "5000m", "0cameras", "cameras", "dragon"] {
            assert!(SceneName::parse(text).is_err(), "{text}");
        }
    }
}
