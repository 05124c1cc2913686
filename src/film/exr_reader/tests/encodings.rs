use super::*;
use ChannelName::{A, Id, Instance, Prim, T, Z};

/// Every lossless encoding of the crate.
fn encodings() -> Vec<Encoding> {
    let mut encodings = Vec::new();
    for compression in [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
    ] {
        for line_order in [LineOrder::Increasing, LineOrder::Decreasing] {
            encodings.push(Encoding {
                compression,
                blocks: Blocks::ScanLines,
                line_order,
            });
        }
        let line_order = LineOrder::Unspecified;
        for tile in [(1, 1), (7, 3), (64, 64)] {
            encodings.push(Encoding {
                compression,
                blocks: Blocks::Tiles(tile.into()),
                line_order,
            });
        }
    }
    encodings
}

#[test]
fn files_of_feimos_are_read_bit_for_bit() {
    let crop = PixelBounds {
        x0: 17,
        x1: 60,
        y0: 130,
        y1: 271,
    };
    for (film, window) in [
        ((70, 300), PixelBounds::of_film(70, 300)),
        ((70, 300), crop),
        ((1, 1), PixelBounds::of_film(1, 1)),
    ] {
        let image = strange(film, window);
        assert_same(&image, &read(&of_our_writer(&image)).unwrap());
        for channel in &image.channels {
            let one = Image {
                channels: vec![channel.clone()],
                ..image.clone()
            };
            assert_same(&one, &read(&of_our_writer(&one)).unwrap());
        }
    }
}

#[test]
fn all_encodings_give_the_same_image() {
    let size = (20, 37);
    let image = strange((20, 37), PixelBounds::of_film(20, 37));
    let samples = |name: ChannelName| match name.is_integer() {
        true => FlatSamples::U32(image.numbers(name).unwrap().to_vec()),
        false => FlatSamples::F32(image.measures(name).unwrap().to_vec()),
    };
    for encoding in encodings() {
        let mut channels: Vec<_> = ChannelName::ALL
            .iter()
            .map(|name| (name.name(), samples(*name)))
            .collect();
        // Unknown channels lie before, between and after the known ones.
        channels.extend(["B", "R", "depth", "zz"].map(|name| (name, as_f16(&small(20 * 37)))));
        assert_same(&image, &read(&one_layer(size, channels, encoding)).unwrap());
    }
}

#[test]
fn encodings_for_colours_are_refused_except_for_one() {
    let file = |compression, samples| {
        let encoding = Encoding {
            compression,
            blocks: Blocks::ScanLines,
            line_order: LineOrder::Increasing,
        };
        one_layer((40, 40), vec![("Z", samples)], encoding)
    };
    for samples in [as_f16(&[0.5; 1600]), FlatSamples::F32(vec![0.5; 1600])] {
        assert_eq!(
            read(&file(Compression::PXR24, samples))
                .unwrap()
                .measures(Z),
            Some(&[0.5; 1600][..])
        );
    }
    for compression in [
        Compression::B44,
        Compression::B44A,
        Compression::DWAA(None),
        Compression::DWAB(None),
    ] {
        let message = refused(&file(compression, as_f16(&[0.5; 1600])));
        assert!(message.contains("which is not read"), "{message}");
    }
}

#[test]
fn other_types_are_read_if_they_hold_the_same_numbers() {
    let values = small(12);
    let all = ChannelName::ALL.map(ChannelName::name);
    for to_samples in [as_f16, as_u32, |values: &[f32]| {
        FlatSamples::F32(values.to_vec())
    }] {
        let channels = all
            .iter()
            .map(|name| (*name, to_samples(&values)))
            .collect();
        let image = read(&one_layer((4, 3), channels, Encoding::default())).unwrap();
        image.validate().unwrap();
        [Z, T, A]
            .iter()
            .for_each(|name| assert_eq!(image.measures(*name), Some(&values[..])));
        let numbers: Vec<u32> = values.iter().map(|value| *value as u32).collect();
        [Id, Prim, Instance]
            .iter()
            .for_each(|name| assert_eq!(image.numbers(*name), Some(&numbers[..])));
    }
}

#[test]
fn a_half_may_be_infinite() {
    let file = one_layer(
        (2, 1),
        vec![("Z", as_f16(&[f32::INFINITY, f32::NAN]))],
        Encoding::default(),
    );
    let image = read(&file).unwrap();
    let [first, second] = image.measures(Z).unwrap() else {
        panic!("two pixels")
    };
    assert!(*first == f32::INFINITY && second.is_nan());
}

#[test]
fn numbers_that_do_not_fit_are_reported_with_their_pixel() {
    let of = |name, value: FlatSamples| {
        let FlatSamples::F32(value) = value else {
            panic!("a number")
        };
        let values = FlatSamples::F32([[1.0; 5], [1.0, 1.0, value[0], 1.0, 1.0]].concat());
        refused(&one_layer(
            (5, 2),
            vec![(name, values)],
            Encoding::default(),
        ))
    };
    for value in [1.5, -1.0, f32::NAN, f32::INFINITY, 4_294_967_296.0] {
        let message = of("prim", FlatSamples::F32(vec![value]));
        let expected = format!(
            "a.exr: channel prim holds {value} in pixel (2, 1)\n   = expected a whole number from 0 to 4294967295"
        );
        assert_eq!(message, expected);
    }
    let largest = 4_294_967_040.0;
    let file = one_layer(
        (1, 1),
        vec![("id", FlatSamples::F32(vec![largest]))],
        Encoding::default(),
    );
    assert_eq!(read(&file).unwrap().numbers(Id), Some(&[4_294_967_040][..]));
    for number in [(1 << 24) + 1, u32::MAX] {
        let file = one_layer(
            (1, 1),
            vec![("Z", FlatSamples::U32(vec![number]))],
            Encoding::default(),
        );
        assert!(refused(&file).contains(&format!("channel Z holds {number} in pixel (0, 0)")));
    }
}

#[test]
fn the_first_part_with_a_known_channel_is_read() {
    let mut layers = Vec::new();
    for (name, channel, value) in [
        ("a", "R", 1.0),
        ("b", "Z", 2.0),
        ("c", "Z", 3.0),
        ("d", "left.Z", 4.0),
    ] {
        let mut layer = layer(
            (40, 40),
            vec![(channel, FlatSamples::F32(vec![value; 1600]))],
            Encoding::FAST_LOSSLESS,
        );
        layer.attributes.layer_name = Some(name.into());
        layers.push(layer);
    }
    let attributes = exr::prelude::ImageAttributes::with_size((40, 40));
    let file = written(&exr::prelude::Image::from_layers(attributes, layers));
    assert_eq!(read(&file).unwrap().measures(Z), Some(&[2.0; 1600][..]));
}

#[test]
fn the_largest_of_several_resolutions_is_read() {
    use exr::math::RoundingMode;
    use exr::prelude::Levels;
    let levels = [(6, 4), (3, 2), (1, 1)]
        .map(|(width, height)| FlatSamples::F32(vec![width as f32; width * height]));
    let levels = Levels::Mip {
        rounding_mode: RoundingMode::Down,
        level_data: levels.to_vec(),
    };
    let channels = AnyChannels::sort([AnyChannel::new("Z", levels)].into_iter().collect());
    let encoding = Encoding {
        blocks: Blocks::Tiles((2, 3).into()),
        ..Encoding::default()
    };
    let layer = Layer::new((6, 4), LayerAttributes::default(), encoding, channels);
    let file = written(&exr::prelude::Image::from_layer(layer));
    assert_eq!(read(&file).unwrap().measures(Z), Some(&[6.0; 24][..]));
}
