//! Rows for programs.

use super::{Errors, InputError, Machine, Row, Spread};
use crate::json;
use serde::Serialize;

/// The document: the machine, and a row for each configuration of each scene.
#[derive(Serialize)]
struct Document<'a> {
    machine: &'a Machine,
    rows: Vec<Record<'a>>,
}

/// A row as files have it. What was not measured is null.
#[derive(Debug, Serialize)]
pub(super) struct Record<'a> {
    pub(super) scene: &'a str,
    pub(super) accel: &'static str,
    pub(super) precision: &'static str,
    pub(super) threads: usize,
    pub(super) rays: u64,
    pub(super) pixels: u64,
    pub(super) load_ms: Spread,
    pub(super) build_ms: Spread,
    pub(super) trace_ms: Spread,
    pub(super) mrays_per_s: f64,
    pub(super) cycles_per_ray: Option<f64>,
    pub(super) nodes_per_ray: f64,
    pub(super) primitives_per_ray: f64,
    pub(super) sah_cost: f64,
    pub(super) epo: Option<f64>,
    pub(super) depth: usize,
    pub(super) bytes: usize,
    pub(super) input: Option<InputError>,
    pub(super) sampled_pixels: Option<u64>,
    pub(super) wrong_hits: Option<u64>,
    pub(super) false_hits: Option<u64>,
    pub(super) missed_hits: Option<u64>,
    pub(super) wrong_primitives: Option<u64>,
    /// Shares of all pixels, where only some were looked at.
    pub(super) confidence_95: Option<Confidence>,
    pub(super) max_ulp: Option<u32>,
    pub(super) p99_ulp: Option<u32>,
    pub(super) mean_ulp: Option<f64>,
    pub(super) fallback_rays: Option<u64>,
}

/// Between which shares of all pixels those lie that are wrong, with a confidence of 95 %.
#[derive(Debug, Serialize)]
pub(super) struct Confidence {
    pub(super) wrong_hits: [f64; 2],
    pub(super) wrong_primitives: [f64; 2],
}

impl<'a> Record<'a> {
    pub(super) fn new(row: &'a Row, machine: &Machine) -> Record<'a> {
        let tally = row.errors.as_ref().map(|errors| &errors.tally);
        Record {
            scene: &row.scene,
            accel: row.method.name(),
            precision: row.kernel.name(),
            threads: row.threads,
            rays: row.rays,
            pixels: row.pixels,
            load_ms: row.load_ms,
            build_ms: row.build_ms,
            trace_ms: row.trace_ms,
            mrays_per_s: row.mrays_per_s(),
            cycles_per_ray: machine.mhz.map(|mhz| row.cycles_per_ray(mhz)),
            nodes_per_ray: row.nodes_per_ray,
            primitives_per_ray: row.primitives_per_ray,
            sah_cost: row.sah_cost,
            epo: row.overlap,
            depth: row.depth,
            bytes: row.bytes,
            input: row.input,
            sampled_pixels: tally.map(|tally| tally.pixels),
            wrong_hits: tally.map(|tally| tally.wrong_hits()),
            false_hits: tally.map(|tally| tally.false_hits),
            missed_hits: tally.map(|tally| tally.missed_hits),
            wrong_primitives: tally.map(|tally| tally.wrong_primitives),
            confidence_95: row.errors.as_ref().and_then(confidence),
            max_ulp: tally.and_then(|tally| tally.depths.max()),
            p99_ulp: tally.and_then(|tally| tally.depths.percentile(99.0)),
            mean_ulp: tally.and_then(|tally| tally.depths.mean()),
            fallback_rays: row.fallback_rays,
        }
    }
}

fn confidence(errors: &Errors) -> Option<Confidence> {
    Some(Confidence {
        wrong_hits: errors.confidence(errors.tally.wrong_hits())?,
        wrong_primitives: errors.confidence(errors.tally.wrong_primitives)?,
    })
}

/// All of it as one JSON document that ends with a line break. Numbers that are not finite are null.
pub fn to_json(machine: &Machine, rows: &[Row]) -> Vec<u8> {
    let document = Document {
        machine,
        rows: rows.iter().map(|row| Record::new(row, machine)).collect(),
    };
    json::pretty(&document)
}
