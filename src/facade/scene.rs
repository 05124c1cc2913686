//! A scene, as a user has it.

use super::camera::Camera;
use super::image::Image;
use super::load_options::LoadOptions;
use super::shared_scene::{SharedScene, SharedTree};
use super::structure::Structure;
use crate::accel::{self, Aggregate, Bins, Precision, SplitMethod};
use crate::error::Error;
use crate::film::Aov as Channel;
use crate::geometry::Point;
use crate::progress::Progress;
use crate::scene::{self, Pose, read_poses};
use crate::simd::Level;
use crate::structure_choice::{may_share_tree, shared_anchor, takes_bins};
use std::fmt;
use std::path::Path;
use std::sync::Arc;

/// A scene: its geometry and its camera.
///
/// It is a handle: a clone is cheap and shares everything. Threads may use it at the same time.
/// Work runs on the threads of the current rayon pool, by default all that the process may use.
#[derive(Clone)]
pub struct Scene {
    shared: Arc<SharedScene>,
    precision: Precision,
}

impl Scene {
    /// Loads a PBRT scene with all files that it names, or a mesh: `.ply`, `.obj`, `.stl` or
    /// `.off`, also with `.gz`.
    ///
    /// # Errors
    /// A file that is missing or wrong. The text names the file and the line.
    pub fn load(path: impl AsRef<Path>) -> Result<Scene, Error> {
        Scene::load_with(path, &LoadOptions::default())
    }

    /// Like [`Scene::load`], with options.
    ///
    /// # Errors
    /// See [`Scene::load`]; also an option out of its range.
    pub fn load_with(path: impl AsRef<Path>, options: &LoadOptions) -> Result<Scene, Error> {
        Scene::load_reporting(path, options, Progress::SILENT)
    }

    /// Like [`Scene::load_with`]; `progress` counts bytes of scene files, and may cancel.
    #[doc(hidden)]
    pub fn load_reporting(
        path: impl AsRef<Path>,
        options: &LoadOptions,
        progress: Progress,
    ) -> Result<Scene, Error> {
        let options = options.checked()?;
        let load = || scene::load(path.as_ref(), &options, progress);
        Progress::cancellable(load).map(Scene::new)
    }

