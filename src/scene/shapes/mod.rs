//! Shapes, one file a kind: what their parameters mean.

mod arrays;
mod bilinear_mesh;
mod mesh_file;
mod sphere;
mod subdivision_surface;
mod triangle_mesh;
