//! Hierarchical linear BVH (Pantaleoni and Luebke, 2010; PBR book, 3rd edition, section 4.3.3).
//!
//! Primitives are sorted along a Morton curve, runs of codes that share their upper bits become treelets split
//! bit by bit, and the surface area heuristic builds the tree above the treelets.

use super::SplitMethod;
use super::build_primitive::{BuildPrimitive, bounds_of, centre_bounds};
use super::node::{Children, Node, Subtree};
use super::splitter::Splitter;
use super::top_down::TopDown;
use crate::progress::Progress;
use crate::shape::Primitive;
use rayon::prelude::*;
use std::ops::Range;

/// Bits of a Morton code on each axis.
const AXIS_BITS: u32 = 10;
const CODE_BITS: u32 = 3 * AXIS_BITS;
/// Upper bits that the codes of a treelet share.
const TREELET_BITS: u32 = 12;
/// Levels of the tree above the treelets at most.
const MAX_UPPER_DEPTH: u32 = 40;

/// The deepest tree this can build: above, then a level a bit, then halves of one code's primitives.
pub(super) const MAX_DEPTH: u32 = MAX_UPPER_DEPTH + (CODE_BITS - TREELET_BITS) + 32;

/// Builds the tree over `primitives`, which come to lie in the order of its leaves. The list must not be empty.
pub(super) fn build(primitives: &mut Vec<BuildPrimitive>, max_leaf: usize, progress: Progress) -> Subtree {
    let codes = sort_by_code(primitives);
    let runs = treelet_runs(&codes);
    let mut treelets: Vec<Subtree> = runs
        .par_iter()
        .map(|run| {
            let mut below = Vec::new();
            let emitter = Emitter { primitives, codes: &codes, max_leaf };
            let root = emitter.node(run.clone(), CODE_BITS - TREELET_BITS, &mut below);
            progress.advance(run.len());
            Subtree { root, below }
        })
        .collect();
    join_by_sah(&mut treelets)
}

/// Sorts the primitives by their codes (equal ones by their place in the list) and returns the codes.
fn sort_by_code(primitives: &mut Vec<BuildPrimitive>) -> Vec<u32> {
    let quantizer = Quantizer::new(primitives);
    let mut keys: Vec<u64> = primitives
        .par_iter()
        .enumerate()
        .map(|(index, primitive)| u64::from(quantizer.code(primitive)) << 32 | index as u64)
        .collect();
    // No two keys are equal, so the order does not depend on how the work was divided.
    keys.par_sort_unstable();
    *primitives = keys.par_iter().map(|key| primitives[*key as u32 as usize]).collect();
    keys.into_par_iter().map(|key| (key >> 32) as u32).collect()
}

/// Maps centres to a grid of 2^10 cells an axis.
struct Quantizer {
    low: [f32; 3],
    cells_per_unit: [f32; 3],
}

impl Quantizer {
    fn new(primitives: &[BuildPrimitive]) -> Quantizer {
        let centres = centre_bounds(primitives);
        let cells = |extent: f32| if extent > 0.0 { (1 << AXIS_BITS) as f32 / extent } else { 0.0 };
        Quantizer { low: centres.low, cells_per_unit: centres.extent().map(cells) }
    }

    fn code(&self, primitive: &BuildPrimitive) -> u32 {
        let centre = primitive.doubled_centre();
        let cell = |k: usize| {
            // A NaN, from infinite boxes, becomes 0.
            let cell = ((centre[k] - self.low[k]) * self.cells_per_unit[k]) as u32;
            spread(cell.min((1 << AXIS_BITS) - 1))
        };
        cell(2) << 2 | cell(1) << 1 | cell(0)
    }
}

/// Moves bit k of a 10-bit number to bit 3k.
fn spread(cell: u32) -> u32 {
    let x = (cell | cell << 16) & 0x0300_00ff;
    let x = (x | x << 8) & 0x0300_f00f;
    let x = (x | x << 4) & 0x030c_30c3;
    (x | x << 2) & 0x0924_9249
}

