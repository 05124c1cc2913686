//! The tree as tiles walk through it: sixteen children a node, whatever the split method.

use super::block::BLOCK;
use crate::accel::node::{Children, Node};
use crate::accel::space::Box32;
use crate::accel::tree::Tree;
use crate::simd::LANES;

/// Up to sixteen children, side by side.
#[derive(Debug, Clone, PartialEq)]
#[repr(align(64))]
pub(super) struct WideNode {
    /// Low corners of the children's boxes, in anchor space; infinite where there is no child.
    pub(super) low: [[f32; LANES]; 3],
    /// High corners.
    pub(super) high: [[f32; LANES]; 3],
    /// What is below each.
    pub(super) children: [Child; LANES],
}

/// What is below a child: blocks, or a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Child {
    /// The place of its first block, or of the node.
    pub(super) first: u32,
    /// The number of its blocks; 0 for a node.
    pub(super) blocks: u32,
}

/// A tree with sixteen children a node over blocks of primitives. It is a binary tree with levels left out: no box is moved.
#[derive(Debug, PartialEq)]
pub(crate) struct WideTree<B> {
    pub(super) nodes: Vec<WideNode>,
    pub(super) blocks: Vec<B>,
}

impl<B> WideTree<B> {
    /// Of a binary tree; `blocks_of` makes the blocks of runs of what is in its leaves.
    pub(in crate::accel) fn of<T>(
        tree: &Tree<T>,
        blocks_of: impl FnOnce(Vec<Run>) -> Vec<B>,
    ) -> WideTree<B> {
        let Some(root) = tree.root else {
            return WideTree {
                nodes: Vec::new(),
                blocks: Vec::new(),
            };
        };
        let below = &tree.below;
        let mut collapse = Collapse {
            below,
            measured: measure(below),
            nodes: Vec::new(),
            blocks: Vec::new(),
        };
        collapse.node(vec![root]);
        let Collapse {
            nodes,
            blocks,
            measured,
            ..
        } = collapse;
        drop(measured);
        WideTree {
            blocks: blocks_of(blocks),
            nodes,
        }
    }

    /// Bytes that the tree takes.
    pub(in crate::accel) fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.blocks[..])
    }
}

/// A part of what is in the leaves, in their order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Run {
    pub(super) first: u32,
    pub(super) count: u32,
}

impl Run {
    /// What it is, in the order of the leaves.
    #[inline]
    pub(super) fn of<T>(self, order: &[T]) -> &[T] {
        &order[self.first as usize..][..self.count as usize]
    }
}

/// Runs for blocks: what is in them is looked up when a tile comes by.
pub(in crate::accel) fn runs_of(mut runs: Vec<Run>) -> Vec<Run> {
    runs.shrink_to_fit();
    runs
}

/// What is below a node of the binary tree.
#[derive(Debug, Clone, Copy)]
struct Below {
    /// All primitives, where they are few and follow each other: they need not be looked into.
    run: Option<Run>,
    /// How many runs they form.
    runs: u32,
}

/// What is below each pair of children.
fn measure(below: &[Children]) -> Vec<Below> {
    let mut measured = vec![Below { run: None, runs: 0 }; below.len()];
    // Children stand behind their parents.
    for place in (0..below.len()).rev() {
        let [left, right] = [0, 1].map(|side| below_node(&below[place].node(side), &measured));
        let run = left.run.zip(right.run).and_then(|(left, right)| {
            let (a, b) = if left.first < right.first {
                (left, right)
            } else {
                (right, left)
            };
            let joined = Run {
                first: a.first,
                count: a.count + b.count,
            };
            (a.first + a.count == b.first && joined.count as usize <= BLOCK).then_some(joined)
        });
        measured[place] = Below {
            run,
            runs: if run.is_some() {
                1
            } else {
                left.runs + right.runs
            },
        };
    }
    measured
}

fn below_node(node: &Node, measured: &[Below]) -> Below {
    if node.is_leaf() {
        Below {
            run: Some(Run {
                first: node.first,
                count: node.count,
            }),
            runs: 1,
        }
    } else {
        measured[node.first as usize]
    }
}

/// Leaves out levels.
struct Collapse<'a> {
    below: &'a [Children],
    measured: Vec<Below>,
    nodes: Vec<WideNode>,
    /// What is in each block.
    blocks: Vec<Run>,
}

impl Collapse<'_> {
    /// Appends a node over `parts`, as many of which are opened as there is room for, and all below it; returns its place.
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
        self.nodes.push(WideNode::over(&parts));
        for (lane, part) in parts.iter().enumerate() {
            self.nodes[place].children[lane] = match self.of(part).run {
                Some(run) => self.blocks_of(run),
                None => {
                    let [left, right] =
                        [0, 1].map(|side| self.below[part.first as usize].node(side));
                    Child {
                        first: self.node(vec![left, right]),
                        blocks: 0,
                    }
                }
            };
        }
        place as u32
    }

    fn of(&self, node: &Node) -> Below {
        below_node(node, &self.measured)
    }

    /// The largest part that is best opened: one that fits with all its runs, or one that will not make a small node.
    fn part_to_open(&self, parts: &[Node]) -> Option<usize> {
        let room = LANES - parts.len() + 1;
        let fits = |runs: u32| runs as usize > LANES || runs as usize <= room;
        let inner = parts.iter().enumerate().filter(|(_, part)| {
            let Below { run, runs } = self.of(part);
            run.is_none() && fits(runs)
        });
        let largest =
            inner.max_by(|(_, a), (_, b)| a.bounds.half_area().total_cmp(&b.bounds.half_area()));
        largest.map(|(part, _)| part)
    }

    fn blocks_of(&mut self, run: Run) -> Child {
        let first = self.blocks.len() as u32;
        let starts = (0..run.count).step_by(BLOCK);
        let block = |start: u32| Run {
            first: run.first + start,
            count: (run.count - start).min(BLOCK as u32),
        };
        self.blocks.extend(starts.map(block));
        Child {
            first,
            blocks: self.blocks.len() as u32 - first,
        }
    }
}

impl WideNode {
    /// Lanes that have a child, lane k as bit k.
    pub(super) fn used(&self) -> u32 {
        (0..LANES).fold(0, |used, lane| {
            used | u32::from(self.low[0][lane] <= self.high[0][lane]) << lane
        })
    }

    fn over(parts: &[Node]) -> WideNode {
        let Box32 { low, high } = Box32::EMPTY;
        let mut node = WideNode {
            low: low.map(|x| [x; LANES]),
            high: high.map(|x| [x; LANES]),
            children: [Child::default(); LANES],
        };
        for (lane, part) in parts.iter().enumerate() {
            for axis in 0..3 {
                node.low[axis][lane] = part.bounds.low[axis];
                node.high[axis][lane] = part.bounds.high[axis];
            }
        }
        node
    }
}
