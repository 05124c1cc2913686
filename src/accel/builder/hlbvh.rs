//! Hierarchical linear BVH (Pantaleoni and Luebke, 2010; Garanzha, Pantaleoni and McAllister,
//! 2011).
//!
//! Primitives are sorted along a Morton curve, and runs of codes that share their upper bits become
//! treelets, so the upper half of the levels costs no more than a sort. The surface area heuristic
//! builds the tree above the treelets. Within treelets, this implementation departs from the papers
//! and ignores the codes: splitting such short lists in the middle is as fast and gives better
//! trees.

use super::branch::Branch;
use super::build_primitive::BuildPrimitive;
use super::full_leaves::LeafSize;
use super::morton::{CurvePlace, along_curve};
use super::splitter::Splitter;
use super::top_down::TopDown;
use crate::accel::SplitMethod;
use crate::accel::tree::{Node, Subtree};
use crate::progress::Progress;

/// The largest number of leaves in a treelet, unless its primitives share one code.
const TREELET_LEAVES: usize = 16;

/// Two threads share longer parts of the curve. The tree does not depend on this.
const PARALLEL: usize = 1 << 13;

/// The largest depth of the tree above the treelets.
const MAX_UPPER_DEPTH: u32 = 40;

/// The tree over `primitives`, which must not be empty, and their bits in the order of its leaves.
pub(super) fn build(
    primitives: &[BuildPrimitive],
    leaf_size: LeafSize,
    max_depth: u32,
    progress: Progress,
) -> (Subtree, Vec<u32>) {
    let splitter = Splitter {
        method: SplitMethod::Middle,
        leaf_size,
    };
    let top_down = TopDown {
        splitter,
        max_depth: max_depth - MAX_UPPER_DEPTH,
        progress,
    };
    let curve = along_curve(primitives);
    let mut order = vec![0; primitives.len()];
    let treelets = Treelets {
        primitives,
        top_down,
        longest: TREELET_LEAVES * leaf_size.0,
    };
    let treelets = treelets.build(&curve, &mut order, 0);
    drop(curve);
    (join_by_sah(treelets), order)
}

/// Builds the treelets.
struct Treelets<'a> {
    primitives: &'a [BuildPrimitive],
    top_down: TopDown<'a>,
    /// The largest number of primitives in a treelet, unless they share one code.
    longest: usize,
}

impl Treelets<'_> {
    /// The treelets of a part of the curve, which begins at index `first`. Writes the bits of its
    /// primitives to `order`, in the order of the leaves.
    ///
    /// Recursion goes no deeper than a code has bits.
    fn build(&self, curve: &[CurvePlace], order: &mut [u32], first: usize) -> Vec<Subtree> {
        if curve.len() > PARALLEL
            && let Some(middle) = self.cut(curve)
        {
            let (left, right) = curve.split_at(middle);
            let (left_order, right_order) = order.split_at_mut(middle);
            let (mut treelets, right) = rayon::join(
                || self.build(left, left_order, first),
                || self.build(right, right_order, first + middle),
            );
            treelets.extend(right);
            return treelets;
        }
        let mut treelets = Vec::new();
        // All at once, so that memory answers many requests together.
        let places = curve.iter().map(|place| place.index());
        let mut list: Vec<_> = places.map(|place| self.primitives[place]).collect();
        // The later parts of all cuts, no more than a code has bits.
        let mut waiting = Vec::new();
        let mut next = Some(0..curve.len());
        while let Some(run) = next.take().or_else(|| waiting.pop()) {
            if let Some(len) = self.cut(&curve[run.clone()]) {
                let middle = run.start + len;
                waiting.push(middle..run.end);
                next = Some(run.start..middle);
                continue;
            }
            let list = &mut list[run.clone()];
            treelets.push(self.top_down.build(list, first + run.start));
        }
        for (place, primitive) in order.iter_mut().zip(&list) {
            *place = primitive.bits();
        }
        treelets
    }

    /// The length of the first part of a run that is too long: up to where the highest bit changes
    /// in which its codes differ. `None` if the run is a treelet.
    fn cut(&self, run: &[CurvePlace]) -> Option<usize> {
        let differing = run.first()?.code() ^ run.last()?.code();
        if run.len() <= self.longest || differing == 0 {
            return None;
        }
        let bit = differing.ilog2();
        Some(run.partition_point(|place| place.code() >> bit & 1 == 0))
    }
}

/// Builds the tree above the treelets and joins it with them.
fn join_by_sah(mut treelets: Vec<Subtree>) -> Subtree {
    let stand_in = |(index, treelet): (usize, &Subtree)| {
        BuildPrimitive::new(&treelet.root.bounds, index as u32)
    };
    let mut stand_ins: Vec<BuildPrimitive> = treelets.iter().enumerate().map(stand_in).collect();
    let splitter = Splitter {
        method: SplitMethod::Sah,
        leaf_size: LeafSize(1),
    };
    let top_down = TopDown {
        splitter,
        max_depth: MAX_UPPER_DEPTH,
        progress: Progress::SILENT,
    };
    let upper = top_down.build(&mut stand_ins, 0);
    graft(upper.root, &upper, &mut |place| {
        let treelet = &mut treelets[stand_ins[place].bits() as usize];
        Subtree {
            root: treelet.root,
            below: std::mem::take(&mut treelet.below),
        }
    })
    .into_subtree()
}

/// The tree below `node` of `upper`, with its leaves replaced by treelets.
fn graft(node: Node, upper: &Subtree, treelet: &mut impl FnMut(usize) -> Subtree) -> Branch {
    if node.is_leaf() {
        return Branch::Part(treelet(node.first as usize));
    }
    let children = &upper.below[node.first as usize];
    let left = graft(children.node(0), upper, treelet);
    Branch::fork(left, graft(children.node(1), upper, treelet))
}
