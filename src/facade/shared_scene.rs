//! A loaded scene, and the tree that its views share.

use crate::accel::{Aggregate, BuildOptions, SplitMethod};
use crate::error::Error;
use crate::geometry::Point;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::structure_choice::{build_options, method_of_scene, shared_anchor};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

/// Everything that the handles of a scene share.
pub(super) struct SharedScene {
    pub(super) scene: Scene,
    /// The number of views that have been rendered or begun.
    views: AtomicUsize,
    /// The tree of all views.
    tree: OnceLock<Arc<Aggregate>>,
    /// Whether a thread builds this tree.
    is_building: AtomicBool,
}

/// The tree of all views, or what to do without it.
pub(super) enum SharedTree<'a> {
    Ready(&'a Arc<Aggregate>),
    /// Another thread builds it.
    InWork,
}

/// Marks the tree as being built.
struct Building<'a>(&'a AtomicBool);

impl Drop for Building<'_> {
    fn drop(&mut self) {
        self.0.store(false, Ordering::Release);
    }
}

impl SharedScene {
    pub(super) fn new(scene: Scene) -> SharedScene {
        SharedScene {
            scene,
            views: AtomicUsize::new(0),
            tree: OnceLock::new(),
            is_building: AtomicBool::new(false),
        }
    }

    /// Counts one more view, and returns the number of views with this one.
    pub(super) fn count_view(&self) -> usize {
        self.views.fetch_add(1, Ordering::Relaxed).saturating_add(1)
    }

    /// The tree that all views share; builds it if there is none.
    ///
    /// No thread waits for another one here: a thread of a rayon pool might wait for its own work.
    ///
    /// # Errors
    /// There is no memory for it.
    pub(super) fn shared_tree(&self, progress: Progress) -> Result<SharedTree<'_>, Error> {
        if let Some(tree) = self.tree.get() {
            return Ok(SharedTree::Ready(tree));
        }
        if self.is_building.swap(true, Ordering::Acquire) {
            return Ok(SharedTree::InWork);
        }
        let building = Building(&self.is_building);
        // The thread that was building a moment ago may have finished.
        if self.tree.get().is_none() {
            let tree = self.build(self.own_method(), shared_anchor(&self.scene), progress)?;
            // Only the thread that builds sets the tree.
            _ = self.tree.set(Arc::new(tree));
        }
        drop(building);
        Ok(self
            .tree
            .get()
            .map_or(SharedTree::InWork, SharedTree::Ready))
    }

    /// Builds a tree over the whole scene.
    ///
    /// # Errors
    /// There is no memory for it.
    pub(super) fn build(
        &self,
        method: SplitMethod,
        anchor: Point,
        progress: Progress,
    ) -> Result<Aggregate, Error> {
        let geometry = &self.scene.geometry;
        Aggregate::check_memory(geometry)?;
        let options = self.options(method);
        Ok(Aggregate::build(geometry, anchor, options, progress))
    }

    /// The options of trees by `method`.
    pub(super) fn options(&self, method: SplitMethod) -> BuildOptions {
        build_options(method, &self.scene.accelerator)
    }

    /// The split method that the scene asks for.
    pub(super) fn own_method(&self) -> SplitMethod {
        method_of_scene(&self.scene.accelerator).unwrap_or(SplitMethod::Sah)
    }
}
