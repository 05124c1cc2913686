use super::*;
use proptest::prelude::*;

fn points(coordinates: &[[f64; 3]]) -> Vec<Point> {
    coordinates.iter().map(|p| Point::from(*p)).collect()
}

/// The corners x, y, z, -x, -y and -z, and a face for each octant.
fn octahedron() -> (Vec<Point>, Vec<[u32; 3]>) {
    let axis =
        |k: usize, sign: f64| Point::from([0, 1, 2].map(|j| if j == k { sign } else { 0.0 }));
    let vertices = (0..6)
        .map(|k| axis(k % 3, if k < 3 { 1.0 } else { -1.0 }))
        .collect();
    let faces = (0..8u32)
        .map(|octant| [0, 1, 2].map(|k| k + 3 * (octant >> k & 1)))
        .collect();
    (vertices, faces)
}

fn tetrahedron() -> (Vec<Point>, Vec<[u32; 3]>) {
    let vertices = points(&[
        [1.0, 1.0, 1.0],
        [1.0, -1.0, -1.0],
        [-1.0, 1.0, -1.0],
        [-1.0, -1.0, 1.0],
    ]);
    (vertices, vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
}

/// Points of a square grid, each square split into two faces.
fn grid(size: u32) -> (Vec<Point>, Vec<[u32; 3]>) {
    let side = size + 1;
    let vertices = (0..side * side)
        .map(|k| Point::new(f64::from(k % side), f64::from(k / side), 2.0))
        .collect();
    let corner = |x: u32, y: u32| y * side + x;
    let faces = (0..size * size).flat_map(|k| {
        let (x, y) = (k % size, k / size);
        let [a, b, c, d] = [
            corner(x, y),
            corner(x + 1, y),
            corner(x + 1, y + 1),
            corner(x, y + 1),
        ];
        [[a, b, c], [a, c, d]]
    });
    (vertices, faces.collect())
}

fn is_near(a: &Point, b: &Point, distance: f64) -> bool {
    (*a - *b).largest() <= distance
}

#[test]
fn a_level_of_the_octahedron_by_hand() {
    let (vertices, faces) = octahedron();
    let surface = control_mesh::connect(vertices, &faces).unwrap();
    let refined = surface.refined();
    // 1 - 4 * 3/32 of the vertex itself; its neighbours cancel.
    assert_eq!(refined.vertices[1], Point::new(0.0, 0.625, 0.0));
    // The first edge, from x to y: the two opposite corners cancel.
    assert_eq!(refined.vertices[6], Point::new(0.375, 0.375, 0.0));
    assert_eq!(refined.faces[0].corners, [0, 6, 8]);
    assert_eq!(refined.faces[1].corners, [6, 1, 7]);
    assert_eq!(refined.faces[2].corners, [8, 7, 2]);
    assert_eq!(refined.faces[3].corners, [6, 7, 8]);
    // With a weight of 1/8, half of the vertex is left.
    assert_eq!(surface.limit()[2], Point::new(0.0, 0.0, 0.5));
}

#[test]
fn a_level_of_the_tetrahedron_by_hand() {
    let (vertices, faces) = tetrahedron();
    let surface = control_mesh::connect(vertices, &faces).unwrap();
    // 1 - 3 * 3/16 of the vertex, and 3/16 of minus itself.
    assert_eq!(surface.refined().vertices[0], Point::new(0.25, 0.25, 0.25));
    // The edge from 0 to 1: 3/8 (2, 0, 0) + 1/8 (-2, 0, 0).
    assert_eq!(surface.refined().vertices[4], Point::new(0.5, 0.0, 0.0));
}

/// One triangle is boundary all around: a curve of its own.
#[test]
fn one_triangle_by_hand() {
    let vertices = points(&[[0.0, 0.0, 0.0], [8.0, 0.0, 0.0], [0.0, 8.0, 0.0]]);
    let surface = control_mesh::connect(vertices.clone(), &[[0, 1, 2]]).unwrap();
    let refined = surface.refined();
    let expected = [
        [1.0, 1.0, 0.0],
        [6.0, 1.0, 0.0],
        [1.0, 6.0, 0.0],
        [4.0, 0.0, 0.0],
        [4.0, 4.0, 0.0],
        [0.0, 4.0, 0.0],
    ];
    assert_eq!(refined.vertices, points(&expected));
    let at_once = subdivide(vertices, &[[0, 1, 2]], 0).unwrap();
    assert_eq!(at_once.triangles, [[0, 1, 2]]);
    assert!(is_near(
        &at_once.vertices[1],
        &Point::new(4.8, 1.6, 0.0),
        1e-15
    ));
}

#[test]
fn a_flat_grid_stays_where_it_is() {
    let (vertices, faces) = grid(4);
    let mesh = subdivide(vertices.clone(), &faces, 2).unwrap();
    assert_eq!(mesh.triangles.len(), 16 * faces.len());
    assert!(mesh.vertices.iter().all(|vertex| vertex.z == 2.0));
    // Away from the boundary all vertices have six neighbours, and stay.
    assert!(is_near(&mesh.vertices[12], &vertices[12], 1e-15));
}

/// Every level moves the vertices of the octahedron where its symmetries want them, to the last
/// bit.
#[test]
fn symmetries_stay() {
    let (vertices, faces) = octahedron();
    let mesh = subdivide(vertices, &faces, 3).unwrap();
    let mut found: Vec<[u64; 3]> = mesh
        .vertices
        .iter()
        .map(|v| v.to_array().map(|x| x.abs().to_bits()))
        .collect();
    found.sort_unstable();
    let mut turned: Vec<[u64; 3]> = found.iter().map(|[x, y, z]| [*y, *z, *x]).collect();
    turned.sort_unstable();
    assert_eq!(mesh.triangles.len(), 8 * 64);
    assert_eq!(mesh.vertices.len(), 8 * 64 / 2 + 2, "as Euler has it");
    assert_eq!(found, turned);
}

/// The limit of a closed surface is the same from every level.
#[test]
fn levels_lead_to_one_limit() {
    for (vertices, faces) in [octahedron(), tetrahedron()] {
        let limits =
            [0, 1, 2, 4].map(|levels| subdivide(vertices.clone(), &faces, levels).unwrap());
        for vertex in 0..vertices.len() {
            assert!(limits.iter().all(|mesh| is_near(
                &mesh.vertices[vertex],
                &limits[0].vertices[vertex],
                1e-15
            )));
        }
    }
}

#[test]
fn what_is_no_surface_is_refused() {
    let refusal = |faces: &[[u32; 3]]| {
        let Refusal { place, message, .. } =
            subdivide(vec![Point::default(); 9], faces, 2).unwrap_err();
        (place, message)
    };
    let expected = |place, message: &str| (Place::Index(place), message.to_owned());
    assert_eq!(
        refusal(&[[0, 1, 2], [3, 4, 4]]),
        expected(4, "a face with vertex 4 twice")
    );
    assert_eq!(
        refusal(&[[3, 4, 3]]),
        expected(2, "a face with vertex 3 twice")
    );
    let fin = [[0, 1, 2], [1, 0, 3], [0, 1, 4]];
    assert_eq!(
        refusal(&fin),
        expected(6, "a third face at the edge of the vertices 0 and 1")
    );
    assert_eq!(
        refusal(&[[0, 1, 2], [2, 1, 0]]),
        expected(3, "a second face of the vertices 2, 1 and 0")
    );
    let corner_to_corner = [[0, 1, 2], [2, 3, 4]];
    let message = "2 parts of the surface meet at vertex 2 and share no edge there";
    assert_eq!(refusal(&corner_to_corner), expected(2, message));
    // Two closed surfaces that share a vertex.
    let (_, faces) = tetrahedron();
    let other = faces
        .iter()
        .map(|face| face.map(|corner| if corner == 0 { 0 } else { corner + 3 }));
    let both: Vec<[u32; 3]> = faces.iter().copied().chain(other).collect();
    assert_eq!(
        refusal(&both),
        expected(
            0,
            "2 parts of the surface meet at vertex 0 and share no edge there"
        )
    );
}

#[test]
fn faces_either_way_round_make_a_surface() {
    let (vertices, faces) = octahedron();
    let turned: Vec<[u32; 3]> = faces
        .iter()
        .enumerate()
        .map(|(k, [a, b, c])| {
            if k % 3 == 0 {
                [*b, *a, *c]
            } else {
                [*a, *b, *c]
            }
        })
        .collect();
    let [plain, turned] =
        [faces, turned].map(|faces| subdivide(vertices.clone(), &faces, 2).unwrap());
    for vertex in &plain.vertices {
        assert!(
            turned
                .vertices
                .iter()
                .any(|other| is_near(vertex, other, 1e-15))
        );
    }
}

#[test]
fn sizes_are_checked_before_anything_is_made() {
    let refused = |faces: usize, levels| check_size(0, faces, levels).unwrap_err().message;
    assert!(check_size(3, 1, 15).is_ok());
    assert_eq!(
        refused(1, 16),
        "1 face would be 4,294,967,296 after 16 levels of subdivision"
    );
    assert_eq!(
        refused(8, 30),
        "8 faces would be 9,223,372,036,854,775,808 after 30 levels of subdivision"
    );
    assert!(
        check_size(3, usize::MAX, MOST_LEVELS).is_err() && check_size(usize::MAX, 1, 0).is_err()
    );
}

#[test]
fn vertices_that_no_face_names_stay_and_broken_ones_spread_no_panic() {
    let vertices = points(&[
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, f64::NAN, 0.0],
        [5.0, 6.0, 7.0],
    ]);
    let mesh = subdivide(vertices, &[[0, 1, 2]], 1).unwrap();
    assert_eq!(
        (mesh.vertices[3], mesh.vertices.len()),
        (Point::new(5.0, 6.0, 7.0), 7)
    );
    assert!(mesh.vertices[0].y.is_nan() && mesh.vertices[0].x.is_finite());
    assert_eq!(
        subdivide(Vec::new(), &[], 3).unwrap(),
        TriangleMesh::default()
    );
}

