//! `feimos compare`: every format, difference pictures, and files it refuses.

use crate::compare::{folder, object};
use serde_json::json;

#[test]
fn arrays_and_float_maps_hold_depths() {
    let folder = folder();
    for extension in ["npy", "pfm"] {
        let image = format!("z.{extension}");
        folder.render(&format!("ball.pbrt -o {image}")).succeeded();
        let found = object(&folder.compare(&format!("a.exr {image} --json")).succeeded());
        assert_eq!(found["ulps"]["Z"]["compared"], json!(13));
        assert_eq!(found["not_compared"]["prim"], json!("A"));
        folder.compare(&format!("{image} b.exr")).exited(1);
    }
    folder.compare("z.npy z.pfm").succeeded();
    folder
        .render("ball.pbrt --aov Z,t,A,id,prim,N -o all.npy")
        .succeeded();
    let found = object(&folder.compare("a.exr all.npy --json").succeeded());
    assert_eq!(
        found["not_compared"],
        json!({"N.X": "B", "N.Y": "B", "N.Z": "B"})
    );
    folder.render("ball.pbrt --aov id -o id.npy").succeeded();
    folder.compare("id.npy id.npy").failed(
        65,
        "id.npy: this NumPy file cannot be read: its type is unknown",
    );
}

#[test]
fn depths_of_a_png_are_compared_in_steps() {
    let folder = folder();
    for (scene, image) in [("ball", "a16"), ("b", "b16"), ("gone", "gone16")] {
        let render = format!("{scene}.pbrt -o {image}.png --view depth16 --miss 65535");
        folder.render(&render).succeeded();
    }
    folder.compare("a16.png a16.png").succeeded();
    let hits = |name: &str| object(&folder.compare(name).exited(1));
    let (steps, exact) = (
        hits("a16.png gone16.png --json"),
        hits("a.exr gone.exr --json"),
    );
    assert_eq!(steps["missed_hits"], exact["missed_hits"]);
    let found = hits("a16.png b16.png --json");
    let largest = found["ulps"]["Z"]["largest"].as_u64().unwrap();
    assert!(
        (1..=20).contains(&largest),
        "a radius of 1.01 is 10 steps nearer: {largest}"
    );
    let tolerant = format!("a16.png b16.png --max-ulp {largest} --max-pixels 3");
    folder.compare(&tolerant).succeeded();
    folder
        .compare("a.exr a16.png")
        .failed(65, "16-bit depths have no known unit");
    folder
        .compare("a.png a.png")
        .failed(65, "a.png: this PNG file holds colours, not data");
}

#[test]
fn a_difference_picture_shows_each_pixel() {
    use feimos::compare::picture::{EQUAL, EQUAL_HIT, MISSED_HIT, WRONG_PRIMITIVE};
    let folder = folder();
    let run = folder
        .compare("a.exr gone.exr --diff d.png --json")
        .exited(1)
        .said("d.png: differences");
    let picture = folder.png("d.png");
    let count = |color: [u8; 3]| picture.pixels().filter(|pixel| pixel.0 == color).count() as u64;
    assert_eq!(picture.dimensions(), (13, 7));
    let number = |name: &str| object(&run)[name].as_u64().unwrap();
    assert_eq!(
        [count(MISSED_HIT), count(WRONG_PRIMITIVE)],
        [number("missed_hits"), number("wrong_primitives")]
    );
    assert_eq!(count(EQUAL), 91 - number("hits_expected"));
    assert_eq!(count(EQUAL_HIT), 91 - count(EQUAL) - number("different"));
}

#[test]
fn a_difference_picture_needs_its_own_place() {
    let folder = folder();
    let before = folder.bytes("a.png");
    for (arguments, part) in [
        (
            "a.exr b.exr --diff d.exr",
            "the difference picture is a PNG",
        ),
        ("a.exr b.exr --diff d", "no extension"),
        (
            "b.exr a.png --diff ./a.png",
            "--diff would overwrite a compared image",
        ),
    ] {
        folder.compare(arguments).failed(2, part);
    }
    folder
        .compare("a.exr b.exr --diff a.exr/d.png")
        .failed(73, "a.exr/d.png: cannot create: Not a directory");
    assert_eq!(folder.bytes("a.png"), before);
}

#[test]
fn other_files_and_damaged_ones_are_refused() {
    let folder = folder()
        .with("cut.exr", [])
        .with("bad.png", b"\x89PNG\r\n\x1a\n");
    std::fs::write(folder.path("cut.exr"), &folder.bytes("a.exr")[..700]).unwrap();
    folder
        .compare("a.exr none.exr")
        .failed(66, "none.exr: cannot read");
    folder.compare("a.exr .").failed(66, ".: ");
    folder
        .compare("ball.pbrt a.exr")
        .failed(65, "ball.pbrt: this is not an EXR, NPY, PFM or PNG file");
    folder
        .compare("a.exr cut.exr")
        .failed(65, "error: cut.exr: ");
    folder
        .compare("bad.png a.exr")
        .failed(65, "bad.png: this PNG file cannot be read");
    folder.compare("a.exr").failed(2, "<B>");
    // The content of a file counts, not its name.
    std::fs::copy(folder.path("a.exr"), folder.path("exr.png")).unwrap();
    folder.compare("a.exr exr.png").succeeded();
}
