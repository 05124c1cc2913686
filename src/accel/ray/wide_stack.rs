//! The children that one ray has still to visit in a wide tree.

use crate::accel::tree::Child;

/// A child to visit, which the ray enters at `near`, in scaled units.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pending {
    pub(super) near: f32,
    pub(super) child: Child,
}

/// The children to visit, the next one last: up to fifteen for each level of the tree.
#[derive(Debug, Default)]
pub(super) struct WideStack {
    pending: Vec<Pending>,
}

impl WideStack {
    /// Starts at the root.
    #[inline(always)]
    pub(super) fn start(&mut self) {
        self.pending.clear();
        self.pending.push(Pending {
            near: 0.0,
            child: Child {
                first: 0,
                blocks: 0,
            },
        });
    }

    /// The number of children, for [`WideStack::insert`].
    #[inline(always)]
    pub(super) fn len(&self) -> usize {
        self.pending.len()
    }

    /// Removes the next child that is entered no later than `limit`.
    #[inline(always)]
    pub(super) fn pop(&mut self, limit: f32) -> Option<Pending> {
        while let Some(next) = self.pending.pop() {
            if next.near <= limit {
                return Some(next);
            }
        }
        None
    }

    /// Inserts a child so that those from index `bottom` on stay in order, the nearest last.
    #[inline(always)]
    pub(super) fn insert(&mut self, bottom: usize, pending: Pending) {
        self.pending.push(pending);
        let mut place = self.pending.len() - 1;
        while place > bottom && self.pending[place - 1].near < pending.near {
            self.pending[place] = self.pending[place - 1];
            place -= 1;
        }
        self.pending[place] = pending;
    }
}
