//! Whether a tree is what a traversal takes it for.

use super::Aggregate;
use super::build::MAX_DEPTH;
use super::statistics::walk;
use crate::shape::Shapes;

impl Aggregate {
    /// Checks that every primitive that can be hit is in exactly one leaf, and every box around all that is below it;
    /// and that the tree is not too deep. Tests call it after each build.
    ///
    /// # Errors
    /// What is wrong, in words.
    pub fn validate(&self, shapes: &Shapes) -> Result<(), String> {
        let Some(root) = self.root else {
            return self.check_primitives(shapes);
        };
        let mut taken = vec![false; self.order.len()];
        for (node, depth) in walk(root, &self.below) {
            if depth > MAX_DEPTH {
                return Err(format!("a node at depth {depth}, but stacks are for {MAX_DEPTH}"));
            }
            let inside = if node.is_leaf() {
                let places = node.first as usize..node.first as usize + node.count as usize;
                let order = self.order.get(places.clone()).ok_or("a leaf beyond the end")?;
                if taken[places.clone()].contains(&true) {
                    return Err(format!("places {places:?} are in two leaves"));
                }
                taken[places].fill(true);
                order.iter().all(|primitive| node.bounds.contains(&self.space.enclose(&shapes.bounds(*primitive))))
            } else {
                let children = &self.below[node.first as usize];
                [0, 1].iter().all(|side| node.bounds.contains(&children.node(*side).bounds))
            };
            if !inside {
                return Err(format!("something is outside the box of {node:?}"));
            }
        }
        if taken.contains(&false) {
            return Err("a place is in no leaf".into());
        }
        self.check_primitives(shapes)
    }

    fn check_primitives(&self, shapes: &Shapes) -> Result<(), String> {
        let mut order = self.order.clone();
        order.sort();
        let expected = shapes.primitives().filter(|primitive| shapes.can_be_hit(*primitive));
        if order.into_iter().eq(expected) { Ok(()) } else { Err("not every primitive is there once".into()) }
    }
}
