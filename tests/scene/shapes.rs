//! Shapes: parameters, meshes in files, subdivision, patches.

use super::*;

#[test]
fn mirrored_meshes_keep_their_vertices() {
    let scene = scene(&format!(
        "WorldBegin Scale -1 1 1 ReverseOrientation {TRIANGLE}"
    ));
    assert_eq!(
        (vertex(&scene, 1), vertex(&scene, 2)),
        ([-1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    );
    assert_eq!(warnings(&scene), []);
}

#[test]
fn spellings_of_both_versions() {
    let scene = scene(
        "Integrator \"path\" Camera \"perspective\" \"float fov\" [ 40 ]
        ColorSpace \"srgb\" Option \"bool disablepixeljitter\" true
        WorldBegin
        Material \"diffuse\" \"rgb reflectance\" [ 1 0 0 ]
        Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"t.png\"
        Shape \"trianglemesh\" \"point P\" [ 0,0,0  1,0,0  0,1,.5 ] \
        \"integer indices\" [ 0 1 2 ] # v3
        Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1e0 +5E-1 ] \
        \"point2 uv\" [ 0 0  1 0  0 1 ]
        MakeNamedMaterial \"m\" \"string type\" \"matte\"",
    );
    assert_eq!(vertex(&scene, 2), vertex(&scene, 5));
    assert_eq!(warnings(&scene), []);
    let summary = "skipped, without influence on hit and depth: 1 ColorSpace, 1 Integrator, 1 \
                   MakeNamedMaterial, 1 Material, 1 Option, 1 Texture";
    assert_eq!(scene.census.summary().as_deref(), Some(summary));
}

#[test]
fn meshes_are_found_beside_the_scene() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let text = "WorldBegin Shape \"objmesh\" \"string filename\" \"meshes/m.obj\"";
    let scene = load_files(&[("a.pbrt", text), ("meshes/m.obj", obj)]).unwrap();
    assert_eq!(scene.geometry.triangle_count(), 1);
    let missing = load_files(&[("a.pbrt", text)]).unwrap_err();
    let expected = "meshes/m.obj: cannot read: No such file or directory (os error 2)\n   \
                    = named in a.pbrt:1:46";
    assert_eq!(missing, expected);
}

const TETRAHEDRON: &str = "\"point3 P\" [ 1 1 1  1 -1 -1  -1 1 -1  -1 -1 1 ] \
                           \"integer indices\" [ 0 1 2  0 3 1  0 2 3  1 3 2 ]";

#[test]
fn subdivision_surfaces_take_the_levels_of_v3_and_of_v4() {
    for (levels, faces) in [
        ("", 256),
        ("\"integer nlevels\" 0", 4),
        ("\"integer levels\" 1 \"integer nlevels\" 2", 16),
    ] {
        let text = format!(
            "WorldBegin Shape \"loopsubdiv\" {TETRAHEDRON} {levels} \"string scheme\" \"loop\" \
             {TRIANGLE}"
        );
        let scene = scene(&text);
        assert_eq!(
            (scene.geometry.triangle_count(), warnings(&scene)),
            (faces + 1, vec![]),
            "{levels}"
        );
        assert_eq!(
            scene
                .geometry
                .shape_number(InstancedId::alone(PrimitiveId::triangle(faces - 1))),
            1
        );
    }
    // The first vertex halfway: (1 - 3 w) v - w v with w = 1/5.
    let scene = scene(&format!(
        "WorldBegin Translate 10 0 0 Shape \"loopsubdiv\" {TETRAHEDRON} \"integer levels\" 0"
    ));
    assert!((scene.geometry.vertices()[0] - Point::new(10.2, 0.2, 0.2)).largest() < 1e-14);
}

#[test]
fn errors_point_at_faces_that_cannot_be_subdivided() {
    let cases = [
        (
            "\"integer indices\" [ 0 1 2 ]",
            "1:18: a subdivision surface without vertices",
        ),
        (
            "\"point3 P\" [ 0 0 0 ]",
            "1:18: a subdivision surface without faces",
        ),
        (
            "\"point3 P\" [ 0 0 0 ] \"integer indices\" [ 0 0 ]",
            "1:70: `indices` has 2 numbers, expected three a face",
        ),
        (
            "\"point3 P\" [ 0 0 0 ] \"integer indices\" [ 0 0 1 ]",
            "1:76: index 1, number 3 of `indices`, names no vertex",
        ),
        (
            "\"point3 P\" [ 0 0 0 ] \"integer indices\" [ 0 0 0 ]",
            "1:72: a face with vertex 0 twice",
        ),
        (
            "\"integer levels\" -1",
            "1:48: `levels` is -1, expected an integer from 0 to 30",
        ),
        (
            "\"integer nlevels\" 31",
            "1:49: `nlevels` is 31, expected an integer from 0 to 30",
        ),
    ];
    for (parameters, expected) in cases {
        let found = diagnostic(&format!("WorldBegin Shape \"loopsubdiv\" {parameters}"));
        assert!(found.starts_with(&format!("a.pbrt:{expected}")), "{found}");
    }
    let found = diagnostic(&format!(
        "WorldBegin\nShape \"loopsubdiv\" {TETRAHEDRON}\n  \"integer nlevels\" 13"
    ));
    let expected = "a.pbrt:3:21: subdivision would make 268,435,456 faces of the scene's 4: at most \
                    4,210,688 are made of so many\n   |\n 3 |   \
        \"integer nlevels\" 13\n   |                     ^^\n   = if this is meant, raise what \
        input files may expand to: --input-budget 2\n   = else take fewer levels";
    assert_eq!(found, expected);
}

