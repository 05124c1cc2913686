//! Scenes as PBRT files with their meshes, for programs to read.

use super::scene_name::SceneName;
use crate::geometry::Geometry;
use crate::programs::Pose;
use crate::views::{ViewName, camera as place_camera};
use crate::{Result, ply};
use feimos::camera::{Camera, Projection};
use feimos::geometry::Point;
use flate2::read::MultiGzDecoder;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// The dragon as text, which several scenes share.
const DRAGON: &str = "dragon.ply";

/// The film of the bumpy spheres.
const SPHERE_FILM: [u32; 2] = [1024, 1024];

/// A scene on disk.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct SceneFile {
    pub(super) scene: PathBuf,
    /// A list of cameras to render from.
    pub(super) cameras: Option<PathBuf>,
    /// A mesh that no other scene needs.
    mesh: Option<PathBuf>,
    pub(super) resolution: [u32; 2],
    pub(super) primitives: u64,
    /// "triangles" or "spheres".
    pub(super) kind: String,
}

impl SceneFile {
    /// Writes the files of a scene to `folder`.
    pub(super) fn write(name: SceneName, folder: &Path) -> Result<SceneFile> {
        let file = |extension| folder.join(format!("{name}.{extension}"));
        let mut written = SceneFile {
            scene: file("pbrt"),
            cameras: None,
            mesh: None,
            resolution: SPHERE_FILM,
            primitives: 0,
            kind: "triangles".to_owned(),
        };
        let mut out = BufWriter::new(File::create(&written.scene)?);
        match name {
            SceneName::View(view_name) => {
                let view = view_name.make()?;
                written.resolution = view.camera.resolution;
                written.primitives = view.geometry.len() as u64;
                written.kind = view.geometry.kind().to_owned();
                write_camera(&view.camera, &mut out)?;
                match &view.geometry {
                    _ if view_name.is_of_dragon() => write_dragon(folder, &mut out)?,
                    Geometry::Spheres(spheres) => write_spheres(spheres, &mut out)?,
                    Geometry::Triangles {
                        vertices,
                        triangles,
                    } => {
                        let mesh = written.mesh.insert(file("ply"));
                        ply::write_mesh(vertices, triangles, mesh)?;
                        write_mesh_name(mesh, &mut out)?;
                    }
                }
            }
            SceneName::Sphere { millions } => {
                let (eye, look) = (Point::new(1.0, 1.4, -2.8), Point::new(0.0, 0.0, 0.0));
                write_camera(&place_camera(eye, look, 45.0, SPHERE_FILM), &mut out)?;
                let mesh = written.mesh.insert(file("ply"));
                written.primitives = ply::generate(millions * 1_000_000, mesh)?;
                write_mesh_name(mesh, &mut out)?;
            }
            SceneName::Cameras { count } => {
                let view = ViewName::A.make()?;
                written.resolution = view.camera.resolution;
                written.primitives = view.geometry.len() as u64;
                write_camera(&view.camera, &mut out)?;
                write_dragon(folder, &mut out)?;
                let list = serde_json::to_vec(&poses(count))?;
                std::fs::write(written.cameras.insert(file("json")), list)?;
            }
        }
        out.into_inner()?;
        Ok(written)
    }

    /// Removes what takes room and no other scene needs.
    pub(super) fn remove(&self) -> Result<()> {
        std::fs::remove_file(&self.scene)?;
        Ok(self.mesh.as_ref().map_or(Ok(()), std::fs::remove_file)?)
    }
}

fn write_camera(camera: &Camera, out: &mut impl Write) -> Result<()> {
    let [up, forward, eye] = [1, 2, 3].map(|j| camera.world_from_camera.column(j));
    let look = [0, 1, 2].map(|k| eye[k] + forward[k]);
    let [eye, look, up] = [eye, look, up].map(|[x, y, z]| format!("{x} {y} {z}"));
    writeln!(out, "LookAt {eye}  {look}  {up}")?;
    match camera.projection {
        Projection::Perspective { .. } => {
            let fov = camera.projection.field_of_view().unwrap_or_default();
            write!(out, "Camera \"perspective\" \"float fov\" {fov}")?;
        }
        Projection::Orthographic => write!(out, "Camera \"orthographic\"")?,
        Projection::Spherical(_) | Projection::Distorted(_) => panic!("every view is linear"),
    }
    let window = &camera.screen_window;
    let (x0, x1, y0, y1) = (window.x0, window.x1, window.y0, window.y1);
    writeln!(out, " \"float screenwindow\" [ {x0} {x1} {y0} {y1} ]")?;
    let [width, height] = camera.resolution;
    write!(out, "Film \"image\" \"integer xresolution\" {width}")?;
    writeln!(out, " \"integer yresolution\" {height}\nWorldBegin")?;
    Ok(())
}

/// The dragon where the scenes of the folder `scenes` have it; decompressed once.
fn write_dragon(folder: &Path, out: &mut impl Write) -> Result<()> {
    let mesh = folder.join(DRAGON);
    if !mesh.exists() {
        let compressed = crate::views::path_of("dragon_vrip.ply.gz");
        let mut text = MultiGzDecoder::new(File::open(compressed)?);
        std::io::copy(&mut text, &mut File::create(&mesh)?)?;
    }
    writeln!(out, "Translate 0 -2.5 0\nScale 20 20 20")?;
    write_mesh_name(&mesh, out)
}

fn write_mesh_name(mesh: &Path, out: &mut impl Write) -> Result<()> {
    let name = mesh.file_name().unwrap_or_default().display();
    writeln!(out, "Shape \"plymesh\" \"string filename\" \"{name}\"")?;
    Ok(())
}

fn write_spheres(spheres: &[[f32; 4]], out: &mut impl Write) -> Result<()> {
    for [x, y, z, radius] in spheres {
        writeln!(out, "AttributeBegin\nTranslate {x} {y} {z}")?;
        writeln!(out, "Shape \"sphere\" \"float radius\" {radius}")?;
        writeln!(out, "AttributeEnd")?;
    }
    Ok(())
}

/// Around the dragon, once, up and down on the way.
fn poses(count: u32) -> Vec<Pose> {
    let pose = |i: u32| {
        let angle = TAU * f64::from(i) / f64::from(count);
        let (x, y, z) = (3.0 * angle.sin(), (3.0 * angle).sin(), -3.0 * angle.cos());
        Pose {
            name: i.to_string(),
            lookat: [x, y, z, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0],
        }
    };
    (0..count).map(pose).collect()
}
