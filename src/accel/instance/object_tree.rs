//! The tree of an object, in the object's own space.

use super::object_blocks::ObjectBlocks;
use super::outline::{Outline, TermBounds};
use super::placement::Placement;
use crate::accel::builder::{self, BuildOptions, BuildPrimitive};
use crate::accel::space::{AnchorSpace, Box32};
use crate::accel::tree::{BinaryTree, Run, WideTree, collapse};
use crate::geometry::{Bounds, Matrix, Point};
use crate::parallel::CollectVec;
use crate::progress::Progress;
use crate::shape::{Geometry, Instance, Pose, PrimitiveId};
use rayon::prelude::*;

/// A tree over the primitives of an object that some instance may show.
#[derive(Debug, PartialEq)]
pub(crate) struct ObjectTree {
    /// Anchored at the middle of the object.
    pub(crate) space: AnchorSpace,
    pub(crate) tree: BinaryTree<PrimitiveId>,
    /// The same tree for tiles.
    pub(crate) wide: WideTree<Run>,
    /// The blocks of the wide tree, for tiles.
    pub(crate) blocks: ObjectBlocks,
    terms: TermBounds,
}

/// The box of every primitive in an object whose place is unknown.
const UNIT_BOX: Box32 = Box32 {
    low: [-1.0; 3],
    high: [1.0; 3],
};

impl ObjectTree {
    /// Builds the tree. `progress` counts primitives.
    pub(super) fn build(
        object: &Geometry,
        outline: Outline,
        options: BuildOptions,
        progress: Progress,
    ) -> ObjectTree {
        let space = space_of(&outline);
        let place = |pose: &mut Pose, primitive: &PrimitiveId| {
            let bounds = Outline::of_one(object, pose, *primitive)?.bounds;
            let bounds = if outline.is_anywhere() {
                UNIT_BOX
            } else {
                space.enclose(&bounds)
            };
            Some(BuildPrimitive::new(&bounds, primitive.to_bits()))
        };
        let all: Vec<PrimitiveId> = object.primitives().collect();
        let pose = || Pose::new(object, Matrix::IDENTITY);
        let placed = all.par_iter().with_min_len(1 << 10).map_init(pose, place);
        let placed: Vec<Option<BuildPrimitive>> = placed.collect_vec();
        let primitives: Vec<BuildPrimitive> = placed.into_iter().flatten().collect();
        progress.advance(all.len() - primitives.len());
        let tree = builder::build(primitives, options, progress, PrimitiveId::from_bits);
        let wide = collapse(&tree);
        ObjectTree {
            space,
            blocks: ObjectBlocks::new(&wide.blocks, &tree.order, object),
            wide,
            tree,
            terms: outline.terms,
        }
    }

    /// The placement of the object's boxes by an instance.
    pub(crate) fn placement(&self, instance: &Instance) -> Placement {
        Placement::new(instance.world_from_instance(), &self.terms)
    }

    /// The memory of the trees in bytes.
    pub(super) fn bytes(&self) -> usize {
        self.tree.bytes() + self.wide.bytes() + self.blocks.bytes()
    }
}

fn space_of(outline: &Outline) -> AnchorSpace {
    if outline.is_anywhere() || outline.is_empty() {
        return AnchorSpace::new(Point::default(), 1.0);
    }
    let Bounds { low, high } = outline.bounds;
    let middle = outline.bounds.centre();
    AnchorSpace::new(
        middle,
        (high - middle).largest().max((middle - low).largest()),
    )
}
