//! Decimal number tokens, as scene files and ASCII meshes write them (rule R1 of `docs/accuracy.md`).

/// The `f64` nearest to the decimal number `token`, ties to even; infinite beyond the range of `f64`.
///
/// Takes what C's `strtod` takes in the C locale except hexadecimal: a sign, digits with or without a point,
/// an exponent, `inf` and `nan`. `None` where the token is anything else or has something after the number.
pub fn parse(token: &[u8]) -> Option<f64> {
    std::str::from_utf8(token).ok()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::parse;

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
            ("0.1000000000000000055511151231257827021181583404541015625", 0.1),
        ];
        for (token, expected) in cases {
            assert_eq!(parse(token.as_bytes()), Some(expected), "{token}");
        }
        assert!(parse(b"nan").is_some_and(f64::is_nan));
    }

    #[test]
    fn refuses_what_is_not_one_number() {
        for token in ["", "-", ".", "1e", "3.1+e2", "1.2.3", "0x10", "1,2", " 1", "foo"] {
            assert_eq!(parse(token.as_bytes()), None, "{token}");
        }
        assert_eq!(parse(b"\xff1"), None);
    }
}
