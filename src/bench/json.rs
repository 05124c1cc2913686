//! Rows for programs.

use super::{Errors, Machine, Row, Spread};
use serde::Serialize;

/// The document: the machine, and a row for each configuration of each scene.
#[derive(Serialize)]
struct Document<'a> {
    machine: &'a Machine,
    rows: Vec<JsonRow<'a>>,
}

/// A row as the document has it. An error that was not measured is null.
#[derive(Serialize)]
struct JsonRow<'a> {
    scene: &'a str,
    accel: &'static str,
    precision: &'static str,
    threads: usize,
    rays: u64,
    build_ms: Spread,
    trace_ms: Spread,
    mrays_per_s: f64,
    nodes_per_ray: f64,
    primitives_per_ray: f64,
    sah_cost: f64,
    depth: usize,
    bytes: usize,
    sampled_pixels: Option<u64>,
    wrong_hits: Option<u64>,
    wrong_primitives: Option<u64>,
    max_ulp: Option<f64>,
    p99_ulp: Option<f64>,
    mean_ulp: Option<f64>,
    fallback_rays: Option<u64>,
}

impl<'a> JsonRow<'a> {
    fn new(row: &'a Row) -> JsonRow<'a> {
        let error = |of: fn(&Errors) -> f64| row.errors.as_ref().map(of);
        let count = |of: fn(&Errors) -> u64| row.errors.as_ref().map(of);
        JsonRow {
            scene: &row.scene,
            accel: row.method.name(),
            precision: row.precision.name(),
            threads: row.threads,
            rays: row.rays,
            build_ms: row.build_ms,
            trace_ms: row.trace_ms,
            mrays_per_s: row.mrays_per_s(),
            nodes_per_ray: row.nodes_per_ray(),
            primitives_per_ray: row.primitives_per_ray(),
            sah_cost: row.sah_cost,
            depth: row.depth,
            bytes: row.bytes,
            sampled_pixels: count(|errors| errors.sampled_pixels),
            wrong_hits: count(|errors| errors.wrong_hits),
            wrong_primitives: count(|errors| errors.wrong_primitives),
            max_ulp: error(|errors| errors.max_ulp),
            p99_ulp: error(|errors| errors.p99_ulp),
            mean_ulp: error(|errors| errors.mean_ulp),
            fallback_rays: row.fallback_rays,
        }
    }
}

/// All of it as one JSON document that ends with a line break. Numbers that are not finite are null.
pub fn to_json(machine: &Machine, rows: &[Row]) -> Vec<u8> {
    let document = Document { machine, rows: rows.iter().map(JsonRow::new).collect() };
    let mut json = serde_json::to_vec_pretty(&document).expect("no key that JSON lacks");
    json.push(b'\n');
    json
}
