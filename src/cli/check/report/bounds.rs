//! A box in the world.

use crate::cli::terminal::words::triple;
use crate::geometry;
use serde::Serialize;
use std::fmt::{self, Display, Formatter};

/// A box that is not empty. Field names are JSON keys.
#[derive(Debug, Serialize)]
pub(super) struct Bounds {
    low: [f64; 3],
    high: [f64; 3],
}

impl Bounds {
    /// `None` for an empty box.
    pub(super) fn of(bounds: &geometry::Bounds) -> Option<Bounds> {
        (!bounds.is_empty()).then(|| Bounds {
            low: bounds.low.to_array(),
            high: bounds.high.to_array(),
        })
    }
}

impl Display for Bounds {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} to {}", triple(self.low), triple(self.high))
    }
}
