//! Parsers of option values.

use crate::error::Error;
use crate::film::{ChannelName, PixelBounds};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use std::fmt::Display;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// Parses one of `values` by its name, and lists the names in help, completions and errors.
pub(crate) fn named<T, const N: usize>(
    values: [T; N],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T>
where
    T: FromStr + Clone + Send + Sync + 'static,
    T::Err: std::error::Error + Send + Sync + 'static,
{
    PossibleValuesParser::new(values.map(name)).try_map(|name| name.parse())
}

/// Like [`named`], with a line of help for each value.
pub(super) fn described<T, const N: usize>(
    values: [(T, &'static str); N],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T>
where
    T: FromStr + Clone + Send + Sync + 'static,
    T::Err: std::error::Error + Send + Sync + 'static,
{
    let possible = values.map(|(value, help)| PossibleValue::new(name(value)).help(help));
    PossibleValuesParser::new(possible).try_map(|name| name.parse())
}

/// Parses an integer within `range`.
pub(crate) fn integer(
    range: RangeInclusive<usize>,
) -> impl Fn(&str) -> Result<usize, String> + Clone {
    move |text| {
        let integer = text.parse().ok().filter(|integer| range.contains(integer));
        integer.ok_or_else(|| {
            format!(
                "expected a number from {} to {}",
                range.start(),
                range.end()
            )
        })
    }
}

/// Parses `N` finite numbers separated by commas.
pub(super) fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    parts(text, ',', |part| match part.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        Ok(_) => Err(format!("`{part}` is not a finite number")),
        Err(_) => Err(format!("`{part}` is not a number")),
    })
}

/// Parses `N` integers separated by commas.
pub(crate) fn integers<const N: usize>(text: &str) -> Result<[u32; N], String> {
    parts(text, ',', whole)
}

/// Parses `WxH`: the width and height of a film in pixels. `X` and the sign for multiplication
/// separate them as well.
pub(crate) fn resolution(text: &str) -> Result<[u32; 2], String> {
    let text = text.replace(['X', '\u{d7}'], "x");
    let [width, height] = parts(&text, 'x', whole)?;
    const MAX_SIDE: u32 = PixelBounds::MAX_SIDE;
    if width == 0 || height == 0 {
        return Err("width and height must be at least 1".to_owned());
    }
    if width.max(height) > MAX_SIDE {
        return Err(format!("expected sides of {MAX_SIDE} pixels or fewer"));
    }
    Ok([width, height])
}

fn whole(part: &str) -> Result<u32, String> {
    part.parse()
        .map_err(|_| format!("`{part}` is not an integer from 0 to {}", u32::MAX))
}

fn parts<T: Copy + Default, const N: usize>(
    text: &str,
    separator: char,
    parse: impl Fn(&str) -> Result<T, String>,
) -> Result<[T; N], String> {
    let parts: Vec<&str> = text.split(separator).map(str::trim).collect();
    if parts.len() != N {
        let count = parts.len();
        return Err(format!(
            "expected {N} values separated by `{separator}`, found {count}"
        ));
    }
    let mut values = [T::default(); N];
    for (value, part) in values.iter_mut().zip(parts) {
        *value = parse(part)?;
    }
    Ok(values)
}

/// OpenEXR 1 limits channel names to this length; older programs cannot read longer ones.
const MAX_CHANNEL_NAME: usize = 31;

/// Parses a name for the channel `Z` that no other channel has.
pub(super) fn depth_channel(name: &str) -> Result<String, String> {
    let is_short = (1..=MAX_CHANNEL_NAME).contains(&name.len());
    if !is_short || !name.chars().all(|c| c.is_ascii_graphic()) {
        return Err(format!(
            "expected 1 to {MAX_CHANNEL_NAME} ASCII characters without spaces"
        ));
    }
    if name != ChannelName::Z.name() && name.parse::<ChannelName>().is_ok() {
        return Err("another channel has this name".to_owned());
    }
    Ok(name.to_owned())
}

/// # Errors
/// The list of `flag` has an item twice.
pub(crate) fn refuse_repeated<T: Copy + PartialEq + Display>(
    flag: &str,
    items: Option<&[T]>,
) -> crate::error::Result<()> {
    let items = items.unwrap_or_default();
    let mut places = items.iter().enumerate();
    match places.find(|(place, item)| items[..*place].contains(item)) {
        Some((_, repeated)) => Err(Error::usage(format!("{flag} names `{repeated}` twice"))),
        None => Ok(()),
    }
}
