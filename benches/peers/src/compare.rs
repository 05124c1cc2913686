//! Views, competitors, rounds; tables.

use crate::Result;
use crate::args::{CompareOptions, Isa};
use crate::competitor::Competitor;
use crate::competitors::{self, Device};
use crate::differences::Differences;
use crate::picture::Picture;
use crate::rounds::{Series, alternate};
use crate::table::{self, BuildRow, TraceRow};
use crate::view::View;
use feimos::simd::Level;
use std::time::{Duration, Instant};

/// Prints two tables for each view and number of threads.
pub(crate) fn run(options: &CompareOptions) -> Result<()> {
    for name in &options.views {
        let view = name.make()?;
        for &threads in &options.threads {
            let device = Device::new(threads, options.isa.map(Isa::name))?;
            println!(
                "### {}, {}\n",
                name.title(),
                heading(&view, threads, &device, options)
            );
            // Clocks run on a thread of the pool, so that handing work to it is not part of what is measured.
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()?;
            pool.install(|| compare(&view, &device, options))?;
        }
    }
    Ok(())
}

fn heading(view: &View, threads: usize, device: &Device, options: &CompareOptions) -> String {
    let threads = if threads == 1 {
        "one thread".to_owned()
    } else {
        format!("{threads} threads")
    };
    let (width, height) = (view.width(), view.height());
    let primitives = table::grouped(view.geometry.len() as u64);
    let kind = view.geometry.kind();
    let embree = match options.isa {
        Some(isa) => isa.name(),
        None if device.has_16_lanes() => "avx512",
        None => "what there is",
    };
    let (runs, simd) = (options.runs, level(options).name());
    format!(
        "{threads}: {width} x {height} pixels, {primitives} {kind}, {runs} rounds, feimos with {simd}, Embree with {embree}"
    )
}

fn level(options: &CompareOptions) -> Level {
    options.simd.unwrap_or_else(Level::detect)
}

fn compare(view: &View, device: &Device, options: &CompareOptions) -> Result<()> {
    let mut competitors = competitors::all(view, level(options), device);
    // The first is feimos, whose exact picture is what pictures are compared with.
    let exact = competitors[0].name();
    competitors
        .retain(|competitor| competitor.name() == exact || is_wanted(competitor.as_ref(), options));
    let builds = build(&mut competitors, options);
    let baseline = competitors
        .iter()
        .position(|competitor| options.baseline.starts_with(&competitor.name()));
    let baseline =
        baseline.ok_or_else(|| format!("no competitor for the baseline `{}`", options.baseline))?;
    let rows = competitors.iter().zip(&builds);
    let rows = rows.map(|(competitor, series)| BuildRow {
        name: competitor.name(),
        series,
    });
    print!(
        "{}",
        table::of_builds(&rows.collect::<Vec<_>>(), &builds[baseline])
    );
    println!();
    trace(&competitors, view, options)
}

fn is_wanted(competitor: &dyn Competitor, options: &CompareOptions) -> bool {
    let name = competitor.name();
    let is_named = options.only.iter().any(|part| name.contains(part.as_str()));
    options.only.is_empty() || is_named || options.baseline.starts_with(&name)
}

/// Leaves every competitor built.
fn build(competitors: &mut [Box<dyn Competitor + '_>], options: &CompareOptions) -> Vec<Series> {
    let runs = options.build_runs.unwrap_or(options.runs);
    alternate(competitors.len(), options.warmup, runs, |row| {
        competitors[row].discard();
        let start = Instant::now();
        competitors[row].build();
        start.elapsed()
    })
}

/// A competitor and one of its modes.
struct Contender<'a> {
    competitor: &'a dyn Competitor,
    mode: usize,
}

impl Contender<'_> {
    fn name(&self) -> String {
        format!(
            "{}, {}",
            self.competitor.name(),
            self.competitor.modes()[self.mode]
        )
    }
}

fn trace(
    competitors: &[Box<dyn Competitor + '_>],
    view: &View,
    options: &CompareOptions,
) -> Result<()> {
    let contenders: Vec<Contender> = competitors
        .iter()
        .flat_map(|competitor| {
            let competitor = competitor.as_ref();
            (0..competitor.modes().len()).map(move |mode| Contender { competitor, mode })
        })
        .collect();
    let baseline = contenders
        .iter()
        .position(|contender| contender.name() == options.baseline);
    let baseline =
        baseline.ok_or_else(|| format!("no row for the baseline `{}`", options.baseline))?;

    let mut picture = Picture::new(view.width(), view.height());
    let mut seen: Vec<Option<(u64, Differences)>> = vec![None; contenders.len()];
    let mut first: Option<Picture> = None;
    let series = alternate(contenders.len(), options.warmup, options.runs, |row| {
        let Contender { competitor, mode } = contenders[row];
        let mut elapsed = Duration::ZERO;
        if options.fresh && !competitor.makes_its_own_picture() {
            picture = Picture::new(0, 0);
            let start = Instant::now();
            picture = Picture::new(view.width(), view.height());
            elapsed = start.elapsed();
        }
        elapsed += competitor.trace(mode, &mut picture);
        if seen[row].is_none() {
            let first = first.get_or_insert_with(|| picture.clone());
            seen[row] = Some((picture.hits(), Differences::between(first, &picture)));
        }
        elapsed
    });
    let rows = contenders
        .iter()
        .zip(&series)
        .zip(&seen)
        .map(|((contender, series), seen)| {
            let (hits, differences) = seen.expect("every row has run");
            TraceRow {
                name: contender.name(),
                series,
                hits,
                differences,
            }
        });
    println!(
        "{}",
        table::of_traces(&rows.collect::<Vec<_>>(), &series[baseline])
    );
    Ok(())
}
