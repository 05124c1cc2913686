//! Exact hit and depth images of [PBRT](https://pbrt.org) scenes and meshes.
//!
//! For every pixel, or for rays of your own, the library computes whether the ray hits something,
//! what it hits, and at which depth. There are no materials, no lights and no noise. Hit or miss,
//! the primitive, and the depth to the last bit of an `f32` are correct for every ray, with every
//! accelerator and any number of threads.
//!
//! # Images
//!
//! ```
//! use feimos::{Channel, LoadOptions, Scene};
//!
//! let options = LoadOptions::new().resolution([40, 40]);
//! let scene = Scene::load_with("scenes/sphere.pbrt", &options)?;
//! let image = scene.render(&scene.camera(), &[Channel::Z, Channel::Normal])?;
//!
//! let depths = image.values(Channel::Z).unwrap();
//! assert_eq!(depths[0], f32::INFINITY, "a miss");
//! let nearest = depths.iter().copied().fold(f32::INFINITY, f32::min);
//! assert!((nearest - 3.0).abs() < 1e-3, "the sphere's near side is 3 units away");
//! # Ok::<(), feimos::Error>(())
//! ```
//!
//! [`Image::save`] writes OpenEXR, NumPy, PFM and PNG files. [`Scene::cameras`] reads lists of
//! cameras, and [`Camera::new`] takes the `K`, `R` and `t` of computer vision.
//!
//! # Rays
//!
//! ```
//! use feimos::{Ray, Scene, SplitMethod};
//!
//! let points = [[0.0, 0.0, 5.0], [4.0, 0.0, 5.0], [0.0, 4.0, 5.0]];
//! let scene = Scene::from_triangles(&points, &[[0, 1, 2]])?;
//! let structure = scene.build(SplitMethod::Sah)?;
//!
//! let hit = structure.cast(&Ray::new([1.0, 1.0, 0.0], [0.0, 0.0, 2.0])).unwrap();
//! assert_eq!((hit.prim, hit.t, hit.distance), (1, 2.5, 5.0));
//! assert!(structure.cast(&Ray::new([9.0, 9.0, 0.0], [0.0, 0.0, 2.0])).is_none());
//! # Ok::<(), feimos::Error>(())
//! ```
//!
//! [`Structure::cast_all`] casts many rays on all threads.
//!
//! # Threads
//!
//! Work runs on the threads of the current rayon pool. Scenes and structures are `Send` and `Sync`.
//!
//! # Features
//!
//! `cli`, on by default, is the program `feimos` and its dependencies. A library needs no part of
//! it:
//!
//! ```toml
//! feimos = { version = "0.1", default-features = false }
//! ```
//!
//! # Rust version
//!
//! Rust 1.89 or later. A later version of this crate may need a later Rust.
//!
//! # More
//!
//! [The repository](https://github.com/feimos/feimos) has examples, and documents on
//! [accuracy](https://github.com/feimos/feimos/blob/main/docs/accuracy.md),
//! [scene files](https://github.com/feimos/feimos/blob/main/docs/scene-files.md),
//! [cameras](https://github.com/feimos/feimos/blob/main/docs/cameras.md) and the
//! [design](https://github.com/feimos/feimos/blob/main/docs/design.md).
//!
//! Modules that are not listed here serve the program and the tests. They change without notice.

#[doc(hidden)]
pub mod accel;
#[doc(hidden)]
pub mod bench;
#[doc(hidden)]
pub mod boxes;
#[doc(hidden)]
pub mod camera;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
#[doc(hidden)]
pub mod compare;
#[doc(hidden)]
pub mod decimal;
#[doc(hidden)]
pub mod digest;
#[doc(hidden)]
pub mod error;
#[doc(hidden)]
pub mod exact;
mod facade;
#[doc(hidden)]
pub mod file_id;
#[doc(hidden)]
pub mod film;
#[doc(hidden)]
pub mod geometry;
#[cfg(target_os = "linux")]
#[doc(hidden)]
pub mod huge_pages;
#[doc(hidden)]
pub mod input;
#[doc(hidden)]
pub mod json;
mod memory;
#[doc(hidden)]
pub mod merge;
#[doc(hidden)]
pub mod mesh;
#[doc(hidden)]
pub mod named;
mod parallel;
mod per_axis;
#[doc(hidden)]
pub mod pixel;
#[doc(hidden)]
pub mod progress;
#[doc(hidden)]
pub mod reference;
#[doc(hidden)]
pub mod render;
#[doc(hidden)]
pub mod scene;
#[doc(hidden)]
pub mod shape;
#[doc(hidden)]
pub mod simd;
mod structure_choice;
#[doc(hidden)]
pub mod survey;
#[doc(hidden)]
pub mod terminal_text;
#[doc(hidden)]
pub mod texture;

pub use accel::{Precision, SplitMethod};
pub use error::{Error, ErrorKind};
pub use facade::{Camera, Hit, Image, LoadOptions, Ray, Scene, Structure};
pub use film::Aov as Channel;

/// The Rust of the documents, as doc tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Documents;
