//! The names of images, and the channels in them.

use crate::exr_file::Exr;
use crate::folder::{Folder, SIZE, png};
use crate::views::RED;

pub(crate) const CENTRE: (u32, u32) = (SIZE.0 / 2, SIZE.1 / 2);
const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                   property float z\n\
                   element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n\
                   1 0 0\n0 1 0\n3 0 1 2\n";

#[test]
fn without_a_name_the_film_names_the_image() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt")
        .succeeded()
        .said("film.exr: 13 x 7 pixels");
    assert_eq!(folder.images(), ["film.exr"]);
}

#[test]
fn without_any_name_the_image_has_the_name_of_pbrt() {
    let folder = Folder::new().with("bare.pbrt", "WorldBegin");
    folder.render("bare.pbrt --resolution 2x2").succeeded();
    assert_eq!(folder.images(), ["pbrt.exr"]);
}

#[test]
fn bare_meshes_give_images_of_the_same_name() {
    let gz = {
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        std::io::Write::write_all(&mut encoder, PLY.as_bytes()).unwrap();
        encoder.finish().unwrap()
    };
    let folder = Folder::new()
        .with("a.ply", PLY)
        .with("b.obj", TRIANGLE)
        .with("c.ply.gz", gz);
    folder
        .render("a.ply b.obj c.ply.gz --resolution 9x5")
        .succeeded();
    assert_eq!(folder.images(), ["a.png", "b.png", "c.png"]);
    assert!(
        folder.bytes("a.png") == folder.bytes("b.png")
            && folder.bytes("a.png") == folder.bytes("c.png")
    );
    assert_eq!(folder.png("a.png").dimensions(), (9, 5));
}

#[test]
fn every_spelling_of_the_output_flag_writes_there() {
    let folder = Folder::new();
    folder.render("ball.pbrt -o a.exr").succeeded();
    folder.render("ball.pbrt --output b.exr").succeeded();
    folder.render("ball.pbrt --outfile c.EXR").succeeded();
    assert_eq!(folder.images(), ["a.exr", "b.exr", "c.EXR"]);
}

#[test]
fn placeholders_are_filled_in() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt -o {stem}-{accel}.exr --accel middle")
        .succeeded();
    folder.render("ball.pbrt -o {accel}.exr").succeeded();
    assert_eq!(folder.images(), ["auto.exr", "ball-middle.exr"]);
}

#[test]
fn an_unknown_placeholder_is_refused() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt -o {name}.exr")
        .failed(2, "unknown placeholder `{name}`");
    assert!(folder.images().is_empty());
}

#[test]
fn one_named_output_is_overwritten() {
    let folder = Folder::new().with("a.exr", "old");
    folder.render("ball.pbrt -o a.exr").succeeded();
    assert_eq!(folder.exr("a.exr").size, (13, 7));
}

#[test]
fn an_exr_holds_five_channels_of_the_whole_film() {
    let exr = Folder::new().rendered("ball.pbrt");
    assert_eq!((exr.film, exr.origin, exr.size), ((13, 7), (0, 0), (13, 7)));
    assert_eq!(exr.channels(), ["A", "Z", "id", "prim", "t"]);
    assert_eq!(exr.integers, ["id", "prim"]);
    let centre = (CENTRE.1 * SIZE.0 + CENTRE.0) as usize;
    assert_eq!(
        (exr.measures("Z")[centre], exr.measures("t")[centre]),
        (4.0, 4.0)
    );
    assert_eq!((exr.bits["id"][centre], exr.bits["prim"][centre]), (1, 1));
    assert!(exr.measures("A").iter().all(|a| [0.0, 1.0].contains(a)));
    let hits = exr
        .measures("A")
        .iter()
        .zip(&exr.bits["id"])
        .all(|(a, id)| (*a == 1.0) == (*id != 0));
    assert!(hits, "ids are 0 where nothing is hit, and only there");
    assert!(
        exr.measures("t")
            .iter()
            .zip(exr.measures("Z"))
            .all(|(t, z)| *t >= z)
    );
}

#[test]
fn exactly_the_requested_channels_are_written() {
    let folder = Folder::new();
    let all = folder.rendered("ball.pbrt");
    let some = folder.rendered("ball.pbrt --aov prim,Z");
    assert_eq!(some.channels(), ["Z", "prim"]);
    assert!(some.bits.iter().all(|(name, bits)| *bits == all.bits[name]));
}

