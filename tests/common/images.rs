//! Images by their bits, and the reference's answers in the same form.

use feimos::camera::Camera;
use feimos::film::{Channel, ChannelName, Image, Samples};
use feimos::progress::Progress;
use feimos::reference::{self, ReferenceHit};
use feimos::shape::Geometry;

/// Asserts that two images are equal bit for bit.
pub(crate) fn assert_same(expected: &Image, found: &Image, what: &str) {
    assert_eq!(expected.data_window, found.data_window, "{what}");
    for (a, b) in expected.channels.iter().zip(&found.channels) {
        assert_eq!(a.name, b.name, "{what}");
        let (a_bits, b_bits) = (bits(a), bits(b));
        let different = a_bits.iter().zip(&b_bits).filter(|(a, b)| a != b).count();
        assert_eq!(
            different, 0,
            "{what}: {different} samples of {} differ",
            a.name
        );
    }
}

/// The reference hit of every pixel: primitive and bits of Z and t, 0 for a miss. Computed ray by
/// ray and area by area, which must agree.
pub(crate) fn judged(camera: &Camera, geometry: &Geometry) -> Vec<[u32; 3]> {
    let [width, height] = camera.resolution;
    let pixels: Vec<[u32; 2]> = (0..height)
        .flat_map(|y| (0..width).map(move |x| [x, y]))
        .collect();
    let ray_by_ray: Vec<_> = pixels
        .iter()
        .map(|[x, y]| {
            let hit = reference::closest_hit(geometry, &camera.ray(*x, *y));
            hit.map(|hit| hit.seen_by(&camera.projection))
        })
        .collect();
    assert_eq!(
        reference::answers(camera, geometry, &pixels, Progress::SILENT),
        ray_by_ray,
        "by area"
    );
    let bits = |hit: ReferenceHit| {
        [
            geometry.image_number(hit.primitive),
            hit.z.to_bits(),
            hit.distance.to_bits(),
        ]
    };
    ray_by_ray
        .into_iter()
        .map(|hit| hit.map_or([0; 3], bits))
        .collect()
}

/// The hits of an image, in the same form.
pub(crate) fn rendered(image: &Image) -> Vec<[u32; 3]> {
    let [prim, z, t] =
        [ChannelName::Prim, ChannelName::Z, ChannelName::T].map(|name| bits_of(image, name));
    let pixel = |k: usize| {
        if prim[k] == 0 {
            [0; 3]
        } else {
            [prim[k], z[k], t[k]]
        }
    };
    (0..prim.len()).map(pixel).collect()
}

/// The samples of the named channel as bits.
pub(crate) fn bits_of(image: &Image, name: ChannelName) -> Vec<u32> {
    bits(
        image
            .channels
            .iter()
            .find(|channel| channel.name == name)
            .expect("the image has the channel"),
    )
}

/// The samples of a channel as bits.
fn bits(channel: &Channel) -> Vec<u32> {
    match &channel.samples {
        Samples::F32(values) => values.iter().map(|value| value.to_bits()).collect(),
        Samples::U32(values) => values.clone(),
    }
}
