//! How numbers are stored in an image file.

use std::hash::{Hash, Hasher};

/// The function from a stored number, from 0 to 1, to the number that it means (rule A2).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Encoding {
    /// The number itself.
    Linear,
    /// That of sRGB (IEC 61966-2-1).
    Srgb,
    /// A power.
    Gamma(f64),
}

impl Eq for Encoding {}

impl Hash for Encoding {
    fn hash<H: Hasher>(&self, state: &mut H) {
        match self {
            Encoding::Linear => 0u64.hash(state),
            Encoding::Srgb => 1u64.hash(state),
            Encoding::Gamma(exponent) => exponent.to_bits().hash(state),
        }
    }
}

impl Encoding {
    /// The encoding that pbrt-v4 calls `name`: `linear`, `sRGB` or `gamma` and a number above 0.
    pub(super) fn of_name(name: &str) -> Option<Encoding> {
        match name {
            "linear" => Some(Encoding::Linear),
            "sRGB" => Some(Encoding::Srgb),
            _ => {
                let exponent: f64 = name.strip_prefix("gamma ")?.trim().parse().ok()?;
                (exponent > 0.0 && exponent.is_finite()).then_some(Encoding::Gamma(exponent))
            }
        }
    }

    /// What `stored`, from 0 to 1, means. The powers are those of the crate `libm`.
    pub(super) fn decode(self, stored: f64) -> f64 {
        match self {
            Encoding::Linear => stored,
            Encoding::Srgb if stored <= 0.04045 => stored / 12.92,
            Encoding::Srgb => libm::pow((stored + 0.055) / 1.055, 2.4),
            Encoding::Gamma(exponent) => libm::pow(stored, exponent),
        }
    }

    /// What each byte means.
    pub(super) fn of_bytes(self) -> [f64; 256] {
        std::array::from_fn(|byte| self.decode(byte as f64 / 255.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_pbrt() {
        assert_eq!(Encoding::of_name("sRGB"), Some(Encoding::Srgb));
        assert_eq!(Encoding::of_name("linear"), Some(Encoding::Linear));
        assert_eq!(Encoding::of_name("gamma 2.2"), Some(Encoding::Gamma(2.2)));
        for wrong in [
            "",
            "srgb",
            "gamma",
            "gamma x",
            "gamma 0",
            "gamma -1",
            "gamma inf",
        ] {
            assert_eq!(Encoding::of_name(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn ends_stay_and_values_between_grow() {
        for encoding in [Encoding::Linear, Encoding::Srgb, Encoding::Gamma(2.2)] {
            let table = encoding.of_bytes();
            assert_eq!((table[0], table[255]), (0.0, 1.0), "{encoding:?}");
            assert!(table.is_sorted(), "{encoding:?}");
        }
        let half = Encoding::Srgb.decode(0.5);
        assert!((half - 0.214_041_140_482_232_55).abs() < 1e-15, "{half}");
    }
}
