//! Casts rays at triangles that are made in code.
//!
//! ```text
//! cargo run --release --example rays
//! ```

use feimos::{Error, Ray, Scene, SplitMethod};

fn main() -> Result<(), Error> {
    // A square of two triangles at z = 5. Each triangle is three indices of points.
    let points = [
        [-1.0, -1.0, 5.0],
        [1.0, -1.0, 5.0],
        [1.0, 1.0, 5.0],
        [-1.0, 1.0, 5.0],
    ];
    let scene = Scene::from_triangles(&points, &[[0, 1, 2], [0, 2, 3]])?;

    // A structure is built once and then answers any number of rays, from any thread.
    let structure = scene.build(SplitMethod::Sah)?;

    // The direction need not be of length 1: `t` counts in its length, `distance` in scene units.
    let ray = Ray::new([0.5, -0.5, 0.0], [0.0, 0.0, 2.0]);
    let hit = structure
        .cast(&ray)
        .expect("the ray goes through the square");
    println!(
        "t {}, distance {}, triangle {}",
        hit.t, hit.distance, hit.prim
    );
    println!(
        "point {:?}, normal {:?}, uv {:?}",
        hit.point, hit.normal, hit.uv
    );

    // The diagonal belongs to both triangles, and edges belong to the square: no ray slips
    // through. Where triangles are equally near, the first one is hit.
    let rays: Vec<Ray> = (-3..=3)
        .map(|x| {
            Ray::new(
                [f64::from(x) / 2.0, f64::from(x) / 2.0, 0.0],
                [0.0, 0.0, 1.0],
            )
        })
        .collect();

    // Many rays at once are cast on all threads; the hits come in the order of the rays.
    for (ray, hit) in rays.iter().zip(structure.cast_all(&rays)) {
        let [x, y, _] = ray.origin;
        match hit {
            Some(hit) => println!("from ({x}, {y}): triangle {} at {}", hit.prim, hit.t),
            None => println!("from ({x}, {y}): nothing"),
        }
    }
    Ok(())
}
