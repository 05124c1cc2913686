//! Infinity and NaN as C libraries of Windows print them.
//!
//! Until 2015 they wrote `1.#INF`, `1.#QNAN`, `1.#SNAN` and `1.#IND`, with a sign perhaps, padded with zeros to the number of digits
//! that was asked for, or cut to it, as `1.#J` is. Since then they write `inf` and `nan`, `nan(ind)` and `nan(snan)`. Other
//! libraries put the bits of a NaN in the brackets.

/// The number `token`, if it has one of these forms.
#[cold]
pub(super) fn parse(token: &[u8]) -> Option<f64> {
    let (sign, magnitude) = match token {
        [b'-', rest @ ..] => (-1.0, rest),
        [b'+', rest @ ..] => (1.0, rest),
        _ => (1.0, token),
    };
    let value = match magnitude {
        [b'1', b'.', b'#', word @ ..] => parse_word(word)?,
        _ => parse_nan(magnitude)?,
    };
    Some(if sign < 0.0 { -value } else { value })
}

/// Whether a number of the old form begins with `text`, the first bytes of a word, and its `#` is the next byte: comments begin with this
/// sign in some formats.
pub(crate) fn continues_at_hash(text: &[u8], rest: &[u8]) -> bool {
    let is_start = matches!(text, b"1." | b"-1." | b"+1.");
    is_start && rest.get(1).is_some_and(|next| matches!(next.to_ascii_uppercase(), b'I' | b'Q' | b'S' | b'J' | b'R'))
}

/// What follows `1.#`.
fn parse_word(word: &[u8]) -> Option<f64> {
    let length = word.iter().position(|byte| !byte.is_ascii_alphabetic()).unwrap_or(word.len());
    let (name, padding) = word.split_at(length);
    if !padding.iter().all(|byte| *byte == b'0') {
        return None;
    }
    match name.to_ascii_uppercase().as_slice() {
        // Rounded to fewer digits, as if F were one: 1.#INF becomes 1.#IO and 1.#J.
        b"INF" | b"IO" | b"J" => Some(f64::INFINITY),
        b"QNAN" | b"SNAN" | b"IND" | b"QNB" | b"QO" | b"R" => Some(f64::NAN),
        _ => None,
    }
}

/// `nan(...)`.
fn parse_nan(magnitude: &[u8]) -> Option<f64> {
    let (name, rest) = magnitude.split_at_checked(3)?;
    let inner = rest.strip_prefix(b"(")?.strip_suffix(b")")?;
    let is_word = inner.iter().all(|byte| byte.is_ascii_alphanumeric() || *byte == b'_');
    (name.eq_ignore_ascii_case(b"nan") && is_word).then_some(f64::NAN)
}

#[cfg(test)]
mod tests {
    use crate::decimal::parse;

    #[test]
    fn infinities_are_read() {
        for token in ["1.#INF", "+1.#INF", "1.#INF00", "1.#inf", "1.#IO", "1.#J", "inf", "Infinity"] {
            assert_eq!(parse(token.as_bytes()), Some(f64::INFINITY), "{token}");
        }
        assert_eq!(parse(b"-1.#INF000"), Some(f64::NEG_INFINITY));
    }

    #[test]
    fn nans_are_read() {
        let tokens = ["1.#QNAN", "-1.#QNAN0", "1.#SNAN", "-1.#IND", "1.#IND00", "1.#R", "nan", "-nan", "NaN"];
        let brackets = ["nan(ind)", "-nan(ind)", "-NaN(IND)", "nan(snan)", "nan(0x8000)", "nan()", "+nan(ind)"];
        for token in tokens.into_iter().chain(brackets) {
            assert!(parse(token.as_bytes()).is_some_and(f64::is_nan), "{token}");
        }
    }

    #[test]
    fn nothing_else_is() {
        for token in ["1.#", "2.#INF", "1#INF", "1.#INF1", "1.#FOO", "nan(", "nan(ind", "nan(a b)", "inf(ind)", "--nan"]
        {
            assert_eq!(parse(token.as_bytes()), None, "{token}");
        }
    }
}
