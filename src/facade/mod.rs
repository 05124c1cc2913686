//! The front door of the library: the types at the root of the crate.

mod accelerator;
mod camera;
mod channel;
mod hit;
mod image;
mod load_options;
mod ray;
mod scene;
mod shared_scene;
mod structure;
mod tracer_pool;

pub use accelerator::Accelerator;
pub use camera::Camera;
pub use channel::Channel;
pub use hit::Hit;
pub use image::Image;
pub use load_options::LoadOptions;
pub use ray::Ray;
pub use scene::Scene;
pub use structure::Structure;