    /// The scene of one mesh. A triangle is three indices of `points`.
    ///
    /// Triangles keep their order: [`Hit::prim`](crate::Hit::prim) of the first is 1. Those with a
    /// point that is not finite, or without an area, are never hit, as in mesh files.
    ///
    /// # Errors
    /// An index without a point, or more triangles than fit: [`ErrorKind::Usage`].
    ///
    /// [`ErrorKind::Usage`]: crate::ErrorKind::Usage
    pub fn from_triangles(points: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<Scene, Error> {
        scene::scene_of_triangles(points, triangles).map(Scene::new)
    }

    fn new(scene: scene::Scene) -> Scene {
        Scene {
            shared: Arc::new(SharedScene::new(scene)),
            precision: Precision::Exact,
        }
    }

    /// The same scene, whose hits are decided with another precision. The default is
    /// [`Precision::Exact`].
    pub fn with_precision(&self, precision: Precision) -> Scene {
        Scene {
            shared: Arc::clone(&self.shared),
            precision,
        }
    }

    /// The camera of the file. For a mesh, one that shows all of it.
    pub fn camera(&self) -> Camera {
        let scene = &self.shared.scene;
        Camera::of_film(None, scene.camera.clone(), &scene.film)
    }

    /// The cameras of a list: feimos's own JSON, a `transforms.json` of NeRF programs, or the text
    /// model of COLMAP.
    ///
    /// # Errors
    /// A file that is missing or not such a list, or a camera without a meaning.
    pub fn cameras(&self, path: impl AsRef<Path>) -> Result<Vec<Camera>, Error> {
        let camera = |pose: &Pose| {
            let (camera, film) = pose.place(&self.shared.scene);
            Camera::of_film(Some(pose.name()), camera, &film)
        };
        Ok(read_poses(path.as_ref())?.iter().map(camera).collect())
    }

    /// Where the picture may differ from what the file means: one text for each kind of warning.
    pub fn warnings(&self) -> Vec<String> {
        let warnings = self.shared.scene.warnings.iter();
        warnings.map(|warning| warning.first.to_string()).collect()
    }

    /// The lowest and the highest corner of the box around everything that can be hit, in world
    /// space. `None` if nothing can.
    pub fn bounds(&self) -> Option<[[f64; 3]; 2]> {
        let extent = self.shared.scene.geometry.extent();
        let corners = [extent.low, extent.high].map(Point::to_array);
        (!extent.is_empty()).then_some(corners)
    }

    /// The number of primitives: triangles, quadrics and segments of curves. Those of an object
    /// count once for each instance.
    pub fn primitive_count(&self) -> u64 {
        self.shared.scene.geometry.primitive_count()
    }

    /// Renders an image of `channels` the fastest way: the first 15 views of a scene through bins
    /// of the view, and further ones through a tree that is built once.
    ///
    /// ```
    /// use feimos::{Channel, Scene};
    ///
    /// let scene = Scene::load("scenes/sphere.pbrt")?;
    /// let image = scene.render(&scene.camera(), &[Channel::Z, Channel::Prim])?;
    /// let hits = image.numbers(Channel::Prim).unwrap();
    /// assert!(hits.contains(&1));
    /// # Ok::<(), feimos::Error>(())
    /// ```
    ///
    /// # Errors
    /// No channel, or too little memory.
    pub fn render(&self, camera: &Camera, channels: &[Channel]) -> Result<Image, Error> {
        self.render_reporting(camera, channels, Progress::SILENT)
    }

    /// Like [`Scene::render`]; `progress` counts items of the structure, then pixels, and may
    /// cancel.
    #[doc(hidden)]
    pub fn render_reporting(
        &self,
        camera: &Camera,
        channels: &[Channel],
        progress: Progress,
    ) -> Result<Image, Error> {
        Progress::cancellable(|| self.render_fastest(camera, channels, progress))
    }

    fn render_fastest(
        &self,
        camera: &Camera,
        channels: &[Channel],
        progress: Progress,
    ) -> Result<Image, Error> {
        let has_costs = channels.contains(&Channel::Cost);
        let views = self.shared.count_view();
        let trace = |structure: accel::Structure| {
            let geometry = &self.shared.scene.geometry;
            Image::render(
                camera,
                geometry,
                structure,
                channels,
                self.precision,
                progress,
            )
        };
        let is_linear = camera.camera.projection.is_linear();
        let takes_bins = is_linear && takes_bins(views, self.precision, has_costs);
        if takes_bins && let Some(bins) = self.bins(camera, progress)? {
            return trace((&bins).into());
        }
        if may_share_tree(self.precision, has_costs) {
            match self.shared.shared_tree(progress)? {
                SharedTree::Ready(tree) => return trace((&**tree).into()),
                SharedTree::InWork => {
                    if !takes_bins && let Some(bins) = self.bins(camera, progress)? {
                        return trace((&bins).into());
                    }
                }
            }
        }
        let anchor = camera.camera.anchor();
        let tree = self
            .shared
            .build(self.shared.own_method(), anchor, progress)?;
        trace((&tree).into())
    }

    /// The bins of a view; `None` if it cannot be rasterized.
    fn bins(&self, camera: &Camera, progress: Progress) -> Result<Option<Bins>, Error> {
        let geometry = &self.shared.scene.geometry;
        Bins::check_memory(geometry)?;
        let options = self.shared.options(self.shared.own_method());
        let (camera, window, level) = (&camera.camera, &camera.window, Level::detect());
        Ok(Bins::new(
            geometry, camera, window, options, level, progress,
        ))
    }

    /// Builds a tree, to cast rays or to render any number of images through it.
    ///
    /// # Errors
    /// Too little memory.
    pub fn build(&self, method: SplitMethod) -> Result<Structure, Error> {
        self.build_reporting(method, Progress::SILENT)
    }

    /// Like [`Scene::build`]; `progress` counts primitives and instances, and may cancel.
    #[doc(hidden)]
    pub fn build_reporting(
        &self,
        method: SplitMethod,
        progress: Progress,
    ) -> Result<Structure, Error> {
        let build = || {
            let anchor = shared_anchor(&self.shared.scene);
            self.shared.build(method, anchor, progress)
        };
        let tree = Progress::cancellable(build)?;
        Ok(self.structure_of(Arc::new(tree)))
    }

    /// The tree that all views share, as a structure; builds it if there is none. While another
    /// thread builds it, one of its own.
    #[doc(hidden)]
    pub fn structure_reporting(&self, progress: Progress) -> Result<Structure, Error> {
        let shared = || self.shared.shared_tree(progress);
        match Progress::cancellable(shared)? {
            SharedTree::Ready(tree) => Ok(self.structure_of(Arc::clone(tree))),
            SharedTree::InWork => self.build_reporting(self.shared.own_method(), progress),
        }
    }

    fn structure_of(&self, tree: Arc<Aggregate>) -> Structure {
        Structure::new(Arc::clone(&self.shared), tree, self.precision)
    }
}

impl fmt::Debug for Scene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Scene")
            .field("primitive_count", &self.primitive_count())
            .field("precision", &self.precision)
            .finish_non_exhaustive()
    }
}
