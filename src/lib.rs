//! Hit and depth images of PBRT scenes, exact in geometry and free of shading.
//!
//! ```text
//! scene.pbrt -> directives -> Scene -> Aggregate -> tiles -> Image -> out.{exr,png,npy,pfm}
//!               scene::parser scene    accel        render   film
//! ```
//!
//! Each arrow is a module that knows its input and its output, but nothing further on.
//! `docs/design.md` explains the design, `docs/accuracy.md` lists the numbers that are rounded.
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
//! let build = BuildOptions::new(SplitMethod::Sah);
//! let aggregate = Aggregate::build(&scene.geometry, anchor, build, Progress::SILENT);
//! let options = RenderOptions {
//!     data_window: scene.film.crop,
//!     channels: vec![ChannelName::Z],
//!     miss: f32::INFINITY,
//!     level: Level::detect(),
//!     precision: Precision::Exact,
//! };
//! let rendering = render(&scene.camera, &scene.geometry, &aggregate, &options, Progress::SILENT)?;
//! let depths = rendering.image.measures(ChannelName::Z).expect("a requested channel");
//! assert_eq!(depths[0], f32::INFINITY);
//! let nearest = depths.iter().copied().fold(f32::INFINITY, f32::min);
//! assert!((nearest - 3.0).abs() < 1e-3, "the sphere's near side is 3 units away");
//! # Ok::<(), feimos::error::Error>(())
//! ```

pub mod accel;
pub mod bench;
pub mod boxes;
pub mod camera;
#[cfg(feature = "cli")]
pub mod cli;
pub mod compare;
pub mod decimal;
pub mod digest;
pub mod error;
pub mod exact;
pub mod file_id;
pub mod film;
pub mod geometry;
#[cfg(target_os = "linux")]
pub mod huge_pages;
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
pub mod survey;
pub mod terminal_text;
pub mod texture;

/// The Rust of the documents, as doc tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Documents;
