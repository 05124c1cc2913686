//! Options for input: the moment that is shown, and limits on what input files may expand to.

use crate::input::BudgetFactor;
use clap::Args;

#[derive(Debug, Args)]
pub(crate) struct InputArgs {
    /// Multiply every limit on what input files may expand to: decompressed bytes, text read
    /// again, memory of meshes and images, subdivided faces, included files, and pairs of corners
    /// tested to cut polygons.
    #[arg(long, value_name = "FACTOR", default_value_t, value_parser = budget_factor)]
    #[arg(hide_short_help = true)]
    pub(crate) input_budget: BudgetFactor,
}

/// Options for what moves.
#[derive(Debug, Args)]
pub(crate) struct MomentArgs {
    /// Show what moves at this moment, from 0 to 1: the start and the end of the motion, which
    /// TransformTimes dates [default: 0, with a warning if anything moves].
    #[arg(long, value_name = "T", value_parser = moment, hide_short_help = true)]
    pub(crate) time: Option<f64>,
}

fn moment(text: &str) -> Result<f64, String> {
    let time = text.parse().ok().filter(|time| (0.0..=1.0).contains(time));
    time.ok_or_else(|| "expected a number from 0 to 1".to_owned())
}

fn budget_factor(text: &str) -> Result<BudgetFactor, String> {
    let factor = text.parse().ok().and_then(BudgetFactor::new);
    factor.ok_or_else(|| format!("expected an integer from 1 to {}", BudgetFactor::MAX))
}
