//! The types that parameters are declared with, in the spellings of pbrt-v2, v3 and v4.

use crate::error::Diagnostic;
use crate::scene::parser::{NUMBER_TYPES, Parameter, Values};
use crate::scene::spelling;

/// The type that a parameter must be declared with, in any of its spellings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct DeclaredType(&'static [&'static str]);

impl DeclaredType {
    pub(crate) const FLOAT: DeclaredType = DeclaredType(&["float"]);
    pub(crate) const BOOLEAN: DeclaredType = DeclaredType(&["bool"]);
    pub(crate) const INTEGER: DeclaredType = DeclaredType(&["integer"]);
    pub(crate) const POINT2: DeclaredType = DeclaredType(&["point2", "float"]);
    pub(crate) const POINT: DeclaredType = DeclaredType(&["point3", "point"]);
    pub(crate) const NORMAL: DeclaredType = DeclaredType(&["normal", "normal3"]);
    pub(crate) const STRING: DeclaredType = DeclaredType(&["string"]);

    /// Why `parameter` is not declared with this type; `None` if it is.
    pub(super) fn refusal(self, parameter: &Parameter) -> Option<Diagnostic> {
        let found = &*parameter.type_name;
        if self.0.contains(&found) {
            return None;
        }
        let diagnostic = Diagnostic::new(format!("`{}` is declared as `{found}`", parameter.name));
        let spellings = self.0.join("` or `");
        Some(
            diagnostic.note(match spelling::closest(found, self.0.iter().copied()) {
                Some(known) => format!("did you mean `{known}`?"),
                None => format!("expected `{spellings}`"),
            }),
        )
    }
}

/// Why the values of `parameter` are not of its declared type; `None` if they are. An unknown type
/// may have any values.
pub(super) fn refusal_of_values(parameter: &Parameter) -> Option<Diagnostic> {
    let expected = match &*parameter.type_name {
        "bool" => "`true` or `false`",
        "string" | "texture" => "a string in quotes",
        name if NUMBER_TYPES.contains(&name) => "numbers",
        _ => return None,
    };
    let (found, fits) = match &parameter.values {
        Values::None => return None,
        Values::Numbers(_) => ("a number", expected == "numbers"),
        Values::Strings(_) => ("a string", expected == "a string in quotes"),
        Values::Booleans(_) => ("a boolean", expected == "`true` or `false`"),
    };
    if fits {
        return None;
    }
    let message = format!(
        "`{}` is declared as `{}`, but its value is {found}",
        parameter.name, parameter.type_name
    );
    Some(Diagnostic::new(message).note(format!("expected {expected}")))
}
