//! The content of NumPy, PFM and EXR files, and the header and the camera of an EXR.

use crate::folder::{BALL, Folder, SIZE};
use exr::prelude::{ReadChannels, ReadLayers};

/// Pixels of the image.
const PIXELS: usize = (SIZE.0 * SIZE.1) as usize;

/// The dictionary and the samples of an `.npy`.
fn npy(bytes: &[u8]) -> (String, &[u8]) {
    assert_eq!(bytes[..8], *b"\x93NUMPY\x01\x00");
    let end = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    (
        String::from_utf8(bytes[10..end].to_vec())
            .unwrap()
            .trim_end()
            .to_owned(),
        &bytes[end..],
    )
}

fn bytes_of(bits: &[u32]) -> Vec<u8> {
    bits.iter().flat_map(|bits| bits.to_le_bytes()).collect()
}

#[test]
fn an_npy_holds_depth_as_a_matrix() {
    let folder = Folder::new();
    let exr = folder.rendered("ball.pbrt");
    folder.render("ball.pbrt -o a.npy").succeeded();
    let file = folder.bytes("a.npy");
    let (header, samples) = npy(&file);
    assert_eq!(
        header,
        "{'descr': '<f4', 'fortran_order': False, 'shape': (7, 13), }"
    );
    assert_eq!(samples, bytes_of(&exr.bits["Z"]));
    folder
        .render("ball.pbrt -o prim.npy --aov prim")
        .succeeded();
    let file = folder.bytes("prim.npy");
    assert_eq!(npy(&file).1, bytes_of(&exr.bits["prim"]));
}

#[test]
fn an_npy_of_several_channels_has_named_fields() {
    let folder = Folder::new();
    let exr = folder.rendered("ball.pbrt --miss -1");
    folder
        .render("ball.pbrt -o a.npy --aov t,id,N --miss -1")
        .succeeded();
    let file = folder.bytes("a.npy");
    let (header, samples) = npy(&file);
    let descr = "[('t', '<f4'), ('id', '<u4'), ('N', '<f4', (3,))]";
    assert_eq!(
        header,
        format!("{{'descr': {descr}, 'fortran_order': False, 'shape': (7, 13), }}")
    );
    assert_eq!(samples.len(), PIXELS * 20);
    for (pixel, (t, id)) in samples
        .chunks_exact(20)
        .zip(exr.bits["t"].iter().zip(&exr.bits["id"]))
    {
        assert_eq!(pixel[..8], bytes_of(&[*t, *id]));
    }
}

#[test]
fn a_pfm_holds_rows_from_the_bottom() {
    let folder = Folder::new();
    let exr = folder.rendered("ball.pbrt");
    folder.render("ball.pbrt -o a.pfm --aov t").succeeded();
    let file = folder.bytes("a.pfm");
    let header = b"Pf\n13 7\n-1.0\n";
    assert_eq!(file[..header.len()], *header);
    let rows: Vec<u32> = exr.bits["t"].chunks(13).rev().flatten().copied().collect();
    assert_eq!(file[header.len()..], bytes_of(&rows));
    folder.render("ball.pbrt -o P.pfm --aov P").succeeded();
    assert!(folder.bytes("P.pfm").starts_with(b"PF\n13 7\n-1.0\n"));
}

#[test]
fn content_that_a_pfm_cannot_hold_is_refused() {
    let folder = Folder::new();
    for aov in ["id", "prim", "uv", "Z,t", "cost"] {
        folder
            .render(&format!("ball.pbrt -o a.pfm --aov {aov}"))
            .failed(2, "a PFM holds one of Z, t, A, N and P");
    }
    assert!(folder.images().is_empty());
}

