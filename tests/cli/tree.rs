//! `feimos tree`: statistics by depth, boxes as a mesh and over a picture.

use crate::folder::{Folder, Run};
use serde_json::json;

/// Eight spheres side by side, each with a leaf of its own.
fn row() -> Folder {
    let spheres: String = (0..8)
        .map(|x| {
            let x = 2.5 * f64::from(x) - 8.75;
            format!("AttributeBegin Translate {x} 0 0 Shape \"sphere\" AttributeEnd\n")
        })
        .collect();
    let scene = format!(
        "LookAt 0 3 -20 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 50
        Film \"rgb\" \"integer xresolution\" 60 \"integer yresolution\" 40
        Accelerator \"bvh\" \"string splitmethod\" \"equal\" \"integer maxnodeprims\" 1
        WorldBegin {spheres}"
    );
    Folder::new().with("row.pbrt", scene)
}

fn tree(folder: &Folder, arguments: &str) -> Run {
    folder.run("tree", arguments)
}

#[test]
fn text_has_depths_and_leaf_sizes() {
    let run = tree(&row(), "row.pbrt").succeeded();
    let expected = "\
row.pbrt, equal
  all trees   15 nodes, 8 of them leaves
  depth       3
";
    assert!(run.text().starts_with(expected), "{}", run.text());
    let table = "
  scene       8 primitives: 15 nodes, 1.0 a leaf, SAH cost ";
    assert!(run.text().contains(table), "{}", run.text());
    let words: Vec<Vec<&str>> = run
        .text()
        .lines()
        .map(|line| line.split_whitespace().collect())
        .collect();
    let bar = "##############################";
    assert!(words.contains(&vec![
        "by",
        "depth",
        "depth",
        "nodes",
        "leaves",
        "primitives",
        "area"
    ]));
    assert!(words.contains(&vec!["0", "1", "0", "0", "1.00"]));
    assert!(
        words
            .iter()
            .any(|line| line.starts_with(&["3", "8", "8", "8"]) && line[5] == bar)
    );
    assert!(words.contains(&vec!["1", "8", bar]));
    let run = tree(&row(), "row.pbrt --max-leaf 8 --accel none").succeeded();
    assert!(
        run.text()
            .starts_with("row.pbrt, none\n  all trees   1 node, 1 of them leaves\n")
    );
    assert!(tree(&row(), "row.pbrt -q").succeeded().text().is_empty());
}

#[test]
fn json_has_every_level() {
    let run = tree(&row(), "row.pbrt --json").succeeded();
    let report = &run.json()[0];
    assert_eq!(
        (
            &report["accel"],
            &report["nodes"],
            &report["leaves"],
            &report["depth"]
        ),
        (&json!("equal"), &json!(15), &json!(8), &json!(3))
    );
    let tree = &report["trees"][0];
    assert_eq!(
        (&tree["over"], &tree["items"]),
        (&json!("scene"), &json!(8))
    );
    assert_eq!(tree["leaf_sizes"], json!([{"items": 1, "leaves": 8}]));
    let levels = tree["levels"].as_array().unwrap();
    let nodes: Vec<u64> = levels
        .iter()
        .map(|level| level["nodes"].as_u64().unwrap())
        .collect();
    assert_eq!(nodes, [1, 2, 4, 8]);
    assert_eq!(levels[0]["area"], json!(1.0));
}

#[test]
fn objects_have_trees_that_are_shown_once() {
    let object = |name: &str| {
        format!(
            "ObjectBegin \"{name}\" Shape \"sphere\" Shape \"disk\" ObjectEnd \
             ObjectInstance \"{name}\" Translate 9 0 0 ObjectInstance \"{name}\"\n"
        )
    };
    let folder = Folder::new()
        .with("one.pbrt", format!("WorldBegin {}", object("a")))
        .with(
            "two.pbrt",
            format!("WorldBegin {}{}", object("a"), object("b")),
        )
        .with("empty.pbrt", "WorldBegin");
    let one = tree(&folder, "one.pbrt").succeeded();
    assert!(
        one.text()
            .contains("\n  instances   2 instances: 1 node, 2.0 a leaf")
    );
    assert!(
        one.text()
            .contains("\n  object      2 primitives, shown by 2 instances: 1 node")
    );
    let two = tree(&folder, "two.pbrt").succeeded();
    let title = "\n  objects      object  instances   primitives      nodes  depth  SAH cost\n";
    assert!(two.text().contains(title), "{}", two.text());
    let json = tree(&folder, "two.pbrt --json").succeeded().json();
    let trees = json[0]["trees"].as_array().unwrap();
    let over: Vec<_> = trees
        .iter()
        .map(|tree| (&tree["over"], &tree["object"]))
        .collect();
    let (null, one, two) = (json!(null), json!(1), json!(2));
    let (instances, object) = (json!("instances"), json!("object"));
    assert_eq!(
        over,
        [(&instances, &null), (&object, &one), (&object, &two)]
    );
    let empty = tree(&folder, "empty.pbrt").succeeded();
    assert!(
        empty.text().contains("no tree     nothing can be hit"),
        "{}",
        empty.text()
    );
}

