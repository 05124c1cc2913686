//! The cells of results, in each form of output.

use crate::bench::error::InputError;
use crate::bench::run::Spread;
use crate::error::grouped;
use serde::{Serialize, Serializer};

/// A cell. What was not measured is `None`: null in JSON, empty in CSV, a dash in tables.
pub(super) enum Value {
    Name(String),
    Count(Option<u64>),
    /// A measurement and its text format.
    Real(Option<f64>, fn(f64) -> String),
    Spread(Option<Spread>),
    /// A count of pixels, and the confidence interval of its share if they are a sample.
    Pixels(Option<(u64, Option<[f64; 2]>)>),
    Input(Option<InputError>),
    /// Confidence intervals of the shares of wrong hits and wrong primitives.
    Confidence(Option<[[f64; 2]; 2]>),
}

impl Value {
    /// The text for people.
    pub(super) fn text(&self) -> String {
        let text = match self {
            Value::Name(name) => Some(name.clone()),
            Value::Count(count) => count.map(grouped),
            Value::Real(value, format) => value.map(format),
            Value::Spread(spread) => spread.map(|spread| spread.to_string()),
            Value::Pixels(pixels) => pixels.map(|(count, interval)| match interval {
                Some([_, high]) => format!("{} (<{})", grouped(count), percent_above(high)),
                None => grouped(count),
            }),
            Value::Input(_) | Value::Confidence(_) => None,
        };
        text.unwrap_or_else(|| "-".to_owned())
    }

    /// The cells of CSV, with titles that begin with `key`.
    pub(super) fn cells(&self, key: &str) -> Vec<(String, String)> {
        let cell = |title: String, value: Option<String>| (title, value.unwrap_or_default());
        let one = |value| vec![cell(key.to_owned(), value)];
        match self {
            Value::Name(name) => one(Some(name.clone())),
            Value::Count(count) => one(count.map(|count| count.to_string())),
            Value::Real(value, _) => one(value.map(|value| value.to_string())),
            Value::Pixels(pixels) => one(pixels.map(|(count, _)| count.to_string())),
            Value::Spread(spread) => {
                let cell = |end: &str, value: Option<f64>| {
                    cell(format!("{key}_{end}"), value.map(|value| value.to_string()))
                };
                vec![
                    cell("min", spread.map(|spread| spread.min)),
                    cell("median", spread.map(|spread| spread.median)),
                    cell("max", spread.map(|spread| spread.max)),
                ]
            }
            Value::Input(input) => {
                let [ulp, pixels] = [
                    input.map(|input| input.max_ulp),
                    input.map(|input| input.max_pixels),
                ];
                let cell = |end: &str, value: Option<f64>| {
                    cell(format!("{key}_{end}"), value.map(|value| value.to_string()))
                };
                vec![cell("max_ulp", ulp), cell("max_pixels", pixels)]
            }
            Value::Confidence(intervals) => {
                let names = ["wrong_hits", "wrong_primitives"].into_iter().enumerate();
                let ends = names.flat_map(|(index, name)| {
                    ["low", "high"]
                        .into_iter()
                        .enumerate()
                        .map(move |(end, title)| {
                            let value =
                                intervals.map(|intervals| intervals[index][end].to_string());
                            cell(format!("{name}_95_{title}"), value)
                        })
                });
                ends.collect()
            }
        }
    }
}

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        /// Keys of JSON.
        #[derive(Serialize)]
        struct Confidence {
            wrong_hits: [f64; 2],
            wrong_primitives: [f64; 2],
        }
        match self {
            Value::Name(name) => name.serialize(serializer),
            Value::Count(count) => count.serialize(serializer),
            Value::Real(value, _) => value.serialize(serializer),
            Value::Spread(spread) => spread.serialize(serializer),
            Value::Pixels(pixels) => pixels.map(|(count, _)| count).serialize(serializer),
            Value::Input(input) => input.serialize(serializer),
            Value::Confidence(intervals) => {
                let confidence = intervals.map(|[wrong_hits, wrong_primitives]| Confidence {
                    wrong_hits,
                    wrong_primitives,
                });
                confidence.serialize(serializer)
            }
        }
    }
}

/// One decimal, or none above a thousand.
pub(super) fn mean(value: f64) -> String {
    match value {
        value if !value.is_finite() => "-".to_owned(),
        value if value < 1000.0 => format!("{value:.1}"),
        value => grouped(value.round() as u64),
    }
}

/// A share in percent, with two digits; none has no unit.
pub(super) fn percent(share: f64) -> String {
    in_percent(share, f64::round)
}

/// An upper bound of a share in percent, with two digits, rounded up.
pub(super) fn percent_above(share: f64) -> String {
    in_percent(share, f64::ceil)
}

fn in_percent(share: f64, rounded: fn(f64) -> f64) -> String {
    let value = 100.0 * share;
    if value == 0.0 {
        return "0".to_owned();
    }
    let decimals = (1.0 - value.log10().floor()).clamp(0.0, 12.0) as usize;
    let unit = 10f64.powi(decimals as i32);
    format!("{:.decimals$} %", rounded(value * unit) / unit)
}

/// Two decimals, or two digits of small values.
pub(super) fn rate(value: f64) -> String {
    if value < 0.01 {
        format!("{value:.1e}")
    } else {
        format!("{value:.2}")
    }
}

/// Three decimals, or fewer for very small and very large values.
pub(super) fn small(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        value if value < 0.001 => format!("{value:.0e}"),
        value if value < 1000.0 => format!("{value:.3}"),
        value => grouped(value.round() as u64),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percents_have_two_digits() {
        let shares = [0.0, 1.5e-5, 0.049, 0.3, 1.0, 2e-11];
        let texts = ["0", "0.0015 %", "4.9 %", "30 %", "100 %", "0.0000000020 %"];
        assert_eq!(shares.map(percent), texts);
        let bounds = ["0", "0.0015 %", "4.9 %", "31 %", "100 %"];
        assert_eq!(
            [0.0, 1.41e-5, 0.04801, 0.301, 1.0].map(percent_above),
            bounds
        );
    }
}
