//! Objects and their instances among the geometry of a scene.

use super::{CapacityError, FirstNumber, Geometry};
use crate::geometry::Matrix;
use crate::shape::object::{Instance, Object, Pose};
use crate::shape::{InstancedId, Primitive, Triangle};

/// In place of an object's number, where the object is still to come.
const UNDEFINED: u32 = u32::MAX;

impl Geometry {
    /// Adds an object, of which there is no instance yet; returns its number. Its geometry has no instances itself.
    pub fn add_object(&mut self, geometry: Geometry) -> usize {
        self.objects.push(Object::new(geometry));
        self.objects.len() - 1
    }

    /// Adds an instance of an object that was added; its primitives are numbered next.
    pub fn add_instance(
        &mut self,
        object: usize,
        world_from_instance: Matrix,
    ) -> Result<(), CapacityError> {
        self.push_instance(object as u32, world_from_instance)?;
        self.instanced += self.objects[object].geometry().number_count();
        Ok(())
    }

    /// Adds an instance of an object that is still to come; returns its number for [`Geometry::define_instances`],
    /// which has to follow.
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

    /// Says of which objects the undefined instances are, as pairs of an instance and an object, and numbers all
    /// primitives anew: those of an instance where it stands.
    pub fn define_instances(&mut self, objects: &[(usize, usize)]) {
        // The primitives in no instance that come before each instance, which do not change.
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
        // Numbers of instances before the first instance, the second, and so on; last all of them.
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

    /// Primitive numbers of an instance; none while its object is undefined.
    fn numbers_in(&self, instance: usize) -> u64 {
        let object = self.objects.get(self.instances[instance].object());
        object.map_or(0, |object| object.geometry().number_count())
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
        Pose::new(
            self.object_of(instance).geometry(),
            self.instances[instance].world_from_instance,
        )
    }

    /// Primitive numbers in use, each primitive as often as there are instances of it: triangles and quadrics, and
    /// those of surfaces that are left out.
    pub fn primitive_count(&self) -> u64 {
        self.number_count() + self.instanced
    }

    /// Whether there are too many primitives for `prim` channels to count them all: then they count within the instance.
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

    /// A primitive of a tree, in world space, if any ray can hit it: trees of objects hold what can be hit in some instance, not
    /// in each.
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

    /// All primitives, those of instances as often as there are instances.
    pub fn all(&self) -> impl Iterator<Item = InstancedId> {
        let instances = 0..self.instances.len();
        let instanced = instances.flat_map(|instance| {
            let primitives = self.object_of(instance).geometry().primitives();
            primitives.map(move |primitive| InstancedId::in_instance(instance, primitive))
        });
        self.primitives().map(InstancedId::alone).chain(instanced)
    }
}
