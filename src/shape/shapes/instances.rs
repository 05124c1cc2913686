//! Objects and their instances among the geometry of a scene.

use super::{CapacityError, Shapes};
use crate::geometry::Matrix;
use crate::shape::object::{Instance, Object, Pose};
use crate::shape::{Placed, Surface, Triangle};

impl Shapes {
    /// Adds an object, of which there is no instance yet; returns its number. Its geometry has no instances itself.
    pub fn add_object(&mut self, shapes: Shapes) -> usize {
        self.objects.push(Object::new(shapes));
        self.objects.len() - 1
    }

    /// Adds an instance of an object that was added; its primitives are numbered next.
    pub fn add_instance(&mut self, object: usize, world_from_instance: Matrix) -> Result<(), CapacityError> {
        if self.instances.len() == Placed::MAX_INSTANCES {
            return Err(CapacityError { what: "instances", limit: Placed::MAX_INSTANCES as u64 });
        }
        let first_number = self.instanced + self.own_count() as u64;
        self.instanced += self.objects[object].shapes().own_count() as u64;
        self.instances.push(Instance { world_from_instance, first_number, object: object as u32 });
        Ok(())
    }

    /// The objects that instances are of.
    pub fn objects(&self) -> &[Object] {
        &self.objects
    }

    /// The instances of objects, in the order of the file.
    pub fn instances(&self) -> &[Instance] {
        &self.instances
    }

    /// The object of an instance.
    #[inline]
    pub fn object_of(&self, instance: usize) -> &Object {
        &self.objects[self.instances[instance].object()]
    }

    /// The object of an instance where the instance places it.
    #[inline]
    pub fn pose(&self, instance: usize) -> Pose<'_> {
        Pose::new(self.object_of(instance).shapes(), self.instances[instance].world_from_instance)
    }

    /// Triangles and spheres, each as often as there are instances of it.
    pub fn primitive_count(&self) -> u64 {
        self.own_count() as u64 + self.instanced
    }

    /// Whether there are too many primitives for `prim` channels to count them all: then they count within the instance.
    pub fn counts_within_instances(&self) -> bool {
        self.primitive_count() > u64::from(u32::MAX)
    }

    /// A primitive, in world space (rule R4).
    #[inline]
    pub fn surface(&self, placed: Placed) -> Surface {
        match placed.instance() {
            None => self.own_surface(placed.primitive()),
            Some(instance) => self.pose(instance).surface(placed.primitive()),
        }
    }

    /// A primitive of a tree, in world space, if any ray can hit it: trees of objects hold what can be hit in some instance, not
    /// in each.
    #[inline]
    pub(crate) fn surface_in_tree(&self, placed: Placed) -> Option<Surface> {
        let surface = self.surface(placed);
        (placed.instance().is_none() || surface.can_be_hit()).then_some(surface)
    }

    /// A triangle, in world space (rule R4).
    #[inline]
    pub fn placed_triangle(&self, placed: Placed) -> Triangle {
        let index = placed.primitive().index();
        match placed.instance() {
            None => self.triangle(index),
            Some(instance) => self.pose(instance).triangle(index),
        }
    }

    /// All primitives, those of instances as often as there are instances.
    pub fn all(&self) -> impl Iterator<Item = Placed> {
        let instances = 0..self.instances.len();
        let instanced = instances.flat_map(|instance| {
            let primitives = self.object_of(instance).shapes().primitives();
            primitives.map(move |primitive| Placed::in_instance(instance, primitive))
        });
        self.primitives().map(Placed::alone).chain(instanced)
    }
}
