use super::{gzipped, message, obj, triangles, vertices, warnings};

const VERTICES: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn with(rest: &str) -> String {
    format!("{VERTICES}{rest}")
}

#[test]
fn keeps_the_order_of_faces_over_groups() {
    let content =
        with("g a\nf 1 2 3\nusemtl red\nf 1 3 4\no b\nv 0 0 1\nf 1/1 2/1/1 5//1\ng a\nf 4 3 2 1\n");
    assert_eq!(
        triangles(obj(&content)),
        [[0, 1, 2], [0, 2, 3], [0, 1, 4], [3, 2, 1], [3, 1, 0]]
    );
    assert_eq!(vertices(obj(&content)).len(), 5);
}

#[test]
fn resolves_indices_that_count_backwards() {
    let content = with("f -4 -3 -2\nv 0 0 1\nf -1 1 2\n");
    assert_eq!(triangles(obj(&content)), [[0, 1, 2], [3, 0, 1]]);
    assert_eq!(vertices(obj(&content))[3], [0.0, 0.0, 1.0]);
}

#[test]
fn reads_numbers_as_doubles_and_divides_by_the_weight() {
    let content =
        "v 0.1 +1 2.\nv 1e+2 -.5 1E-3\nv 1 2 3 2\nv 1 2 3 0.5 0.5 0.5\nf 1 2 3\nf 1 2 4\n";
    assert_eq!(
        vertices(obj(content)),
        [
            [0.1, 1.0, 2.0],
            [100.0, -0.5, 1e-3],
            [0.5, 1.0, 1.5],
            [1.0, 2.0, 3.0]
        ]
    );
}

#[test]
fn joins_continued_lines_except_comments() {
    let content = with("f 1 2\\\r\n 3\n# C:\\\nf 1 \\\n 3 \\\n 4 # not C:\\\nf 2 3 4");
    assert_eq!(triangles(obj(content)), [[0, 1, 2], [0, 2, 3], [1, 2, 3]]);
}

#[test]
fn reads_every_kind_of_line_end() {
    for end in ["\r\n", "\r"] {
        assert_eq!(
            triangles(obj(with("f 1 2 3\n").replace('\n', end))),
            [[0, 1, 2]]
        );
    }
    assert_eq!(
        triangles(obj(format!("\u{feff}{}", with("f 1 2 3")))),
        [[0, 1, 2]]
    );
    assert_eq!(
        triangles(obj(gzipped(with("f 1 2 3").as_bytes()))),
        [[0, 1, 2]]
    );
}

/// Each of these makes `tobj` alone fail or give another mesh.
#[test]
fn leaves_out_what_does_not_shape_the_mesh() {
    let others = "usemtl \nmtllib nowhere.mtl\nvt 0.5\nvn 0 0\nvt x\nl 1 2 3\nl 1 2\np 1\ng\ns off\n# \u{e4}\n";
    assert_eq!(
        triangles(obj(with(others) + "f 1// 2/7/7 3//-8 # last\n")),
        [[0, 1, 2]]
    );
    let latin1 = [
        with("g K\u{f6}rper\nf 1 2 3\n").as_bytes(),
        b"g K\xf6rper\n",
    ]
    .concat();
    assert_eq!(triangles(obj(latin1)), [[0, 1, 2]]);
}

#[test]
fn warns_and_goes_on() {
    let small = with("f\nf 1 2\nf 1 2 3\n");
    let expected = "a.obj:5:1: 2 faces of fewer than 3 corners, left out\n   |\n 5 | f\n   | ^";
    assert_eq!(warnings(obj(small)), [expected]);
    let unknown = with("f 1 2 3\nfaces 1 2 3\n");
    assert!(
        warnings(obj(unknown))[0]
            .starts_with("a.obj:6:1: 1 statement that OBJ does not know, left out")
    );
    let broken = "v nan 0 0\nv inf 0 0\nv 0 0 1e999\nf 1 2 3";
    assert!(
        warnings(obj(broken))[0]
            .starts_with("a.obj: 3 vertices with an infinite or NaN coordinate")
    );
    assert_eq!(
        warnings(obj("# nothing\n")),
        ["a.obj: the mesh is empty: it has no faces\n   = rays cannot hit it"]
    );
}

#[test]
fn says_which_statement_is_wrong() {
    let expected = "a.obj:5:7: the face has a corner at vertex 5, which does not exist\n   |\n 5 | f 1 2 5\n   \
                    |       ^\n   = the file has 4 vertices: expected 1 to 4";
    assert_eq!(message(obj(with("f 1 2 5\n"))), expected);
    let expected = "a.obj:5:3: face index 0\n   |\n 5 | f 0/1 1 2\n   |   ^^^\n   = indices of OBJ count from 1";
    assert_eq!(message(obj(with("f 0/1 1 2\n"))), expected);
    assert!(
        message(obj(with("f 1 2 5\nf 2 0 1\n")))
            .ends_with("\n   = the next mistake is at a.obj:6:5: face index 0")
    );
    let expected = "a.obj:2:5: `3.1+e2` is not a number\n   |\n 2 | v 0 3.1+e2 1\n   |     ^^^^^^";
    assert_eq!(message(obj("v 0 0 0\nv 0 3.1+e2 1\n")), expected);
    assert!(
        message(obj(with("f 1 2 -5\n")))
            .contains("4 vertices come before this line: expected -1 to -4")
    );
    assert!(message(obj(with("f 1 2 \\\n x\n"))).starts_with("a.obj:6:2: `x` is not a corner"));
    assert!(message(obj("v 1 2 ".to_string() + &"9".repeat(1 << 20) + "x")).len() < 400);
    // Found by fuzzing: corners without a position left the OBJ reader a face of none.
    assert!(
        message(obj("s 1\nf 1// 2//\nf /2 / //13//\n"))
            .starts_with("a.obj:3:3: `/2` is not a corner")
    );
    assert!(message(obj("v 1 2\n")).starts_with("a.obj:1:1: a vertex of 2 coordinates"));
    assert!(message(obj("v 1 2 3 0\n")).starts_with("a.obj:1:9: a vertex of weight 0"));
    // A blank that is not ASCII must not split one number into two.
    assert!(message(obj("v 1\u{a0}2 3 4\n")).contains("is not a number"));
}

