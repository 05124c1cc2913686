//! Kinds of inputs: mesh files of each format, folders, and files of other programs.

use crate::folder::Folder;

/// Three corners in front of each other, and one beside them.
const VERTICES: [[f32; 3]; 5] = [
    [0.0, 0.0, 0.0],
    [3.0, 0.25, 1.0],
    [2.0, 3.0, -1.0],
    [-1.0, 2.0, 0.5],
    [1.0, 1.0, 2.0],
];
const TRIANGLES: [[usize; 3]; 4] = [[0, 1, 2], [0, 2, 3], [0, 1, 4], [1, 2, 4]];

/// A line for each item, of its numbers behind `start`.
fn lines<T: ToString, const N: usize>(start: &str, items: &[[T; N]]) -> String {
    let line = |item: &[T; N]| {
        let numbers: Vec<String> = item.iter().map(T::to_string).collect();
        format!("{start}{}\n", numbers.join(" "))
    };
    items.iter().map(line).collect()
}

/// The same triangles in each format: by name.
fn meshes() -> Vec<(&'static str, Vec<u8>)> {
    let properties: String = ["x", "y", "z"]
        .map(|c| format!("property float {c}\n"))
        .concat();
    let ply = format!(
        "ply\nformat ascii 1.0\nelement vertex 5\n{properties}element face 4\n\
         property list uchar int vertex_indices\nend_header\n{}{}",
        lines("", &VERTICES),
        lines("3 ", &TRIANGLES)
    );
    let from_1 = TRIANGLES.map(|triangle| triangle.map(|corner| corner + 1));
    let obj = lines("v ", &VERTICES) + &lines("f ", &from_1);
    let off = format!(
        "OFF\n5 4 0\n{}{}",
        lines("", &VERTICES),
        lines("3 ", &TRIANGLES)
    );
    let mut text = "solid\n".to_owned();
    let mut binary = [&b"solid"[..], &[0; 75], &[4, 0, 0, 0]].concat();
    for triangle in TRIANGLES {
        let corners = triangle.map(|corner| VERTICES[corner]);
        let vertices = lines("vertex ", &corners);
        text += &format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n");
        binary.extend([0; 12]);
        binary.extend(
            corners
                .as_flattened()
                .iter()
                .flat_map(|number| number.to_le_bytes()),
        );
        binary.extend([0; 2]);
    }
    text += "endsolid\n";
    vec![
        ("a.ply", ply.into()),
        ("b.obj", obj.into()),
        ("c.off", off.into()),
        ("d.stl", text.into()),
        ("e.stl", binary),
    ]
}

#[test]
fn a_mesh_is_the_same_in_every_format() {
    let flags = "--resolution 41x23 --aov Z,t,A,prim,N,uv";
    let mut bare = Vec::new();
    let mut named = Vec::new();
    for (name, content) in meshes() {
        let folder = Folder::new().with(name, &content);
        bare.push(folder.rendered(&format!("{name} {flags}")).bits);
        for shape in ["plymesh", "objmesh"] {
            if (name, shape) == ("b.obj", "plymesh") {
                continue;
            }
            let scene = format!(
                "LookAt 1 1 9 1 1 0 0 1 0\nCamera \"perspective\"\nWorldBegin\n\
                 Shape \"{shape}\" \"string filename\" \"{name}\"\n"
            );
            std::fs::write(folder.path("a.pbrt"), scene).unwrap();
            named.push(folder.rendered(&format!("a.pbrt --force {flags}")).bits);
        }
    }
    assert!(bare[0]["prim"].contains(&4));
    assert!(bare.iter().all(|image| image == &bare[0]));
    assert!(named.iter().all(|image| image == &named[0]));
}

#[test]
fn compressed_meshes_are_known_by_their_content() {
    let gzipped = |content: &[u8]| {
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        std::io::Write::write_all(&mut encoder, content).unwrap();
        encoder.finish().unwrap()
    };
    for (name, content) in meshes() {
        let plain = Folder::new().with(name, &content);
        let expected = plain.rendered(&format!("{name} --resolution 9x7"));
        let zipped = format!("{name}.gz");
        let folder = Folder::new().with(&zipped, gzipped(&content));
        let image = folder.rendered(&format!("{zipped} --resolution 9x7"));
        assert_eq!(image.bits, expected.bits, "{name}");
    }
}

#[test]
fn files_of_other_programs_are_named() {
    let reads = "feimos reads PBRT scenes, and PLY, OBJ, STL and OFF meshes";
    let folder = Folder::new()
        .with("a.fbx", b"Kaydara FBX Binary  \x00\x1a\x00")
        .with("a.usdz", b"PK\x03\x04\0\0")
        .with("a.xml", "<scene version=\"3.0.0\"></scene>")
        .with("a.glb", b"glTF\x02\0\0\0")
        .with("a.gltf", "{\"asset\": {\"version\": \"2.0\"}}")
        .with("a.splat", b"\0\x01\x02")
        .with("mesh", "solid a\nendsolid a\n")
        .with("b.ply", "BLENDER-v300\0")
        .with("b.off", b"OFF BINARY\n\0\0\0\x01");
    for (name, found) in [
        ("a.fbx", "an FBX file"),
        ("a.usdz", "a USDZ archive"),
        ("a.xml", "a Mitsuba scene"),
        ("a.splat", "a Gaussian splat file"),
    ] {
        let expected = format!("{name}: this is {found}\n   = {reads}\n");
        folder.render(name).failed(65, &expected);
    }
    for name in ["a.glb", "a.gltf"] {
        let expected = format!("{name}: this is a glTF file\n   = {reads}: convert it, ");
        folder.render(name).failed(65, &expected);
    }
    let advice = "mesh: this is an STL mesh\n   = give it the extension of its format";
    folder.render("mesh").failed(65, advice);
    let other = format!("b.ply: not a PLY mesh: this is a Blender file\n   = {reads}\n");
    folder.render("b.ply").failed(65, &other);
    folder
        .render("b.off")
        .failed(65, "b.off:1:5: this is a binary OFF mesh");
}

#[test]
fn a_folder_is_answered_with_the_scenes_in_it() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("scenes")).unwrap();
    let empty = "scenes: this is a folder, not a file\n   = it has no file `*.pbrt`";
    folder.render("scenes").failed(66, empty);
    let folder = folder.with("scenes/a.pbrt", "WorldBegin\n");
    let advice = "this is a folder, not a file\n   = name the scenes in it: `scenes/*.pbrt`";
    folder.render("scenes").failed(66, advice);
    folder.bench("scenes").failed(66, advice);
    folder.pixel("scenes 1,1").failed(66, advice);
}
