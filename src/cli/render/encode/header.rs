//! The header of an image file: JSON that tells programs how its pixels were made.
//!
//! It holds everything that decides the pixels and nothing else: neither the number of threads nor
//! the instruction set nor file names. So equal headers mean equal pixels, and all crops of an
//! image share one header.

use super::channel_file::{ChannelFile, ChannelFormat};
use super::content::Content;
use super::view_file::ViewFile;
use crate::accel::{Precision, SplitMethod};
use crate::camera::Projection;
use crate::digest::Digest;
use crate::film::view::Depth16;
use crate::film::{Aov, ColorRange, DEPTH_CHANNEL, MISS, PixelBounds, View};
use serde_json::{Map, Value, json};

/// How the pixels of an image were made.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Provenance {
    /// Digest of the scene and the camera.
    pub(crate) scene: Digest,
    /// How rays leave the camera.
    pub(crate) projection: Projection,
    pub(crate) precision: Precision,
    pub(crate) accel: SplitMethod,
    /// Width and height of the film.
    pub(crate) film: [u32; 2],
    pub(crate) window: PixelBounds,
}

impl Provenance {
    /// The header of a file with `content`, whose format must have one.
    pub(crate) fn header(&self, content: &Content) -> String {
        let mut header = Map::new();
        header.insert("version".into(), env!("CARGO_PKG_VERSION").into());
        header.insert("scene".into(), self.scene.to_string().into());
        header.insert("precision".into(), self.precision.name().into());
        if !self.projection.is_linear() {
            header.insert("camera".into(), self.projection.name().into());
        }
        if let Some(mapping) = self.projection.sphere_mapping() {
            header.insert("mapping".into(), mapping.name().into());
        }
        if let Some(lens) = self.projection.distortion() {
            header.insert("distortion".into(), lens.coefficients().into());
        }
        if content.needs_tree() {
            header.insert("accelerator".into(), self.accel.name().into());
        }
        match content {
            Content::Channels(file) => {
                add_channels(file, self.projection.has_planar_depth(), &mut header)
            }
            Content::View(file) => add_view(file, self, &mut header),
        }
        Value::Object(header).to_string()
    }
}

/// Adds the channels of an EXR; its windows are attributes of their own.
fn add_channels(file: &ChannelFile, has_planar_depth: bool, header: &mut Map<String, Value>) {
    header.insert(MISS.into(), number(file.miss));
    for aov in &file.aovs {
        let meaning = match aov {
            // Without a plane, both depths are the distance.
            Aov::Z if !has_planar_depth => meaning(Aov::T, file.within_instances),
            _ => meaning(*aov, file.within_instances),
        };
        header.insert(aov.name().into(), meaning.into());
    }
    if let ChannelFormat::Exr {
        depth_channel: Some(name),
    } = &file.format
    {
        header.insert(DEPTH_CHANNEL.into(), name.as_str().into());
    }
}

/// A number, or a string if JSON has no such number.
fn number(value: f32) -> Value {
    if value.is_finite() {
        json!(value)
    } else {
        json!(value.to_string())
    }
}

/// The meaning of an AOV. These words are part of files: `merge` and `--skip-existing` compare
/// them, so they must not change.
fn meaning(aov: Aov, within_instances: bool) -> &'static str {
    match aov {
        Aov::Z => "planar depth along the view axis, in camera units",
        Aov::T => "distance from the ray's origin, in world units",
        Aov::A => "1 hit, 0 miss",
        Aov::Id => "number of the Shape statement, from 1; 0 miss",
        Aov::Prim if within_instances => {
            "number of the primitive within its instance, or among those in none, from 1; 0 miss"
        }
        Aov::Prim => "number of the primitive, from 1; 0 miss",
        Aov::Instance => "number of the ObjectInstance, from 1; 0 miss, or in no instance",
        Aov::Normal => "geometric normal in world space, of length 1; 0 miss",
        Aov::Point => "point of the hit in world space; 0 miss",
        Aov::Uv => "parameters of the surface, as pbrt has them; 0 miss",
        Aov::Cost => {
            "nodes and primitives that the ray tests when it goes alone through the whole tree of \
             the accelerator"
        }
    }
}

fn add_view(file: &ViewFile, provenance: &Provenance, header: &mut Map<String, Value>) {
    let PixelBounds { x0, x1, y0, y1 } = provenance.window;
    header.insert("view".into(), file.view.name().into());
    header.insert("film".into(), json!(provenance.film));
    header.insert("window".into(), json!([x0, x1, y0, y1]));
    if file.view.has_color_map() {
        let range = file.range.map(|ColorRange { start, end }| [start, end]);
        header.insert("colormap".into(), file.colors.name().into());
        header.insert("range".into(), json!(range));
    }
    if file.view == View::Depth16 {
        let Depth16 { scale, miss } = file.depth16;
        header.insert("scale".into(), json!(scale));
        header.insert(MISS.into(), json!(miss));
    }
    if let Some(background) = &file.background {
        header.insert("background".into(), background.to_string().into());
    }
    if file.has_legend {
        header.insert("legend".into(), true.into());
    }
}
