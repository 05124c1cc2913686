use super::*;
use crate::scene::{LoadOptions, parse};
use std::path::Path;

/// Four by four pixels over x and y from -1 to 1, seen along z: the centres are at odd multiples of
/// 1/4.
fn scene(camera: &str, world: &str) -> Scene {
    let text = format!(
        "Camera {camera}\nFilm \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4\nWorldBegin\n{world}"
    );
    parse(
        Path::new("a.pbrt"),
        text.into_bytes(),
        &LoadOptions {
            locations: true,
            ..LoadOptions::default()
        },
    )
    .unwrap()
}

fn explained(scene: &Scene, pixel: [u32; 2]) -> Explanation {
    let builds = SplitMethod::ALL.map(BuildOptions::new);
    let explanation = explain(scene, pixel, &builds).unwrap();
    assert_eq!(explanation.contradictions, [""; 0]);
    assert!(explanation.has_reference);
    assert_eq!(explanation.costs.len(), builds.len());
    // Ours alone and in a tile, exact and fast, and two baselines.
    assert_eq!(explanation.answers.len(), 6);
    explanation
}

fn triangle(corners: &str) -> String {
    format!("Shape \"trianglemesh\" \"point P\" [ {corners} ]\n")
}

const ORTHOGRAPHIC: &str = "\"orthographic\"";

#[test]
fn a_ray_through_an_edge_has_no_margin() {
    let scene = scene(ORTHOGRAPHIC, &triangle("0.25 -1 2  0.25 1 2  1 0 2"));
    let explanation = explained(&scene, [2, 1]);
    let hit = explanation.hit.unwrap();
    assert!(hit.margin.is_on_rim());
    assert_eq!(
        hit.margin,
        Margin::Triangle {
            barycentric: [0.375, 0.625, 0.0],
            on_film: Some(0.0)
        }
    );
    assert_eq!((hit.depth.z, hit.depth.distance), (2.0, 2.0));
    assert!(
        hit.z.low <= 2.0 && 2.0 <= hit.z.high && hit.z.high - hit.z.low < 1e-14,
        "{:?}",
        hit.z
    );
    assert!(
        (hit.point.z - 2.0).abs() < 1e-14 && hit.point.x == 0.25 && hit.point.y == 0.25,
        "{:?}",
        hit.point
    );
    assert_eq!(
        hit.normal.unwrap().to_array().map(|x| x + 0.0),
        [0.0, 0.0, -1.0]
    );
    let scan = explanation.scan.unwrap();
    assert_eq!((scan.met, scan.next, scan.missed), (1, None, None));
    assert!(!explained(&scene, [3, 1]).hit.unwrap().margin.is_on_rim());
}

#[test]
fn of_two_in_one_place_the_first_wins() {
    let one = triangle("-1 -1 2  1 -1 2  0 1 2");
    let scene = scene(ORTHOGRAPHIC, &format!("{one}{one}Translate 0 0 1\n{one}"));
    let explanation = explained(&scene, [1, 2]);
    let scan = explanation.scan.unwrap();
    let next = scan.next.unwrap();
    assert_eq!(
        (
            explanation.hit.unwrap().prim,
            scene.geometry.image_number(next.primitive)
        ),
        (1, 2)
    );
    assert_eq!((next.is_tie, next.farther, scan.met), (true, 0.0, 3));
    let places = scene.locations.as_ref().unwrap();
    let place = |shape| {
        places
            .shape(shape)
            .map(|(name, place)| (name, place.to_string()))
    };
    assert_eq!(place(2), Some(("trianglemesh", "a.pbrt:5:1".to_owned())));
    assert_eq!(place(4), None);
}

#[test]
fn what_is_behind_is_told_with_its_distance() {
    let (near, far) = (
        triangle("-1 -1 2  1 -1 2  0 1 2"),
        triangle("-1 -1 2.5  1 -1 2.5  0 1 2.5"),
    );
    let scene = scene(
        ORTHOGRAPHIC,
        &format!("{far}{near}Shape \"sphere\" \"float radius\" 9"),
    );
    let explanation = explained(&scene, [1, 2]);
    let next = explanation.scan.unwrap().next.unwrap();
    assert_eq!(
        (
            explanation.hit.unwrap().prim,
            scene.geometry.image_number(next.primitive)
        ),
        (2, 1)
    );
    assert!(
        !next.is_tie && (next.farther - 0.5).abs() < 1e-14,
        "{next:?}"
    );
}

#[test]
fn a_miss_tells_how_far_away_the_nearest_triangle_is_on_the_film() {
    let world = format!(
        "{}{}Translate 5 5 5 Shape \"sphere\"",
        triangle("0.5 -1 1  0.5 1 1  1 0 1"),
        triangle("0.9 -1 1  0.9 1 1  1 0 1")
    );
    let missed = |scene: &Scene| {
        let explanation = explained(scene, [0, 1]);
        assert!(
            explanation.hit.is_none()
                && explanation
                    .answers
                    .iter()
                    .all(|answer| answer.found.is_none())
        );
        let scan = explanation.scan.unwrap();
        assert_eq!((scan.met, scan.first, scan.unmeasured), (0, None, 1));
        let missed = scan.missed.unwrap();
        (
            scene.geometry.image_number(missed.primitive),
            missed.on_film,
        )
    };
    // From x = -0.75 to 0.5, at two pixels a unit.
    assert_eq!(missed(&scene(ORTHOGRAPHIC, &world)), (1, 2.5));
    let (prim, on_film) = missed(&scene("\"perspective\" \"float fov\" 90", &world));
    assert!(prim == 1 && (on_film - 2.5).abs() < 1e-12, "{on_film}");
}

