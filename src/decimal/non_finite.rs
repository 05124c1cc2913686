//! Parses infinities and NaNs as C libraries print them.

/// The value of `token` if it is a spelling of infinity or NaN by C's `printf`: `nan(ind)`, which
/// `strtod` accepts, and `1.#INF`, `1.#IND`, `1.#QNAN`, `1.#SNAN`, which Microsoft's library
/// printed before 2015, with the zeros of a precision, or rounded to a letter (`1.#J`, `1.#R`).
pub(super) fn parse(token: &[u8]) -> Option<f64> {
    let (sign, unsigned) = match token {
        [b'-', rest @ ..] => (-1.0, rest),
        [b'+', rest @ ..] => (1.0, rest),
        _ => (1.0, token),
    };
    let magnitude = match unsigned {
        [digits @ .., _] if is_nan_with_payload(unsigned, digits) => f64::NAN,
        _ => of_windows(unsigned)?,
    };
    Some(magnitude * sign)
}

/// `nan(`, letters, digits and underscores, `)`.
fn is_nan_with_payload(unsigned: &[u8], but_the_last: &[u8]) -> bool {
    let is_payload = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
    let opened = but_the_last
        .get(..4)
        .is_some_and(|head| head.eq_ignore_ascii_case(b"nan("));
    opened && unsigned.ends_with(b")") && but_the_last[4..].iter().all(is_payload)
}

fn of_windows(unsigned: &[u8]) -> Option<f64> {
    let hash = unsigned.iter().position(|byte| *byte == b'#')?;
    let (head, name) = (&unsigned[..hash], &unsigned[hash + 1..]);
    let [whole @ .., b'.'] = head else {
        return None;
    };
    if whole.is_empty() || !whole.iter().all(u8::is_ascii_digit) {
        return None;
    }
    let (name, power) = match name.iter().position(|byte| matches!(byte, b'e' | b'E')) {
        Some(at) => (&name[..at], &name[at + 1..]),
        None => (name, &b"0"[..]),
    };
    let power = power
        .strip_prefix(b"+")
        .or(power.strip_prefix(b"-"))
        .unwrap_or(power);
    let letters = name
        .iter()
        .position(|byte| !byte.is_ascii_alphabetic())
        .unwrap_or(name.len());
    let zeros = &name[letters..];
    if power.is_empty() || !power.iter().chain(zeros).all(u8::is_ascii_digit) {
        return None;
    }
    match name[..letters].to_ascii_uppercase().as_slice() {
        b"INF" | b"J" | b"IO" | b"INE" => Some(f64::INFINITY),
        b"IND" | b"QNAN" | b"SNAN" | b"QNAO" | b"QNB" | b"QO" | b"R" | b"SNAO" | b"SNB" | b"SO"
        | b"T" => Some(f64::NAN),
        _ => None,
    }
}

/// The length of a number such as `1.#INF` at the start of `text`, if there is one; it ends with
/// `is_word`.
pub(crate) fn leading(text: &[u8], is_word: impl Fn(u8) -> bool) -> Option<usize> {
    let hash = text.iter().position(|byte| !is_word(*byte))?;
    if text[hash] != b'#' || !text[..hash].ends_with(b".") {
        return None;
    }
    let rest = &text[hash + 1..];
    let length = hash
        + 1
        + rest
            .iter()
            .position(|byte| !is_word(*byte))
            .unwrap_or(rest.len());
    parse(&text[..length]).map(|_| length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spellings_of_c_libraries_are_read() {
        for token in [
            "1.#INF",
            "+1.#INF",
            "1.#INF00",
            "1.#inf000",
            "1.#INF00e+000",
            "1.#INFe+00",
            "1.#J",
            "1.#IO",
        ] {
            assert_eq!(parse(token.as_bytes()), Some(f64::INFINITY), "{token}");
        }
        assert_eq!(parse(b"-1.#INF"), Some(f64::NEG_INFINITY));
        let nans = [
            "-nan(ind)",
            "nan(snan)",
            "NaN(0x1)",
            "nan()",
            "-1.#IND",
            "1.#QNAN",
            "1.#SNAN0",
            "1.#R",
            "1.#QO",
        ];
        for token in nans {
            assert!(parse(token.as_bytes()).is_some_and(f64::is_nan), "{token}");
        }
        for token in [
            "1.#", "#INF", ".#INF", "1#INF", "1.#FOO", "1.#INFx", "1.#INF0x", "nan(", "nan(-)",
            "1.#INFe", "x.#INF",
        ] {
            assert_eq!(parse(token.as_bytes()), None, "{token}");
        }
    }

    #[test]
    fn what_follows_a_point_may_be_a_comment() {
        let is_word = |byte: u8| !matches!(byte, b' ' | b'#' | b']');
        assert_eq!(leading(b"1.#INF 2", is_word), Some(6));
        assert_eq!(leading(b"-1.#IND]", is_word), Some(7));
        assert_eq!(leading(b"1.# a comment", is_word), None);
        assert_eq!(leading(b"1.#infinite wisdom", is_word), None);
        assert_eq!(leading(b"1.", is_word), None);
    }
}
