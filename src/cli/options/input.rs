//! Options for input: limits on what input files may expand to.

use clap::Args;
use feimos::input::BudgetFactor;

#[derive(Debug, Args)]
pub(crate) struct InputArgs {
    /// Multiply every limit on what input files may expand to: decompressed bytes, text read
    /// again, memory of meshes and images, subdivided faces, included files, and pairs of corners
    /// tested to cut polygons.
    #[arg(long, value_name = "FACTOR", default_value_t, value_parser = budget_factor)]
    pub(crate) input_budget: BudgetFactor,
}

fn budget_factor(text: &str) -> Result<BudgetFactor, String> {
    let factor = text.parse().ok().and_then(BudgetFactor::new);
    factor.ok_or_else(|| format!("expected an integer from 1 to {}", BudgetFactor::MAX))
}
