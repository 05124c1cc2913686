//! Shapes, instances and cameras that move.

use crate::directives::messages;
use crate::{TRIANGLE, scene, vertex, warnings};
use feimos::scene::{LoadOptions, Scene, parse};
use feimos::shape::{Primitive, PrimitiveId};
use std::path::Path;

#[test]
fn what_moves_is_rendered_at_the_start_time_with_one_warning() {
    let scene = scene(&format!(
        "TransformTimes 0 1 WorldBegin
        AttributeBegin
          ActiveTransform StartTime Translate 1 0 0
          ActiveTransform EndTime Translate 2 0 0
          ActiveTransform All Translate 0 3 0
          {TRIANGLE} {TRIANGLE}
        AttributeEnd
        {TRIANGLE}"
    ));
    assert_eq!(
        (vertex(&scene, 0), vertex(&scene, 3), vertex(&scene, 6)),
        ([1., 3., 0.], [1., 3., 0.], [0.; 3])
    );
    let message = "a moving shape is shown where it is at the start time";
    assert_eq!(warnings(&scene), [(message.to_owned(), 2)]);
}

#[test]
fn what_stands_still_is_not_warned_of() {
    let scene = scene(&format!(
        "WorldBegin
        ActiveTransform EndTime Translate 1 0 0 ActiveTransform StartTime Translate 1 0 0 {TRIANGLE}
        ActiveTransform All
        AttributeBegin ActiveTransform EndTime Scale 2 2 2 AttributeEnd {TRIANGLE}
        TransformBegin ActiveTransform EndTime Rotate 9 0 0 1 Identity ActiveTransform All \
        Identity {TRIANGLE} TransformEnd
        CoordinateSystem \"still\" ActiveTransform EndTime Translate 1 1 1 \
        CoordSysTransform \"still\" {TRIANGLE}"
    ));
    assert_eq!(messages(&scene), Vec::<String>::new());
    assert_eq!(
        [0, 3, 6, 9].map(|index| vertex(&scene, index)),
        [[1., 0., 0.], [1., 0., 0.], [0.; 3], [1., 0., 0.]]
    );
}

#[test]
fn a_camera_that_moves_stands_at_its_start() {
    let scene = scene(&format!(
        "ActiveTransform EndTime Translate 5 0 0 ActiveTransform StartTime Translate 2 0 0
        Camera \"perspective\" WorldBegin {TRIANGLE} CoordSysTransform \"camera\" {TRIANGLE}"
    ));
    assert_eq!(scene.camera.anchor().to_array(), [-2.0, 0.0, 0.0]);
    let expected = [
        "a moving camera is shown where it is at the start time",
        "a moving shape is shown where it is at the start time",
    ];
    assert_eq!(messages(&scene), expected);
}

/// The scene of `text` at a moment.
fn scene_at(time: f64, text: &str) -> Scene {
    let options = LoadOptions {
        time: Some(time),
        transform_history: true,
        ..LoadOptions::default()
    };
    let scene = parse(Path::new("a.pbrt"), text.into(), &options).unwrap();
    assert_eq!(messages(&scene), Vec::<String>::new());
    scene
}

#[test]
fn what_moves_is_shown_at_the_moment_that_is_asked_for() {
    let text = format!(
        "ActiveTransform EndTime Translate -4 0 0 ActiveTransform All
        Camera \"perspective\" TransformTimes 3 7 WorldBegin
        ObjectBegin \"o\" ActiveTransform EndTime Translate 0 8 0 ActiveTransform All {TRIANGLE} \
        ObjectEnd
        ActiveTransform StartTime Translate 1 0 0
        ActiveTransform EndTime Translate 2 0 0 Scale 3 3 3
        ActiveTransform All {TRIANGLE} ObjectInstance \"o\""
    );
    for (time, x, scale) in [(0.0, 1.0, 1.0), (0.25, 1.25, 1.5), (1.0, 2.0, 3.0)] {
        let scene = scene_at(time, &text);
        assert_eq!(scene.camera.anchor().to_array(), [4.0 * time, 0.0, 0.0]);
        assert_eq!(vertex(&scene, 0), [x, 0.0, 0.0]);
        let [far, ..] = vertex(&scene, 1);
        assert!((far - (x + scale)).abs() < 1e-14, "{time}: {far}");
        let instanced = scene.geometry.pose(0).surface(PrimitiveId::triangle(0));
        let Primitive::Triangle(triangle) = instanced else {
            panic!("a triangle")
        };
        let corner = triangle.0[0].to_array();
        let expected = [x, 8.0 * time * scale, 0.0];
        assert!(
            (0..3).all(|k| (corner[k] - expected[k]).abs() < 1e-14),
            "{corner:?}"
        );
        // Roundings are bounded from directives, which do not say what happens in between.
        assert_eq!(scene.transform_history.is_some(), time == 0.0);
    }
}

#[test]
fn what_stands_still_does_not_depend_on_the_moment() {
    let text =
        format!("Rotate 33 1 2 3 Camera \"perspective\" WorldBegin Scale .1 .2 .3 {TRIANGLE}");
    let [start, middle] = [0.0, 0.5].map(|time| scene_at(time, &text));
    assert_eq!(start.camera, middle.camera);
    assert_eq!(vertex(&start, 1), vertex(&middle, 1));
    assert!(middle.transform_history.is_some());
}
