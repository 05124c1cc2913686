//! Random and damaged files, read as by the general reader.

use proptest::prelude::*;
use proptest::sample::Index;

use super::*;

fn number() -> impl Strategy<Value = String> {
    prop_oneof![
        40 => "-?[0-9]{1,3}[.][0-9]{1,7}",
        4 => "-?0[.][0-9]{6,9}",
        2 => "[+-]?[0-9]{0,9}[.]?[0-9]{0,18}(e[+-]?[0-9]{1,3})?",
        1 => "(nan|inf|-inf|0|-0|x)",
    ]
}

fn blank() -> impl Strategy<Value = &'static str> {
    prop_oneof![60 => Just(" "), 1 => Just("  "), 1 => Just("\t"), 1 => Just(" \r")]
}

fn line_end() -> impl Strategy<Value = &'static str> {
    prop_oneof![
        90 => Just("\n"),
        30 => Just(" \n"),
        6 => Just("\r\n"),
        1 => Just("\n\n"),
        1 => Just("\r"),
    ]
}

/// The values of a vertex apart from its coordinates.
#[derive(Debug, Clone, Copy)]
enum Others {
    None,
    BeforeZ,
    AfterZ,
}

impl Others {
    fn any() -> impl Strategy<Value = Others> {
        prop_oneof![
            Just(Others::None),
            Just(Others::BeforeZ),
            Just(Others::AfterZ)
        ]
    }

    fn header(self, vertices: usize, faces: usize, kind: &str) -> String {
        let z = format!("property {kind} z\n");
        let before_z = format!("property uchar red\n{z}");
        let properties = match self {
            Others::None => z,
            Others::BeforeZ => before_z.clone(),
            Others::AfterZ => z + "property uchar red\nproperty float quality\n",
        };
        header("ascii", vertices, faces, kind).replace(&before_z, &properties)
    }

    fn line(self, [x, y, z]: [String; 3], blanks: [&str; 4], end: &str) -> String {
        let [a, b, c, d] = blanks;
        match self {
            Others::None => format!("{x}{a}{y}{b}{z}{end}"),
            Others::BeforeZ => format!("{x}{a}{y}{b}255{c}{z}{end}"),
            Others::AfterZ => format!("{x}{a}{y}{b}{z}{c}255{d}0.123456789{end}"),
        }
    }
}

/// A face of corners below `count`, most of the time.
fn face(count: u32) -> impl Strategy<Value = String> {
    let corners = prop_oneof![
        12 => proptest::collection::vec(0..count, 3..5),
        1 => proptest::collection::vec(0..30_u32, 0..12),
    ];
    (corners, blank(), line_end()).prop_map(|(corners, blank, end)| {
        let corners: String = corners
            .iter()
            .map(|corner| format!("{blank}{corner}"))
            .collect();
        format!("{}{corners}{end}", corners.split_whitespace().count())
    })
}

/// Text that is plain most of the time.
fn any_text() -> impl Strategy<Value = String> {
    let numbers = proptest::array::uniform3(number());
    let vertex = (numbers, proptest::array::uniform4(blank()), line_end());
    let kind = prop_oneof![Just("float"), Just("double")];
    let bodies = (
        proptest::collection::vec(vertex, 12..30),
        proptest::collection::vec(face(12), 1..20),
    );
    (bodies, kind, Others::any()).prop_map(|((vertices, faces), kind, others)| {
        let header = others.header(vertices.len(), faces.len(), kind);
        let line = |(numbers, blanks, end)| others.line(numbers, blanks, end);
        let vertices: String = vertices.into_iter().map(line).collect();
        header + &vertices + &faces.concat()
    })
}

/// Records of faces that have three corners most of the time.
fn any_bytes() -> impl Strategy<Value = Vec<u8>> {
    let corners = (3..5_usize).prop_flat_map(|most| {
        let odd = proptest::collection::vec(-1..12_i32, 0..7);
        let face = prop_oneof![60 => proptest::collection::vec(0..9_i32, most), 1 => odd];
        proptest::collection::vec(face, 1..12)
    });
    let vertices = proptest::collection::vec(any::<[f32; 3]>(), 9..12);
    (vertices, corners, any::<[bool; 2]>(), 0..4_usize).prop_map(
        |(vertices, faces, [is_big, is_double], padding)| {
            let encoding = if is_big {
                "binary_big_endian"
            } else {
                "binary_little_endian"
            };
            let kind = if is_double { "double" } else { "float" };
            let mut bytes = header(encoding, vertices.len(), faces.len(), kind).into_bytes();
            let mut push = |mut value: Vec<u8>| {
                if is_big {
                    value.reverse();
                }
                bytes.extend(value);
            };
            for [x, y, z] in vertices {
                let mut real = |value: f32| match is_double {
                    true => push(f64::from(value).to_le_bytes().to_vec()),
                    false => push(value.to_le_bytes().to_vec()),
                };
                real(x);
                real(y);
                push(vec![7]);
                let mut real = |value: f32| match is_double {
                    true => push(f64::from(value).to_le_bytes().to_vec()),
                    false => push(value.to_le_bytes().to_vec()),
                };
                real(z);
            }
            for face in faces {
                push(vec![face.len() as u8]);
                face.iter()
                    .for_each(|corner| push(corner.to_le_bytes().to_vec()));
            }
            bytes.extend([b"\n\r\0", &b"\0"[..], b"", b"x"][padding]);
            bytes
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn text_is_read_as_by_the_reader_of_everything(text in any_text()) {
        check(text.as_bytes());
    }

    #[test]
    fn bytes_are_read_as_by_the_reader_of_everything(bytes in any_bytes()) {
        check(&bytes);
    }

    #[test]
    fn damaged_files_are_read_as_by_the_reader_of_everything(
        mesh in prop_oneof![any_text().prop_map(String::into_bytes), any_bytes()],
        changes in proptest::collection::vec((any::<Index>(), any::<u8>()), 0..3),
        word in "(|-?[0-9]{1,20}|\n|\r|e|nan| )",
        place in any::<Index>(),
        end in any::<Index>(),
        is_cut in any::<bool>(),
    ) {
        let mut mesh = mesh;
        for (at, byte) in changes {
            let at = at.index(mesh.len());
            mesh[at] = byte;
        }
        let at = place.index(mesh.len());
        mesh.splice(at..at, word.bytes());
        mesh.truncate(if is_cut { end.index(mesh.len()) } else { mesh.len() });
        check(&mesh);
    }
}
