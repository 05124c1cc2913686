//! Digests of a scene: of its geometry, and of a view of it.

use crate::camera::{Camera, Distortion, Projection, ScreenWindow, SphereMapping};
use crate::digest::{Digest, Digester};
use crate::shape::Geometry;

/// The digest of a scene's geometry, shared by all views of it.
pub struct SceneDigest(Digest);

impl SceneDigest {
    /// Computes the digest of the geometry alone.
    pub fn of(geometry: &Geometry) -> SceneDigest {
        let mut digester = Digester::default();
        geometry.digest(&mut digester);
        SceneDigest(digester.finish())
    }

    /// The digest of everything that decides pixels as `camera` sees the scene: geometry, camera
    /// and film, but not the crop. Comments, materials and the notation of numbers do not count.
    pub fn seen_by(&self, camera: &Camera) -> Digest {
        let Camera {
            world_from_camera,
            projection,
            screen_window,
            resolution,
        } = camera;
        let ScreenWindow { x0, x1, y0, y1 } = screen_window;
        let mut digester = Digester::default();
        digester.list(&[self.0], |digest| digest.words());
        digester.measures(world_from_camera.rows.as_flattened());
        digester.measures(&match projection {
            Projection::Perspective { tangent } => [0.0, *tangent],
            Projection::Orthographic => [1.0, 0.0],
            Projection::Spherical(SphereMapping::Equirectangular) => [2.0, 0.0],
            Projection::Spherical(SphereMapping::EqualArea) => [3.0, 0.0],
            Projection::Distorted(Distortion::RadialTangential(_)) => [4.0, 0.0],
            Projection::Distorted(Distortion::Fisheye(_)) => [5.0, 0.0],
        });
        if let Some(lens) = projection.distortion() {
            digester.measures(&lens.coefficients());
        }
        digester.measures(&[*x0, *x1, *y0, *y1]);
        resolution
            .iter()
            .for_each(|side| digester.word((*side).into()));
        digester.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{LoadOptions, parse};
    use std::path::Path;

    fn digest(text: &str) -> Digest {
        let options = LoadOptions {
            orientation: true,
            uv: true,
            ..LoadOptions::default()
        };
        let scene = parse(Path::new("a.pbrt"), text.into(), &options).unwrap();
        SceneDigest::of(&scene.geometry).seen_by(&scene.camera)
    }

    const SCENE: &str = r#"LookAt 0 0 -5  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 13 "integer yresolution" 7
WorldBegin
Shape "sphere" "float radius" 2
Shape "cylinder" "float zmin" -1 "float phimax" 90
Shape "disk" "float height" 1
ObjectBegin "a"
Shape "sphere" "float zmax" 0.5
Shape "trianglemesh" "point3 P" [-2 -1 0  2 -1 0.5  0 2 0]
ObjectEnd
Translate 3 0 0
ObjectInstance "a"
Shape "trianglemesh" "point3 P" [-2 -1 0  2 -1 0.5  0 2 0] "integer indices" [0 1 2]
"#;

    #[test]
    fn changes_of_the_picture_change_it() {
        let changes = [
            ("-5  0 0 0", "-6  0 0 0"),
            ("fov\" 40", "fov\" 41"),
            ("xresolution\" 13", "xresolution\" 14"),
            ("radius\" 2", "radius\" 3"),
            ("zmin\" -1", "zmin\" -2"),
            ("phimax\" 90", "phimax\" 91"),
            ("height\" 1", "height\" 2"),
            ("zmax\" 0.5", "zmax\" 0.25"),
            ("3 0 0\nObjectInstance \"a\"", "3 0 1\nObjectInstance \"a\""),
            ("ObjectInstance \"a\"\n", ""),
            ("0 2 0] \"integer", "0 2 1] \"integer"),
            ("[0 1 2]", "[0 2 1]"),
            ("perspective\" \"float fov\" 40", "orthographic\""),
            ("WorldBegin\n", "WorldBegin\nShape \"cone\"\n"),
            ("WorldBegin\n", "WorldBegin\nReverseOrientation\n"),
            ("[0 1 2]", "[0 1 2] \"point2 uv\" [0 0 1 0 0 1]"),
            ("[0 1 2]", "[0 1 2] \"point2 uv\" [0 0 1 0 0 2]"),
        ];
        let mut digests = vec![digest(SCENE)];
        digests.extend(changes.iter().map(|(from, to)| {
            assert!(SCENE.contains(from), "{from}");
            digest(&SCENE.replace(from, to))
        }));
        let different: std::collections::HashSet<Digest> = digests.iter().copied().collect();
        assert_eq!(different.len(), digests.len());
    }

    #[test]
    fn other_changes_do_not_change_it() {
        let changes = [
            (
                "WorldBegin\n",
                "WorldBegin # a comment\nMaterial \"diffuse\"\n",
            ),
            ("fov\" 40", "fov\" 4e1"),
            (
                "yresolution\" 7",
                "yresolution\" 7 \"float cropwindow\" [0 0.5 0 0.5]",
            ),
            ("0 2 0] \"integer", "0 2 -0.0] \"integer"),
            (
                "yresolution\" 7",
                "yresolution\" 7 \"string filename\" \"other.exr\"",
            ),
            (
                "WorldBegin\n",
                "Accelerator \"bvh\" \"string splitmethod\" \"hlbvh\"\nWorldBegin\n",
            ),
        ];
        for (from, to) in changes {
            assert_eq!(digest(&SCENE.replace(from, to)), digest(SCENE), "{to}");
        }
    }
}
