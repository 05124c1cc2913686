//! Reads a number that may be in a list of its own.

use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};
use std::fmt::{self, Formatter};

/// A number, or a list of one number: NumPy writes the rows of a column vector so, and OpenCV's
/// `solvePnP` returns t as one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scalar(pub(super) f64);

impl<'de> Deserialize<'de> for Scalar {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Scalar, D::Error> {
        deserializer.deserialize_any(ScalarVisitor)
    }
}

struct ScalarVisitor;

impl<'de> Visitor<'de> for ScalarVisitor {
    type Value = Scalar;

    fn expecting(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or a list of one number")
    }

    fn visit_f64<E>(self, number: f64) -> Result<Scalar, E> {
        Ok(Scalar(number))
    }

    fn visit_u64<E>(self, number: u64) -> Result<Scalar, E> {
        Ok(Scalar(number as f64))
    }

    fn visit_i64<E>(self, number: i64) -> Result<Scalar, E> {
        Ok(Scalar(number as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Scalar, A::Error> {
        match (list.next_element()?, list.next_element::<f64>()?) {
            (Some(number), None) => Ok(Scalar(number)),
            (found, _) => Err(Error::invalid_length(
                if found.is_some() { 2 } else { 0 },
                &self,
            )),
        }
    }
}
