//! The structure that an image is traced through: bins of its view, or a tree.

use crate::accel::{Accelerator, Aggregate, Bins, SplitMethod, Statistics, Structure};
use crate::cli::terminal::words::counted;
use crate::error::grouped;
use crate::shape::Geometry;

/// A tree and its statistics, which take a traversal to collect.
pub(super) struct BuiltTree {
    method: SplitMethod,
    aggregate: Aggregate,
    statistics: Statistics,
}

impl BuiltTree {
    pub(super) fn new(method: SplitMethod, aggregate: Aggregate, geometry: &Geometry) -> BuiltTree {
        let statistics = aggregate.statistics(geometry);
        BuiltTree {
            method,
            aggregate,
            statistics,
        }
    }

    pub(super) fn method(&self) -> SplitMethod {
        self.method
    }

    pub(super) fn aggregate(&self) -> &Aggregate {
        &self.aggregate
    }

    pub(super) fn statistics(&self) -> Statistics {
        self.statistics
    }
}

/// The structure of one view, or a tree that all share.
pub(super) enum Built<'a> {
    Bins(Box<Bins>),
    Tree(Box<BuiltTree>),
    Shared(&'a BuiltTree),
}

/// The size of a structure.
#[derive(Debug, Clone, Copy)]
pub(super) enum BuiltSize {
    Bins {
        /// Primitives in no instance that a ray may meet.
        primitives: usize,
        bytes: usize,
    },
    Tree(Statistics),
}

impl Built<'_> {
    /// The tree, unless the structure is bins.
    pub(super) fn tree(&self) -> Option<&BuiltTree> {
        match self {
            Built::Bins(_) => None,
            Built::Tree(tree) => Some(tree),
            Built::Shared(tree) => Some(tree),
        }
    }

    pub(super) fn structure(&self) -> Structure<'_> {
        match self {
            Built::Bins(bins) => Structure::Bins(bins),
            Built::Tree(tree) => Structure::Tree(&tree.aggregate),
            Built::Shared(tree) => Structure::Tree(&tree.aggregate),
        }
    }

    pub(super) fn accelerator(&self) -> Accelerator {
        let method = self.tree().map(|tree| tree.method);
        method.map_or(Accelerator::Raster, Accelerator::Tree)
    }

    pub(super) fn size(&self) -> BuiltSize {
        match self {
            Built::Bins(bins) => BuiltSize::Bins {
                primitives: bins.seen(),
                bytes: bins.bytes(),
            },
            Built::Tree(tree) => BuiltSize::Tree(tree.statistics),
            Built::Shared(tree) => BuiltSize::Tree(tree.statistics),
        }
    }

    /// Its size in words.
    pub(super) fn summary(&self, geometry: &Geometry) -> String {
        let all = counted(geometry.primitive_count(), "primitive");
        let tree = match self {
            Built::Bins(bins) => {
                let seen = grouped(bins.seen() as u64);
                return format!("sorted {seen} of {all} into bins");
            }
            Built::Tree(tree) => tree,
            Built::Shared(tree) => *tree,
        };
        let nodes = counted(tree.statistics.nodes as u64, "node");
        let held = grouped(tree.aggregate.primitive_count(geometry));
        format!("built {nodes} by {} over {held} of {all}", tree.method)
    }

    /// The number of primitives in no instance that no ray can hit.
    pub(super) fn never_hit(&self) -> usize {
        match self.structure() {
            Structure::Bins(bins) => bins.never_hit(),
            Structure::Tree(aggregate) => aggregate.never_hit(),
        }
    }
}
