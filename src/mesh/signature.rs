//! Recognizes by its first bytes what a file is instead of a mesh.

/// First bytes, and the kind of file that they mark.
const SIGNATURES: [(&[u8], &str); 17] = [
    (
        b"version https://git-lfs.github.com/spec",
        "a Git LFS pointer: the mesh itself has not been fetched",
    ),
    (b"\xff\xfe", "UTF-16 text"),
    (b"\xfe\xff", "UTF-16 text"),
    (b"\x1f\x8b", "gzip data compressed twice"),
    (b"PK\x03\x04", "a ZIP archive"),
    (b"\xfd7zXZ", "xz data"),
    (b"BZh", "bzip2 data"),
    (b"\x28\xb5\x2f\xfd", "zstd data"),
    (b"glTF", "a glTF mesh"),
    (b"OFF", "an OFF mesh"),
    (b"solid ", "an STL mesh"),
    (b"\x89PNG", "a PNG picture"),
    (b"\xff\xd8\xff", "a JPEG picture"),
    (b"<", "an XML or HTML document"),
    (b"{", "a JSON document"),
    (b"ply\n", "a PLY mesh"),
    (b"ply\r", "a PLY mesh"),
];

const UTF8_MARK: &[u8] = b"\xef\xbb\xbf";

/// The kind of file that `bytes` look like, in words that continue "this is".
pub(super) fn describe(bytes: &[u8]) -> Option<&'static str> {
    if bytes.is_empty() {
        return Some("an empty file");
    }
    // ASCII text in UTF-16, without a byte order mark.
    if matches!(
        bytes,
        [0, 1..=127, 0, 1..=127, ..] | [1..=127, 0, 1..=127, 0, ..]
    ) {
        return Some("UTF-16 text");
    }
    let known = SIGNATURES.iter().find(|(mark, _)| bytes.starts_with(mark));
    known.map(|(_, name)| *name)
}

/// `bytes` without a UTF-8 byte order mark.
pub(super) fn without_utf8_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(UTF8_MARK).unwrap_or(bytes)
}