#[test]
fn flat_bilinear_patches_are_two_triangles_and_others_are_patches() {
    let corners = "\"point3 P\" [ 0 0 0  1 0 0  0 1 0  1 1 0  2 0 0  2 1 1 ]";
    let flat = scene(&format!(
        "WorldBegin Shape \"bilinearmesh\" {corners} \"integer indices\" [ 0 1 2 3 ] \
         \"point2 uv\" [ 0 0 ]"
    ));
    assert_eq!(warnings(&flat), []);
    let triangles = [0, 1].map(|index| {
        flat.geometry
            .triangle(index)
            .0
            .map(|corner| (corner.x, corner.y))
    });
    assert_eq!(
        triangles,
        [
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)],
            [(0.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
        ]
    );
    let curved = "\"integer indices\" [ 0 1 2 3  1 4 3 5 ]";
    let both = scene(&format!(
        "WorldBegin Shape \"bilinearmesh\" {corners} {curved} Shape \"bilinearmesh\" {corners} \
         {curved}"
    ));
    // A flat patch keeps two numbers, and any other has one.
    let numbers = |index: usize| {
        let (triangle, patch) = (PrimitiveId::triangle(index), PrimitiveId::quadric(index));
        [triangle, patch].map(|primitive| both.geometry.number(InstancedId::alone(primitive)))
    };
    let counts = [
        both.geometry.triangle_count(),
        both.geometry.quadric_count(),
    ];
    assert_eq!(
        (counts, [numbers(0), numbers(1)]),
        ([4, 2], [[0, 2], [1, 5]])
    );
    assert_eq!(warnings(&both), []);
    let patch = both.geometry.quadric(1);
    assert_eq!(patch.form, feimos::shape::Form::Patch);
    assert_eq!(patch.world_from_object.column(3), [2.0, 1.0, 1.0]);
    let alone =
        scene("WorldBegin Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0  1 1 0 ]");
    assert_eq!(alone.geometry.triangle_count(), 2);
    let found = diagnostic(&format!("WorldBegin Shape \"bilinearmesh\" {corners}"));
    assert!(
        found.starts_with("a.pbrt:1:18: a bilinear mesh of 6 vertices without `indices`"),
        "{found}"
    );
    let found = diagnostic(&format!(
        "WorldBegin Shape \"bilinearmesh\" {corners} \"integer indices\" [ 0 1 2 ]"
    ));
    assert!(
        found.contains("`indices` has 3 numbers, expected four a patch"),
        "{found}"
    );
}

#[test]
fn a_bare_mesh_is_framed() {
    let obj = "v -1 -1 0\nv 3 -1 0\nv 1 2 4\nf 1 2 3\n";
    let scene = load_files(&[("m.obj", obj)]).unwrap();
    let eye = scene.camera.anchor();
    assert_eq!(eye.x, 1.0);
    // The middle of the picture, not that of the mesh, whose top is nearer.
    assert!(0.5 < eye.y && eye.y < 2.0, "{eye:?}");
    assert!(eye.z > 4.0);
    let floor = load_files(&[("m.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nf 1 2 3\n")]).unwrap();
    assert!(
        floor.camera.world_from_camera.column(2)[1] < -0.4,
        "a flat mesh is not seen along its edge"
    );
    let empty = load_files(&[("m.obj", "# nothing\n")]).unwrap();
    assert_eq!(
        (empty.geometry.triangle_count(), warnings(&empty).len()),
        (0, 1)
    );
}

#[test]
fn shapes_count_whether_they_are_supported_or_not() {
    let scene = scene(&format!(
        "WorldBegin {TRIANGLE} Shape \"blob\" Shape \"blob\" Shape \"sphere\" Shape \"spehre\" \
         {TRIANGLE}"
    ));
    assert_eq!(scene.shape_count, 6);
    let geometry = &scene.geometry;
    assert_eq!(
        geometry.shape_number(InstancedId::alone(PrimitiveId::triangle(1))),
        6
    );
    let sphere = InstancedId::alone(PrimitiveId::quadric(0));
    assert_eq!(
        (geometry.shape_number(sphere), geometry.number(sphere)),
        (4, 1)
    );
    let expected = [
        "the shape `blob` is not supported: left out",
        "the shape `spehre` is not supported: left out",
    ];
    assert_eq!(
        warnings(&scene),
        [(expected[0].to_owned(), 2), (expected[1].to_owned(), 1)]
    );
    let second = scene.warnings.iter().nth(1).unwrap();
    assert_eq!(second.first.notes, ["did you mean `sphere`?"]);
}

#[test]
fn a_patch_of_forks_names_its_corners() {
    let corners = "\"point3 P00\" [ 0 0 0 ] \"point3 P10\" [ 1 0 0 ] \"point3 P01\" [ 0 1 0 ]";
    let text = |last: &str| format!("WorldBegin Shape \"bilinearPatch\" {corners} {last}");
    let flat = scene(&text("\"point3 P11\" [ 1 1 0 ]"));
    let counts = |scene: &Scene| {
        (
            scene.geometry.triangle_count(),
            scene.geometry.quadric_count(),
        )
    };
    assert_eq!((counts(&flat), warnings(&flat)), ((2, 0), vec![]));
    assert_eq!(vertex(&flat, 1), [1.0, 0.0, 0.0]);
    let curved = scene(&text("\"point3 P11\" [ 1 1 1 ]"));
    assert_eq!((counts(&curved), warnings(&curved)), ((0, 1), vec![]));
    let missing = diagnostic(&text(""));
    assert!(
        missing.contains("a bilinear patch without the corner `P11`"),
        "{missing}"
    );
}
