//! The `Shape` directive among what surrounds it: numbers, transforms, materials, objects.

use super::builder::Builder;
use super::objects::Definition;
use super::parameters::Parameters;
use super::parser::{Entity, Span};
use super::shape_statement::{ShapeTarget, is_supported};
use super::source::Source;
use crate::error::Result;
use std::rc::Rc;
use std::sync::Arc;

impl Builder<'_> {
    pub(super) fn shape(
        &mut self,
        entity: &Entity,
        keyword: &Span,
        source: &Rc<Source>,
    ) -> Result<()> {
        self.check_in_world("Shape", keyword, source)?;
        let number = self.next_shape(entity, keyword, source)?;
        let name = &entity.name.text;
        let bounds_medium = self.state.material.only_bounds_media(self.state.is_light);
        if bounds_medium {
            self.census.add_boundary(name, || source.at(keyword));
        } else if is_supported(name) {
            self.check_usable("Shape", keyword, source)?;
            self.warn_if_moving(keyword, source);
        }
        self.materials
            .wait(&self.state.material, number, self.state.is_light);
        let is_in_object = self.objects.open.is_some();
        let (geometry, transforms) = match &mut self.objects.open {
            Some(Definition {
                geometry,
                transforms,
                ..
            }) => (geometry, transforms),
            None => (&mut self.geometry, &mut self.transforms),
        };
        let world_from_object = self.state.current.matrix;
        let is_turned = || self.state.reverses_orientation != world_from_object.swaps_handedness();
        let mut target = ShapeTarget {
            geometry,
            transforms,
            warnings: &mut self.warnings,
            directory: &self.directory,
            files: &mut self.files,
            number,
            world_from_object,
            is_in_object,
            keeps_orientation: self.keeps_orientation,
            is_turned: self.keeps_orientation && is_turned(),
            keeps_uv: self.keeps_uv,
            bounds_medium,
            budget: &self.budget,
            mesh_cache: &mut self.mesh_cache,
        };
        let before = target.geometry.own_count();
        let is_added = target.add(Parameters::of_shape(entity, source, &self.state.defaults)?)?;
        let added = target.geometry.own_count() - before;
        self.census.count_shape(name, is_added.then_some(added));
        Ok(())
    }

    /// The number of a `Shape` statement, and its place where that is wanted.
    fn next_shape(&mut self, entity: &Entity, keyword: &Span, source: &Rc<Source>) -> Result<u32> {
        let Some(number) = self.shape_count.checked_add(1) else {
            return Err(source.error(
                keyword,
                format!("the scene has more than {} shapes", u32::MAX),
            ));
        };
        self.shape_count = number;
        let name = &entity.name.text;
        if let Some(places) = &mut self.places {
            match source.is_spliced() {
                true => places.add_shape_at(name, &source.at(keyword)),
                false => places.add_shape(name, keyword, &source.text),
            }
        }
        if let (Some(roundings), Some(rounded)) = (&mut self.roundings, &self.state.rounded) {
            roundings.shapes.push(Arc::clone(rounded));
        }
        Ok(number)
    }
}
