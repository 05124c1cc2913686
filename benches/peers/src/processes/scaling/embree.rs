//! Embree's trace by more and more threads, in this process.

use super::table::Row;
use crate::Result;
use crate::args::{Isa, ScalingOptions};
use crate::competitor::Competitor;
use crate::competitors::Device;
use crate::competitors::embree::{Embree, Quality, input};
use crate::picture::Picture;
use crate::rounds::alternate;
use crate::views::ViewName;
use rayon::ThreadPool;

/// Traces coherent packets through a tree of medium quality, which is built once.
pub(super) fn row(name: ViewName, threads: &[usize], options: &ScalingOptions) -> Result<Row> {
    let view = name.make()?;
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    let device = Device::new(processors, options.isa.map(Isa::name))?;
    let mut embree = Embree::new(&view, &device, &input(&view), Quality::Medium);
    embree.build();
    let pool = |&count: &usize| rayon::ThreadPoolBuilder::new().num_threads(count).build();
    let pools: std::result::Result<Vec<ThreadPool>, _> = threads.iter().map(pool).collect();
    let pools = pools?;
    let mut picture = Picture::new(view.width(), view.height());
    let series = alternate(pools.len(), options.warmup, options.runs, |row| {
        pools[row].install(|| embree.trace(0, &mut picture))
    });
    Ok(Row {
        name: "Embree medium, trace".to_owned(),
        times: series.iter().map(|series| series.median()).collect(),
    })
}