fn treelet_runs(codes: &[u32]) -> Vec<Range<usize>> {
    let mut first = 0;
    let runs = codes.chunk_by(|a, b| a >> (CODE_BITS - TREELET_BITS) == b >> (CODE_BITS - TREELET_BITS));
    runs.map(|run| {
        let range = first..first + run.len();
        first = range.end;
        range
    })
    .collect()
}

/// Makes a treelet of a run of sorted primitives.
struct Emitter<'a> {
    primitives: &'a [BuildPrimitive],
    codes: &'a [u32],
    max_leaf: usize,
}

impl Emitter<'_> {
    /// The node over `run`, whose codes agree above bit `bits`; the nodes below it are appended to `below`.
    ///
    /// Recursion goes down one bit at a time, then halves what shares all bits: 50 levels at most.
    fn node(&self, run: Range<usize>, bits: u32, below: &mut Vec<Children>) -> Node {
        if run.len() <= self.max_leaf {
            let bounds = bounds_of(&self.primitives[run.clone()]);
            return Node::leaf(bounds, run.start as u32, run.len() as u32);
        }
        let (middle, bits) = self.split(&run, bits);
        let children = below.len();
        below.push(Children::PLACEHOLDER);
        let left = self.node(run.start..middle, bits, below);
        let right = self.node(middle..run.end, bits, below);
        below[children] = Children::new(&left, &right);
        Node::inner(left.bounds.union(&right.bounds), children as u32)
    }

    /// Where the highest differing bit below `bits` changes, and the bits below it; the middle where none differs.
    fn split(&self, run: &Range<usize>, mut bits: u32) -> (usize, u32) {
        let codes = &self.codes[run.clone()];
        while bits > 0 {
            bits -= 1;
            let is_left = |code: &u32| code >> bits & 1 == 0;
            if is_left(&codes[0]) && !is_left(&codes[codes.len() - 1]) {
                return (run.start + codes.partition_point(is_left), bits);
            }
        }
        (run.start + run.len() / 2, 0)
    }
}

/// Builds the tree above the treelets, then puts each treelet in the place of its leaf.
fn join_by_sah(treelets: &mut [Subtree]) -> Subtree {
    let stand_in = |(index, treelet): (usize, &Subtree)| BuildPrimitive {
        bounds: treelet.root.bounds,
        primitive: Primitive::triangle(index),
    };
    let mut stand_ins: Vec<BuildPrimitive> = treelets.iter().enumerate().map(stand_in).collect();
    let splitter = Splitter { method: SplitMethod::Sah, max_leaf: 1 };
    let top_down = TopDown { splitter, max_depth: MAX_UPPER_DEPTH, progress: Progress::SILENT };
    let Subtree { mut root, mut below } = top_down.build(&mut stand_ins, 0);
    below.reserve_exact(treelets.iter().map(|treelet| treelet.below.len()).sum());
    let mut graft = |leaf: Node, below: &mut Vec<Children>| {
        let treelet = &mut treelets[stand_ins[leaf.first as usize].primitive.index()];
        let base = below.len();
        below.extend(std::mem::take(&mut treelet.below).into_iter().map(|children| children.shifted(base)));
        treelet.root.shifted(base)
    };
    for place in 0..below.len() {
        let grafted = [0, 1].map(|side| {
            let node = below[place].node(side);
            if node.is_leaf() { graft(node, &mut below) } else { node }
        });
        below[place] = Children::new(&grafted[0], &grafted[1]);
    }
    if root.is_leaf() {
        root = graft(root, &mut below);
    }
    Subtree { root, below }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spreads_ten_bits() {
        assert_eq!(spread(0b11_1111_1111), 0x0924_9249);
        assert_eq!(spread(0b10_0000_0001), 1 << 27 | 1);
    }
}
