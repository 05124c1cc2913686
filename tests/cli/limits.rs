//! Limits on what input files may expand to, and the flag that raises them.

use crate::folder::Folder;
use flate2::Compression;
use flate2::write::GzEncoder;
use image::{ImageBuffer, ImageFormat, Luma};
use std::io::{Cursor, Write};

const WORLD: &str = "Camera \"perspective\"\nWorldBegin\n";

fn gzipped(content: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(content).unwrap();
    encoder.finish().unwrap()
}

#[test]
fn compressed_files_of_a_scene_have_one_limit() {
    let blanks = gzipped(&vec![b' '; 40 << 20]);
    let scene = format!("{WORLD}{}", "Include \"blanks.pbrt.gz\"\n".repeat(1000));
    let folder = Folder::new()
        .with("blanks.pbrt.gz", blanks)
        .with("a.pbrt", scene);
    let run = folder.check("a.pbrt").failed(65, "blanks.pbrt.gz: ");
    assert!(
        run.stderr
            .contains("bytes of gzip data decompress to more than"),
        "{}",
        run.stderr
    );
    assert!(run.stderr.contains("--input-budget 2"), "{}", run.stderr);
    assert!(
        run.stderr.contains("included from a.pbrt:5:9"),
        "the first two have room: {}",
        run.stderr
    );
    let few = format!("{WORLD}{}", "Include \"blanks.pbrt.gz\"\n".repeat(3));
    folder
        .with("few.pbrt", few)
        .check("few.pbrt --input-budget 2")
        .succeeded();
}

#[test]
fn faces_made_by_subdivision_have_one_limit() {
    let surface = |levels: u32| {
        let shape = "\"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2]";
        format!("Shape \"loopsubdiv\" \"integer levels\" {levels} {shape}\n")
    };
    let folder = Folder::new().with("twelve.pbrt", format!("{WORLD}{}", surface(12)));
    let folder = folder.with(
        "many.pbrt",
        format!("{WORLD}{}{}", surface(3).repeat(7), surface(11).repeat(2)),
    );
    let folder = folder.with("few.pbrt", format!("{WORLD}{}", surface(6).repeat(8)));
    folder.check("few.pbrt").succeeded();
    let run = folder.check("twelve.pbrt").failed(
        65,
        "twelve.pbrt:3:37: subdivision would make 16,777,216 faces",
    );
    assert!(run.stderr.contains("--input-budget 2"), "{}", run.stderr);
    folder
        .check("many.pbrt")
        .failed(65, "many.pbrt:11:37: subdivision would make");
}

#[test]
fn meshes_named_repeatedly_have_one_limit() {
    let numbers: Vec<f32> = (0..3 * 1000).map(|k| k as f32).collect();
    let numbers: Vec<String> = numbers.iter().map(f32::to_string).collect();
    let default = format!(
        "Attribute \"shape\" \"point3 P\" [{}] \"integer indices\" [0 1 2]\n",
        numbers.join(" ")
    );
    let scene = |count: usize| {
        format!(
            "{WORLD}{default}{}",
            "Shape \"trianglemesh\"\n".repeat(count)
        )
    };
    let folder = Folder::new()
        .with("few.pbrt", scene(20))
        .with("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.check("few.pbrt").succeeded();
    let named = format!(
        "{WORLD}{}",
        "Shape \"objmesh\" \"string filename\" \"mesh.obj\"\n".repeat(100)
    );
    let run = folder
        .with("named.pbrt", named)
        .check("named.pbrt")
        .succeeded();
    assert!(
        String::from_utf8(run.stdout)
            .unwrap()
            .contains("100 triangles")
    );
}

#[test]
fn images_that_take_far_more_memory_than_their_files_are_refused() {
    let image = ImageBuffer::<Luma<u16>, _>::new(8000, 8000);
    let mut file = Cursor::new(Vec::new());
    image.write_to(&mut file, ImageFormat::Png).unwrap();
    let folder = Folder::new().with("a.png", file.into_inner());
    let run = folder.compare("a.png a.png").failed(65, "a.png: ");
    assert!(
        run.stderr.contains("bytes of PNG hold 8000 x 8000 pixels"),
        "{}",
        run.stderr
    );
    assert!(run.stderr.contains("--input-budget 2"), "{}", run.stderr);
}

#[cfg(unix)]
#[test]
fn a_scene_must_name_regular_files() {
    let folder = Folder::new();
    let made = std::process::Command::new("mkfifo")
        .arg(folder.path("pipe"))
        .status()
        .unwrap();
    assert!(made.success());
    let folder = folder.with("a.pbrt", format!("{WORLD}\nInclude \"pipe\""));
    let folder = folder.with(
        "b.pbrt",
        format!("{WORLD}\nShape \"plymesh\" \"string filename\" \"pipe\""),
    );
    let folder = folder.with("c.pbrt", format!("{WORLD}\nInclude \"/dev/zero\""));
    for (scene, found) in [
        ("a", "a pipe or a socket"),
        ("b", "a pipe or a socket"),
        ("c", "a device"),
    ] {
        let run = folder
            .check(&format!("{scene}.pbrt"))
            .failed(66, &format!("this is {found}, not a file"));
        assert!(
            run.stderr.contains(&format!("{scene}.pbrt:4:")),
            "{}",
            run.stderr
        );
    }
}

#[test]
fn the_factor_is_checked() {
    let folder = Folder::new();
    for factor in ["0", "-1", "1000001", "x", "1.5"] {
        folder
            .check(&format!("ball.pbrt --input-budget={factor}"))
            .failed(2, "expected an integer from 1 to 1000000");
    }
    for command in [
        "check ball.pbrt",
        "pixel ball.pbrt 3,3",
        "render ball.pbrt -o a.exr",
        "compare a.exr a.exr",
    ] {
        let (name, arguments) = command.split_once(' ').unwrap();
        folder
            .run(name, &format!("{arguments} --input-budget 3"))
            .succeeded();
    }
    folder.merge("a.exr -o b.exr --input-budget 3").succeeded();
}
