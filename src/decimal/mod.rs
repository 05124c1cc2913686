//! Parses decimal numbers of scene files and ASCII meshes (rule R1 of `docs/accuracy.md`).

mod eight_bytes;
mod non_finite;
pub(crate) mod usual_lines;

use self::eight_bytes::EightBytes;
pub(crate) use self::non_finite::leading as leading_non_finite;

/// The `f64` nearest to the decimal number `token`, ties to even; infinite beyond the range of
/// `f64`.
///
/// Accepts what C's `strtod` accepts in the C locale, except hexadecimal: a sign, digits with or
/// without a point, an exponent, `inf` and `nan`, also as Windows prints them. `None` if the token
/// is anything else or has something after the number.
pub fn parse(token: &[u8]) -> Option<f64> {
    parse_short(token)
        .or_else(|| std::str::from_utf8(token).ok()?.parse().ok())
        .or_else(|| non_finite::parse(token))
}

/// The powers of ten that an `f64` represents exactly.
const EXACT_POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// The powers of ten up to the number of digits that are read at once.
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

/// The number of digits that always fit a `u64`.
const SAFE_DIGITS: usize = 19;

/// The number at the start of `text`, and its length, if it has the form of most numbers in files:
/// an optional minus sign, up to 7 digits, and optionally a point and up to 15 digits. `None` means
/// unknown: `text` may be too short. The caller checks what follows the number.
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
    // At most 14 digits, so both numbers are exact and the division rounds once.
    let mantissa = number * WHOLE_POWERS[places] + fraction.number(places);
    Some((
        signed(mantissa as f64 / EXACT_POWERS[places]),
        at + 1 + places,
    ))
}

/// The up to 7 digits at the start of `text`, and their count; another byte must follow.
#[inline]
fn leading_digits(text: &[u8]) -> Option<(u64, usize)> {
    // A guess of the length frees the start of the next number from waiting for it.
    if let [digit @ b'0'..=b'9', b'.', ..] = text {
        return Some((u64::from(digit - b'0'), 1));
    }
    let bytes = EightBytes::of(text)?;
    let length = bytes.digits();
    (length < 8).then(|| (bytes.number(length), length))
}

/// The digits `whole`, at most 7, eight more and those at the start of `rest`, if an `f64`
/// represents them exactly; and how many follow the point.
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

/// The unsigned integer of up to 7 digits at the start of `text`, and its length. `None` means
/// unknown. The caller checks what follows the number.
#[inline]
pub(crate) fn leading_whole(text: &[u8]) -> Option<(u64, usize)> {
    let bytes = EightBytes::of(text)?;
    let length = bytes.digits();
    (1..8)
        .contains(&length)
        .then(|| (bytes.number(length), length))
}

/// Clinger's fast path: the number `token` if its digits and the power of ten are both exact in
/// `f64`, so that the one multiplication or division rounds once and correctly. `None` means
/// unknown.
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

/// Appends the digits at the start of `text` to `number`, which wraps after [`SAFE_DIGITS`]; also
/// returns the rest.
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

/// The value of the exponent `text`, a sign and one to three digits.
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
mod tests;
