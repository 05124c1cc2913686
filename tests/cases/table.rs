//! The table of all cases, with the right result of each.

/// The right result of a case.
pub(crate) enum Right {
    /// `scene.pbrt` gives the hits and depths of `expected.pbrt`, without a warning.
    Same,
    /// As `Same`, but with a warning that contains this.
    SameWarned(&'static str),
    /// `feimos ARGUMENTS` exits with this code, after messages that contain all of these parts.
    Ends(&'static str, i32, &'static [&'static str]),
}

use self::Right::{Ends, Same, SameWarned};

/// All folders of `tests/cases`, sorted.
pub(crate) const CASES: &[(&str, Right)] = &[
    (
        "a-name-commands-the-terminal",
        Ends("render s.pbrt --color always", 65, &["control character"]),
    ),
    ("alpha-zero", Same),
    ("attribute-alpha-zero", Same),
    ("attribute-end-before-object-end", SameWarned("pbrt-v4")),
    ("begin-without-end", SameWarned("AttributeBegin")),
    ("coordsys-nfc-nfd", Same),
    (
        "coplanar-disks",
        Ends("render scene.pbrt -o found.exr", 0, &["489 hit"]),
    ),
    ("cropwindow-1.0001", SameWarned("cropwindow")),
    ("cropwindow-and-pixelbounds", SameWarned("pixelbounds")),
    ("cropwindow-out-of-range", SameWarned("cropwindow")),
    (
        "disk-v-negative-innerradius",
        Ends("check scene.pbrt", 0, &[]),
    ),
    ("end-without-begin", SameWarned("AttributeEnd")),
    (
        "environment-camera",
        Ends("render scene.pbrt -o found.exr", 0, &["8 hit"]),
    ),
    (
        "few-bytes-much-memory",
        Ends("check loop8.pbrt", 65, &["loop8.pbrt:", "--"]),
    ),
    ("gzip-padded-with-zeros", Same),
    (
        "import-coordinate-system",
        Ends("render scene.pbrt -o found.exr", 0, &["288 hit", "`q`"]),
    ),
    (
        "include-backslash",
        Ends("check scene.pbrt", 66, &["scene.pbrt:5:9", "sub/a.pbrt"]),
    ),
    (
        "include-in-other-case",
        Ends("check scene.pbrt", 66, &["scene.pbrt:5:9", "a.pbrt"]),
    ),
    ("indices-excess", SameWarned("indices")),
    ("instance-before-its-object", Same),
    ("interface-disk", Same),
    ("interface-ends-with-block", Same),
    ("interface-material", Same),
    ("lookat-commas", Same),
    ("loopsubdiv-normal", Ends("check scene.pbrt", 0, &[])),
    ("matrix-w", Same),
    ("matrix-w-almost-1", Same),
    ("matrix-w-negative", Same),
    ("medium-parameters-after-include", Same),
    (
        "mesh-beside-the-included-file",
        Ends("check scene.pbrt", 66, &["m.ply", "sub/m.ply"]),
    ),
    (
        "mesh-in-other-case",
        Ends("check scene.pbrt", 66, &["M.PLY", "m.ply"]),
    ),
    ("msvc-nan-in-light", Same),
    ("named-interface", Same),
    ("names-nfc-nfd", Same),
    ("negative-radius-disk", Same),
    ("none-material-v3", Same),
    (
        "obj-surfaces-in-silence",
        Ends("check c.obj", 65, &["c.obj:11:", "1/1/1/7/7"]),
    ),
    (
        "one-include-a-thousand-times",
        Ends("check scene.pbrt", 65, &["scene.pbrt:", "--"]),
    ),
    ("parameters-after-include", Same),
    ("phimax-underflow", Ends("check scene.pbrt", 0, &[])),
    ("ply-float-indices", Same),
    (
        "polygons-that-cross",
        Ends("check scene.pbrt", 65, &["many.ply.gz", "face"]),
    ),
    (
        "poses-t-column",
        Ends(
            "render scene.pbrt --cameras p.json -o found.exr",
            0,
            &["200 hit"],
        ),
    ),
    ("projective-matrix-of-a-light", Same),
    (
        "the-output-is-the-scene",
        Ends("render f.png", 2, &["f.png"]),
    ),
    ("transform-begin-attribute-end", SameWarned("AttributeEnd")),
    ("translate-split-over-files", Same),
    ("zero-matrix-of-a-light", Same),
];
