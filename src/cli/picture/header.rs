//! What an image file says of itself, for programs: JSON.
//!
//! It holds everything that decides the pixels and nothing else: never the number of threads, the instructions or the names of
//! files. So equal headers mean equal pixels, and crops of one image have one header.

use super::{Data, DataFormat, Picture, Shown};
use feimos::accel::{Precision, SplitMethod};
use feimos::digest::Digest;
use feimos::film::view::Depth16;
use feimos::film::{Aov, ColorRange, DEPTH_CHANNEL, MISS, PixelBounds};
use serde_json::{Map, Value, json};

/// Where the pixels come from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Origin {
    /// Of the scene and the camera.
    pub(crate) scene: Digest,
    pub(crate) precision: Precision,
    pub(crate) accel: SplitMethod,
    pub(crate) film: [u32; 2],
    pub(crate) window: PixelBounds,
}

impl Picture {
    /// Whether the format has a place for a header.
    pub(crate) fn has_header(&self) -> bool {
        !matches!(
            self,
            Picture::Data(Data {
                format: DataFormat::Npy | DataFormat::Pfm,
                ..
            })
        )
    }

    /// The header of a file that has a place for it.
    pub(crate) fn header(&self, origin: &Origin) -> String {
        let mut header = Map::new();
        header.insert("version".into(), env!("CARGO_PKG_VERSION").into());
        header.insert("scene".into(), origin.scene.to_string().into());
        header.insert("precision".into(), origin.precision.name().into());
        if self.needs_whole_tree() {
            header.insert("accelerator".into(), origin.accel.name().into());
        }
        match self {
            Picture::Data(data) => of_data(data, &mut header),
            Picture::View(shown) => of_view(shown, origin, &mut header),
        }
        Value::Object(header).to_string()
    }
}

/// Windows are in attributes of their own.
fn of_data(data: &Data, header: &mut Map<String, Value>) {
    header.insert(MISS.into(), number(data.miss));
    for aov in &data.aovs {
        header.insert(
            aov.name().into(),
            meaning(aov, data.within_instances).into(),
        );
    }
    if let DataFormat::Exr {
        depth_channel: Some(name),
    } = &data.format
    {
        header.insert(DEPTH_CHANNEL.into(), name.as_str().into());
    }
}

/// A number, or a string where JSON has no number for it.
fn number(value: f32) -> Value {
    if value.is_finite() {
        json!(value)
    } else {
        json!(value.to_string())
    }
}

/// What an AOV holds.
fn meaning(aov: &Aov, within_instances: bool) -> &'static str {
    match aov.name() {
        "Z" => "planar depth along the view axis, in camera units",
        "t" => "distance from the ray's origin, in world units",
        "A" => "1 hit, 0 miss",
        "id" => "number of the Shape statement, from 1; 0 miss",
        "prim" if within_instances => {
            "number of the primitive within its instance, or among those in none, from 1; 0 miss"
        }
        "prim" => "number of the primitive, from 1; 0 miss",
        "instance" => "number of the ObjectInstance, from 1; 0 miss, or in no instance",
        "N" => "geometric normal in world space, of length 1; 0 miss",
        "P" => "point of the hit in world space; 0 miss",
        "uv" => "parameters of the surface, as pbrt has them; 0 miss",
        _ => {
            "nodes and primitives that the ray tests when it goes alone through the whole tree of the accelerator"
        }
    }
}

fn of_view(shown: &Shown, origin: &Origin, header: &mut Map<String, Value>) {
    let PixelBounds { x0, x1, y0, y1 } = origin.window;
    header.insert("view".into(), shown.view().name().into());
    header.insert("film".into(), json!(origin.film));
    header.insert("window".into(), json!([x0, x1, y0, y1]));
    match shown {
        Shown::Depth { colors, range } | Shown::Cost { colors, range } => {
            let range = range.map(|ColorRange { start, end }| [start, end]);
            header.insert("colormap".into(), colors.name().into());
            header.insert("range".into(), json!(range));
        }
        Shown::Depth16(Depth16 { scale, miss }) => {
            header.insert("scale".into(), json!(scale));
            header.insert(MISS.into(), json!(miss));
        }
        Shown::Hit | Shown::Normal | Shown::Id => {}
    }
}
