//! Hit and depth images of PBRT scenes: exact about geometry, and about nothing else.
//!
//! ```text
//! scene.pbrt -> directives -> Scene -> Aggregate -> tiles -> Image -> out.{exr,png,npy,pfm}
//!               scene::parser scene    accel        render   film
//! ```
//!
//! Each arrow is one module that knows its input and its output and nothing further on. `docs/design.md` tells why
//! it is built this way, `docs/accuracy.md` which numbers are rounded on the way.
//!
//! ```
//! use feimos::accel::{Aggregate, BuildOptions, Precision, SplitMethod};
//! use feimos::film::ChannelName;
//! use feimos::progress::Progress;
//! use feimos::render::{RenderOptions, render};
//! use feimos::scene::{LoadOptions, load};
//! use feimos::simd::Level;
//! use std::path::Path;
//!
//! let options = LoadOptions { resolution: Some([40, 40]), ..LoadOptions::default() };
//! let scene = load(Path::new("scenes/sphere.pbrt"), &options, Progress::SILENT)?;
//! let anchor = scene.camera.anchor();
//! let aggregate = Aggregate::build(&scene.geometry, anchor, BuildOptions::new(SplitMethod::Sah), Progress::SILENT);
//! let options = RenderOptions {
//!     data_window: scene.film.crop,
//!     channels: vec![ChannelName::Z],
//!     miss: f32::INFINITY,
//!     counted: false,
//!     level: Level::detect(),
//!     precision: Precision::Exact,
//! };
//! let rendering = render(&scene.camera, &scene.geometry, &aggregate, &options, Progress::SILENT)?;
//! let depths = rendering.image.measures(ChannelName::Z).expect("the channel asked for");
//! assert_eq!(depths[0], f32::INFINITY);
//! let nearest = depths.iter().copied().fold(f32::INFINITY, f32::min);
//! assert!((nearest - 3.0).abs() < 1e-3, "the sphere's near side is 3 units away");
//! # Ok::<(), feimos::error::Error>(())
//! ```

pub mod accel;
pub mod bench;
pub mod camera;
pub mod compare;
pub mod decimal;
pub mod digest;
pub mod error;
pub mod exact;
pub mod file_id;
pub mod film;
pub mod geometry;
pub mod input;
pub mod json;
mod memory;
pub mod merge;
pub mod mesh;
pub mod named;
pub mod pixel;
pub mod progress;
pub mod reference;
pub mod render;
pub mod scene;
pub mod shape;
pub mod simd;
pub mod terminal_text;
