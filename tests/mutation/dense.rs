//! Valid files that describe as much as possible in few bytes.

use super::Format;
use feimos::mesh::MeshFormat;

/// The number of repeated parts in most files.
const COUNT: usize = 100_000;

/// Names, formats and contents. All files are valid, although some show nothing.
pub(crate) fn files() -> Vec<(&'static str, Format, Vec<u8>)> {
    let of = |format, files: Vec<(&'static str, Vec<u8>)>| {
        files
            .into_iter()
            .map(move |(name, bytes)| (name, format, bytes))
    };
    of(Format::Mesh(MeshFormat::Ply), ply_files())
        .chain(of(Format::Mesh(MeshFormat::Obj), obj_files()))
        .chain(of(Format::Mesh(MeshFormat::Off), off_files()))
        .chain(of(Format::Mesh(MeshFormat::Stl), stl_files()))
        .chain(of(Format::Scene, scene_files()))
        .collect()
}

/// `start`, then `part` `count` times, then `end`.
fn repeated(start: &str, part: &str, count: usize, end: &str) -> Vec<u8> {
    format!("{start}{}{end}", part.repeat(count)).into()
}

fn ply_files() -> Vec<(&'static str, Vec<u8>)> {
    let head = "ply\nformat ascii 1.0\n";
    let element = format!("{head}element a 1\n");
    vec![
        ("corners.ply", one_list("face", 5)),
        ("polygons.ply", polygons()),
        ("strip.ply", one_list("tristrips", 5)),
        ("elements.ply", repeated(head, "element a 0\n", COUNT, "")),
        (
            "properties.ply",
            repeated(&element, "property char a\n", COUNT, ""),
        ),
    ]
}

fn obj_files() -> Vec<(&'static str, Vec<u8>)> {
    let vertex = "v 0 0 0\n";
    vec![
        ("corners.obj", repeated("v 0 0 0\nf", " 1", COUNT, "")),
        ("backwards.obj", repeated("v 0 0 0\nf", " -1", COUNT, "")),
        ("triangles.obj", repeated(vertex, "f 1 1 1\n", COUNT, "")),
        ("vertices.obj", repeated("", vertex, COUNT, "f 1 2 3")),
        ("distinct.obj", distinct().into()),
    ]
}

fn off_files() -> Vec<(&'static str, Vec<u8>)> {
    let faces = format!("OFF 1 {COUNT}\n0 0 0\n");
    let vertices = format!("OFF {COUNT} 0\n");
    let corners = format!("OFF 1 1\n0 0 0\n{COUNT}");
    vec![
        ("faces.off", repeated(&faces, "3 0 0 0\n", COUNT, "")),
        ("empty.off", repeated(&faces, "0\n", COUNT, "")),
        ("vertices.off", repeated(&vertices, "0 0 0\n", COUNT, "")),
        ("corners.off", repeated(&corners, " 0", COUNT, "")),
    ]
}

fn stl_files() -> Vec<(&'static str, Vec<u8>)> {
    let facet = "facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 0 0 vertex 0 0 0 endloop \
                 endfacet ";
    let mut binary = vec![0; 84 + 50 * COUNT];
    binary[80..84].copy_from_slice(&(COUNT as u32).to_le_bytes());
    vec![
        (
            "text.stl",
            repeated("solid\n", facet, COUNT / 10, "endsolid"),
        ),
        ("binary.stl", binary),
    ]
}

fn scene_files() -> Vec<(&'static str, Vec<u8>)> {
    let mesh = "WorldBegin\nShape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \
                \"integer indices\" [";
    let world = |part, count| repeated("WorldBegin\n", part, count, "");
    let sphere = "WorldBegin\nShape\"sphere\"";
    vec![
        ("mesh.pbrt", repeated(mesh, "0 1 2 ", COUNT, "]")),
        ("spheres.pbrt", world("Shape\"sphere\"", COUNT / 10)),
        ("moved.pbrt", world("Scale 2 1 1Shape\"sphere\"", 1000)),
        ("blocks.pbrt", world("AttributeBegin ", COUNT / 10)),
        ("names.pbrt", names().into()),
        ("skipped.pbrt", world("Texture\"a\"\"b\"\"c\"", COUNT / 10)),
        (
            "parameters.pbrt",
            repeated(sphere, "\"float a\"1", COUNT / 10, ""),
        ),
    ]
}

/// Bytes as indices of 3 vertices, in one list.
fn one_list(element: &str, most: usize) -> Vec<u8> {
    let mut bytes = header(element, 1, "uint");
    let corners = COUNT * most;
    bytes.extend((corners as u32).to_le_bytes());
    bytes.extend((0..corners).map(|at| (at % 3) as u8));
    bytes
}

/// Polygons of 200 corners each.
fn polygons() -> Vec<u8> {
    let mut bytes = header("face", COUNT / 200, "uchar");
    (0..COUNT / 200).for_each(|_| bytes.extend([[200].as_slice(), &[0; 200]].concat()));
    bytes
}

fn header(element: &str, count: usize, length: &str) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\n\
         property uchar y\nproperty uchar z\n\
         element {element} {count}\nproperty list {length} uchar vertex_indices\nend_header\n"
    )
    .into_bytes();
    bytes.extend([0, 0, 0, 1, 0, 0, 0, 1, 0]);
    bytes
}

/// Distinct corners, all of which `tobj` must keep apart.
fn distinct() -> String {
    let vertex = |at: usize| format!("v {at} {} 0\n", at * at);
    let corners: String = (1..=COUNT / 10).map(|at| format!(" {at}")).collect();
    format!(
        "{}f -1 1 2\nf{corners}\n",
        (1..=COUNT / 10).map(vertex).collect::<String>()
    )
}

fn names() -> String {
    (0..COUNT / 100)
        .map(|at| format!("CoordinateSystem\"{at}\""))
        .collect()
}