#[test]
fn surfaces_have_eight_channels() {
    let exr = Folder::new().rendered("ball.pbrt --aov N,P,uv");
    assert_eq!(
        exr.channels(),
        ["N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "u", "v"]
    );
    assert!(exr.integers.is_empty());
    let centre = (CENTRE.1 * SIZE.0 + CENTRE.0) as usize;
    let normal = ["N.X", "N.Y", "N.Z"].map(|name| exr.measures(name)[centre]);
    let point = ["P.X", "P.Y", "P.Z"].map(|name| exr.measures(name)[centre]);
    assert_eq!((normal, point), ([0.0, 0.0, -1.0], [0.0, 0.0, -1.0]));
    assert!(["u", "v"].iter().all(|name| {
        exr.measures(name)
            .iter()
            .all(|value| (0.0..=1.0).contains(value))
    }));
    assert_eq!(exr.measures("N.Z")[0], 0.0, "a miss");
}

#[test]
fn unknown_and_repeated_channels_are_refused() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt --aov Z,depth")
        .failed(2, "invalid value 'depth' for '--aov <NAMES>'");
    folder
        .render("ball.pbrt --aov Z,t,Z")
        .failed(2, "--aov names `Z` twice");
    assert!(folder.images().is_empty());
}

#[test]
fn misses_have_the_requested_value() {
    let folder = Folder::new();
    for (flag, expected) in [
        ("", f32::INFINITY),
        ("--miss inf", f32::INFINITY),
        ("--miss 0", 0.0),
        ("--miss -1", -1.0),
        ("--miss=2.5", 2.5),
    ] {
        let exr = folder.rendered(&format!("ball.pbrt {flag}"));
        let misses = [exr.at_misses("Z"), exr.at_misses("t")].concat();
        assert!(
            !misses.is_empty() && misses.iter().all(|value| *value == expected),
            "{flag}: {misses:?}"
        );
    }
    let exr = folder.rendered("ball.pbrt --miss nan");
    assert!(exr.at_misses("Z").iter().all(|z| z.is_nan()));
    assert_eq!(exr.header["miss"], "NaN");
}

#[test]
fn hits_do_not_depend_on_the_value_of_misses() {
    let folder = Folder::new();
    let (inf, zero) = (
        folder.rendered("ball.pbrt"),
        folder.rendered("ball.pbrt --miss 0"),
    );
    let differing = inf.bits["Z"]
        .iter()
        .zip(&zero.bits["Z"])
        .filter(|(a, b)| a != b)
        .count();
    assert_eq!(differing, inf.at_misses("Z").len());
    assert_eq!(inf.bits["A"], zero.bits["A"]);
}

#[test]
fn a_value_of_misses_must_be_a_number() {
    let run = Folder::new().render("ball.pbrt --miss far").exited(2);
    assert!(run.stderr.starts_with(
        "error: invalid value 'far' for '--miss <VALUE>': expected inf, nan or a number\n"
    ));
}

#[test]
fn flags_without_a_meaning_for_the_format_are_refused() {
    let folder = Folder::new();
    let cases = [
        "-o a.exr --view hit",
        "-o a.exr --range 1,2",
        "-o a.exr --colormap gray",
        "-o a.png --aov Z",
    ];
    for flags in cases
        .into_iter()
        .chain(["-o a.png --view hit --range 1,2", "-o a.png --miss 0"])
    {
        folder
            .render(&format!("ball.pbrt {flags}"))
            .failed(2, "has no meaning for a.");
    }
    assert!(folder.images().is_empty());
}

#[test]
fn the_origin_of_an_unsuitable_name_is_reported() {
    let scene = crate::folder::BALL.replace("film.exr", "film.tga");
    let folder = Folder::new().with("old.pbrt", scene);
    let note = "\n   = the scene names this file; use -o to name another one\n";
    folder
        .render("ball.pbrt --view hit")
        .failed(2, "--view has no meaning for film.exr")
        .said(note);
    folder
        .render("old.pbrt")
        .failed(2, "film.tga: unknown image format `.tga`")
        .said(note);
    folder
        .render("ball.pbrt --view hit -o a.exr")
        .failed(2, "--view has no meaning for a.exr")
        .did_not_say(note);
}

#[test]
fn a_scene_may_come_from_standard_input() {
    let folder = Folder::new();
    folder
        .render_input("- -o {stem}.exr", crate::folder::BALL)
        .succeeded();
    assert_eq!(folder.images(), ["stdin.exr"]);
    assert_eq!(
        folder.exr("stdin.exr").bits,
        folder.rendered("ball.pbrt").bits
    );
}

#[test]
fn an_image_may_go_to_standard_output() {
    let folder = Folder::new();
    let exr = folder.render("ball.pbrt -o -").succeeded();
    let hit = folder.render("ball.pbrt -o - --view hit").succeeded();
    assert!(folder.images().is_empty());
    assert_eq!(Exr::read(&exr.stdout), folder.rendered("ball.pbrt"));
    assert_eq!(png(&hit.stdout)[CENTRE], RED);
}

#[test]
fn the_same_scene_gives_the_same_file() {
    let folder = Folder::new();
    for name in ["a", "b"] {
        folder
            .render(&format!("ball.pbrt -o {name}.exr"))
            .succeeded();
        folder
            .render(&format!("ball.pbrt -o {name}.png"))
            .succeeded();
    }
    assert!(
        folder.bytes("a.exr") == folder.bytes("b.exr")
            && folder.bytes("a.png") == folder.bytes("b.png")
    );
}
