//! Scenes.

use super::camera::Camera;
use super::casting::Hits;
use super::error::exception;
use super::work::{run, run_here};
use feimos::film::Samples;
use feimos::progress::Progress;
use feimos::{Channel, Error, Image, LoadOptions, Precision, SplitMethod, Structure};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

/// So few rays are cast faster than another thread begins.
const FEW_RAYS: usize = 64;

/// The scene of `feimos.Scene`, with the trees that were built for it.
#[pyclass(frozen, module = "feimos._feimos")]
pub(super) struct Scene {
    scene: feimos::Scene,
    /// Locked only by threads that are attached to the interpreter, and never for long.
    structures: Mutex<Vec<(Option<SplitMethod>, Structure)>>,
}

impl Scene {
    fn new(scene: feimos::Scene) -> Scene {
        Scene {
            scene,
            structures: Mutex::default(),
        }
    }

    /// The tree by a method, built on the first call; without one, the tree that views share.
    fn structure(
        &self,
        py: Python<'_>,
        method: Option<SplitMethod>,
        threads: Option<usize>,
    ) -> PyResult<Structure> {
        let built = || {
            self.structures
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
        };
        let known = built().iter().find(|(known, _)| *known == method).cloned();
        if let Some((_, structure)) = known {
            return Ok(structure);
        }
        let scene = self.scene.clone();
        let build = move |progress: Progress<'_>| match method {
            Some(method) => scene.build_reporting(method, progress),
            None => scene.structure_reporting(progress),
        };
        let structure = run(py, threads, build)?;
        built().push((method, structure.clone()));
        Ok(structure)
    }
}

#[pymethods]
impl Scene {
    /// Load a scene or a mesh.
    #[staticmethod]
    #[pyo3(signature = (path, *, resolution, time, alpha_cutoff, input_budget, threads))]
    fn load(
        py: Python<'_>,
        path: PathBuf,
        resolution: Option<(u32, u32)>,
        time: Option<f64>,
        alpha_cutoff: Option<f64>,
        input_budget: Option<u32>,
        threads: Option<usize>,
    ) -> PyResult<Scene> {
        let mut options = LoadOptions::new();
        if let Some((width, height)) = resolution {
            options = options.resolution([width, height]);
        }
        if let Some(time) = time {
            options = options.time(time);
        }
        if let Some(alpha) = alpha_cutoff {
            options = options.alpha_cutoff(alpha);
        }
        if let Some(factor) = input_budget {
            options = options.input_budget(factor);
        }
        let load =
            move |progress: Progress<'_>| feimos::Scene::load_reporting(path, &options, progress);
        run(py, threads, load).map(Scene::new)
    }

    /// A scene of triangles.
    #[staticmethod]
    #[pyo3(signature = (points, triangles, *, threads))]
    fn mesh(
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f32>,
        triangles: PyReadonlyArray2<'_, u32>,
        threads: Option<usize>,
    ) -> PyResult<Scene> {
        // The caller may change the arrays while the work goes on.
        let points = points.as_slice()?.as_chunks::<3>().0.to_vec();
        let triangles = triangles.as_slice()?.as_chunks::<3>().0.to_vec();
        let make = move |_: Progress<'_>| feimos::Scene::from_triangles(&points, &triangles);
        run(py, threads, make).map(Scene::new)
    }

    /// The scene's own camera.
    #[getter]
    fn camera(&self) -> Camera {
        Camera(self.scene.camera())
    }

    /// The cameras of a list.
    fn cameras(&self, py: Python<'_>, path: PathBuf) -> PyResult<Vec<Camera>> {
        let scene = self.scene.clone();
        let cameras = run(py, None, move |_| scene.cameras(path))?;
        Ok(cameras.into_iter().map(Camera).collect())
    }

    /// The lowest and the highest corner of the box around all primitives.
    #[getter]
    fn bounds(&self, py: Python<'_>) -> PyResult<Option<[[f64; 3]; 2]>> {
        let scene = self.scene.clone();
        run(py, None, move |_| Ok(scene.bounds()))
    }

    /// The number of primitives.
    #[getter]
    fn primitive_count(&self) -> u64 {
        self.scene.primitive_count()
    }

    /// The warnings about the scene.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.scene.warnings()
    }

    /// Render channels as arrays by their names.
    #[pyo3(signature = (camera, channels, *, accel, precision, threads))]
    fn render<'py>(
        &self,
        py: Python<'py>,
        camera: &Camera,
        channels: Vec<String>,
        accel: Option<String>,
        precision: String,
        threads: Option<usize>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let raised = |error: Error| exception(py, &error);
        let channels = channels.iter().map(|name| name.parse::<Channel>());
        let channels = channels
            .collect::<Result<Vec<Channel>, _>>()
            .map_err(raised)?;
        let precision = precision.parse::<Precision>().map_err(raised)?;
        let camera = camera.0.clone();
        let image = match accel {
            None => {
                let scene = self.scene.with_precision(precision);
                let render = move |progress: Progress<'_>| {
                    scene.render_reporting(&camera, &channels, progress)
                };
                run(py, threads, render)?
            }
            Some(name) => {
                let method = name.parse().map_err(raised)?;
                let structure = self.structure(py, Some(method), threads)?;
                let structure = structure.with_precision(precision);
                let render = move |progress: Progress<'_>| {
                    structure.render_reporting(&camera, &channels, progress)
                };
                run(py, threads, render)?
            }
        };
        arrays_of(py, image)
    }

    /// Cast rays, and return their hits as arrays by their names.
    #[pyo3(signature = (origins, directions, *, threads))]
    fn cast<'py>(
        &self,
        py: Python<'py>,
        origins: PyReadonlyArray2<'py, f64>,
        directions: PyReadonlyArray2<'py, f64>,
        threads: Option<usize>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let structure = self.structure(py, None, threads)?;
        let count = origins.shape()[0];
        // The caller may change the arrays while the work goes on.
        let origins = origins.as_slice()?.to_vec();
        let directions = directions.as_slice()?.to_vec();
        let hits = if count <= FEW_RAYS {
            run_here(py, move || {
                Hits::cast_here(&structure, &origins, &directions)
            })?
        } else {
            run(py, threads, move |progress| {
                Hits::cast(&structure, &origins, &directions, progress)
            })?
        };
        hits.into_arrays(py)
    }
}

/// The channels of an image as arrays by their names, which take its memory.
fn arrays_of(py: Python<'_>, image: Image) -> PyResult<Bound<'_, PyDict>> {
    let [width, height] = image.size().map(|side| side as usize);
    let arrays = PyDict::new(py);
    for (channel, samples) in image.into_channels() {
        let name = channel.name();
        match (samples, channel.components()) {
            (Samples::U32(values), _) => {
                let array = PyArray1::from_vec(py, values).reshape([height, width])?;
                arrays.set_item(name, array)?;
            }
            (Samples::F32(values), 1) => {
                let array = PyArray1::from_vec(py, values).reshape([height, width])?;
                arrays.set_item(name, array)?;
            }
            (Samples::F32(values), count) => {
                let array = PyArray1::from_vec(py, values).reshape([height, width, count])?;
                arrays.set_item(name, array)?;
            }
        }
    }
    Ok(arrays)
}
