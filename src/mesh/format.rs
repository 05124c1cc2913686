//! The formats of mesh files: their extensions, and what a file is instead.

use crate::error::{Diagnostic, Error, SourceLocation};
use crate::input::{Kind, Signature};
use std::path::Path;

/// A format of mesh files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MeshFormat {
    /// PLY, of the Stanford 3D Scanning Repository.
    Ply,
    /// OBJ, of Wavefront.
    Obj,
    /// STL, of 3D Systems, binary or ASCII.
    Stl,
    /// OFF, of Geomview.
    Off,
}

impl MeshFormat {
    /// The format of the file `path` by its extension, apart from `.gz`.
    pub fn of_extension(path: &Path) -> Option<MeshFormat> {
        let name = path.file_name()?.to_str()?.to_ascii_lowercase();
        let name = name.strip_suffix(".gz").unwrap_or(&name);
        Some(match name.rsplit_once('.')?.1 {
            "ply" => MeshFormat::Ply,
            "obj" => MeshFormat::Obj,
            "stl" => MeshFormat::Stl,
            "off" => MeshFormat::Off,
            _ => return None,
        })
    }

    /// The name, with its article.
    fn described(self) -> &'static str {
        match self {
            MeshFormat::Ply => "a PLY mesh",
            MeshFormat::Obj => "an OBJ mesh",
            MeshFormat::Stl => "an STL mesh",
            MeshFormat::Off => "an OFF mesh",
        }
    }

    /// The error about the file `path` whose `content` is of another kind, if it is known which.
    pub(super) fn refused(self, path: &Path, content: &[u8]) -> Option<Error> {
        let at_file = |message: String| {
            let message = format!("not {}: this is {message}", self.described());
            Error::bad_input(Diagnostic::new(message).at(SourceLocation::file(path)))
        };
        if content.is_empty() {
            return Some(at_file("an empty file".to_owned()));
        }
        let head = &content[..content.len().min(HEAD)];
        let signature = Signature::of(path, head).filter(|found| found.kind != Kind::Mesh)?;
        Some(match signature {
            Signature::LFS_POINTER => at_file(format!(
                "{}: the mesh itself has not been fetched",
                signature.name
            )),
            _ => {
                let error = at_file(signature.name.to_owned());
                let advice = signature.advice().into_iter();
                advice.fold(error, |error, advice| error.note(advice))
            }
        })
    }
}

/// The first bytes that tell what a file is.
const HEAD: usize = 1024;
