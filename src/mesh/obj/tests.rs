//! The fast reader against the general one.

use std::path::Path;

use proptest::prelude::*;
use proptest::sample::Index;

use super::parallel::read_in_blocks;
use super::{parse, reader};
use crate::input::Budget;
use crate::mesh::tests::told;
use crate::mesh::{CornerWants, Loaded, MeshFormat};

/// Checks that the fast reader, in blocks of several sizes, agrees with the general one. Returns
/// whether `text` is in the usual form.
fn check(text: &[u8]) -> bool {
    let path = Path::new("a.obj");
    let budget = || Budget::of_bytes(text.len());
    let expected = told(&reader::read(path, text, CornerWants::NOTHING, &budget()));
    let mut times_read = 0;
    for block in [1, 9, 50, 1 << 20] {
        if let Some(mesh) = read_in_blocks(text, block, &budget()) {
            assert_eq!(
                told(&Ok(Loaded::new(path, mesh, Vec::new()))),
                expected,
                "in blocks of {block} bytes"
            );
            times_read += 1;
        }
    }
    assert!(
        times_read == 0 || times_read == 4,
        "the result depends on the size of blocks"
    );
    if MeshFormat::Obj.refused(path, text).is_none() {
        assert_eq!(
            told(&parse(path, text, CornerWants::NOTHING, &budget())),
            expected
        );
    }
    times_read > 0
}

const VERTICES: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0.5 .2 1e-1\nv 0 1 0\n";

#[test]
fn files_in_the_usual_form_are_read() {
    for rest in [
        "f 3 2 1\nf 1 3 4 5\nf 1 2 3",
        "# a\ng b c\nusemtl d\n\n  f 1/1 2/2/2 3//-3  \r\nvt x\nf\t1\n"
            .replace("f\t1\n", "f 5 1 2\n")
            .as_str(),
        "f 1 2 3 4 5\nf 5 4 0000001\nv nan inf +3\nf 6 1 2\n",
    ] {
        assert!(
            check(&[VERTICES.as_bytes(), rest.as_bytes()].concat()),
            "{rest}"
        );
    }
}

#[test]
fn other_files_are_left_to_the_general_reader() {
    let odd = [
        "",
        "f 1 2\n",
        "f 1 2 6\n",
        "f 0 1 2\n",
        "f 1 2 -1\n",
        "f 1 2 3 # c\n",
        "f 1 2 3 \\\n 4\n",
        "f 1 2 x\n",
        "f 1 2 3x\n",
        "f 1 2 3/x\n",
        "f 1 2 3\nf\n",
        "f 1 2 3\nfaces\n",
        "v 1 2 3 4\nf 1 2 3\n",
        "v 1 2\nf 1 2 3\n",
        "f 1 2 3\rf 1 2 3\n",
        "# a\rf 1 2 3\n",
        "# a\\\nf 1 2 3\nf 1 2 3\\\n",
        "f 1 2 4294967297\n",
        "f 1 2 99999999999999999999\n",
        "f 1 2 3\x0b\n",
        "f 1 2 3\n\x0b0.5\n",
        "f 1 2 3\nvt\0x\n",
    ];
    for rest in odd {
        assert!(
            !check(&[VERTICES.as_bytes(), rest.as_bytes()].concat()),
            "{rest}"
        );
    }
}

fn line() -> impl Strategy<Value = String> {
    let number = prop_oneof![6 => "-?[0-9]{1,2}[.][0-9]{1,6}", 1 => "[+-]?[0-9]{1,9}[.]?[0-9]{0,18}(e[+-]?[0-9]{1,2})?"];
    let corner = prop_oneof![8 => "[1-9]", 1 => "[1-9](/[0-9]?(/-?[1-9])?)"];
    let end = prop_oneof![20 => Just("\n"), 3 => Just(" \n"), 1 => Just("\r\n")];
    let line = prop_oneof![
        10 => proptest::collection::vec(number, 3).prop_map(|words| format!("v {}", words.join(" "))),
        10 => proptest::collection::vec(corner, 3..7).prop_map(|words| format!("f {}", words.join("  "))),
        1 => "(vt 0 1|vn 1|g a|# b|o|)",
        1 => "(f 1 2|f 1 2 -1|v 1 2 3 4|v 1 2 3 1 1 1|x|f 1 2 3 \\\\)",
    ];
    (line, end).prop_map(|(line, end)| line + end)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn both_readers_agree(lines in proptest::collection::vec(line(), 1..12)) {
        check((VERTICES.repeat(2) + &lines.concat()).as_bytes());
    }

    #[test]
    fn both_readers_agree_on_damaged_files(
        lines in proptest::collection::vec(line(), 1..9),
        changes in proptest::collection::vec((any::<Index>(), any::<u8>()), 0..3),
        word in "(|-?[0-9]{1,20}|\n|\r|e|nan| |#|\\\\|/)",
        place in any::<Index>(),
    ) {
        let mut text = (VERTICES.repeat(2) + &lines.concat()).into_bytes();
        for (at, byte) in changes {
            let at = at.index(text.len());
            text[at] = byte;
        }
        let at = place.index(text.len());
        text.splice(at..at, word.bytes());
        check(&text);
    }
}
