//! Shapes, one file a kind: what their parameters mean.

mod arrays;
mod bilinear_mesh;
mod mesh_file;
mod quadrics;
mod subdivision_surface;
mod triangle_mesh;
