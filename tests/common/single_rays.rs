//! Single rays through the trees that pictures are made with.

use feimos::accel::{Aggregate, Precision, Tracer, TraversalCounts};
use feimos::camera::Camera;
use feimos::film::{ChannelName, Image, PixelBounds};
use feimos::shape::Geometry;
use feimos::simd::Level;

/// The most rays of a picture that are traced alone.
const MAX_RAYS: u64 = 100;

/// Asserts that single rays through the wide trees hit what counted rays through the binary trees
/// hit, and what `image` shows if hits are exact.
pub(crate) fn assert_single_rays_agree(
    camera: &Camera,
    geometry: &Geometry,
    aggregate: &Aggregate,
    (precision, level): (Precision, Level),
    window: &PixelBounds,
    image: &Image,
) {
    let [z, t] = [ChannelName::Z, ChannelName::T].map(|name| image.measures(name).unwrap());
    let prim = image.numbers(ChannelName::Prim).unwrap();
    let mut tracer = Tracer::new(aggregate, geometry, precision).with_level(level);
    let columns = window.x0..window.x1;
    let pixels = (window.y0..window.y1).flat_map(|y| columns.clone().map(move |x| (x, y)));
    let step = window.area().div_ceil(MAX_RAYS) as usize;
    for (place, (x, y)) in pixels.enumerate().step_by(step.max(1)) {
        let ray = camera.ray(x, y);
        let hit = tracer.closest_hit(&ray);
        let counted = tracer.closest_hit_counted(&ray, &mut TraversalCounts::default());
        let any = tracer.any_hit(&ray);
        let bits = |hit: feimos::accel::Hit| {
            let ends = [hit.t.low, hit.t.high].map(f64::to_bits);
            (hit.primitive, ends)
        };
        let context = format!("pixel {x}, {y} alone, {precision}, {level}");
        assert_eq!(any.is_some(), hit.is_some(), "{context}: hit or miss");
        if precision == Precision::Fast {
            assert_eq!(hit.map(bits), counted.map(bits), "{context}");
            continue;
        }
        let primitives = [hit, counted].map(|hit| hit.map(|hit| hit.primitive));
        assert_eq!(primitives[0], primitives[1], "{context}");
        let number = hit.map_or(0, |hit| geometry.image_number(hit.primitive));
        assert_eq!(number, prim[place], "{context}: in a tile");
        if let Some(hit) = hit {
            let depth = tracer.depth(&ray, &hit).seen_by(&camera.projection);
            let bits = [depth.z, depth.distance].map(f32::to_bits);
            assert_eq!(bits, [z[place], t[place]].map(f32::to_bits), "{context}");
        }
    }
}
