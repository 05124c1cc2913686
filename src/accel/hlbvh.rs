//! Hierarchical linear BVH (Pantaleoni and Luebke, 2010), with all of the upper tree by the surface area heuristic
//! (Garanzha, Pantaleoni and McAllister, 2011).
//!
//! Primitives are sorted along a Morton curve, runs of them become treelets, and the surface area heuristic builds the tree
//! above the treelets. Treelets are as small as a leaf of the usual size, since the tree above them costs little.

use super::SplitMethod;
use super::build_primitive::BuildPrimitive;
use super::morton::along_curve;
use super::node::{Children, Node, Subtree};
use super::splitter::Splitter;
use super::top_down::TopDown;
use crate::progress::Progress;
use crate::shape::Primitive;
use rayon::prelude::*;
use std::ops::Range;

pub(super) const MAX_UPPER_DEPTH: u32 = 64;
pub(super) const MAX_DEPTH: u32 = MAX_UPPER_DEPTH;

/// The tree over `primitives`, which are not empty, and they in the order of its leaves.
pub(super) fn build(primitives: &[BuildPrimitive], max_leaf: usize, progress: Progress) -> (Subtree, Vec<Primitive>) {
    let keys = along_curve(primitives);
    let splitter = Splitter { method: SplitMethod::Sah, max_leaf };
    let mut runs = Vec::new();
    cut(&splitter, &keys, 0..keys.len(), 62, &mut runs);
    let order = keys.par_iter().map(|k| primitives[*k as u32 as usize].primitive()).collect();
    let mut leaves: Vec<BuildPrimitive> = Vec::new();
    runs.par_iter()
        .enumerate()
        .map(|(index, run)| {
            let mut bounds = super::lanes::LaneBox::EMPTY;
            for key in &keys[run.start as usize..run.end as usize] {
                let p = &primitives[*key as u32 as usize];
                bounds = p.bounds().union(bounds);
            }
            BuildPrimitive::new(&bounds.to_box(), Primitive::triangle(index))
        })
        .collect_into_vec(&mut leaves);
    drop(keys);
    let splitter = Splitter { method: SplitMethod::Sah, max_leaf: 1 };
    let mut tree = TopDown { splitter, max_depth: MAX_UPPER_DEPTH, progress: Progress::SILENT }.build(&mut leaves);
    let fix = |node: Node| {
        if !node.is_leaf() {
            return node;
        }
        let run = &runs[leaves[node.first as usize].primitive().index()];
        Node::leaf(node.bounds, run.start, run.end - run.start)
    };
    tree.below.par_iter_mut().for_each(|c| *c = Children::new(&fix(c.node(0)), &fix(c.node(1))));
    tree.root = fix(tree.root);
    progress.advance(primitives.len());
    (tree, order)
}

fn cut(splitter: &Splitter, keys: &[u64], run: Range<usize>, bits: u32, runs: &mut Vec<Range<u32>>) {
    if run.len() <= splitter.max_leaf {
        runs.push(run.start as u32..run.end as u32);
        return;
    }
    let differing = (keys[run.start] ^ keys[run.end - 1]) >> 32;
    let mut middle = run.len() / 2;
    if differing != 0 {
        let bit = 32 + 63 - differing.leading_zeros();
        middle = keys[run.clone()].partition_point(|key| key >> bit & 1 == 0);
    }
    if run.len() <= 16 * splitter.max_leaf {
        middle = splitter.full(run.len(), middle);
    }
    cut(splitter, keys, run.start..run.start + middle, bits, runs);
    cut(splitter, keys, run.start + middle..run.end, bits, runs);
}
