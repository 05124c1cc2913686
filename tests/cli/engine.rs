//! Accelerators, instruction sets and threads never change an image.

use crate::folder::{BALL, Folder};

const ACCELERATORS: [&str; 7] = ["none", "middle", "equal", "sah", "hlbvh", "raster", "auto"];

/// A floor of 200 triangles that share edges, some of them twice, with balls that intersect it.
fn crowd() -> String {
    let corners: Vec<String> = (0..121)
        .map(|i| format!("{} 0 {}", i % 11 - 5, i / 11 - 5))
        .collect();
    let squares = (0..100).map(|i| i / 10 * 11 + i % 10);
    let faces: Vec<String> = squares
        .map(|a| format!("{a} {} {} {a} {} {}", a + 1, a + 12, a + 12, a + 11))
        .collect();
    let mesh = |faces: &[String]| {
        let (corners, faces) = (corners.join(" "), faces.join(" "));
        format!("Shape \"trianglemesh\" \"point3 P\" [{corners}] \"integer indices\" [{faces}]\n")
    };
    let balls = (0..30).map(|i| {
        format!(
            "Translate 0.31 0 {}\nShape \"sphere\" \"float radius\" 0.4\n",
            (i % 7) - 3
        )
    });
    let head = BALL
        .split("Shape")
        .next()
        .unwrap()
        .replace("LookAt 0 0 -5", "LookAt 0 4 -8");
    [
        head.as_str(),
        &mesh(&faces),
        &mesh(&faces[30..60]),
        "Translate -4 0 0\n",
    ]
    .concat()
        + &balls.collect::<String>()
}

fn crowded() -> Folder {
    Folder::new().with("crowd.pbrt", crowd())
}

#[test]
fn every_accelerator_gives_the_same_bytes() {
    let folder = crowded();
    for accel in ACCELERATORS {
        folder
            .render(&format!(
                "crowd.pbrt -o {accel}.exr --resolution 61x43 --accel {accel}"
            ))
            .succeeded();
        assert!(
            folder.bytes(&format!("{accel}.exr")) == folder.bytes("none.exr"),
            "{accel}"
        );
    }
    assert!(folder.exr("none.exr").bits["id"].iter().max().unwrap() > &20);
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let folder = crowded();
    for (threads, name) in [
        ("--threads 1", "a"),
        ("--nthreads 1", "b"),
        ("--threads 3", "c"),
        ("", "d"),
    ] {
        folder
            .render(&format!(
                "crowd.pbrt {threads} -o {name}.exr --resolution 61x43"
            ))
            .succeeded();
        folder
            .render(&format!(
                "crowd.pbrt {threads} -o {name}.png --resolution 61x43"
            ))
            .succeeded();
        assert!(
            folder.bytes(&format!("{name}.exr")) == folder.bytes("a.exr"),
            "{threads}"
        );
        assert!(
            folder.bytes(&format!("{name}.png")) == folder.bytes("a.png"),
            "{threads}"
        );
    }
}

#[test]
fn every_instruction_set_gives_the_same_bytes() {
    let folder = crowded();
    for (precision, channels) in [
        ("exact", "Z,t,A,id,N,P"),
        ("fast", "Z,t,A,id"),
        ("exact", "A"),
    ] {
        let made_with = |set: &str| {
            let flags =
                format!("--simd {set} --precision {precision} --aov {channels} --resolution 61x43");
            let run = folder.render(&format!("crowd.pbrt -o out.exr --json {flags}"));
            (run.code == 0).then(|| (run.json()[0]["simd"].clone(), folder.bytes("out.exr")))
        };
        let (_, expected) = made_with("portable").expect("every machine has it");
        for set in ["sse4.1", "avx2", "avx512"] {
            if let Some((simd, found)) = made_with(set) {
                assert_eq!(simd, set);
                assert!(found == expected, "{set} {precision} {channels}");
            }
        }
    }
    let unknown = folder.render("crowd.pbrt --simd neon9");
    assert_eq!(unknown.code, 2);
    assert!(
        unknown.stderr.contains("[possible values: auto, portable"),
        "{}",
        unknown.stderr
    );
}

/// Two squares in one plane, split along different diagonals: every ray hits both at the same
/// point.
const IN_ONE_PLANE: &str = r#"
LookAt 0.3 1.7 -5.1  0.1 0.2 0  0 1 0
Camera "perspective" "float fov" 60
Film "rgb" "integer xresolution" 16 "integer yresolution" 9 "string filename" "plane.exr"
WorldBegin
Shape "trianglemesh" "point3 P" [-90 0 -90  90 0 -90  90 0 90  -90 0 90]
    "integer indices" [0 1 2 0 2 3]
