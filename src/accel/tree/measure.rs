//! Measures the subtrees of a binary tree before it is collapsed.

use super::node::{Children, Node};
use super::primitive_block::BLOCK_SIZE;
use super::wide::Run;

/// Two threads share longer lists. The result does not depend on this.
const PARALLEL: usize = 1 << 12;

/// The contents of a node of the binary tree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Contents {
    /// All items, if they are consecutive and fit into a block: then the subtree becomes a leaf.
    pub(super) run: Option<Run>,
    /// The number of runs that the items form.
    pub(super) runs: u32,
}

impl Contents {
    const NONE: Contents = Contents { run: None, runs: 0 };

    fn of_leaf(leaf: &Node) -> Contents {
        let (first, count) = (leaf.first, leaf.count);
        Contents {
            run: Some(Run { first, count }),
            runs: 1,
        }
    }

    fn union(self, other: Contents) -> Contents {
        let joined = self.run.zip(other.run);
        let run = joined.and_then(|(left, right)| joined_run(left, right));
        let runs = match run {
            Some(_) => 1,
            None => self.runs + other.runs,
        };
        Contents { run, runs }
    }
}

/// Two runs as one, if they are consecutive and fit into a block.
fn joined_run(left: Run, right: Run) -> Option<Run> {
    let (a, b) = if left.first < right.first {
        (left, right)
    } else {
        (right, left)
    };
    let joined = Run {
        first: a.first,
        count: a.count + b.count,
    };
    (a.first + a.count == b.first && joined.count as usize <= BLOCK_SIZE).then_some(joined)
}

/// The contents of `node`; `all` holds those of each inner node, by the index of its children.
#[inline]
pub(super) fn contents_of(node: &Node, all: &[Contents]) -> Contents {
    if node.is_leaf() {
        Contents::of_leaf(node)
    } else {
        all[node.first as usize]
    }
}

/// The contents of each inner node below `root`, by the index of its children.
pub(super) fn measure(root: &Node, below: &[Children]) -> Vec<Contents> {
    let mut contents = vec![Contents::NONE; below.len()];
    if !root.is_leaf() {
        measure_subtree(below, &mut contents, 0);
    }
    contents
}

/// Measures a subtree, whose nodes stand in depth-first order from index `first` on.
fn measure_subtree(below: &[Children], contents: &mut [Contents], first: usize) {
    let [left, right] = [0, 1].map(|side| below[0].node(side));
    if below.len() < PARALLEL || left.is_leaf() || right.is_leaf() {
        return measure_serially(below, contents, first);
    }
    let middle = right.first as usize - first;
    let (front, back) = contents.split_at_mut(middle);
    rayon::join(
        || measure_subtree(&below[1..middle], &mut front[1..], first + 1),
        || measure_subtree(&below[middle..], back, first + middle),
    );
    front[0] = front[1].union(back[0]);
}

fn measure_serially(below: &[Children], contents: &mut [Contents], first: usize) {
    // Children stand behind their parents.
    for place in (0..below.len()).rev() {
        let side = |side: usize| match below[place].node(side) {
            leaf if leaf.is_leaf() => Contents::of_leaf(&leaf),
            node => contents[node.first as usize - first],
        };
        contents[place] = side(0).union(side(1));
    }
}
