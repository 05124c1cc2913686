//! Any bytes as a scene, rendered: every accelerator gives the picture of the plain list.
#![no_main]

use feimos::accel::{
    Accelerator, Aggregate, Bins, BuildOptions, Precision, SplitMethod, Structure,
};
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
    let list = Accelerator::Tree(SplitMethod::None);
    let plain = picture(&scene, list, Level::Portable);
    for accelerator in Accelerator::ALL.into_iter().filter(|other| *other != list) {
        let found = picture(&scene, accelerator, Level::detect());
        assert_eq!(found, plain, "{accelerator}");
    }
    Corpus::Keep
});

/// The bits of all channels.
fn picture(scene: &Scene, accelerator: Accelerator, level: Level) -> Vec<u32> {
    let (camera, geometry) = (&scene.camera, &scene.geometry);
    let [width, height] = camera.resolution;
    let window = PixelBounds::of_film(width, height);
    let (method, bins) = match accelerator {
        Accelerator::Tree(method) => (method, None),
        Accelerator::Raster => {
            let build = BuildOptions::new(SplitMethod::Sah);
            let bins = Bins::new(geometry, camera, &window, build, level, Progress::SILENT);
            (SplitMethod::Sah, bins)
        }
    };
    let tree = bins.is_none().then(|| {
        let options = BuildOptions::new(method);
        Aggregate::build(geometry, camera.anchor(), options, Progress::SILENT)
    });
    let of_bins = bins.as_ref().map(Structure::Bins);
    let structure = of_bins
        .or(tree.as_ref().map(Structure::Tree))
        .expect("one of them");
    let options = RenderOptions {
        data_window: window,
        channels: ChannelName::ALL
            .into_iter()
            .filter(|name| *name != ChannelName::Cost)
            .collect(),
        miss: f32::INFINITY,
        level,
        precision: Precision::Exact,
    };
    let rendering =
        render(camera, geometry, structure, &options, Progress::SILENT).expect("memory");
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
