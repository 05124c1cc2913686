use proptest::prelude::*;

use super::{integers, quotient, three_reals};

/// Bytes after a line, as many as the readers of lines need.
const AFTER: &str = "1 2 3 4 5 6 7 8 9 0 1 2 3 4 5 6 7 8 9 0 1 2 3 4 5 6 7 8 9 0\n\
                     1 2 3 4 5 6 7 8 9 0 1 2 3 4 5 6 7 8 9 0 1 2 3 4 5 6 7 8 9 0\n";

#[test]
fn usual_lines_are_read() {
    let read = |line: &str, others| three_reals(format!("{line}{AFTER}").as_bytes(), others);
    let long = "0.1234567890123456789012345678901 a_rather_long_value_of_some_other_kind";
    let taken = [
        ("0.5 -12.25 .5\n", 0, [0.5, -12.25, 0.5]),
        ("5. -0.0 1234567.1 \n", 0, [5.0, -0.0, 1_234_567.1]),
        (
            "0.12345678 -0.00000001 0.9\r\n",
            0,
            [0.12345678, -1e-8, 0.9],
        ),
        (
            "0.123456789 1.5 1234567.123456789\n",
            0,
            [0.123456789, 1.5, 1_234_567.123_456_789],
        ),
        (
            "0.12345678901234567 9.007199254740993 900719.9254740993001\n",
            0,
            [
                0.12345678901234567,
                9.007199254740993,
                900_719.925_474_099_3,
            ],
        ),
        ("0.5 1.5 2.5 255 x \n", 2, [0.5, 1.5, 2.5]),
        (&format!("0.5 1.5 2.5 {long}\n"), 2, [0.5, 1.5, 2.5]),
    ];
    for (line, others, expected) in taken {
        let bits = |point: [f64; 3]| point.map(f64::to_bits);
        let found = read(line, others).map(|(point, length)| (bits(point), length));
        assert_eq!(found, Some((bits(expected), line.len())), "{line}");
    }
    for line in [
        "0.5 1.5\n2.5\n",
        "0.5\n1.5 2.5\n",
        "0.5 1.5  2.5\n",
        " 0.5 1.5 2.5\n",
        "0.5\t1.5 2.5\n",
        "0.5 1.5 2.5 3.5\n",
        "0.5 1.5 2.5  \n",
        "0.5 1.5 .\n",
        "0.5 1.5 -\n",
        "0.5 1.5 1.2.3\n",
        "0.5 1.5 1.2e3\n",
        "0.5 1.5 +1.2\n",
        "0.5 1.5 nan\n",
        "0.5 1.5 12345678.5\n",
        "0.5 1.5 0.1234567890123456789\n",
        "0.5 1.5 2.5 a_rather_long_value_of_some_other_kind_and_a_longer_one_yet\n",
    ] {
        assert_eq!(read(line, 0), None, "{line}");
    }
    for line in [
        "0.5 1.5 2.5 3.5\n4.5\n",
        "0.5 1.5 2.5  3.5 4.5\n",
        "0.5 1.5 2.5 3 4 5\n",
    ] {
        assert_eq!(read(line, 2), None, "{line}");
    }
    assert_eq!(three_reals(b"0.5 1.5 2.5\n", 0), None, "too short to tell");
}

#[test]
fn usual_lines_of_integers_are_read() {
    let read = |line: &str, others| integers(format!("{line}{AFTER}").as_bytes(), others);
    assert_eq!(
        read("0 12345678 99999999\n", 0),
        Some(([0, 12_345_678, 99_999_999], 20))
    );
    assert_eq!(read("7 8 9 \n", 0), Some(([7, 8, 9], 7)));
    assert_eq!(read("07 8 9 1.5 x\r\n", 2), Some(([7, 8, 9], 14)));
    let four = format!("12345678 12345679 12345670 12345671\n{AFTER}");
    let expected = [12_345_678, 12_345_679, 12_345_670, 12_345_671];
    assert_eq!(integers(four.as_bytes(), 0), Some((expected, 36)));
    for line in [
        "1 2 3 4\n",
        "1 2\n3\n",
        "1  2 3\n",
        "1 2 -3\n",
        "1 2 +3\n",
        "1 2 3.\n",
        "1 2 123456789\n",
        "\n1 2 3\n",
    ] {
        assert_eq!(
            read(line, 0).map(|(numbers, _): ([u32; 3], _)| numbers),
            None,
            "{line}"
        );
    }
}

/// A token, of the usual form most of the time.
fn token() -> impl Strategy<Value = String> {
    prop_oneof![
        30 => "-?[0-9]{1,3}[.][0-9]{1,7}",
        10 => "-?0[.][0-9]{1,19}",
        10 => "-?[0-9]{0,7}[.][0-9]{9,18}",
        1 => "(9007199254740993|4503599627370497|9007199254740995)[.][05]",
        10 => "-?[0-9]{0,9}[.][0-9]{0,12}",
        2 => "[0-9]{1,9}",
        1 => "[-+.0-9e]{0,9}",
        1 => "[!-~]{1,40}",
    ]
}

proptest! {
    #[test]
    fn usual_lines_agree_with_the_parser_of_tokens(
        tokens in proptest::collection::vec(token(), 1..7),
        blanks in proptest::collection::vec("( | | | | | | |\t|\n|\r|  )", 6),
        end in "(\n| \n|\r\n|\r|)",
    ) {
        let pairs = tokens.iter().zip(&blanks).enumerate();
        let line: String = pairs
            .map(|(at, (token, blank))| match at {
                0 => token.clone(),
                _ => blank.clone() + token,
            })
            .collect();
        let text = line + &end + AFTER;
        let others = tokens.len().saturating_sub(3);
        let words = |length: usize| {
            let line = &text[..length];
            prop_assert!(line.ends_with('\n') && !line[..length - 1].contains('\n'));
            Ok(line.split_whitespace().collect::<Vec<_>>())
        };
        if let Some((reals, length)) = three_reals(text.as_bytes(), others) {
            let words = words(length)?;
            prop_assert_eq!(words.len(), 3 + others);
            for (real, word) in reals.iter().zip(words) {
                prop_assert_eq!(Some(real.to_bits()), word.parse().ok().map(f64::to_bits));
            }
        }
        if let Some((numbers, length)) = integers::<3>(text.as_bytes(), others) {
            let words = words(length)?;
            prop_assert_eq!(words.len(), 3 + others);
            for (number, word) in numbers.iter().zip(words) {
                prop_assert_eq!(Ok(*number), word.parse());
            }
        }
    }

    #[test]
    fn quotients_are_rounded_once(
        (mantissa, places) in prop_oneof![
            (any::<u64>(), 0..=19_usize),
            (0..1_u64 << 54, 0..=19_usize),
            // Halfway between two numbers.
            ((1_u64 << 53..1 << 54), 0..3_usize)
                .prop_map(|(number, places)| (number * 10_u64.pow(places as u32), places)),
        ],
    ) {
        let expected = format!("{mantissa}e-{places}").parse().map(f64::to_bits);
        prop_assert_eq!(quotient(mantissa, places).map(f64::to_bits), expected.ok());
        prop_assert_eq!(quotient(mantissa, 20), None);
    }
}
