//! Names of objects, coordinate systems and files: their order, and how they are spelled.

use crate::{TRIANGLE, error, folder, load_files, load_folder, scene, warnings};
use feimos::scene::Scene;
use feimos::shape::Instance;

const SPHERE: &str = "Shape \"sphere\"";

fn numbers(scene: &Scene) -> Vec<(u64, u32)> {
    let geometry = &scene.geometry;
    let mut numbers: Vec<_> = geometry
        .all()
        .map(|placed| (geometry.number(placed), geometry.shape_number(placed)))
        .collect();
    numbers.sort_unstable();
    numbers
}

#[test]
fn an_instance_may_stand_before_its_object() {
    let object = |name: &str| format!("ObjectBegin \"{name}\" {TRIANGLE} {SPHERE} ObjectEnd\n");
    let uses = format!(
        "{SPHERE} ObjectInstance \"a\" {SPHERE} {SPHERE} Translate 1 0 0 ObjectInstance \"b\" \
         {TRIANGLE} ObjectInstance \"a\" {SPHERE}"
    );
    let before = scene(&format!(
        "WorldBegin {uses} {} {}",
        object("a"),
        object("b")
    ));
    let after = scene(&format!(
        "WorldBegin {} {} {uses}",
        object("a"),
        object("b")
    ));
    assert_eq!(warnings(&before), []);
    let order = |scene: &Scene| {
        numbers(scene)
            .into_iter()
            .map(|(number, _)| number)
            .collect::<Vec<_>>()
    };
    assert_eq!(order(&before), (0..11).collect::<Vec<_>>());
    assert_eq!(order(&before), order(&after));
    let firsts = |scene: &Scene| {
        scene
            .geometry
            .instances()
            .iter()
            .map(Instance::first_number)
            .collect::<Vec<_>>()
    };
    assert_eq!(firsts(&before), [1, 5, 8]);
    assert_eq!(firsts(&before), firsts(&after));
    let some = scene(&format!(
        "WorldBegin {} ObjectInstance \"a\" {uses} {}",
        object("a"),
        object("b")
    ));
    assert_eq!(order(&some), (0..13).collect::<Vec<_>>());
}

#[test]
fn an_instance_of_nothing_is_an_error_at_its_place() {
    let found = error(&format!(
        "WorldBegin\n ObjectInstance \"tere\" ObjectBegin \"tree\" {SPHERE} ObjectEnd"
    ));
    assert!(
        found.starts_with("a.pbrt:2:17: there is no object called `tere`"),
        "{found}"
    );
    assert!(found.contains("did you mean `tree`?"), "{found}");
}

#[test]
fn a_name_may_be_composed_or_not() {
    let (composed, decomposed) = ("caf\u{e9}", "cafe\u{301}");
    let scene = scene(&format!(
        "WorldBegin CoordinateSystem \"{composed}\" Translate 5 0 0 \
         CoordSysTransform \"{decomposed}\" {TRIANGLE}
        ObjectBegin \"{decomposed}\" {SPHERE} ObjectEnd ObjectInstance \"{composed}\""
    ));
    assert_eq!(
        (warnings(&scene), scene.geometry.instances().len()),
        (vec![], 1)
    );
    assert_eq!(scene.geometry.vertices()[0].x, 0.0);
}

#[test]
fn names_that_are_not_utf8_are_told_apart() {
    let folder = folder(&[]);
    let object = |name: &[u8]| {
        [
            b"ObjectBegin \"".as_slice(),
            name,
            b"\" Shape \"sphere\" ObjectEnd\n",
        ]
        .concat()
    };
    let instance = |name: &[u8]| [b"ObjectInstance \"".as_slice(), name, b"\"\n"].concat();
    let text = [
        b"WorldBegin\n".to_vec(),
        object(b"\xe9"),
        object(b"\xe8"),
        instance(b"\xe9"),
        instance(b"\xe8"),
    ];
    std::fs::write(folder.path().join("a.pbrt"), text.concat()).unwrap();
    let scene = load_folder(&folder, "a.pbrt").unwrap();
    assert_eq!(warnings(&scene), []);
    assert_eq!(
        scene
            .geometry
            .instances()
            .iter()
            .map(Instance::object)
            .collect::<Vec<_>>(),
        [0, 1]
    );
}

#[cfg(target_os = "linux")]
#[test]
fn files_may_have_names_that_are_not_utf8() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = folder(&[]);
    std::fs::write(
        folder.path().join(OsStr::from_bytes(b"caf\xe9.pbrt")),
        "Include \"caf\u{e9}.pbrt\"",
    )
    .unwrap();
    std::fs::write(folder.path().join("caf\u{e9}.pbrt"), SPHERE).unwrap();
    std::fs::write(
        folder.path().join("a.pbrt"),
        b"WorldBegin Include \"caf\xe9.pbrt\"",
    )
    .unwrap();
    assert_eq!(
        load_folder(&folder, "a.pbrt")
            .unwrap()
            .geometry
            .quadric_count(),
        1
    );
}

#[test]
fn coordinate_systems_of_an_import_end_with_it() {
    let import = |part: &str, rest: &str| {
        let text = format!(
            "WorldBegin CoordinateSystem \"q\" Import \"b.pbrt\" Translate 7 0 0 \
             CoordSysTransform \"q\" {rest} {SPHERE}"
        );
        load_files(&[("a.pbrt", &text), ("b.pbrt", part)]).unwrap()
    };
    let place = |scene: &Scene| scene.geometry.quadric(0).world_from_object.column(3)[0];
    let leaking = "Translate 9 0 0 CoordinateSystem \"q\" CoordinateSystem \"r\" Translate 1 0 0 \
                   CoordinateSystem \"q\"";
    assert_eq!(place(&import(leaking, "")), 0.0);
    let unknown = import(leaking, "CoordSysTransform \"r\"");
    assert_eq!(
        warnings(&unknown),
        [("no coordinate system is called `r`: ignored".to_owned(), 1)]
    );
    // Objects and materials stay.
    let merged = import(
        &format!("ObjectBegin \"o\" {SPHERE} ObjectEnd"),
        "ObjectInstance \"o\"",
    );
    assert_eq!(
        (merged.geometry.instances().len(), warnings(&merged)),
        (1, vec![])
    );
    let known = import("CoordSysTransform \"q\"", "");
    assert_eq!(warnings(&known), []);
}

#[test]
fn objects_that_no_instance_shows_are_listed() {
    let scene = scene(&format!(
        "WorldBegin ObjectBegin \"used\" {SPHERE} ObjectEnd\n ObjectBegin \"idle\" {SPHERE} \
         ObjectEnd ObjectInstance \"used\""
    ));
    let unused = scene.census.unused_objects();
    assert_eq!((unused.count, unused.first[0].name.as_str()), (1, "idle"));
    assert!(
        unused.first[0].place.ends_with("a.pbrt:2:14"),
        "{}",
        unused.first[0].place
    );
}
