//! Embree's C interface, and a safe one over the part that is used. The only unsafe code of this crate.

#![allow(unsafe_code)]

mod device;
mod ffi;
mod packet;
mod ray;
mod scene;

pub(crate) use device::Device;
pub(super) use packet::{LANES, Packet};
pub(super) use ray::closest_hit;
pub(crate) use scene::{Input, Quality, Scene};
