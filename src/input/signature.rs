//! The table of signatures: recognizes by its first bytes, and by its extension, what a file is
//! instead of a scene or a mesh that can be read.

use std::path::Path;

/// What feimos reads, in words that follow "feimos reads".
const READABLE: &str = "PBRT scenes, and PLY, OBJ, STL and OFF meshes";

/// The kind of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A mesh that feimos reads.
    Mesh,
    /// glTF, a format that feimos does not read, though many have such files.
    Gltf,
    /// A format of other programs.
    Foreign,
    /// An archive, or data compressed in a way that feimos does not know.
    Packed,
    /// Compressed twice, in UTF-16, or only the name of the content.
    Wrapped,
}

/// A kind of file, in words that continue "this is".
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Signature {
    pub(crate) kind: Kind,
    pub(crate) name: &'static str,
}

const USD: &str = "a USD file";
const XML: &str = "an XML document";

/// The bytes that are searched for what an XML or JSON document is about.
const SEARCHED: usize = 1024;

/// First bytes of text and data that hide the content.
const WRAPPED: [(&[u8], &str); 2] = [
    (b"version https://git-lfs.github.com/spec", LFS_POINTER),
    (b"\x1f\x8b", GZIP_TWICE),
];
const LFS_POINTER: &str = "a Git LFS pointer";
const GZIP_TWICE: &str = "gzip data, compressed twice";

/// First bytes of formats that feimos reads.
const MESHES: [(&[u8], &str); 8] = [
    (b"ply\n", PLY),
    (b"ply\r", PLY),
    (b"OFF", OFF),
    (b"COFF", OFF),
    (b"NOFF", OFF),
    (b"CNOFF", OFF),
    (b"STOFF", OFF),
    (b"solid ", "an STL mesh"),
];
const PLY: &str = "a PLY mesh";
const OFF: &str = "an OFF mesh";

/// First bytes of glTF in one binary file.
const GLTF_MARK: [(&[u8], &str); 1] = [(b"glTF", GLTF)];
const GLTF: &str = "a glTF file";

/// First bytes of other formats.
const FOREIGN: [(&[u8], &str); 22] = [
    (b"Kaydara FBX Binary", "an FBX file"),
    (b"; FBX ", "an FBX file"),
    (b"PXR-USDC", USD),
    (b"#usda ", USD),
    (b"BLENDER", "a Blender file"),
    (b"LASF", "a LAS point cloud"),
    (b"# .PCD ", "a PCD point cloud"),
    (b"ASTM-E57", "an E57 point cloud"),
    (b"Ogawa", "an Alembic file"),
    (b"#VRML ", "a VRML file"),
    (b"#X3D ", "an X3D file"),
    (b"# vtk DataFile", "a VTK file"),
    (b"ISO-10303-21", "a STEP file"),
    (b"//Maya ASCII", "a Maya file"),
    (b"\x89HDF", "an HDF5 file"),
    (b"\x89PNG", "a PNG image"),
    (b"\xff\xd8\xff", "a JPEG image"),
    (b"\x76\x2f\x31\x01", "an OpenEXR image"),
    (b"II*\0", "a TIFF image"),
    (b"MM\0*", "a TIFF image"),
    (b"\x93NUMPY", "a NumPy array"),
    (b"%PDF", "a PDF document"),
];

/// First bytes of archives and compressed data.
const PACKED: [(&[u8], &str); 6] = [
    (b"PK\x03\x04", "a ZIP archive"),
    (b"\xfd7zXZ", "xz data"),
    (b"BZh", "bzip2 data"),
    (b"\x28\xb5\x2f\xfd", "zstd data"),
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive"),
    (b"Rar!", "a RAR archive"),
];

/// Elements of XML documents.
const ELEMENTS: [(&str, &str); 5] = [
    ("<collada", "a COLLADA file"),
    ("<scene", "a Mitsuba scene"),
    ("<x3d", "an X3D file"),
    ("<vtkfile", "a VTK file"),
    ("<html", "an HTML document"),
];

/// Members of glTF's JSON.
const GLTF_MEMBERS: [&str; 4] = [
    "\"asset\"",
    "\"accessors\"",
    "\"bufferviews\"",
    "\"buffers\"",
];