proptest! {
    /// Whatever the faces are: a mesh of the right size, or a refusal at one of them.
    #[test]
    fn any_faces_are_subdivided_or_refused(
        faces in prop::collection::vec(prop::array::uniform3(0u32..7), 0..8),
        coordinates in prop::array::uniform7(-3i32..4),
    ) {
        let vertices: Vec<Point> = coordinates.iter().zip(0..).map(|(x, k)| Point::new(f64::from(*x), f64::from(k), 1.0)).collect();
        match subdivide(vertices, &faces, 2) {
            Ok(mesh) => {
                prop_assert_eq!(mesh.triangles.len(), 16 * faces.len());
                let is_there = |corner: u32| mesh.vertices.get(corner as usize).is_some_and(|vertex| (vertex.z - 1.0).abs() < 1e-15);
                prop_assert!(mesh.triangles.iter().flatten().all(|corner| is_there(*corner)));
                // The same surface, connected anew from its faces.
                prop_assert!(control_mesh::connect(mesh.vertices, &mesh.triangles).is_ok());
            }
            Err(refusal) => prop_assert!(matches!(refusal.place, Place::Index(place) if place < 3 * faces.len())),
        }
    }

    /// The edges that a level finds by itself are those of its faces.
    #[test]
    fn edges_stay_those_of_the_faces(size in 1u32..4, levels in 0u32..3, is_closed in any::<bool>()) {
        let (vertices, faces) = if is_closed { octahedron() } else { grid(size) };
        let mut surface = control_mesh::connect(vertices, &faces).unwrap();
        for _ in 0..levels {
            surface = surface.refined();
        }
        let corners: Vec<[u32; 3]> = surface.faces.iter().map(|face| face.corners).collect();
        let anew = control_mesh::connect(surface.vertices.clone(), &corners).unwrap();
        prop_assert_eq!(anew.edges.len(), surface.edges.len());
        for (face, other) in surface.faces.iter().zip(&anew.faces) {
            for k in 0..3 {
                let (edge, meant) = (surface.edges[face.edges[k] as usize], anew.edges[other.edges[k] as usize]);
                let sorted = |edge: [u32; 2]| [edge[0].min(edge[1]), edge[0].max(edge[1])];
                prop_assert_eq!((sorted(edge.ends), edge.is_boundary), (sorted(meant.ends), meant.is_boundary));
            }
        }
    }
}