#[test]
fn what_reaches_behind_the_eye_is_measured_before_it() {
    // Edges that end on the film at y = 0, seen from far behind the eye to far before it.
    let crossing = triangle("0 -3 -5  0 -3 1e6  9 -9 -5");
    let scene = scene("\"perspective\" \"float fov\" 90", &crossing);
    let on_film = explained(&scene, [1, 1])
        .scan
        .unwrap()
        .missed
        .unwrap()
        .on_film;
    // The edge along z goes to the middle of the film, 0.5 pixels away from this pixel's centre
    // both ways.
    assert!((on_film - 0.5f64.hypot(0.5)).abs() < 1e-4, "{on_film}");
    let behind = self::scene(
        "\"perspective\" \"float fov\" 90",
        &triangle("0 0 -1  1 0 -1  0 1 -1"),
    );
    assert_eq!(explained(&behind, [1, 1]).scan.unwrap().missed, None);
}

#[test]
fn spheres_tell_how_nearly_they_are_touched() {
    let scene = scene(
        ORTHOGRAPHIC,
        "Translate 0 0 3 Shape \"sphere\" \"float radius\" 1",
    );
    let hit = explained(&scene, [2, 1]).hit.unwrap();
    assert_eq!(
        hit.margin,
        Margin::Quadric {
            clearance: Some(0.875 / 9.0)
        }
    );
    let normal = hit.normal.unwrap().to_array();
    for (found, expected) in normal.into_iter().zip([0.25, 0.25, -0.875f64.sqrt()]) {
        assert!((found - expected).abs() < 1e-15, "{normal:?}");
    }
    let touched = self::scene(
        ORTHOGRAPHIC,
        "Translate 0 0.25 3 Shape \"sphere\" \"float radius\" 0.25",
    );
    let hit = explained(&touched, [2, 1]).hit.unwrap();
    assert!(hit.margin.is_on_rim() && hit.depth.z == 3.0, "{hit:?}");
}

#[test]
fn normals_look_back_along_the_ray() {
    let disk = "Translate 0 0 3 Shape \"disk\" \"float radius\" 2";
    for world in [
        disk,
        &format!("Rotate 180 1 0 0 Translate 0 0 -6 {disk}"),
        &triangle("-1 -1 3  0 1 3  1 -1 3"),
    ] {
        let scene = scene(ORTHOGRAPHIC, world);
        let normal = explained(&scene, [1, 2]).hit.unwrap().normal.unwrap();
        assert_eq!(normal.z, -1.0, "{world}");
    }
}

#[test]
fn instances_are_told_with_their_places() {
    let world = "ObjectBegin \"o\"\n  Shape \"sphere\"\nObjectEnd\nTranslate 0 0 9\nObjectInstance \"o\"\n\
                 Translate 0 0 -4\n ObjectInstance \"o\"";
    let scene = scene(ORTHOGRAPHIC, world);
    let explanation = explained(&scene, [1, 2]);
    let hit = explanation.hit.unwrap();
    assert_eq!(
        (hit.primitive.instance(), hit.shape, hit.prim),
        (Some(1), 1, 2)
    );
    assert_eq!(
        explanation.scan.unwrap().next.unwrap().primitive.instance(),
        Some(0)
    );
    let places = scene.locations.unwrap();
    assert_eq!(places.instance(1).unwrap().to_string(), "a.pbrt:10:2");
    assert_eq!(places.shape(1).unwrap().1.to_string(), "a.pbrt:5:3");
    assert!(
        explanation
            .answers
            .iter()
            .all(|answer| answer.found.is_some_and(|found| found.instance == 2))
    );
}

#[test]
fn costs_are_those_of_the_traversal() {
    let scene = scene(ORTHOGRAPHIC, &triangle("-1 -1 2  1 -1 2  0 1 2").repeat(40));
    for (method, work) in explained(&scene, [1, 2]).costs {
        if method == SplitMethod::None {
            assert_eq!(
                work,
                TraversalCounts {
                    nodes: 1,
                    primitives: 40
                }
            );
        }
        assert!(
            work.nodes > 0 && (1..=40).contains(&work.primitives),
            "{method}: {work:?}"
        );
    }
}

#[test]
fn a_ray_that_is_not_finite_hits_nothing() {
    let scene = scene(
        "\"orthographic\" \"float screenwindow\" [ -1e308 1e308 -1e308 1e308 ]",
        "Shape \"sphere\"",
    );
    let mut scene = scene;
    scene.camera.world_from_camera =
        crate::geometry::Matrix::scale([f64::MAX, f64::MAX, f64::INFINITY]);
    let explanation = explained(&scene, [1, 2]);
    assert!(!explanation.ray.can_hit() && explanation.hit.is_none());
}
