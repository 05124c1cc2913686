//! The way of a tile down the tree.

use super::block::Block;
use super::frame::{Frame, TILE};
use super::pixels::{BLOCKS, Pixels};
use super::view::View;
use super::view_node::ViewNode;
use super::wide_tree::Child;
use crate::simd::{F32s, LANES, Lanes, Mask};

/// A child that waits.
#[derive(Debug, Clone, Copy)]
pub(super) struct Waiting {
    /// Nothing in it is nearer.
    nearness: f32,
    /// The blocks of pixels that may see it, block k as bit k.
    blocks: u32,
    pub(super) child: Child,
}

/// Children that wait; the next one last.
#[derive(Debug, Default)]
pub(super) struct Stack {
    waiting: Vec<Waiting>,
}

/// The tree as a view sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct ViewTree<'a> {
    pub(super) nodes: &'a [ViewNode],
    pub(super) blocks: &'a [Block],
}

/// How near something must be for a block of pixels to be worth a look.
#[derive(Debug, Clone, Copy)]
pub(super) struct Occlusion {
    factor: f32,
    difference: f32,
}

impl Occlusion {
    /// What is farther than all hits of a block by more than nearness may be off.
    #[inline]
    pub(super) fn of(view: &View, is_exact: bool) -> Occlusion {
        match (is_exact, view.is_perspective) {
            (false, _) => Occlusion {
                factor: 1.0,
                difference: 0.0,
            },
            (true, true) => Occlusion {
                factor: 1.0 - 4.0 * view.tolerance,
                difference: 0.0,
            },
            (true, false) => Occlusion {
                factor: 1.0,
                difference: 4.0 * view.tolerance,
            },
        }
    }

    /// The least nearness worth a look, where the best hit has nearness `best`.
    #[inline(always)]
    pub(super) fn least(&self, best: f32) -> f32 {
        best * self.factor - self.difference
    }

    /// Brings the blocks that changed up to date, and returns the least nearness worth a look in the whole tile.
    #[inline(always)]
    pub(super) fn refresh<S: Lanes>(&self, simd: S, pixels: &mut Pixels) -> f32 {
        let mut changed = pixels.changed;
        while changed != 0 {
            let block = changed.trailing_zeros() as usize;
            changed &= changed - 1;
            pixels.farthest[block] = self.least(simd.load(&pixels.nearness[block]).least());
        }
        pixels.changed = 0;
        simd.load(&pixels.farthest).least()
    }
}

/// Blocks of pixels between two columns or rows, by the place of the first and the last block.
const COLUMNS: [[u32; 4]; 4] = ranges(0x1111, 1);
const ROWS: [[u32; 4]; 4] = ranges(0x000f, 4);

/// The union of `one << k * step` for k from the first to the second index.
const fn ranges(one: u32, step: u32) -> [[u32; 4]; 4] {
    let mut ranges = [[0; 4]; 4];
    let mut first = 0;
    while first < 4 {
        let mut last = first;
        let mut all = 0;
        while last < 4 {
            all |= one << (last as u32 * step);
            ranges[first][last] = all;
            last += 1;
        }
        first += 1;
    }
    ranges
}

/// The blocks between the first and the last column and row of pixels.
#[inline(always)]
pub(super) fn blocks_between(columns: [i32; 2], rows: [i32; 2]) -> u32 {
    let place = |pixel: i32| (pixel as usize >> 2) & 3;
    COLUMNS[place(columns[0])][place(columns[1])] & ROWS[place(rows[0])][place(rows[1])]
}

impl Stack {
    /// Starts at the root.
    pub(super) fn start(&mut self) {
        self.waiting.clear();
        let child = Child {
            first: 0,
            blocks: 0,
        };
        self.waiting.push(Waiting {
            nearness: f32::INFINITY,
            blocks: (1 << BLOCKS) - 1,
            child,
        });
    }

    /// The next child that some block of pixels may see.
    #[inline(always)]
    pub(super) fn pop<S: Lanes>(&mut self, simd: S, pixels: &Pixels) -> Option<Child> {
        while let Some(waiting) = self.waiting.pop() {
            let hidden = simd
                .load(&pixels.farthest)
                .above(simd.splat(waiting.nearness))
                .bits();
            if waiting.blocks & !hidden != 0 {
                return Some(waiting.child);
            }
        }
        None
    }

    /// Adds the children of `node` that the tile may see, the nearest last. `nodes` are those that they may be, to be fetched.
    #[inline(always)]
    pub(super) fn push<S: Lanes, N>(
        &mut self,
        simd: S,
        frame: &Frame,
        nodes: &[N],
        node: &ViewNode,
        pixels: &Pixels,
        farthest: f32,
    ) {
        let (zero, whole) = (simd.splat(0.0), simd.splat(TILE as f32 - 1.0));
        let nearness = simd.load(&node.nearness);
        let mut ends = [[[0i32; LANES]; 2]; 2];
        let mut seen = !simd.splat(farthest).above(nearness);
        for (axis, sides) in [&node.columns, &node.rows].into_iter().enumerate() {
            let first_pixel = simd.splat(frame.first[axis] as f32);
            let first = (simd.load(&sides[0]) - first_pixel).ceil().max(zero);
            let last = (simd.load(&sides[1]) - first_pixel).floor().min(whole);
            seen = seen & !first.above(last);
            first.store_whole(&mut ends[axis][0]);
            last.store_whole(&mut ends[axis][1]);
        }
        let mut seen = seen.bits() & node.visible;
        let bottom = self.waiting.len();
        let farthest = simd.load(&pixels.farthest);
        while seen != 0 {
            let lane = seen.trailing_zeros() as usize;
            seen &= seen - 1;
            let side = |axis: usize| [ends[axis][0][lane], ends[axis][1][lane]];
            let nearness = node.nearness[lane];
            let blocks = blocks_between(side(0), side(1));
            if blocks & !farthest.above(simd.splat(nearness)).bits() == 0 {
                continue;
            }
            let child = node.children[lane];
            if child.blocks == 0 {
                simd.prefetch(&nodes[child.first as usize]);
            }
            self.insert(
                bottom,
                Waiting {
                    nearness,
                    blocks,
                    child,
                },
            );
        }
    }

    /// Keeps those from place `bottom` on in order.
    #[inline(always)]
    fn insert(&mut self, bottom: usize, waiting: Waiting) {
        self.waiting.push(waiting);
        let mut place = self.waiting.len() - 1;
        while place > bottom && self.waiting[place - 1].nearness > waiting.nearness {
            self.waiting[place] = self.waiting[place - 1];
            place -= 1;
        }
        self.waiting[place] = waiting;
    }
}
