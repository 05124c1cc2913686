//! Attributes and channel names in the header.

use super::*;

#[test]
fn the_attribute_holds_the_text_in_utf8() {
    let json = format!(
        r#"{{"scene":"Käse 🧀.pbrt","long":"{}"}}"#,
        "x".repeat(5000)
    );
    let file = decoded(&encoded(
        &picture((2, 2), PixelBounds::of_film(2, 2), &[ChannelName::Z]),
        &json,
    ));
    assert!(file.attributes.other.is_empty());
    let other: Vec<_> = file.layer_data[0].attributes.other.iter().collect();
    let [(name, AttributeValue::Text(text))] = other[..] else {
        panic!("{other:?}")
    };
    assert_eq!(
        (name.to_string().as_str(), text.as_slice()),
        (ATTRIBUTE, json.as_bytes())
    );
}

#[test]
fn the_depth_channel_may_have_another_name_and_is_sorted_by_it() {
    let image = picture(
        (4, 3),
        PixelBounds::of_film(4, 3),
        &[ChannelName::Z, ChannelName::A, ChannelName::T],
    );
    let file = decoded(&encoded(&image, r#"{"depth_channel":"Y"}"#));
    let channels: Vec<_> = file.layer_data[0].channel_data.list.iter().collect();
    assert_eq!(
        channels
            .iter()
            .map(|channel| channel.name.to_string())
            .collect::<Vec<_>>(),
        ["A", "Y", "t"]
    );
    assert_eq!(
        bits(&decoded_bits(&channels[1].sample_data)),
        bits(&image.channels[0].samples)
    );
}

#[test]
fn the_camera_is_in_the_standard_attributes() {
    let camera = CameraAttributes {
        pixel_aspect: 2.0,
        screen_window_center: [0.5, -0.25],
        screen_window_width: 3.0,
        world_to_camera: std::array::from_fn(|at| at as f32),
        world_to_ndc: Some(std::array::from_fn(|at| -(at as f32))),
    };
    let image = picture((2, 2), PixelBounds::of_film(2, 2), &[ChannelName::Z]);
    let file = decoded(&encoded_with(
        &image,
        &Metadata {
            camera: Some(camera),
            ..Metadata::default()
        },
    ));
    let attributes = &file.layer_data[0].attributes;
    assert_eq!(file.attributes.pixel_aspect, 2.0);
    assert_eq!(
        (
            attributes.screen_window_center,
            attributes.screen_window_width
        ),
        (Vec2(0.5, -0.25), 3.0)
    );
    assert_eq!(attributes.world_to_camera, Some(camera.world_to_camera));
    assert_eq!(attributes.world_to_normalized_device, camera.world_to_ndc);
}
