//! Checks that trees keep the promises that traversal relies on.

use crate::accel::Aggregate;
use crate::accel::space::Box32;
use crate::accel::tree::{BinaryTree, MAX_DEPTH, Node};
use crate::geometry::Bounds;
use crate::shape::Geometry;

impl Aggregate {
    /// Checks that every primitive that can be hit is in exactly one leaf, that every box encloses
    /// everything below it (for instances in the world), and that no tree is too deep. Tests call
    /// this after each build.
    ///
    /// # Errors
    /// Describes the first defect found.
    pub fn validate(&self, geometry: &Geometry) -> Result<(), String> {
        let own = |primitive: &_| {
            self.space
                .enclose(&geometry.own_surface(*primitive).bounds())
        };
        check(&self.tree, |node, primitive| {
            node.bounds.contains(&own(primitive))
        })?;
        let mut order = self.tree.order.clone();
        order.sort();
        let can_be_hit = |primitive: &_| geometry.own_surface(*primitive).can_be_hit();
        let expected = geometry.primitives().filter(can_be_hit);
        if !order.into_iter().eq(expected) {
            return Err("the leaves do not hold every primitive exactly once".into());
        }
        self.check_instances(geometry)
    }

    fn check_instances(&self, geometry: &Geometry) -> Result<(), String> {
        let tree = &self.instances.tree;
        check(tree, |_, _| true)?;
        for (leaf, _) in tree.nodes().filter(|(node, _)| node.is_leaf()) {
            for instance in tree.in_leaf(&leaf) {
                self.check_instance(geometry, *instance as usize, &leaf)?;
            }
        }
        let is_missing = |instance: usize| {
            let mut pose = geometry.pose(instance);
            let primitives = geometry.object_of(instance).primitives();
            let listed = tree.order.contains(&(instance as u32));
            let tree = listed.then(|| &self.instances.object(geometry, instance).tree.order);
            primitives
                .filter(|primitive| tree.is_none_or(|order| !order.contains(primitive)))
                .any(|primitive| pose.surface(primitive).can_be_hit())
        };
        match (0..geometry.instances().len()).find(|instance| is_missing(*instance)) {
            Some(instance) => Err(format!("a primitive of instance {instance} is missing")),
            None => Ok(()),
        }
    }

    fn check_instance(
        &self,
        geometry: &Geometry,
        instance: usize,
        leaf: &Node,
    ) -> Result<(), String> {
        let object = self.instances.object(geometry, instance);
        let placement = object.placement(&geometry.instances()[instance]);
        let mut pose = geometry.pose(instance);
        let mut bounds = |primitive: &_| {
            let surface = pose.surface(*primitive);
            if surface.can_be_hit() {
                surface.bounds()
            } else {
                Bounds::EMPTY
            }
        };
        let is_in_leaf = |bounds: &Bounds| {
            bounds.is_empty() || leaf.bounds.contains(&self.space.enclose(bounds))
        };
        let mut order = object.tree.order.iter();
        if !order.all(|primitive| is_in_leaf(&bounds(primitive))) {
            let message = format!("a primitive of instance {instance} is outside its leaf");
            return Err(message);
        }
        let in_world =
            |node: &Node| placement.enclose(&object.space.reveal(&node.bounds.corners()));
        check(&object.tree, |node, primitive| {
            let (inner, outer) = (bounds(primitive), in_world(node));
            inner.is_empty()
                || (0..3).all(|k| outer.low[k] < inner.low[k] && inner.high[k] < outer.high[k])
        })
    }
}

/// Checks that every item belongs to exactly one leaf, that boxes are within those above them, and
/// that all items satisfy `is_inside` with their leaf.
fn check<T>(
    tree: &BinaryTree<T>,
    mut is_inside: impl FnMut(&Node, &T) -> bool,
) -> Result<(), String> {
    let mut taken = vec![false; tree.order.len()];
    for (node, depth) in tree.nodes() {
        if depth > MAX_DEPTH {
            return Err(format!("a node has depth {depth}, more than {MAX_DEPTH}"));
        }
        let inside = if node.is_leaf() {
            let places = node.first as usize..node.first as usize + node.count as usize;
            let order = tree
                .order
                .get(places.clone())
                .ok_or("a leaf reaches beyond the last item")?;
            if taken[places.clone()].contains(&true) {
                return Err(format!("items {places:?} are in two leaves"));
            }
            taken[places].fill(true);
            order.iter().all(|item| is_inside(&node, item))
        } else {
            let children = &tree.below[node.first as usize];
            let bounds: [Box32; 2] = [0, 1].map(|side| children.node(side).bounds);
            bounds.iter().all(|bounds| node.bounds.contains(bounds))
        };
        if !inside {
            return Err(format!("something is outside the box of {node:?}"));
        }
    }
    if taken.contains(&false) {
        Err("an item is in no leaf".into())
    } else {
        Ok(())
    }
}
