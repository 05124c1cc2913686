//! Cameras.

use super::error::exception;
use super::work::run;
use numpy::{PyArray1, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use rayon::prelude::*;

/// The camera of `feimos.Camera`.
#[pyclass(frozen, module = "feimos._feimos")]
pub(super) struct Camera(pub(super) feimos::Camera);

/// Origins and directions.
type Rays<'py> = (Bound<'py, PyArray3<f64>>, Bound<'py, PyArray3<f64>>);

#[pymethods]
impl Camera {
    #[new]
    fn new(
        py: Python<'_>,
        k: [[f64; 3]; 3],
        r: [[f64; 3]; 3],
        t: [f64; 3],
        size: (u32, u32),
    ) -> PyResult<Camera> {
        let camera = feimos::Camera::new(k, r, t, [size.0, size.1]);
        camera.map(Camera).map_err(|error| exception(py, &error))
    }

    /// Width and height in pixels.
    #[getter]
    fn size(&self) -> (u32, u32) {
        self.0.size().into()
    }

    /// The name in a list of cameras.
    #[getter]
    fn name(&self) -> Option<&str> {
        self.0.name()
    }

    /// Origins and directions of the rays of all pixels, (h, w, 3).
    fn rays<'py>(&self, py: Python<'py>) -> PyResult<Rays<'py>> {
        let [width, height] = self.0.size().map(|side| side as usize);
        let camera = self.0.clone();
        let (origins, directions) = run(py, None, move |progress| {
            let mut origins = vec![0.0; width * height * 3];
            let mut directions = vec![0.0; width * height * 3];
            let rows = origins.par_chunks_exact_mut(width * 3);
            let rows = rows.zip(directions.par_chunks_exact_mut(width * 3));
            rows.enumerate().for_each(|(y, (origins, directions))| {
                for x in 0..width {
                    let ray = camera.ray(x as u32, y as u32);
                    origins[3 * x..][..3].copy_from_slice(&ray.origin);
                    directions[3 * x..][..3].copy_from_slice(&ray.direction);
                }
                progress.advance(width);
            });
            Ok((origins, directions))
        })?;
        let array = |values| PyArray1::from_vec(py, values).reshape([height, width, 3]);
        Ok((array(origins)?, array(directions)?))
    }
}
