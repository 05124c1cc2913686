//! Objects and their instances.

use super::*;

#[test]
fn objects_are_stored_once_and_placed_by_the_transform_at_the_instance() {
    let scene = scene(&format!(
        "WorldBegin
        Translate 1 2 3
        ObjectBegin \"o\" Scale 2 2 2 {TRIANGLE} Translate 0 0 1 Shape \"sphere\" ObjectEnd
        ObjectBegin \"never shown\" {TRIANGLE} ObjectEnd
        {TRIANGLE}
        AttributeBegin Scale 1 -1 1 ObjectInstance \"o\" AttributeEnd
        ObjectInstance \"o\"
        {TRIANGLE}"
    ));
    let geometry = &scene.geometry;
    assert_eq!(
        (
            geometry.objects().len(),
            geometry.instances().len(),
            geometry.own_count()
        ),
        (1, 2, 2)
    );
    assert_eq!(
        (
            scene.shape_count,
            geometry.primitive_count(),
            warnings(&scene).len()
        ),
        (5, 6, 0)
    );
    let world_from_object = Matrix::translate([1.0, 2.0, 3.0]);
    let world_from_instance = world_from_object.times(&Matrix::scale([1.0, -1.0, 1.0]));
    let world_from_mesh =
        world_from_instance.times(&world_from_object.times(&Matrix::scale([2.0, 2.0, 2.0])));
    let triangle = geometry.placed_triangle(InstancedId::in_instance(0, PrimitiveId::triangle(0)));
    let moved_again =
        geometry.placed_triangle(InstancedId::in_instance(1, PrimitiveId::triangle(0)));
    assert_eq!(
        (triangle.0[0], moved_again.0[0].y),
        (world_from_mesh.apply(Point::new(0.0, 0.0, 0.0)), 4.0)
    );
    let ids = geometry
        .all()
        .map(|placed| (geometry.number(placed), geometry.shape_number(placed)));
    assert_eq!(
        ids.collect::<Vec<_>>(),
        [(0, 4), (5, 5), (1, 1), (2, 2), (3, 1), (4, 2)]
    );
}

#[test]
fn objects_in_the_wrong_place_are_errors() {
    let cases = [
        (
            "ObjectBegin \"o\" ObjectEnd WorldBegin",
            "ObjectBegin outside the world",
        ),
        (
            "ObjectInstance \"o\" WorldBegin",
            "ObjectInstance outside the world",
        ),
        (
            "WorldBegin ObjectBegin \"o\" ObjectInstance \"o\"",
            "an instance within an object",
        ),
        (
            "WorldBegin ObjectBegin \"o\" ObjectEnd ObjectInstance \"p\"",
            "there is no object called `p`",
        ),
    ];
    for (text, message) in cases {
        assert!(error(text).contains(message), "{text}: {}", error(text));
    }
    let misspelt = error("WorldBegin ObjectBegin \"tree\" ObjectEnd ObjectInstance \"tere\"");
    assert!(misspelt.contains("did you mean `tree`?"), "{misspelt}");
}

#[test]
fn instances_show_the_last_definition() {
    let scene = scene(&format!(
        "WorldBegin ObjectBegin \"o\" {TRIANGLE} ObjectEnd ObjectInstance \"o\"
        ObjectBegin \"o\" Shape \"sphere\" ObjectEnd ObjectInstance \"o\""
    ));
    let message = "a second object called `o`: instances that follow show this one";
    assert_eq!(warnings(&scene), [(message.to_owned(), 1)]);
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
