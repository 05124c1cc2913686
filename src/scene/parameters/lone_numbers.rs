//! Single numbers whose declared type does not matter.

use super::Parameters;
use crate::scene::parser::{Parameter, Values};

impl Parameters<'_> {
    /// A single number, whatever the declared type.
    pub(in crate::scene) fn lone_number(&mut self, name: &'static str) -> Option<f64> {
        number(self.find(name)?.0)
    }

    /// Like [`Parameters::lone_number`], of a parameter that hardly ever matters: no warning tells
    /// that it is repeated.
    pub(in crate::scene) fn unchecked_number(&self, name: &str) -> Option<f64> {
        number(self.last(name)?.0)
    }
}

fn number(parameter: &Parameter) -> Option<f64> {
    match &parameter.values {
        Values::Numbers(numbers) if numbers.len() == 1 => Some(numbers[0]),
        _ => None,
    }
}
