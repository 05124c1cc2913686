//! The front door of the library: the types at the root of the crate.

mod camera;
mod hit;
mod image;
mod load_options;
mod ray;
mod scene;
mod shared_scene;
mod structure;
mod tracer_pool;

pub use camera::Camera;
pub use hit::Hit;
pub use image::Image;
pub use load_options::LoadOptions;
pub use ray::Ray;
pub use scene::Scene;
pub use structure::Structure;
