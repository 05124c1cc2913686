use super::*;
use exr::math::Vec2;
use exr::meta::attribute::IntegerBounds;

/// An image of 3 by 2 pixels with its data window at `data` in a display window at `display` of
/// `size`.
fn file(data: (i32, i32), display: (i32, i32), size: (usize, usize)) -> Vec<u8> {
    let mut layer = layer(
        (3, 2),
        vec![("Z", FlatSamples::F32(small(6)))],
        Encoding::default(),
    );
    layer.attributes.layer_position = Vec2(data.0, data.1);
    let mut image = exr::prelude::Image::from_layer(layer);
    image.attributes.display_window = IntegerBounds::new((display.0, display.1), size);
    written(&image)
}

#[test]
fn the_origin_of_the_display_window_becomes_that_of_the_film() {
    let expected = PixelBounds {
        x0: 1,
        x1: 4,
        y0: 2,
        y1: 4,
    };
    for (data, display) in [
        ((1, 2), (0, 0)),
        ((-9, 12), (-10, 10)),
        ((-1_000_000, -8), (-1_000_001, -10)),
    ] {
        let image = read(&file(data, display, (5, 6))).unwrap();
        image.validate().unwrap();
        assert_eq!(
            (image.display_window, image.data_window),
            ((5, 6), expected)
        );
        assert_eq!(image.measures(ChannelName::Z), Some(&small(6)[..]));
    }
}

#[test]
fn a_data_window_beyond_the_display_window_is_refused() {
    for (data, display) in [
        ((-1, 0), (0, 0)),
        ((0, 0), (0, 1)),
        ((3, 0), (0, 0)),
        ((0, 5), (0, 0)),
    ] {
        let message = refused(&file(data, display, (5, 6)));
        assert!(
            message.contains("leaves the display window, x 0 to 4 and y "),
            "{message}"
        );
    }
}

/// A header by the crate, with one window replaced by another.
fn with_window(name: &str, corners: [i32; 4]) -> Vec<u8> {
    let mut file = file((0, 0), (0, 0), (5, 6));
    let name = [name.as_bytes(), b"\0box2i\0"].concat();
    let at = file
        .windows(name.len())
        .position(|bytes| bytes == name)
        .expect("the attribute")
        + name.len()
        + 4;
    let corners = corners.map(i32::to_le_bytes);
    file[at..at + 16].copy_from_slice(corners.as_flattened());
    file
}

#[test]
fn windows_with_no_pixel_or_too_many_are_refused() {
    const FAR: i32 = i32::MAX / 2 - 2;
    let far = |side: i32| with_window("displayWindow", [0, 0, side, side]);
    assert!(
        refused(&far(FAR)).contains("of a film of 1073741822 x 1073741822"),
        "{}",
        refused(&far(FAR))
    );
    for corners in [
        [0, 0, 1 << 20, 1 << 20],
        [0, 0, FAR, 0],
        [0, 0, -1, -1],
        [i32::MIN, 0, i32::MAX, 5],
    ] {
        refused(&with_window("dataWindow", corners));
        let mut file = with_window("dataWindow", corners);
        let other = far(1 << 23);
        let same = file.iter().zip(&other).take_while(|(a, b)| a == b).count();
        let at = other
            .windows(14)
            .position(|bytes| bytes == b"displayWindow\0")
            .unwrap();
        file[at..at + 48].copy_from_slice(&other[at..at + 48]);
        let message = refused(&file);
        assert!(same > 0 && !message.contains("cannot be had"), "{message}");
    }
}

#[test]
fn unknown_channels_are_listed() {
    let file = one_layer(
        (1, 1),
        vec![("R", as_f16(&[0.0])), ("z", as_f16(&[0.0]))],
        Encoding::default(),
    );
    let expected = "a.exr: feimos knows no channel of this image, which has R, z
   = expected one or more of Z, t, A, id, prim, instance, cost, N.X, N.Y, N.Z, P.X, P.Y, P.Z, u, v";
    assert_eq!(refused(&file), expected);
}
