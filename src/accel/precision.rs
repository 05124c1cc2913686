//! Exact or fast decisions.

use std::fmt;
use std::str::FromStr;

/// How hits are decided and rounded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Precision {
    /// The right result: `f64` if its error is known to be small enough, otherwise exact integers.
    #[default]
    Exact,
    /// Plain `f32` arithmetic without error bounds.
    Fast,
}

impl Precision {
    /// All of them.
    pub const ALL: [Precision; 2] = [Precision::Exact, Precision::Fast];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Precision::Exact => "exact",
            Precision::Fast => "fast",
        }
    }
}

impl fmt::Display for Precision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The name is none of the known ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct UnknownPrecision;

impl fmt::Display for UnknownPrecision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = Precision::ALL.map(Precision::name);
        write!(f, "expected one of {}", names.join(", "))
    }
}

impl std::error::Error for UnknownPrecision {}

impl FromStr for Precision {
    type Err = UnknownPrecision;

    fn from_str(name: &str) -> Result<Precision, UnknownPrecision> {
        Precision::ALL
            .into_iter()
            .find(|precision| precision.name() == name)
            .ok_or(UnknownPrecision)
    }
}
