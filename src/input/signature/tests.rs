//! Files of other programs.

use super::*;

fn named(path: &str, head: &[u8]) -> Option<&'static str> {
    Signature::of(Path::new(path), head).map(|signature| signature.name)
}

#[test]
fn files_are_known_by_their_first_bytes() {
    for (head, name) in [
        (&b"Kaydara FBX Binary  \x00\x1a\x00"[..], "an FBX file"),
        (b"; FBX 7.3.0 project file\n", "an FBX file"),
        (b"PXR-USDC\0\0", "a USD file"),
        (b"#usda 1.0\n(\n", "a USD file"),
        (b"BLENDER-v300", "a Blender file"),
        (b"# .PCD v0.7 - Point Cloud Data\n", "a PCD point cloud"),
        (b"LASF\0\0", "a LAS point cloud"),
        (b"MM\x10\0\0\0\x02\0\x0a\0", "a 3DS file"),
        (b"MM\0*\0\0\0\x08", "a TIFF image"),
        (b"glTF\x02\0\0\0", "a glTF file"),
        (b"{\"asset\":{\"version\":\"2.0\"}}", "a glTF file"),
        (b"{\"a\": 1}", "a JSON document"),
        (b"<?xml version=\"1.0\"?>\n<COLLADA>", "a COLLADA file"),
        (b"\xef\xbb\xbf<scene version=\"3.0.0\">", "a Mitsuba scene"),
        (b"<svg>", "an XML document"),
        (b"PK\x03\x04", "a ZIP archive"),
        (b"solid a\n", "an STL mesh"),
        (b"COFF\n1 2 3\n", "an OFF mesh"),
        (b"s\0o\0l\0i\0", "UTF-16 text"),
    ] {
        assert_eq!(named("a", head), Some(name));
    }
    for text in [
        "",
        "LookAt 0 0 0",
        "# a comment\n",
        "Shape \"sphere\"",
        "MM",
    ] {
        assert_eq!(named("a.pbrt", text.as_bytes()), None, "{text}");
    }
}

#[test]
fn extensions_tell_archives_and_binary_data_apart() {
    assert_eq!(named("a.usdz", b"PK\x03\x04"), Some("a USDZ archive"));
    assert_eq!(named("a.3MF", b"PK\x03\x04"), Some("a 3MF archive"));
    assert_eq!(
        named("a.blend", b"\x28\xb5\x2f\xfd"),
        Some("a Blender file")
    );
    assert_eq!(
        named("a.splat", b"\0\x01\x02"),
        Some("a Gaussian splat file")
    );
    assert_eq!(named("a.splat", b"WorldBegin"), None);
    assert_eq!(named("a.3mf", b"ply\n"), Some("a PLY mesh"));
    assert_eq!(named("a.pbrt", b"\0\x01\x02"), None);
}
