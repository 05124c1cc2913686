use proptest::prelude::*;

use super::{leading, leading_whole, parse, parse_short};

fn slowly(token: &str) -> Option<u64> {
    token.parse::<f64>().ok().map(f64::to_bits)
}

#[test]
fn reads_the_forms_that_files_contain() {
    let cases: [(&str, f64); 9] = [
        ("1", 1.0),
        ("-.5", -0.5),
        ("+2.", 2.0),
        ("1e+2", 100.0),
        ("1E-3", 1e-3),
        ("1e999", f64::INFINITY),
        ("-1e999", f64::NEG_INFINITY),
        ("1e-999", 0.0),
        (
            "0.1000000000000000055511151231257827021181583404541015625",
            0.1,
        ),
    ];
    for (token, expected) in cases {
        assert_eq!(parse(token.as_bytes()), Some(expected), "{token}");
    }
    assert!(parse(b"nan").is_some_and(f64::is_nan));
}

#[test]
fn refuses_what_is_not_one_number() {
    for token in [
        "", "-", ".", "1e", "3.1+e2", "1.2.3", "0x10", "1,2", " 1", "foo",
    ] {
        assert_eq!(parse(token.as_bytes()), None, "{token}");
    }
    assert_eq!(parse(b"\xff1"), None);
}

#[test]
fn the_fast_path_ends_where_it_must() {
    let taken = [
        "9007199254740992",
        "-9007199254740992e22",
        "1e-22",
        "-0",
        "0.000000000000000001",
        "5.",
        ".5E+03",
    ];
    for token in taken {
        assert_eq!(
            parse_short(token.as_bytes()).map(f64::to_bits),
            slowly(token),
            "{token}"
        );
    }
    let left = [
        "9007199254740993",
        "1e23",
        "1e-23",
        "18446744073709551617",
        "00000000000000000001",
        "1e0001",
        "inf",
    ];
    for token in left {
        assert_eq!(parse_short(token.as_bytes()), None, "{token}");
        assert_eq!(
            parse(token.as_bytes()).map(f64::to_bits),
            slowly(token),
            "{token}"
        );
    }
}

#[test]
fn leading_numbers_end_where_they_must() {
    let read = |text: &str| leading(format!("{text}        ").as_bytes());
    let taken = [
        "0",
        "-0.0",
        "1234567",
        "-.5",
        "5.",
        "1234567.12345678",
        "0.900719925474099",
        "-0.0750396",
    ];
    for text in taken {
        let expected = (text.parse::<f64>().expect("a number"), text.len());
        assert_eq!(
            read(text).map(|(value, length)| (value.to_bits(), length)),
            Some((expected.0.to_bits(), expected.1))
        );
    }
    let left = [
        "",
        "-",
        ".",
        "-.",
        "+1",
        "x",
        "12345678",
        "0.1234567812345678",
        "9.12345678123456789",
        "nan",
    ];
    for text in left {
        assert_eq!(read(text), None, "{text}");
    }
    assert_eq!(leading(b"1.5"), None, "too short to tell");
    assert_eq!(
        read("1e5"),
        Some((1.0, 1)),
        "the caller looks at what follows"
    );
    assert_eq!(leading_whole(b"1234567 "), Some((1_234_567, 7)));
    assert_eq!(leading_whole(b"7,345678"), Some((7, 1)));
    for text in [" 1      ", "-1      ", "12345678", "1 "] {
        assert_eq!(leading_whole(text.as_bytes()), None, "{text}");
    }
}

proptest! {
    #[test]
    fn leading_numbers_agree_with_the_standard_library(text in "-?[0-9]{0,9}[.]?[0-9]{0,18}", rest in "[^.0-9][ -~]{0,20}") {
        if let Some((value, length)) = leading(format!("{text}{rest}").as_bytes()) {
            prop_assert_eq!(length, text.len());
            prop_assert_eq!(Some(value.to_bits()), slowly(&text));
        }
    }

    #[test]
    fn leading_numbers_are_prefixes(bytes in proptest::collection::vec(any::<u8>(), 0..30)) {
        let token = |length: usize| std::str::from_utf8(&bytes[..length]).ok().and_then(slowly);
        if let Some((value, length)) = leading(&bytes) {
            prop_assert_eq!(Some(value.to_bits()), token(length));
            prop_assert!(!bytes[length].is_ascii_digit());
        }
        if let Some((value, length)) = leading_whole(&bytes) {
            prop_assert_eq!(Some((value as f64).to_bits()), token(length));
            prop_assert!(!bytes[length].is_ascii_digit());
        }
    }

    #[test]
    fn agrees_with_the_standard_library(token in "[-+]?[0-9]{0,12}[.]?[0-9]{0,12}([eE][-+]?[0-9]{0,3})?") {
        prop_assert_eq!(parse(token.as_bytes()).map(f64::to_bits), slowly(&token));
    }

    #[test]
    fn agrees_with_the_standard_library_on_anything(token in "[-+.0-9eE]{0,12}") {
        prop_assert_eq!(parse(token.as_bytes()).map(f64::to_bits), slowly(&token));
    }
}
