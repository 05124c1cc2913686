//! Objects and their instances.

use super::Geometry;
use super::instance::Instance;
use super::pose::Pose;
use super::runs::{CapacityError, FirstNumber};
use crate::geometry::Matrix;
use crate::shape::{InstancedId, Primitive, Triangle};

/// Stands for the number of an object that is not defined yet.
const UNDEFINED: u32 = u32::MAX;

impl Geometry {
    /// Adds an object, and returns its number. Its geometry has no instances.
    pub fn add_object(&mut self, geometry: Geometry) -> usize {
        self.has_cut_outs |= geometry.has_cut_outs;
        self.objects.push(geometry);
        self.objects.len() - 1
    }

    /// Adds an instance of an object. Its primitives get the next numbers.
    pub fn add_instance(
        &mut self,
        object: usize,
        world_from_instance: Matrix,
    ) -> Result<(), CapacityError> {
        self.push_instance(object as u32, world_from_instance)?;
        self.instanced += self.objects[object].number_count();
        Ok(())
    }

    /// Adds an instance of an object that is not defined yet, and returns its number for
    /// [`Geometry::define_instances`], which must follow.
    pub fn add_undefined_instance(
        &mut self,
        world_from_instance: Matrix,
    ) -> Result<usize, CapacityError> {
        self.push_instance(UNDEFINED, world_from_instance)?;
        self.ends_run = true;
        Ok(self.instances.len() - 1)
    }

    fn push_instance(
        &mut self,
        object: u32,
        world_from_instance: Matrix,
    ) -> Result<(), CapacityError> {
        if self.instances.len() == InstancedId::MAX_INSTANCES {
            return Err(CapacityError {
                what: "instances",
                limit: InstancedId::MAX_INSTANCES as u64,
            });
        }
        let first_number = self.instanced + self.number_count();
        self.instances.push(Instance {
            world_from_instance,
            first_number,
            object,
        });
        Ok(())
    }

    /// Defines the objects of undefined instances, as pairs of an instance and an object, and
    /// renumbers all primitives in the order of the file.
    pub fn define_instances(&mut self, objects: &[(usize, usize)]) {
        // The number of primitives in no instance before each instance, which does not change.
        let mut instanced = 0;
        let alone: Vec<u64> = (0..self.instances.len())
            .map(|instance| {
                let alone = self.instances[instance].first_number - instanced;
                instanced += self.numbers_in(instance);
                alone
            })
            .collect();
        for (instance, object) in objects {
            self.instances[*instance].object = *object as u32;
        }
        // The number of instanced primitives before each instance; the last entry counts all.
        let mut before = vec![0; self.instances.len() + 1];
        for instance in 0..self.instances.len() {
            self.instances[instance].first_number = alone[instance] + before[instance];
            before[instance + 1] = before[instance] + self.numbers_in(instance);
        }
        let instances_before =
            |run: &FirstNumber| alone.partition_point(|alone| *alone <= u64::from(run.alone));
        let of_meshes = self.meshes.iter_mut().map(|run| &mut run.first_number);
        for number in of_meshes.chain(
            self.quadric_runs
                .iter_mut()
                .map(|run| &mut run.first_number),
        ) {
            number.instanced = before[instances_before(number)];
        }
        self.instanced = before[self.instances.len()];
    }

    /// The number of primitives of an instance; 0 while its object is undefined.
    fn numbers_in(&self, instance: usize) -> u64 {
        let object = self.objects.get(self.instances[instance].object());
        object.map_or(0, Geometry::number_count)
    }

    /// The objects.
    pub fn objects(&self) -> &[Geometry] {
        &self.objects
    }

    /// The instances of objects, in the order of the file.
    pub fn instances(&self) -> &[Instance] {
        &self.instances
    }

    /// The object of an instance.
    #[inline]
    pub fn object_of(&self, instance: usize) -> &Geometry {
        &self.objects[self.instances[instance].object()]
    }

    /// The object of an instance, at the place of the instance.
    #[inline]
    pub fn pose(&self, instance: usize) -> Pose<'_> {
        Pose::new(
            self.object_of(instance),
            self.instances[instance].world_from_instance,
        )
    }

    /// The number of primitives, each as often as it is instanced, including those of surfaces that
    /// are left out.
    pub fn primitive_count(&self) -> u64 {
        self.number_count() + self.instanced
    }

    /// Whether there are too many primitives for `prim` channels to count all of them: then they
    /// count within the instance.
    pub fn counts_within_instances(&self) -> bool {
        self.primitive_count() > u64::from(u32::MAX)
    }

    /// A primitive, in world space (rule R4).
    #[inline]
    pub fn surface(&self, placed: InstancedId) -> Primitive {
        match placed.instance() {
            None => self.own_surface(placed.primitive()),
            Some(instance) => self.pose(instance).surface(placed.primitive()),
        }
    }

    /// A primitive of a tree, in world space, if any ray can hit it: trees of objects contain
    /// primitives that can be hit in some instance, but perhaps not in this one.
    #[inline]
    pub(crate) fn surface_in_tree(&self, placed: InstancedId) -> Option<Primitive> {
        let surface = self.surface(placed);
        (placed.instance().is_none() || surface.can_be_hit()).then_some(surface)
    }

    /// A triangle, in world space (rule R4).
    #[inline]
    pub fn placed_triangle(&self, placed: InstancedId) -> Triangle {
        let index = placed.primitive().index();
        match placed.instance() {
            None => self.triangle(index),
            Some(instance) => self.pose(instance).triangle(index),
        }
    }

    /// All primitives, each as often as it is instanced.
    pub fn all(&self) -> impl Iterator<Item = InstancedId> {
        let instances = 0..self.instances.len();
        let instanced = instances.flat_map(|instance| {
            let primitives = self.object_of(instance).primitives();
            primitives.map(move |primitive| InstancedId::in_instance(instance, primitive))
        });
        self.primitives().map(InstancedId::alone).chain(instanced)
    }
}
