//! Tests curves against the reference, against hits computed by hand, and against the formula of
//! the curve itself.

mod by_hand;
#[path = "../common/mod.rs"]
mod common;
mod hair;
mod random;
