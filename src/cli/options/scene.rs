//! Options for reading scenes.

use super::input::{InputArgs, MomentArgs};
use crate::scene::LoadOptions;
use crate::shape::AlphaCutoff;
use clap::Args;

#[derive(Debug, Args)]
pub(crate) struct SceneArgs {
    #[command(flatten)]
    moment: MomentArgs,
    /// Let rays pass where the alpha of a surface is up to this number, from 0 to below 1; 0 cuts
    /// away only what has no alpha at all, as in pbrt-v3.
    #[arg(long, value_name = "ALPHA", default_value_t, value_parser = alpha_cutoff)]
    #[arg(hide_short_help = true)]
    alpha_cutoff: AlphaCutoff,
    #[command(flatten)]
    pub(crate) limits: InputArgs,
}

impl SceneArgs {
    /// The options that they stand for.
    pub(crate) fn load_options(&self) -> LoadOptions {
        LoadOptions {
            time: self.moment.time,
            alpha_cutoff: self.alpha_cutoff,
            input_budget: self.limits.input_budget,
            ..LoadOptions::default()
        }
    }
}

fn alpha_cutoff(text: &str) -> Result<AlphaCutoff, String> {
    let cutoff = text.parse().ok().and_then(AlphaCutoff::new);
    cutoff.ok_or_else(|| "expected a number from 0 to below 1".to_owned())
}
