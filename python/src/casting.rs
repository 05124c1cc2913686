//! Rays of the user, and their hits as arrays.

use feimos::progress::Progress;
use feimos::{Error, Hit, Ray, Structure};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The rays whose hits are found at a time: enough for all threads, and little memory.
const BLOCK: usize = 1 << 16;

/// The hits of rays, a list for each number. Misses are 0, and infinity for `t` and `distance`.
#[derive(Default)]
pub(super) struct Hits {
    t: Vec<f32>,
    distance: Vec<f32>,
    prim: Vec<u32>,
    id: Vec<u32>,
    instance: Vec<u32>,
    normal: Vec<f32>,
    point: Vec<f32>,
    uv: Vec<f32>,
}

impl Hits {
    /// No hits, with room for those of `count` rays.
    fn with_capacity(count: usize) -> Hits {
        Hits {
            t: Vec::with_capacity(count),
            distance: Vec::with_capacity(count),
            prim: Vec::with_capacity(count),
            id: Vec::with_capacity(count),
            instance: Vec::with_capacity(count),
            normal: Vec::with_capacity(3 * count),
            point: Vec::with_capacity(3 * count),
            uv: Vec::with_capacity(2 * count),
        }
    }

    /// Casts rays on the threads of the current pool. `origins` and `directions` have three numbers
    /// for each ray.
    pub(super) fn cast(
        structure: &Structure,
        origins: &[f64],
        directions: &[f64],
        progress: Progress,
    ) -> Result<Hits, Error> {
        let mut hits = Hits::with_capacity(origins.len() / 3);
        let blocks = origins.chunks(3 * BLOCK).zip(directions.chunks(3 * BLOCK));
        for (origins, directions) in blocks {
            let rays: Vec<Ray> = rays(origins, directions).collect();
            for hit in structure.cast_all_reporting(&rays, progress)? {
                hits.push(hit);
            }
        }
        Ok(hits)
    }

    /// Casts rays on the current thread.
    pub(super) fn cast_here(structure: &Structure, origins: &[f64], directions: &[f64]) -> Hits {
        let mut hits = Hits::with_capacity(origins.len() / 3);
        rays(origins, directions).for_each(|ray| hits.push(structure.cast(&ray)));
        hits
    }

    fn push(&mut self, hit: Option<Hit>) {
        let missed = f32::INFINITY;
        let depths = hit.map_or([missed; 2], |hit| [hit.t, hit.distance]);
        self.t.push(depths[0]);
        self.distance.push(depths[1]);
        self.prim.push(hit.map_or(0, |hit| hit.prim));
        self.id.push(hit.map_or(0, |hit| hit.id));
        self.instance.push(hit.map_or(0, |hit| hit.instance));
        self.normal.extend(hit.map_or([0.0; 3], |hit| hit.normal));
        self.point.extend(hit.map_or([0.0; 3], |hit| hit.point));
        self.uv.extend(hit.map_or([0.0; 2], |hit| hit.uv));
    }

    /// Arrays by their names, which take the memory of the lists.
    pub(super) fn into_arrays(self, py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        let arrays = PyDict::new(py);
        let count = self.t.len();
        arrays.set_item("t", PyArray1::from_vec(py, self.t))?;
        arrays.set_item("distance", PyArray1::from_vec(py, self.distance))?;
        arrays.set_item("prim", PyArray1::from_vec(py, self.prim))?;
        arrays.set_item("id", PyArray1::from_vec(py, self.id))?;
        arrays.set_item("instance", PyArray1::from_vec(py, self.instance))?;
        let components = [
            ("N", self.normal, 3),
            ("P", self.point, 3),
            ("uv", self.uv, 2),
        ];
        for (name, values, width) in components {
            arrays.set_item(
                name,
                PyArray1::from_vec(py, values).reshape([count, width])?,
            )?;
        }
        Ok(arrays)
    }
}

fn rays(origins: &[f64], directions: &[f64]) -> impl Iterator<Item = Ray> {
    let origins = origins.as_chunks::<3>().0;
    let directions = directions.as_chunks::<3>().0;
    let pairs = origins.iter().zip(directions);
    pairs.map(|(origin, direction)| Ray::new(*origin, *direction))
}