Shape "trianglemesh" "point3 P" [-91 0 -90  92 0 -93  93 0 90  -90 0 94]
    "integer indices" [0 1 3 1 2 3]
"#;

#[test]
fn exact_is_the_default_and_counts_its_fallbacks() {
    // The second square lies so little above the first that `f64` cannot order the hits of a ray.
    let apart = IN_ONE_PLANE.replace(
        "[-91 0 -90  92 0 -93  93 0 90  -90 0 94]",
        "[-91 H -90  92 H -93  93 H 90  -90 H 94]",
    );
    let folder = Folder::new()
        .with("plane.pbrt", IN_ONE_PLANE)
        .with("apart.pbrt", apart.replace('H', "1e-17"));
    let line = |flags: &str| {
        folder
            .render(&format!("{flags} --json -o plane.exr"))
            .succeeded()
            .json()[0]
            .clone()
    };
    for (scene, nearest, share) in [("plane.pbrt", 1, 0), ("apart.pbrt", 2, 1)] {
        for flags in ["", "--precision exact --accel none --threads 1"] {
            let line = line(&format!("{scene} {flags}"));
            let hits = line["hits"].as_u64().unwrap();
            assert_eq!(line["precision"], "exact");
            assert_eq!(
                line["exact"]["comparisons"],
                hits * share,
                "{scene}: planes are compared once, and hits if they differ"
            );
            assert_eq!(line["exact"]["fallback_rays"], hits * share, "{scene}");
            assert!(hits > 50);
            let ids = folder.exr("plane.exr").bits["id"].clone();
            assert!(ids.iter().all(|id| *id == 0 || *id == nearest), "{scene}");
        }
    }
    let fast = line("plane.pbrt --precision fast");
    assert_eq!(
        (&fast["precision"], &fast["exact"]),
        (&"fast".into(), &serde_json::Value::Null)
    );
}

#[test]
fn fast_also_gives_the_same_bytes_with_every_accelerator() {
    let folder = crowded();
    for accel in ACCELERATORS {
        let flags = format!("-o {accel}.exr --resolution 61x43 --accel {accel} --precision fast");
        folder.render(&format!("crowd.pbrt {flags}")).succeeded();
        assert!(
            folder.bytes(&format!("{accel}.exr")) == folder.bytes("none.exr"),
            "{accel}"
        );
    }
    folder
        .render("crowd.pbrt -o exact.exr --resolution 61x43")
        .succeeded();
    let (exact, fast) = (
        folder.exr("exact.exr").measures("Z"),
        folder.exr("none.exr").measures("Z"),
    );
    assert!(exact != fast, "the flag has an effect");
    let close = |(a, b): (&f32, &f32)| a == b || (a - b).abs() < 1e-5 * a;
    assert!(exact.iter().zip(&fast).filter(|pair| close(*pair)).count() > exact.len() - 9);
}

/// Rays pass through the missing parts of a sphere: half of it, a cap or a slice.
#[test]
fn partial_spheres_are_cut_as_in_pbrt() {
    let sphere = |parameters: &str| {
        let head = BALL.split("Shape").next().unwrap();
        format!(
            "{head}Shape \"sphere\" {parameters}\nTranslate 0 0 9\n\
             Shape \"sphere\" \"float radius\" 4\n"
        )
    };
    let ids = |parameters: &str| {
        let folder = Folder::new().with("cut.pbrt", sphere(parameters));
        folder
            .render("cut.pbrt -o cut.exr --resolution 3x3")
            .succeeded()
            .did_not_say("warning");
        folder.exr("cut.exr").bits["id"].clone()
    };
    let whole = ids("");
    assert_eq!(whole[4], 1, "the middle of the near sphere");
    // The view is along z: zmax 0 leaves the near half, zmin 0 the far one, through whose hole the
    // far half is seen.
    assert_eq!(ids("\"float zmax\" 0"), whole);
    assert_eq!(ids("\"float zmin\" 0"), whole);
    // A hole around the near pole and the far one: the middle ray passes.
    assert_eq!(ids("\"float zmin\" -0.9 \"float zmax\" 0.9")[4], 2);
    assert_eq!(
        ids("\"float zmin\" -0.9")[4],
        1,
        "the far pole is still there"
    );
    // Half a turn leaves y >= 0, which is up, and the poles.
    let half = ids("\"float phimax\" 180");
    assert_eq!((half[4], half[1]), (1, whole[1]));
}