#[test]
fn boxes_are_a_mesh_that_can_be_rendered() {
    let folder = row();
    tree(&folder, "row.pbrt --ply boxes.ply --depth 3")
        .succeeded()
        .said("boxes.ply: 8 boxes as quads");
    let check = folder.check("boxes.ply --json").succeeded().json();
    assert_eq!(check[0]["triangles"], json!(8 * 6 * 2));
    let [low, high] = ["low", "high"].map(|end| {
        let end = check[0]["bounds"][end].as_array().unwrap();
        end.iter()
            .map(|x| x.as_f64().unwrap())
            .collect::<Vec<f64>>()
    });
    let expected = [[-9.75, -1.0, -1.0], [9.75, 1.0, 1.0]];
    for (found, expected) in low.iter().chain(&high).zip(expected.as_flattened()) {
        assert!((found - expected).abs() < 1e-4, "{low:?} {high:?}");
    }
    tree(&folder, "row.pbrt --ply boxes.ply --depth 0")
        .succeeded()
        .said("1 box as quads");
    tree(&folder, "row.pbrt --ply boxes.ply")
        .succeeded()
        .said("15 boxes");
}

#[test]
fn boxes_are_drawn_over_the_picture() {
    let folder = row();
    tree(&folder, "row.pbrt -o tree.png --depth 0,3")
        .succeeded()
        .said("tree.png: 15 boxes from depth 0, red, to 3, blue");
    let picture = folder.png("tree.png");
    assert_eq!(picture.dimensions(), (60, 40));
    let (mut red, mut blue, mut gray) = (0, 0, 0);
    for pixel in picture.pixels() {
        let [r, g, b] = pixel.0.map(i32::from);
        red += i32::from(r > 2 * b && r > 2 * g);
        blue += i32::from(b > r + 80);
        gray += i32::from(r == g && g == b);
    }
    assert!(
        red > 20 && blue > 20 && gray > 20,
        "{red} red, {blue} blue, {gray} gray"
    );
    tree(&folder, "row.pbrt -o tree.png --depth 3 --resolution 30x20")
        .succeeded()
        .said("8 boxes at depth 3, red");
    assert_eq!(folder.png("tree.png").dimensions(), (30, 20));
}

#[test]
fn mistakes_are_told_before_the_work() {
    let folder = row().with(
        "sky.pbrt",
        "Camera \"spherical\" WorldBegin Shape \"sphere\"",
    );
    let cases = [
        ("row.pbrt --depth 3", "give -o FILE.png or --ply FILE.ply"),
        (
            "row.pbrt -o t.png --depth 4,3",
            "expected the smaller depth first",
        ),
        (
            "row.pbrt -o t.png --depth 97",
            "not an integer from 0 to 96",
        ),
        ("row.pbrt -o t.png --depth x", "`x` is not an integer"),
        ("row.pbrt -o t.exr", "expected a name that ends in .png"),
        ("row.pbrt --ply t.obj", "expected a name that ends in .ply"),
        ("row.pbrt --max-leaf 0", "expected a number from 1"),
        (
            "row.pbrt --accel raster",
            "possible values: none, middle, equal, sah, hlbvh",
        ),
        ("sky.pbrt -o t.png", "--ply writes them as a mesh"),
    ];
    for (arguments, message) in cases {
        tree(&folder, arguments).failed(2, message);
    }
    let folder = folder.with("m.ply", "ply\n");
    tree(&folder, "m.ply --ply m.ply").failed(2, "--ply would overwrite a scene");
    let scene = "WorldBegin Shape \"plymesh\" \"string filename\" \"t.ply\"";
    let triangle = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                    property float z\nelement face 1\nproperty list uchar int vertex_indices\n\
                    end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    let folder = folder.with("mesh.pbrt", scene).with("t.ply", triangle);
    tree(&folder, "mesh.pbrt --ply t.ply").failed(2, "would overwrite a file that the scene reads");
    assert_eq!(folder.text("t.ply"), triangle);
}
