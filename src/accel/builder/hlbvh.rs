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
use rayon::prelude::*;
use std::ops::Range;

/// The largest number of leaves in a treelet, unless its primitives share one code.
const TREELET_LEAVES: usize = 16;

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
    let runs = runs(&curve, TREELET_LEAVES * leaf_size.0);
    let mut order = vec![0; primitives.len()];
    let treelet = |(run, order): (&Range<usize>, &mut [u32])| {
        let places = curve[run.clone()].iter();
        let mut list: Vec<_> = places.map(|place| primitives[place.index()]).collect();
        let treelet = top_down.build(&mut list, run.start);
        for (place, primitive) in order.iter_mut().zip(&list) {
            *place = primitive.bits();
        }
        treelet
    };
    let parts = runs.par_iter().zip(split_into(&mut order, &runs));
    let treelets = parts.map(treelet).collect();
    (join_by_sah(treelets), order)
}

/// Splits `list` at `runs`, which cover all of it.
fn split_into<'a, T>(mut list: &'a mut [T], runs: &[Range<usize>]) -> Vec<&'a mut [T]> {
    let part = |run: &Range<usize>| {
        list.split_off_mut(..run.len())
            .expect("runs cover the list")
    };
    runs.iter().map(part).collect()
}

/// Cuts the curve into runs of up to `longest` codes, each time where the highest bit changes in
/// which they differ. Runs of a single code may be longer.
fn runs(curve: &[CurvePlace], longest: usize) -> Vec<Range<usize>> {
    let mut runs = Vec::new();
    // The later parts of all cuts, no more than a code has bits.
    let mut waiting = Vec::new();
    let mut next = Some(0..curve.len());
    while let Some(run) = next.take().or_else(|| waiting.pop()) {
        let codes = &curve[run.clone()];
        let differing = codes[0].code() ^ codes[codes.len() - 1].code();
        if codes.len() <= longest || differing == 0 {
            runs.push(run);
            continue;
        }
        let bit = differing.ilog2();
        let middle = run.start + codes.partition_point(|place| place.code() >> bit & 1 == 0);
        waiting.push(middle..run.end);
        next = Some(run.start..middle);
    }
    runs
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