#[test]
fn refuses_corners_of_another_form() {
    for corner in [
        "1/1/1/7/7",
        "1/1/1/",
        "1///",
        "1/",
        "1/x",
        "1/1/x",
        "1/1.5",
        "1//--2",
        "1/+1",
        "/",
        "1/1/1/1",
    ] {
        let expected = format!("a.obj:5:3: `{corner}` is not a corner");
        let text = message(obj(with(&format!("f {corner} 2 3\n"))));
        assert!(text.starts_with(&expected), "{text}");
    }
    for corner in ["1", "1/7", "1//", "1/7/", "1/7/-7", "1//9"] {
        assert_eq!(
            triangles(obj(with(&format!("f {corner} 2 3\n")))),
            [[0, 1, 2]],
            "{corner}"
        );
    }
}

#[test]
fn warns_of_surfaces_and_calls_left_out() {
    let surface = "cstype bezier\ndeg 3 3\nsurf 0 1 0 1 1 2 3 4\nparm u 0 1\nend\nsurf 0 1 0 1 4 3 2 1\nend\n";
    let expected = "a.obj:8:1: 2 surfaces in free form, left out\n   |\n 8 | surf 0 1 0 1 1 2 3 4\n   | ^^^^\n   \
                    = free-form surfaces are not supported: turn them into polygons where the file was made";
    assert_eq!(
        warnings(obj(with(&format!("f 1 2 3\n{surface}")))),
        [expected]
    );
    for (keyword, count) in [
        ("bsp", 1),
        ("bzp", 1),
        ("cdp", 1),
        ("res", 1),
        ("call other.obj", 1),
        ("csh -make", 1),
    ] {
        assert_eq!(
            warnings(obj(with(&format!("f 1 2 3\n{keyword} 1 2 3 4\n")))).len(),
            count,
            "{keyword}"
        );
    }
    let call = &warnings(obj(with("f 1 2 3\ncall a.obj\ncall b.obj\n")))[0];
    assert!(
        call.starts_with("a.obj:6:1: 2 statements `call` or `csh`, not executed"),
        "{call}"
    );
    // Curves of points and lines have no area.
    assert_eq!(
        triangles(obj(with(
            "f 1 2 3\np 1\nl 1 2\ncstype bezier\ndeg 3\ncurv 0 1 1 2 3 4\nend\n"
        ))),
        [[0, 1, 2]]
    );
}

#[test]
fn reads_numbers_that_are_none_as_windows_prints_them() {
    let content =
        "v 1.#INF 0 -1.#IND\nv nan(ind) 1.#QNAN0 0 # 1.#INF\nv 0 0 1.# comment\nf 1 2 3\n";
    let loaded = obj(content).unwrap();
    let bits = |value: f64| {
        if value.is_nan() {
            "nan".to_owned()
        } else {
            value.to_string()
        }
    };
    let found: Vec<_> = loaded
        .mesh
        .vertices
        .iter()
        .map(|vertex| vertex.to_array().map(bits).join(" "))
        .collect();
    assert_eq!(found, ["inf 0 nan", "nan nan 0", "0 0 1"]);
    assert_eq!(loaded.warnings.len(), 1);
}

#[test]
fn says_where_a_hopeless_polygon_is() {
    let corners = 10_001;
    let radius = |k: i32| if k == 7 { 0.5 } else { 1.0 };
    let vertex = |k: i32| {
        (
            radius(k),
            (f64::from(k) / f64::from(corners) * std::f64::consts::TAU).sin_cos(),
        )
    };
    let mut content = with("f 1 2\nf 1 2 3\n");
    (0..corners)
        .map(vertex)
        .for_each(|(r, (sin, cos))| content += &format!("v {} {} 0\n", r * cos, r * sin));
    content += "f";
    (5..corners + 5).for_each(|index| content += &format!(" {index}"));
    let expected = "a.obj:10008:1: a face of 10001 corners that is not convex\n";
    assert!(message(obj(content)).starts_with(expected));
}

#[test]
fn says_what_a_file_is_instead() {
    assert_eq!(
        message(obj("")),
        "a.obj: not an OBJ mesh: this is an empty file"
    );
    let utf16: Vec<u8> = VERTICES.encode_utf16().flat_map(u16::to_be_bytes).collect();
    assert_eq!(
        message(obj(utf16)),
        "a.obj: not an OBJ mesh: this is UTF-16 text"
    );
    let reads = "feimos reads PBRT scenes, and PLY, OBJ, STL and OFF meshes";
    assert_eq!(
        message(obj("Kaydara FBX Binary  \0\x1a\0")),
        format!("a.obj: not an OBJ mesh: this is an FBX file\n   = {reads}")
    );
}
