//! Builds every method over a scene, and compares their times and images.
//!
//! ```text
//! cargo run --release --example compare                        # waves of 7,200 triangles
//! cargo run --release --example compare -- scenes/dragon.pbrt
//! ```

use feimos::{Camera, Channel, Error, Image, Precision, Scene, SplitMethod};
use std::env;
use std::time::Instant;

fn main() -> Result<(), Error> {
    let scene = match env::args().nth(1) {
        Some(path) => Scene::load(path)?,
        None => waves(60)?,
    };
    let camera = scene.camera();
    println!(
        "{} primitives, {:?} pixels",
        scene.primitive_count(),
        camera.size()
    );

    // Without a tree: what the view may see is sorted into bins of the film.
    let start = Instant::now();
    let expected = render(&scene, &camera)?;
    println!("raster: {:?}", start.elapsed());

    for method in SplitMethod::ALL {
        let start = Instant::now();
        let structure = scene.build(method)?;
        let built = start.elapsed();

        let start = Instant::now();
        let image = structure.render(&camera, &[Channel::Z, Channel::Prim])?;
        let traced = start.elapsed();

        // Every bit of every pixel is the same: hits are decided by exact arithmetic.
        assert!(image == expected, "{method} has another image");
        println!("{method}: built in {built:?}, traced in {traced:?}, the same image");
    }

    // Plain f32 arithmetic takes wrong decisions near edges, and its last digits are wrong.
    let start = Instant::now();
    let fast = render(&scene.with_precision(Precision::Fast), &camera)?;
    let [prims, depths] = differences(&expected, &fast);
    println!("raster in f32: {:?}", start.elapsed());
    println!("  {prims} pixels with another primitive, {depths} with another depth");
    Ok(())
}

fn render(scene: &Scene, camera: &Camera) -> Result<Image, Error> {
    scene.render(camera, &[Channel::Z, Channel::Prim])
}

/// The pixels whose primitive differs, and those whose depth does.
fn differences(a: &Image, b: &Image) -> [usize; 2] {
    let numbers = [a, b].map(|image| image.numbers(Channel::Prim).expect("requested"));
    let depths = [a, b].map(|image| image.values(Channel::Z).expect("requested"));
    [
        numbers[0]
            .iter()
            .zip(numbers[1])
            .filter(|(a, b)| a != b)
            .count(),
        depths[0]
            .iter()
            .zip(depths[1])
            .filter(|(a, b)| a != b)
            .count(),
    ]
}

/// A surface of waves: `count` x `count` squares of two triangles each.
fn waves(count: u32) -> Result<Scene, Error> {
    let side = count + 1;
    let point = |k: u32| {
        let [x, y] = [k % side, k / side].map(|step| step as f32 / count as f32 * 20.0);
        [x, y, x.sin() + y.cos()]
    };
    let points: Vec<[f32; 3]> = (0..side * side).map(point).collect();
    let corner = (0..count * count).map(|k| k / count * side + k % count);
    let triangles: Vec<[u32; 3]> = corner
        .flat_map(|k| [[k, k + 1, k + side], [k + 1, k + side + 1, k + side]])
        .collect();
    Scene::from_triangles(&points, &triangles)
}
