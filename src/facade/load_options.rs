//! Options for loading a scene.

use crate::error::Error;
use crate::film::PixelBounds;
use crate::input::BudgetFactor;
use crate::scene;
use crate::shape::AlphaCutoff;

/// Options for [`Scene::load_with`](crate::Scene::load_with). The default loads the scene as its
/// file describes it.
///
/// ```
/// use feimos::LoadOptions;
///
/// let options = LoadOptions::new().resolution([320, 240]).time(0.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadOptions {
    resolution: Option<[u32; 2]>,
    time: Option<f64>,
    alpha_cutoff: f64,
    input_budget: u32,
    surfaces: bool,
}

impl Default for LoadOptions {
    fn default() -> LoadOptions {
        LoadOptions {
            resolution: None,
            time: None,
            alpha_cutoff: 0.0,
            input_budget: 1,
            surfaces: true,
        }
    }
}

impl LoadOptions {
    /// The default.
    pub fn new() -> LoadOptions {
        LoadOptions::default()
    }

    /// Width and height of the film in pixels, in place of those of the file.
    pub fn resolution(self, size: [u32; 2]) -> LoadOptions {
        LoadOptions {
            resolution: Some(size),
            ..self
        }
    }

    /// The moment that is shown of what moves: from 0, the start and the default, to 1, the end.
    pub fn time(self, time: f64) -> LoadOptions {
        LoadOptions {
            time: Some(time),
            ..self
        }
    }

    /// Lets rays pass where the alpha of a surface is up to this number, from 0 to below 1. The
    /// default is 0.
    pub fn alpha_cutoff(self, alpha: f64) -> LoadOptions {
        LoadOptions {
            alpha_cutoff: alpha,
            ..self
        }
    }

    /// Multiplies the limits of what input files may expand to by this factor, from 1 to
    /// 1,000,000.
    pub fn input_budget(self, factor: u32) -> LoadOptions {
        LoadOptions {
            input_budget: factor,
            ..self
        }
    }

    /// Whether to keep what normals and `uv` need: the sides of surfaces, and vertex normals and
    /// coordinates of mesh files. The default is `true`. Without it, large meshes that have such
    /// values load faster and take less memory. Normals may then point to the other side, and
    /// triangles have default coordinates.
    pub fn surfaces(self, keep: bool) -> LoadOptions {
        LoadOptions {
            surfaces: keep,
            ..self
        }
    }

    /// The options as the loader has them.
    ///
    /// # Errors
    /// A number out of its range.
    pub(super) fn checked(&self) -> Result<scene::LoadOptions, Error> {
        let most = PixelBounds::MAX_SIDE;
        let mut sides = self.resolution.iter().flatten();
        if let Some(side) = sides.find(|side| !(1..=most).contains(*side)) {
            return Err(unfit(
                "resolution",
                side,
                &format!("two numbers from 1 to {most}"),
            ));
        }
        if let Some(time) = self.time.filter(|time| !(0.0..=1.0).contains(time)) {
            return Err(unfit("time", &time, "a number from 0 to 1"));
        }
        let alpha = self.alpha_cutoff;
        let alpha_cutoff = AlphaCutoff::new(alpha)
            .ok_or_else(|| unfit("alpha cutoff", &alpha, "a number from 0 to below 1"))?;
        let factor = self.input_budget;
        let range = format!("a number from 1 to {}", BudgetFactor::MAX);
        let input_budget =
            BudgetFactor::new(factor).ok_or_else(|| unfit("input budget", &factor, &range))?;
        Ok(scene::LoadOptions {
            resolution: self.resolution,
            time: self.time,
            alpha_cutoff,
            input_budget,
            orientation: self.surfaces,
            uv: self.surfaces,
            ..scene::LoadOptions::default()
        })
    }
}

fn unfit(option: &str, found: &dyn std::fmt::Display, expected: &str) -> Error {
    Error::usage(format!("{option} {found}")).note(format!("expected {expected}"))
}