#[test]
fn depth_may_have_another_name() {
    let folder = Folder::new();
    let plain = folder.rendered("ball.pbrt");
    for name in ["Y", "R", "depth.V"] {
        let renamed = folder.rendered(&format!("ball.pbrt --depth-channel {name}"));
        assert_eq!(renamed.bits[name], plain.bits["Z"]);
        assert!(!renamed.bits.contains_key("Z") && renamed.bits["t"] == plain.bits["t"]);
        assert_eq!(renamed.header["depth_channel"], name);
        folder.render("ball.pbrt -o plain.exr").succeeded();
        // Readers of feimos's own look for it.
        folder.compare("plain.exr rendered.exr").exited(0);
    }
    assert_eq!(folder.rendered("ball.pbrt --depth-channel Z"), plain);
}

#[test]
fn taken_and_invalid_names_of_the_depth_channel_are_refused() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt --depth-channel A")
        .failed(2, "another channel has this name");
    folder
        .render("ball.pbrt --depth-channel N.X")
        .failed(2, "another channel has this name");
    folder
        .render("ball.pbrt --depth-channel Tiefe\u{e4}")
        .failed(2, "expected 1 to 31 ASCII characters");
    folder
        .render("ball.pbrt --aov t --depth-channel Y")
        .failed(2, "--depth-channel has no meaning without Z");
    folder
        .render("ball.pbrt -o a.npy --depth-channel Y")
        .failed(2, "--depth-channel has no meaning for a.npy");
}

#[test]
fn the_header_of_an_exr_holds_exactly_what_decides_its_pixels() {
    let folder = Folder::new().with("moved.pbrt", BALL.replace("0 0 -5", "0 0 -6"));
    let header = |arguments: &str| folder.rendered(arguments).header;
    let plain = header("ball.pbrt");
    assert_eq!(
        plain["Z"],
        "planar depth along the view axis, in camera units"
    );
    assert_eq!(
        (&plain["miss"], &plain["precision"]),
        (&"inf".into(), &"exact".into())
    );
    assert_eq!(plain["scene"].as_str().unwrap().len(), 32);
    for same in [
        "--accel hlbvh",
        "--threads 1",
        "--pixelbounds 2,5,1,3",
        "--stats",
    ] {
        assert_eq!(header(&format!("ball.pbrt {same}")), plain, "{same}");
    }
    for other in [
        "--miss 0",
        "--precision fast",
        "--resolution 14x7",
        "--aov Z,t,A,id",
        "--depth-channel Y",
    ] {
        assert_ne!(header(&format!("ball.pbrt {other}")), plain, "{other}");
    }
    assert_ne!(header("moved.pbrt")["scene"], plain["scene"]);
    // Costs are those of one accelerator.
    assert_eq!(
        header("ball.pbrt --aov Z,cost --accel middle")["accelerator"],
        "middle"
    );
}

#[test]
fn an_exr_holds_its_camera() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt -o a.exr --aov A,P --pixelbounds 2,11,1,6")
        .succeeded();
    let read = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels();
    let file = read
        .all_layers()
        .all_attributes()
        .from_file(folder.path("a.exr"))
        .unwrap();
    let attributes = &file.layer_data[0].attributes;
    assert!(
        (attributes.screen_window_width - 2.0 * 20f32.to_radians().tan() * 13.0 / 7.0).abs() < 1e-6
    );
    let to_ndc = attributes.world_to_normalized_device.unwrap();
    assert_eq!(
        attributes.world_to_camera.unwrap()[12..],
        [0.0, 0.0, 5.0, 1.0]
    );
    let exr = folder.exr("a.exr");
    let points = ["P.X", "P.Y", "P.Z"].map(|name| exr.measures(name));
    for (place, _) in exr
        .measures("A")
        .iter()
        .enumerate()
        .filter(|(_, a)| **a == 1.0)
    {
        let point = [points[0][place], points[1][place], points[2][place], 1.0];
        let column = |j: usize| (0..4).map(|i| point[i] * to_ndc[4 * i + j]).sum::<f32>();
        let pixel = [column(0) / column(3) * 13.0, column(1) / column(3) * 7.0];
        let expected = [(2 + place % 9) as f32 + 0.5, (1 + place / 9) as f32 + 0.5];
        assert!(
            (pixel[0] - expected[0]).abs() < 1e-3 && (pixel[1] - expected[1]).abs() < 1e-3,
            "{pixel:?}"
        );
    }
}
