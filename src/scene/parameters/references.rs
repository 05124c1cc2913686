//! Parameters that name textures, and booleans.

use super::{DeclaredType, Parameters};
use crate::error::Result;
use crate::scene::parser::{Text, Values};

impl<'a> Parameters<'a> {
    /// The name of a texture, if the parameter is declared as one.
    pub(crate) fn texture(&mut self, name: &'static str) -> Result<Option<&'a Text<'a>>> {
        let Some((parameter, file)) = self.find(name) else {
            return Ok(None);
        };
        if parameter.type_name != "texture" {
            return Ok(None);
        }
        match &parameter.values {
            Values::Strings(names) if names.len() == 1 && !names[0].text.is_empty() => {
                Ok(Some(&names[0]))
            }
            _ => {
                let message = format!("`{name}` takes the name of one texture");
                Err(file.error(&parameter.values_span, message))
            }
        }
    }

    /// One boolean, declared as `bool`.
    pub(crate) fn boolean(&mut self, name: &'static str) -> Result<Option<bool>> {
        let Some((parameter, file)) = self.find_declared(name, DeclaredType::BOOLEAN)? else {
            return Ok(None);
        };
        match &parameter.values {
            Values::Booleans(values) if values.len() == 1 => Ok(Some(values[0])),
            _ => {
                let message = format!("`{name}` takes `true` or `false`");
                Err(file.error(&parameter.values_span, message))
            }
        }
    }
}
