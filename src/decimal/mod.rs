//! Decimal number tokens, as scene files and ASCII meshes write them (rule R1 of `docs/accuracy.md`).

mod eight_bytes;
mod non_finite;

use self::eight_bytes::EightBytes;
pub(crate) use self::non_finite::leading as leading_non_finite;

/// The `f64` nearest to the decimal number `token`, ties to even; infinite beyond the range of `f64`.
///
/// Takes what C's `strtod` takes in the C locale except hexadecimal: a sign, digits with or without a point,
/// an exponent, `inf` and `nan`, also as Windows prints them. `None` where the token is anything else or has
/// something after the number.
pub fn parse(token: &[u8]) -> Option<f64> {
    parse_short(token)
        .or_else(|| std::str::from_utf8(token).ok()?.parse().ok())
        .or_else(|| non_finite::parse(token))
}

/// Powers of ten that an `f64` holds exactly.
const EXACT_POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// Powers of ten up to the number of digits that are read at once.
const WHOLE_POWERS: [u64; 9] = [
    1,
    10,
    100,
    1_000,
    10_000,
    100_000,
    1_000_000,
    10_000_000,
    100_000_000,
];

/// Digits that a `u64` takes whatever they are.
const SAFE_DIGITS: usize = 19;

/// The number that `text` begins with and its length, where it has the form that most numbers in files have: a minus sign
/// or none, up to 7 digits, and perhaps a point and up to 15 digits. `None` says nothing about `text`, which may be too
/// short to tell; and what follows the number is the caller's to look at.
#[inline]
pub(crate) fn leading(text: &[u8]) -> Option<(f64, usize)> {
    let sign = usize::from(text.first() == Some(&b'-'));
    let signed = |magnitude: f64| if sign == 1 { -magnitude } else { magnitude };
    let (number, length) = leading_digits(text.get(sign..)?)?;
    let at = sign + length;
    if text[at] != b'.' {
        return (length > 0).then(|| (signed(number as f64), at));
    }
    let fraction = EightBytes::of(&text[at + 1..])?;
    let places = fraction.digits();
    if places == 8 {
        let (mantissa, places) = long_fraction(number, fraction, &text[at + 9..])?;
        return Some((
            signed(mantissa as f64 / EXACT_POWERS[places]),
            at + 1 + places,
        ));
    }
    if length + places == 0 {
        return None;
    }
    // Of 14 digits at most, so that both numbers are exact and the division rounds once.
    let mantissa = number * WHOLE_POWERS[places] + fraction.number(places);
    Some((
        signed(mantissa as f64 / EXACT_POWERS[places]),
        at + 1 + places,
    ))
}

/// The digits that `text` begins with, 0 to 7, and how many they are; another byte follows.
#[inline]
fn leading_digits(text: &[u8]) -> Option<(u64, usize)> {
    // Where the next number begins should not have to wait for the length of this one, if that can be guessed.
    if let [digit @ b'0'..=b'9', b'.', ..] = text {
        return Some((u64::from(digit - b'0'), 1));
    }
    let bytes = EightBytes::of(text)?;
    let length = bytes.digits();
    (length < 8).then(|| (bytes.number(length), length))
}

/// The digits `whole`, 7 at most, eight more and those that `rest` begins with, where an `f64` holds them exactly; and how
/// many follow the point.
fn long_fraction(whole: u64, first: EightBytes, rest: &[u8]) -> Option<(u64, usize)> {
    let second = EightBytes::of(rest)?;
    let places = second.digits();
    if places == 8 {
        return None;
    }
    let high = whole * WHOLE_POWERS[8] + first.number(8);
    let mantissa = high
        .checked_mul(WHOLE_POWERS[places])?
        .checked_add(second.number(places))?;
    (mantissa <= 1 << f64::MANTISSA_DIGITS).then_some((mantissa, 8 + places))
}

/// The whole number without a sign that `text` begins with, of up to 7 digits, and its length. `None` says nothing about
/// `text`, and what follows the number is the caller's to look at.
#[inline]
pub(crate) fn leading_whole(text: &[u8]) -> Option<(u64, usize)> {
    let bytes = EightBytes::of(text)?;
    let length = bytes.digits();
    (1..8)
        .contains(&length)
        .then(|| (bytes.number(length), length))
}

/// Clinger's fast path: the number `token` where its digits and the power of ten are both exact in `f64`, so that
/// the one multiplication or division rounds once and correctly. `None` says nothing about `token`.
fn parse_short(token: &[u8]) -> Option<f64> {
    let (negative, unsigned) = match token {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, token),
    };
    let (mut mantissa, mut rest) = digits(0, unsigned);
    let mut count = unsigned.len() - rest.len();
    let mut exponent = 0;
    if let [b'.', fraction @ ..] = rest {
        (mantissa, rest) = digits(mantissa, fraction);
        let places = fraction.len() - rest.len();
        count += places;
        exponent = -i32::try_from(places).ok()?;
    }
    if let [b'e' | b'E', power @ ..] = rest {
        exponent += short_exponent(power)?;
        rest = &[];
    }
    if !rest.is_empty()
        || !(1..=SAFE_DIGITS).contains(&count)
        || mantissa > 1 << f64::MANTISSA_DIGITS
    {
        return None;
    }
    let power = *EXACT_POWERS.get(usize::try_from(exponent.unsigned_abs()).ok()?)?;
    let magnitude = if exponent < 0 {
        mantissa as f64 / power
    } else {
        mantissa as f64 * power
    };
    Some(if negative { -magnitude } else { magnitude })
}

/// Appends the digits that `text` begins with to `number`, which wraps after [`SAFE_DIGITS`], and what is left.
#[inline]
fn digits(mut number: u64, text: &[u8]) -> (u64, &[u8]) {
    let mut rest = text;
    while let [digit @ b'0'..=b'9', after @ ..] = rest {
        number = number
            .wrapping_mul(10)
            .wrapping_add(u64::from(digit - b'0'));
        rest = after;
    }
    (number, rest)
}

/// The exponent `text`, a sign and one to three digits.
fn short_exponent(text: &[u8]) -> Option<i32> {
    let (sign, unsigned) = match text {
        [b'-', rest @ ..] => (-1, rest),
        [b'+', rest @ ..] => (1, rest),
        _ => (1, text),
    };
    let (magnitude, rest) = digits(0, unsigned);
    let is_short = (1..=3).contains(&unsigned.len()) && rest.is_empty();
    is_short.then(|| sign * magnitude as i32)
}

#[cfg(test)]
mod tests {
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
}
