//! Any bytes as a scene, rendered: every accelerator gives the picture of the plain list.
#![no_main]

use feimos::accel::{Aggregate, BuildOptions, Precision, SplitMethod};
use feimos::film::{ChannelName, PixelBounds, Samples};
use feimos::progress::Progress;
use feimos::render::{RenderOptions, render};
use feimos::scene::{LoadOptions, Scene, parse};
use feimos::simd::Level;
use libfuzzer_sys::{Corpus, fuzz_target};
use std::path::Path;

/// More would only make each case slow.
const MOST_PRIMITIVES: u64 = 2000;

fuzz_target!(|bytes: &[u8]| -> Corpus {
    // An absolute name would be the only one of a file that exists.
    if bytes.windows(2).any(|pair| pair == b"\"/") {
        return Corpus::Reject;
    }
    let path = Path::new("/no such folder/fuzz.pbrt");
    let options = LoadOptions {
        resolution: Some([9, 7]),
        orientation: true,
        uv: true,
        ..LoadOptions::default()
    };
    let Ok(scene) = parse(path, bytes.to_vec(), &options) else {
        return Corpus::Keep;
    };
    if scene.geometry.primitive_count() > MOST_PRIMITIVES {
        return Corpus::Reject;
    }
    let plain = picture(&scene, SplitMethod::None, Level::Portable);
    for method in [
        SplitMethod::Middle,
        SplitMethod::Equal,
        SplitMethod::Sah,
        SplitMethod::Hlbvh,
    ] {
        assert_eq!(picture(&scene, method, Level::detect()), plain, "{method}");
    }
    Corpus::Keep
});

/// The bits of all channels.
fn picture(scene: &Scene, method: SplitMethod, level: Level) -> Vec<u32> {
    let aggregate = Aggregate::build(
        &scene.geometry,
        scene.camera.anchor(),
        BuildOptions::new(method),
        Progress::SILENT,
    );
    let [width, height] = scene.camera.resolution;
    let options = RenderOptions {
        data_window: PixelBounds::of_film(width, height),
        channels: ChannelName::ALL
            .into_iter()
            .filter(|name| *name != ChannelName::Cost)
            .collect(),
        miss: f32::INFINITY,
        counted: false,
        level,
        precision: Precision::Exact,
    };
    let rendering = render(
        &scene.camera,
        &scene.geometry,
        &aggregate,
        &options,
        Progress::SILENT,
    )
    .expect("memory");
    assert_eq!(rendering.image.validate(), Ok(()));
    let bits = |samples: &Samples| match samples {
        Samples::F32(values) => values.iter().map(|value| value.to_bits()).collect(),
        Samples::U32(values) => values.clone(),
    };
    rendering
        .image
        .channels
        .iter()
        .flat_map(|channel| bits(&channel.samples))
        .collect()
}
