//! The PBRT directives that the scenes of `picture` use.

use super::cameras::look_at;
use super::ply::Mesh;
use super::text::{Text, number};
use crate::Result;
use crate::geometry::Geometry;
use feimos::camera::{Camera, Projection, ScreenWindow};
use feimos::geometry::Matrix;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Reads a scene file and the mesh that it names.
pub(super) fn read(path: &Path) -> Result<(Camera, Geometry)> {
    let file = File::open(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let mut reader = Reader {
        text: Text::new(file),
        folder: path.parent().unwrap_or(Path::new("")).to_owned(),
        matrix: Matrix::IDENTITY,
        saved: Vec::new(),
        world_from_camera: Matrix::IDENTITY,
        projection: Projection::perspective(90.0),
        screen_window: None,
        resolution: [1280, 720],
        mesh: Mesh::default(),
        spheres: Vec::new(),
    };
    reader
        .read()
        .map_err(|error| format!("{}: {error}", path.display()))?;
    reader.finish()
}

struct Reader<R> {
    text: Text<R>,
    folder: PathBuf,
    /// The current transform, and those that `AttributeEnd` restores.
    matrix: Matrix,
    saved: Vec<Matrix>,
    world_from_camera: Matrix,
    projection: Projection,
    screen_window: Option<[f64; 4]>,
    resolution: [u32; 2],
    mesh: Mesh,
    spheres: Vec<[f32; 4]>,
}

/// Directives by name.
#[derive(Clone, Copy)]
enum Directive {
    LookAt,
    Camera,
    Film,
    WorldBegin,
    AttributeBegin,
    AttributeEnd,
    Translate,
    Scale,
    Shape,
}

impl Directive {
    fn of(word: &[u8]) -> Result<Directive> {
        Ok(match word {
            b"LookAt" => Directive::LookAt,
            b"Camera" => Directive::Camera,
            b"Film" => Directive::Film,
            b"WorldBegin" => Directive::WorldBegin,
            b"AttributeBegin" => Directive::AttributeBegin,
            b"AttributeEnd" => Directive::AttributeEnd,
            b"Translate" => Directive::Translate,
            b"Scale" => Directive::Scale,
            b"Shape" => Directive::Shape,
            _ => {
                let word = String::from_utf8_lossy(word);
                return Err(format!("`{word}` is not known here").into());
            }
        })
    }
}

impl<R: Read> Reader<R> {
    fn read(&mut self) -> Result<()> {
        while let Some(word) = self.text.word()? {
            let directive = Directive::of(word)?;
            self.execute(directive)?;
        }
        Ok(())
    }

    fn execute(&mut self, directive: Directive) -> Result<()> {
        match directive {
            Directive::LookAt => self.world_from_camera = look_at(self.numbers()?)?.inverse,
            Directive::Camera => self.camera()?,
            Directive::Film => self.film()?,
            Directive::WorldBegin => self.matrix = Matrix::IDENTITY,
            Directive::AttributeBegin => self.saved.push(self.matrix),
            Directive::AttributeEnd => {
                self.matrix = self.saved.pop().ok_or("an AttributeEnd too many")?
            }
            Directive::Translate => {
                let offset = self.numbers()?;
                self.matrix = self.matrix.times(&Matrix::translate(offset));
            }
            Directive::Scale => {
                let factors = self.numbers()?;
                self.matrix = self.matrix.times(&Matrix::scale(factors));
            }
            Directive::Shape => self.shape()?,
        }
        Ok(())
    }

    fn numbers<const N: usize>(&mut self) -> Result<[f64; N]> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = self.text.number()?;
        }
        Ok(numbers)
    }

    /// The text in quotes that follows a directive.
    fn kind(&mut self) -> Result<Vec<u8>> {
        Ok(self.text.word()?.ok_or("the file ends early")?.to_vec())
    }

    fn camera(&mut self) -> Result<()> {
        let is_perspective = self.kind()? == b"\"perspective\"";
        let mut fov = 90.0;
        while let Some(name) = self.parameter()? {
            match name {
                Parameter::Fov => fov = self.bracketed::<1>()?[0],
                Parameter::ScreenWindow => self.screen_window = Some(self.bracketed()?),
                _ => return Err("a camera has `fov` and `screenwindow` here".into()),
            }
        }
        self.projection = if is_perspective {
            Projection::perspective(fov)
        } else {
            Projection::Orthographic
        };
        Ok(())
    }

    fn film(&mut self) -> Result<()> {
        self.text.word()?;
        while let Some(name) = self.parameter()? {
            match name {
                Parameter::Width => self.resolution[0] = self.bracketed::<1>()?[0] as u32,
                Parameter::Height => self.resolution[1] = self.bracketed::<1>()?[0] as u32,
                _ => return Err("a film has `xresolution` and `yresolution` here".into()),
            }
        }
        Ok(())
    }

    fn shape(&mut self) -> Result<()> {
        self.text.word()?;
        match self.parameter()? {
            Some(Parameter::Radius) => {
                let [radius] = self.bracketed()?;
                let [x, y, z] = self.matrix.column(3);
                self.spheres.push([x, y, z, radius].map(|n| n as f32));
                Ok(())
            }
            Some(Parameter::Filename) => {
                let name = self.kind()?;
                let name = std::str::from_utf8(&name)?.trim_matches('"');
                let path = self.folder.join(name);
                self.mesh.read(&path, &self.matrix)
            }
            _ => Err("a shape has `radius` or `filename` here".into()),
        }
    }

    /// The name of the next parameter; `None` before a directive.
    fn parameter(&mut self) -> Result<Option<Parameter>> {
        let Some(word) = self.text.next_if_quoted()? else {
            return Ok(None);
        };
        Ok(Some(match word {
            b"\"float fov\"" => Parameter::Fov,
            b"\"float screenwindow\"" => Parameter::ScreenWindow,
            b"\"integer xresolution\"" => Parameter::Width,
            b"\"integer yresolution\"" => Parameter::Height,
            b"\"float radius\"" => Parameter::Radius,
            b"\"string filename\"" => Parameter::Filename,
            _ => {
                let word = String::from_utf8_lossy(word);
                return Err(format!("the parameter {word} is not known here").into());
            }
        }))
    }

    /// Numbers between brackets that blanks surround.
    fn bracketed<const N: usize>(&mut self) -> Result<[f64; N]> {
        let word = self.text.word()?.ok_or("the file ends early")?;
        if word != b"[" {
            return if N == 1 {
                Ok([number(word)?.0; N])
            } else {
                Err("brackets are missing".into())
            };
        }
        let numbers = self.numbers()?;
        match self.text.word()? {
            Some(b"]") => Ok(numbers),
            _ => Err("a bracket is not closed".into()),
        }
    }

    fn finish(self) -> Result<(Camera, Geometry)> {
        let [width, height] = self.resolution;
        let aspect = f64::from(width) / f64::from(height);
        let screen_window = match self.screen_window {
            Some([x0, x1, y0, y1]) => ScreenWindow { x0, x1, y0, y1 },
            None => ScreenWindow::of_aspect(aspect),
        };
        let camera = Camera {
            world_from_camera: self.world_from_camera,
            projection: self.projection,
            screen_window,
            resolution: self.resolution,
        };
        let Mesh {
            vertices,
            triangles,
        } = self.mesh;
        match (triangles.is_empty(), self.spheres.is_empty()) {
            (false, true) => Ok((
                camera,
                Geometry::Triangles {
                    vertices,
                    triangles,
                },
            )),
            (true, false) => Ok((camera, Geometry::Spheres(self.spheres))),
            _ => Err("a scene holds triangles or spheres, not both".into()),
        }
    }
}

/// Parameters by name.
enum Parameter {
    Fov,
    ScreenWindow,
    Width,
    Height,
    Radius,
    Filename,
}
