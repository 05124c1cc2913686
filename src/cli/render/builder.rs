//! Builds the structure that an image is traced through: bins of its view, or a tree.

use super::built::{Built, BuiltTree};
use super::milliseconds::timed;
use super::plan::Plan;
use super::scene::{LoadedScene, Viewpoint};
use super::summary::report_built;
use super::target::Target;
use crate::accel::{Accelerator, Aggregate, Bins};
use crate::cli::options::engine::AcceleratorChoice;
use crate::cli::terminal::progress::{Phase, ProgressBars};
use crate::cli::terminal::reporter::Reporter;
use crate::error::{Error, Result};
use crate::film::PixelBounds;
use crate::geometry::Point;
use crate::progress::Progress;
use crate::structure_choice::{may_share_tree, shared_anchor, takes_bins};

/// Builds structures as the plan has it.
pub(super) struct Builder<'a> {
    pub(super) plan: &'a Plan,
    pub(super) reporter: &'a Reporter,
    pub(super) bars: &'a ProgressBars,
}

impl Builder<'_> {
    /// The structure for an image, and the milliseconds that building it took now.
    pub(super) fn build<'a>(
        &self,
        loaded: &'a LoadedScene,
        view: &Viewpoint,
        target: &Target,
    ) -> Result<(Built<'a>, f64)> {
        let is_linear = view.camera.projection.is_linear();
        let takes_bins = self.takes_bins(loaded, target)?;
        if takes_bins && !is_linear && self.plan.accel != AcceleratorChoice::Auto {
            let method = loaded.build.method;
            self.reporter.note(format_args!(
                "a {} camera cannot be rasterized: its rays are traced one by one, \
                 using {method}",
                view.camera.projection.name()
            ));
        }
        if takes_bins && is_linear {
            Bins::check_memory(&loaded.scene.geometry)?;
            let (bins, ms) = self.bins(loaded, view, &target.window);
            if let Some(bins) = bins {
                let built = Built::Bins(Box::new(bins));
                report_built(&built, &loaded.scene.geometry, self.reporter);
                return Ok((built, ms));
            }
            if self.plan.accel != AcceleratorChoice::Auto {
                let method = loaded.build.method;
                self.reporter.note(format_args!(
                    "this view cannot be rasterized, because its numbers are too large or too \
                     small: using {method}"
                ));
            }
        }
        self.tree(loaded, view, target)
    }

    /// Decides between bins and a tree.
    ///
    /// # Errors
    /// Costs are asked for, and bins.
    fn takes_bins(&self, loaded: &LoadedScene, target: &Target) -> Result<bool> {
        let costs = target.needs_tree();
        match self.plan.accel {
            AcceleratorChoice::Fixed(Accelerator::Tree(_)) => Ok(false),
            AcceleratorChoice::Fixed(Accelerator::Raster) if costs => {
                let error =
                    Error::usage("the cost of a ray is that in a tree, and raster has none");
                Err(error.note("choose a tree, such as --accel sah"))
            }
            AcceleratorChoice::Fixed(Accelerator::Raster) => Ok(true),
            AcceleratorChoice::Auto => {
                Ok(takes_bins(loaded.views.len(), self.plan.precision, costs))
            }
        }
    }

    fn bins(
        &self,
        loaded: &LoadedScene,
        view: &Viewpoint,
        window: &PixelBounds,
    ) -> (Option<Bins>, f64) {
        let (geometry, build, simd) = (&loaded.scene.geometry, loaded.build, self.plan.simd);
        let make = |progress: Progress<'_>| {
            Bins::new(geometry, &view.camera, window, build, simd, progress)
        };
        let phase = Phase::Building(Aggregate::item_count(geometry));
        timed(|| self.bars.during(phase, make))
    }

    fn tree<'a>(
        &self,
        loaded: &'a LoadedScene,
        view: &Viewpoint,
        target: &Target,
    ) -> Result<(Built<'a>, f64)> {
        let geometry = &loaded.scene.geometry;
        let may_share = may_share_tree(self.plan.precision, target.needs_tree());
        let is_shared = loaded.views.len() > 1 && may_share;
        if let (true, Some(built)) = (is_shared, loaded.shared()) {
            return Ok((Built::Shared(built), 0.0));
        }
        Aggregate::check_memory(geometry)?;
        let anchor = match is_shared {
            true => shared_anchor(&loaded.scene),
            false => view.camera.anchor(),
        };
        let (tree, ms) = self.build_tree(loaded, anchor);
        let built = match is_shared {
            true => Built::Shared(loaded.share(tree)),
            false => Built::Tree(Box::new(tree)),
        };
        report_built(&built, geometry, self.reporter);
        Ok((built, ms))
    }

    /// Builds a tree over the whole scene. Returns it with the milliseconds that this took.
    fn build_tree(&self, loaded: &LoadedScene, anchor: Point) -> (BuiltTree, f64) {
        let (geometry, build) = (&loaded.scene.geometry, loaded.build);
        let make = |progress: Progress<'_>| Aggregate::build(geometry, anchor, build, progress);
        let phase = Phase::Building(Aggregate::item_count(geometry));
        let (aggregate, ms) = timed(|| self.bars.during(phase, make));
        (BuiltTree::new(build.method, aggregate, geometry), ms)
    }

    /// A tree over the whole scene, which all views share.
    ///
    /// # Errors
    /// There is no memory for it.
    pub(super) fn tree_beside_bins<'a>(
        &self,
        loaded: &'a LoadedScene,
        view: &Viewpoint,
    ) -> Result<&'a BuiltTree> {
        if let Some(tree) = loaded.shared() {
            return Ok(tree);
        }
        Aggregate::check_memory(&loaded.scene.geometry)?;
        let anchor = match loaded.views.len() {
            1 => view.camera.anchor(),
            _ => shared_anchor(&loaded.scene),
        };
        Ok(loaded.share(self.build_tree(loaded, anchor).0))
    }
}
