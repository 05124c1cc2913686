//! Collapses a binary tree into a wide one.

use super::binary::BinaryTree;
use super::measure::{Contents, contents_of, measure};
use super::node::{Children, Node};
use super::primitive_block::BLOCK_SIZE;
use super::wide::{Child, Run, WideNode, WideTree};
use crate::parallel::CollectVec;
use crate::simd::LANES;
use rayon::prelude::*;

/// One thread collapses a subtree of at most this many runs. The size does not depend on the number
/// of threads, so neither does the order of the nodes.
const PART_RUNS: u32 = 1 << 10;

/// Collapses `tree` into nodes of sixteen children over runs of up to [`BLOCK_SIZE`] items.
pub(crate) fn collapse<T>(tree: &BinaryTree<T>) -> WideTree<Run> {
    let Some(root) = tree.root else {
        return WideTree {
            nodes: Vec::new(),
            blocks: Vec::new(),
        };
    };
    let binary = Measured {
        below: &tree.below,
        contents: &measure(&root, &tree.below),
    };
    let part_runs = match binary.contents_of(&root).runs {
        ..=PART_RUNS => 0,
        _ => PART_RUNS,
    };
    let top = Collapse::of(binary, root, part_runs);
    let parts = top.parts.par_iter();
    let parts = parts.map(|part| Collapse::of(binary, part.root, 0));
    let parts: Vec<Collapse> = parts.collect_vec();
    join(top, &parts)
}

/// A binary tree with the contents of its inner nodes.
#[derive(Debug, Clone, Copy)]
struct Measured<'a> {
    below: &'a [Children],
    contents: &'a [Contents],
}

impl Measured<'_> {
    fn contents_of(&self, node: &Node) -> Contents {
        contents_of(node, self.contents)
    }
}

/// A subtree that another thread may collapse, below a lane of a node.
#[derive(Debug)]
struct Part {
    root: Node,
    node: usize,
    lane: usize,
}

/// The wide nodes over a subtree, and its runs. Their numbers count from 0 in each subtree.
#[derive(Debug)]
struct Collapse<'a> {
    binary: Measured<'a>,
    /// Subtrees of at most this many runs become parts.
    part_runs: u32,
    parts: Vec<Part>,
    nodes: Vec<WideNode>,
    /// The items of each block.
    runs: Vec<Run>,
}

