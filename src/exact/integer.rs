//! Integers of any size.

use num_bigint::{BigInt, BigUint, Sign};
use std::borrow::Cow;
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// An integer of any size. Up to 127 bits, as most have, it allocates no memory.
#[derive(Debug, Clone)]
pub(super) enum Integer {
    /// A small value.
    Small(i128),
    /// Any other value, or a small one.
    Large(BigInt),
}

impl Integer {
    pub(super) fn sign(&self) -> Ordering {
        match self {
            Integer::Small(value) => value.cmp(&0),
            Integer::Large(value) => match value.sign() {
                Sign::Minus => Ordering::Less,
                Sign::NoSign => Ordering::Equal,
                Sign::Plus => Ordering::Greater,
            },
        }
    }

    /// The absolute value.
    pub(super) fn magnitude(&self) -> BigUint {
        match self {
            Integer::Small(value) => value.unsigned_abs().into(),
            Integer::Large(value) => value.magnitude().clone(),
        }
    }

    /// `self * 2^bits`.
    pub(super) fn shifted(&self, bits: u64) -> Integer {
        match self {
            Integer::Small(0) => Integer::Small(0),
            Integer::Small(value) if bits < u64::from(spare_bits(*value)) => {
                Integer::Small(value << bits)
            }
            _ => Integer::Large(&*self.large() << bits),
        }
    }

    fn large(&self) -> Cow<'_, BigInt> {
        match self {
            Integer::Small(value) => Cow::Owned(BigInt::from(*value)),
            Integer::Large(value) => Cow::Borrowed(value),
        }
    }
}

/// The number of bits by which a number can be shifted without overflow.
fn spare_bits(value: i128) -> u32 {
    value.unsigned_abs().leading_zeros()
}

impl From<BigInt> for Integer {
    fn from(value: BigInt) -> Integer {
        Integer::Large(value)
    }
}

impl Add for &Integer {
    type Output = Integer;

    fn add(self, other: &Integer) -> Integer {
        if let (Integer::Small(a), Integer::Small(b)) = (self, other)
            && let Some(sum) = a.checked_add(*b)
        {
            return Integer::Small(sum);
        }
        Integer::Large(&*self.large() + &*other.large())
    }
}

impl Sub for &Integer {
    type Output = Integer;

    fn sub(self, other: &Integer) -> Integer {
        if let (Integer::Small(a), Integer::Small(b)) = (self, other)
            && let Some(difference) = a.checked_sub(*b)
        {
            return Integer::Small(difference);
        }
        Integer::Large(&*self.large() - &*other.large())
    }
}

impl Neg for &Integer {
    type Output = Integer;

    fn neg(self) -> Integer {
        match self {
            Integer::Small(value) if *value != i128::MIN => Integer::Small(-value),
            _ => Integer::Large(-&*self.large()),
        }
    }
}

impl Mul for &Integer {
    type Output = Integer;

    fn mul(self, other: &Integer) -> Integer {
        if let (Integer::Small(a), Integer::Small(b)) = (self, other)
            && spare_bits(*a) + spare_bits(*b) > 128
        {
            return Integer::Small(a * b);
        }
        Integer::Large(&*self.large() * &*other.large())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn integer() -> impl Strategy<Value = (Integer, BigInt)> {
        (any::<i128>(), 0u32..128, any::<bool>()).prop_map(|(value, bits, is_large)| {
            let value = value >> bits;
            let large = BigInt::from(value);
            (
                if is_large {
                    Integer::Large(large.clone())
                } else {
                    Integer::Small(value)
                },
                large,
            )
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(5000))]

        #[test]
        fn small_and_large_ones_are_alike((a, x) in integer(), (b, y) in integer(), bits in 0u64..200) {
            prop_assert_eq!((&a + &b).large().into_owned(), &x + &y);
            prop_assert_eq!((&a - &b).large().into_owned(), &x - &y);
            prop_assert_eq!((&a * &b).large().into_owned(), &x * &y);
            prop_assert_eq!((-&a).large().into_owned(), -&x);
            prop_assert_eq!(a.shifted(bits).large().into_owned(), &x << bits);
            prop_assert_eq!(&a.magnitude(), x.magnitude());
            prop_assert_eq!(a.sign(), x.cmp(&BigInt::ZERO));
        }
    }

    #[test]
    fn the_ends_of_128_bits_are_passed() {
        for value in [i128::MIN, i128::MIN + 1, -1, 0, 1, i128::MAX] {
            let (small, large) = (Integer::Small(value), BigInt::from(value));
            assert_eq!((-&small).large().into_owned(), -&large);
            assert_eq!((&small + &small).large().into_owned(), &large + &large);
            assert_eq!((&small * &small).large().into_owned(), &large * &large);
            assert_eq!(small.shifted(1).large().into_owned(), &large << 1u32);
            assert_eq!(&small.magnitude(), large.magnitude());
        }
    }
}