/// Extensions of formats that have no first bytes of their own, or are archives.
const EXTENSIONS: [(&str, &str); 15] = [
    ("usdz", "a USDZ archive"),
    ("3mf", "a 3MF archive"),
    ("kmz", "a KMZ archive"),
    ("blend", "a Blender file"),
    ("3ds", "a 3DS file"),
    ("splat", "a Gaussian splat file"),
    ("spz", "a Gaussian splat file"),
    ("ksplat", "a Gaussian splat file"),
    ("max", "a 3ds Max file"),
    ("mb", "a Maya file"),
    ("c4d", "a Cinema 4D file"),
    ("skp", "a SketchUp file"),
    ("drc", "a Draco mesh"),
    ("laz", "a LAZ point cloud"),
    ("abc", "an Alembic file"),
];

const UTF8_MARK: &[u8] = b"\xef\xbb\xbf";

/// `bytes` without a UTF-8 byte order mark.
pub(crate) fn without_utf8_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(UTF8_MARK).unwrap_or(bytes)
}

impl Signature {
    pub(crate) const UTF_16: Signature = Signature {
        kind: Kind::Wrapped,
        name: "UTF-16 text",
    };
    pub(crate) const LFS_POINTER: Signature = Signature {
        kind: Kind::Wrapped,
        name: LFS_POINTER,
    };

    /// The signature of the file `path` with these first bytes; `None` for text and for data that
    /// have none.
    pub(crate) fn of(path: &Path, head: &[u8]) -> Option<Signature> {
        let signature = Signature::of_bytes(head);
        let is_text = signature.is_none() && !head.contains(&0);
        if is_text || signature.is_some_and(|signature| signature.kind != Kind::Packed) {
            return signature;
        }
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        let known = EXTENSIONS.iter().find(|(known, _)| extension == *known);
        known.map(|(_, name)| foreign(name)).or(signature)
    }

    fn of_bytes(head: &[u8]) -> Option<Signature> {
        let head = without_utf8_mark(head);
        let starts = |kind: Kind, table: &[(&[u8], &'static str)]| {
            let found = table.iter().find(|(mark, _)| head.starts_with(mark));
            found.map(|(_, name)| Signature { kind, name })
        };
        match head {
            [b'<', ..] => Some(of_xml(head)),
            [b'{', ..] => Some(of_json(head)),
            // The main chunk, its size, and the chunk of a version or of a scene.
            [b'M', b'M', _, _, _, _, 2, 0, ..] | [b'M', b'M', _, _, _, _, 0x3d, 0x3d, ..] => {
                Some(foreign("a 3DS file"))
            }
            _ if is_utf16(head) => Some(Signature::UTF_16),
            _ => starts(Kind::Wrapped, &WRAPPED)
                .or_else(|| starts(Kind::Mesh, &MESHES))
                .or_else(|| starts(Kind::Gltf, &GLTF_MARK))
                .or_else(|| starts(Kind::Foreign, &FOREIGN))
                .or_else(|| starts(Kind::Packed, &PACKED)),
        }
    }

    /// The advice to a user who has such a file, if there is any.
    pub(crate) fn advice(self) -> Option<String> {
        Some(match self.kind {
            Kind::Mesh => "give it the extension of its format, or name it in a `Shape \
                           \"plymesh\"` of a scene"
                .to_owned(),
            Kind::Gltf => format!(
                "feimos reads {READABLE}: convert it, for example with Blender or with \
                 `assimp export a.glb a.ply`"
            ),
            Kind::Foreign => format!("feimos reads {READABLE}"),
            Kind::Packed => format!("unpack it first; feimos reads {READABLE}"),
            Kind::Wrapped => return None,
        })
    }
}

/// Whether this is text in UTF-16; ASCII text is recognized without a byte order mark, too.
fn is_utf16(head: &[u8]) -> bool {
    matches!(
        head,
        [0xff, 0xfe, ..]
            | [0xfe, 0xff, ..]
            | [0, 1..=127, 0, 1..=127, ..]
            | [1..=127, 0, 1..=127, 0, ..]
    )
}

fn foreign(name: &'static str) -> Signature {
    let kind = Kind::Foreign;
    Signature { kind, name }
}

fn of_xml(head: &[u8]) -> Signature {
    let text = lowercase(head);
    let known = ELEMENTS.iter().find(|(element, _)| text.contains(element));
    foreign(known.map_or(XML, |(_, name)| name))
}

fn of_json(head: &[u8]) -> Signature {
    let text = lowercase(head);
    match GLTF_MEMBERS.iter().any(|member| text.contains(member)) {
        true => Signature {
            kind: Kind::Gltf,
            name: GLTF,
        },
        false => foreign("a JSON document"),
    }
}

/// The first bytes of a text, in small letters.
fn lowercase(head: &[u8]) -> String {
    String::from_utf8_lossy(&head[..head.len().min(SEARCHED)]).to_ascii_lowercase()
}

#[cfg(test)]
mod tests;