impl<'a> Collapse<'a> {
    fn of(binary: Measured<'a>, root: Node, part_runs: u32) -> Collapse<'a> {
        let mut collapse = Collapse {
            binary,
            part_runs,
            parts: Vec::new(),
            nodes: Vec::new(),
            runs: Vec::new(),
        };
        collapse.node(root);
        collapse
    }

    /// Appends the node over `root`, and everything below it but for parts. Returns its index.
    ///
    /// Recursion is no deeper than the binary tree.
    fn node(&mut self, root: Node) -> u32 {
        let lanes = NodeLanes::below(root, self.binary);
        let place = self.nodes.len();
        let nodes = || lanes.nodes[..lanes.count].iter();
        self.nodes
            .push(WideNode::over(nodes().map(|node| node.bounds)));
        for (lane, node) in nodes().enumerate() {
            let Contents { run, runs } = self.binary.contents_of(node);
            let child = match run {
                Some(run) => self.blocks_of(run),
                None if runs <= self.part_runs => {
                    self.parts.push(Part {
                        root: *node,
                        node: place,
                        lane,
                    });
                    Child::default()
                }
                None => Child {
                    first: self.node(*node),
                    blocks: 0,
                },
            };
            self.nodes[place].children[lane] = child;
        }
        place as u32
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

/// The binary nodes that become the children of a wide node.
struct NodeLanes {
    count: usize,
    nodes: [Node; LANES],
    /// The number of runs of each node that can be opened; 0 for others.
    runs: [u32; LANES],
    areas: [f32; LANES],
}

impl NodeLanes {
    /// Opens `root`, and as many nodes below it as there is room for.
    fn below(root: Node, binary: Measured) -> NodeLanes {
        let mut lanes = NodeLanes {
            count: 1,
            nodes: [root; LANES],
            runs: [0; LANES],
            areas: [0.0; LANES],
        };
        lanes.put(0, root, binary);
        while lanes.count < LANES
            && let Some(lane) = lanes.lane_to_open()
        {
            let children = &binary.below[lanes.nodes[lane].first as usize];
            lanes.put(lane, children.node(0), binary);
            lanes.put(lanes.count, children.node(1), binary);
            lanes.count += 1;
        }
        lanes
    }

    #[inline]
    fn put(&mut self, lane: usize, node: Node, binary: Measured) {
        let Contents { run, runs } = binary.contents_of(&node);
        self.nodes[lane] = node;
        self.areas[lane] = node.bounds.half_area();
        self.runs[lane] = if run.is_some() { 0 } else { runs };
    }

    /// The largest node worth opening: one whose runs all fit into this wide node, or one with so
    /// many runs that its own wide node would be full anyway.
    #[inline]
    fn lane_to_open(&self) -> Option<usize> {
        let room = LANES - self.count + 1;
        let fits = |runs: u32| runs as usize > LANES || runs as usize <= room;
        let can_open = |lane: &usize| self.runs[*lane] > 0 && fits(self.runs[*lane]);
        let lanes = (0..self.count).filter(can_open);
        lanes.max_by(|a, b| self.areas[*a].total_cmp(&self.areas[*b]))
    }
}

/// Appends the parts to the nodes above them.
fn join(top: Collapse, parts: &[Collapse]) -> WideTree<Run> {
    let Collapse {
        mut nodes,
        mut runs,
        parts: places,
        ..
    } = top;
    let (mut node_count, mut run_count) = (nodes.len(), runs.len());
    let mut starts = Vec::with_capacity(parts.len());
    for (part, place) in parts.iter().zip(&places) {
        nodes[place.node].children[place.lane].first = node_count as u32;
        starts.push((node_count, run_count));
        node_count += part.nodes.len();
        run_count += part.runs.len();
    }
    let node = |index: usize| {
        let part = starts.partition_point(|(start, _)| *start <= index) - 1;
        let (first_node, first_run) = starts[part];
        parts[part].nodes[index - first_node].shifted(first_node as u32, first_run as u32)
    };
    nodes.par_extend((nodes.len()..node_count).into_par_iter().map(node));
    runs.reserve_exact(run_count - runs.len());
    for part in parts {
        runs.extend_from_slice(&part.runs);
    }
    WideTree {
        nodes,
        blocks: runs,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::space::Box32;

    /// Appends a balanced tree over `leaves` runs of sixteen items from `first` on, depth first.
    fn balanced(first: u32, leaves: u32, below: &mut Vec<Children>) -> Node {
        if leaves == 1 {
            let bounds = Box32 {
                low: [first as f32; 3],
                high: [first as f32 + 16.0; 3],
            };
            return Node::leaf(bounds, first, 16);
        }
        let place = below.len();
        below.push(Children::PLACEHOLDER);
        let left = balanced(first, leaves / 2, below);
        let right = balanced(first + leaves / 2 * 16, leaves - leaves / 2, below);
        below[place] = Children::new(&left, &right);
        Node::inner(left.bounds.union(&right.bounds), place as u32)
    }

    /// The runs below a node, whose box must lie within `bounds`. Counts nodes.
    fn runs_below(tree: &WideTree<Run>, node: u32, bounds: &Box32, nodes: &mut usize) -> Vec<Run> {
        *nodes += 1;
        let node = &tree.nodes[node as usize];
        let mut runs = Vec::new();
        for lane in (0..LANES).filter(|lane| node.used() >> lane & 1 == 1) {
            let child_bounds = Box32 {
                low: [0, 1, 2].map(|axis| node.low[axis][lane]),
                high: [0, 1, 2].map(|axis| node.high[axis][lane]),
            };
            assert!(bounds.contains(&child_bounds));
            let Child { first, blocks } = node.children[lane];
            if blocks == 0 {
                runs.extend(runs_below(tree, first, &child_bounds, nodes));
                continue;
            }
            for run in &tree.blocks[first as usize..][..blocks as usize] {
                let reach = [run.first, run.first + run.count].map(|x| x as f32);
                assert!(child_bounds.low[0] <= reach[0] && reach[1] <= child_bounds.high[0]);
                runs.push(*run);
            }
        }
        runs
    }

    #[test]
    fn a_tree_in_parts_holds_every_run_once() {
        for leaves in [1, 2, 17, PART_RUNS, PART_RUNS + 1, 5 * PART_RUNS + 3] {
            let mut below = Vec::new();
            let root = balanced(0, leaves, &mut below);
            let order = vec![(); leaves as usize * 16];
            let binary = BinaryTree {
                root: Some(root),
                below,
                order,
            };
            let tree = collapse(&binary);
            let mut nodes = 0;
            let mut runs = runs_below(&tree, 0, &root.bounds, &mut nodes);
            assert_eq!(nodes, tree.nodes.len(), "every node has one parent");
            runs.sort_by_key(|run| run.first);
            let expected = (0..leaves).map(|leaf| Run {
                first: leaf * 16,
                count: 16,
            });
            assert!(runs.into_iter().eq(expected), "{leaves} leaves");
        }
    }
}
