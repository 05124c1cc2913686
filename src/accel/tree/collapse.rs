//! Collapses a binary tree into a wide one.

use super::binary::BinaryTree;
use super::node::{Children, Node};
use super::primitive_block::BLOCK_SIZE;
use super::wide::{Child, Run, WideNode, WideTree};
use crate::simd::LANES;

/// Collapses `tree` into nodes of sixteen children over runs of up to [`BLOCK_SIZE`] items.
pub(crate) fn collapse<T>(tree: &BinaryTree<T>) -> WideTree<Run> {
    let Some(root) = tree.root else {
        return WideTree {
            nodes: Vec::new(),
            blocks: Vec::new(),
        };
    };
    let below = &tree.below;
    let contents = measure(below);
    let mut collapse = Collapse {
        below,
        contents,
        nodes: Vec::new(),
        runs: Vec::new(),
    };
    collapse.node(vec![root]);
    let Collapse {
        nodes, mut runs, ..
    } = collapse;
    runs.shrink_to_fit();
    WideTree {
        nodes,
        blocks: runs,
    }
}

/// The contents of a node of the binary tree.
#[derive(Debug, Clone, Copy)]
struct Contents {
    /// All items, if they are consecutive and fit into a block: then the subtree becomes a leaf.
    run: Option<Run>,
    /// The number of runs that the items form.
    runs: u32,
}

/// The contents of each inner node, by the index of its children.
fn measure(below: &[Children]) -> Vec<Contents> {
    let mut contents = vec![Contents { run: None, runs: 0 }; below.len()];
    // Children stand behind their parents.
    for place in (0..below.len()).rev() {
        let [left, right] = [0, 1].map(|side| contents_of(&below[place].node(side), &contents));
        let run = left
            .run
            .zip(right.run)
            .and_then(|(left, right)| joined(left, right));
        let runs = if run.is_some() {
            1
        } else {
            left.runs + right.runs
        };
        contents[place] = Contents { run, runs };
    }
    contents
}

/// Two runs as one, if they are consecutive and fit into a block.
fn joined(left: Run, right: Run) -> Option<Run> {
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

fn contents_of(node: &Node, contents: &[Contents]) -> Contents {
    if node.is_leaf() {
        Contents {
            run: Some(Run {
                first: node.first,
                count: node.count,
            }),
            runs: 1,
        }
    } else {
        contents[node.first as usize]
    }
}

/// The state of a collapse.
struct Collapse<'a> {
    below: &'a [Children],
    contents: Vec<Contents>,
    nodes: Vec<WideNode>,
    /// The items of each block.
    runs: Vec<Run>,
}

impl Collapse<'_> {
    /// Appends a node over `parts`, opening as many of them as there is room for, and everything
    /// below it. Returns its index.
    ///
    /// Recursion is no deeper than the binary tree.
    fn node(&mut self, mut parts: Vec<Node>) -> u32 {
        while parts.len() < LANES {
            let Some(part) = self.part_to_open(&parts) else {
                break;
            };
            let children = &self.below[parts[part].first as usize];
            parts[part] = children.node(0);
            parts.push(children.node(1));
        }
        let place = self.nodes.len();
        self.nodes
            .push(WideNode::over(parts.iter().map(|part| part.bounds)));
        for (lane, part) in parts.iter().enumerate() {
            self.nodes[place].children[lane] = match contents_of(part, &self.contents).run {
                Some(run) => self.blocks_of(run),
                None => {
                    let children = &self.below[part.first as usize];
                    let first = self.node(vec![children.node(0), children.node(1)]);
                    Child { first, blocks: 0 }
                }
            };
        }
        place as u32
    }

    /// The largest part worth opening: one whose runs all fit into this node, or one with so many
    /// runs that its own node would be full anyway.
    fn part_to_open(&self, parts: &[Node]) -> Option<usize> {
        let room = LANES - parts.len() + 1;
        let fits = |runs: u32| runs as usize > LANES || runs as usize <= room;
        let can_open = |part: &Node| {
            let Contents { run, runs } = contents_of(part, &self.contents);
            run.is_none() && fits(runs)
        };
        let area = |place: usize| parts[place].bounds.half_area();
        let inner = (0..parts.len()).filter(|place| can_open(&parts[*place]));
        inner.max_by(|a, b| area(*a).total_cmp(&area(*b)))
    }

    fn blocks_of(&mut self, run: Run) -> Child {
        let first = self.runs.len() as u32;
        let starts = (0..run.count).step_by(BLOCK_SIZE);
        self.runs.extend(starts.map(|start| Run {
            first: run.first + start,
            count: (run.count - start).min(BLOCK_SIZE as u32),
        }));
        Child {
            first,
            blocks: self.runs.len() as u32 - first,
        }
    }
}
