//! The structure in which rays find primitives: a tree, or the bins of one view.

use super::aggregate::Aggregate;
use super::bins::Bins;
use super::instance::InstanceTrees;
use super::space::AnchorSpace;

/// A structure that the primitives of a scene are found in.
#[derive(Debug, Clone, Copy)]
pub enum Structure<'a> {
    /// Trees over the whole scene, for any ray.
    Tree(&'a Aggregate),
    /// Bins, for the rays of the view that they were made for.
    Bins(&'a Bins),
}

impl<'a> Structure<'a> {
    /// The trees, unless the structure is bins.
    pub fn tree(self) -> Option<&'a Aggregate> {
        match self {
            Structure::Tree(aggregate) => Some(aggregate),
            Structure::Bins(_) => None,
        }
    }

    /// The space of the boxes in the world.
    pub(super) fn space(self) -> &'a AnchorSpace {
        match self {
            Structure::Tree(aggregate) => &aggregate.space,
            Structure::Bins(bins) => &bins.space,
        }
    }

    /// The trees over the instances.
    pub(super) fn instances(self) -> &'a InstanceTrees {
        match self {
            Structure::Tree(aggregate) => &aggregate.instances,
            Structure::Bins(bins) => &bins.instances,
        }
    }
}

impl<'a> From<&'a Aggregate> for Structure<'a> {
    fn from(aggregate: &'a Aggregate) -> Structure<'a> {
        Structure::Tree(aggregate)
    }
}

impl<'a> From<&'a Bins> for Structure<'a> {
    fn from(bins: &'a Bins) -> Structure<'a> {
        Structure::Bins(bins)
    }
}
