//! Renders the depth of a scene or of a mesh, as a picture and as an array for NumPy.
//!
//! ```text
//! cargo run --release --example depth                        # a sphere, to depth.png, depth.npy
//! cargo run --release --example depth -- mesh.ply out/mesh   # a mesh, to out/mesh.png, ...
//! ```

use feimos::{Channel, Error, Scene};
use std::env;
use std::process::ExitCode;

fn main() -> ExitCode {
    let mut arguments = env::args().skip(1);
    let input = arguments.next().unwrap_or("scenes/sphere.pbrt".to_owned());
    let output = arguments.next().unwrap_or("depth".to_owned());
    match render(&input, &output) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // The text of an error has several lines: the place in the file, and advice.
            eprintln!("error: {error}");
            // The code is that of the program `feimos`, such as 66 for a missing file.
            ExitCode::from(error.kind().exit_code())
        }
    }
}

/// Renders the file `input` to `output` with two extensions.
fn render(input: &str, output: &str) -> Result<(), Error> {
    // A .pbrt file has a camera. A mesh (.ply, .obj, .stl, .off) gets one that shows all of it.
    let scene = Scene::load(input)?;
    let camera = scene.camera();
    let [width, height] = camera.size();
    println!("{input}: {} primitives", scene.primitive_count());

    // `Z` is the depth along the view axis, infinite where nothing is hit. `A` is 1 for a hit.
    let image = scene.render(&camera, &[Channel::Z, Channel::A])?;

    // Values come row by row from the top, so the pixel in column x and row y is at y * width + x.
    let depths = image.values(Channel::Z).expect("a requested channel");
    let middle = depths[(height / 2 * width + width / 2) as usize];
    println!("{width} x {height} pixels; the depth in the middle is {middle}");

    // The extension selects the format; .exr and .pfm work, too.
    for extension in ["png", "npy"] {
        let path = format!("{output}.{extension}");
        image.save(&path)?;
        println!("wrote {path}");
    }
    Ok(())
}
