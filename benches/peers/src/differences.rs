//! How far two pictures of one view agree.

use crate::picture::Picture;

/// Pixels that differ.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Differences {
    /// A hit here, a miss there.
    pub(crate) hits: u64,
    /// Both hit, but not the same primitive.
    pub(crate) primitives: u64,
}

impl Differences {
    pub(crate) fn between(a: &Picture, b: &Picture) -> Differences {
        let mut differences = Differences::default();
        for (&a, &b) in a.primitives.iter().zip(&b.primitives) {
            if (a == 0) != (b == 0) {
                differences.hits += 1;
            } else if a != b {
                differences.primitives += 1;
            }
        }
        differences
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_each_kind() {
        let picture = |primitives: [u32; 4]| Picture {
            primitives: primitives.to_vec(),
            ..Picture::new(4, 1)
        };
        let differences = Differences::between(&picture([0, 1, 2, 3]), &picture([1, 0, 2, 4]));
        assert_eq!(
            differences,
            Differences {
                hits: 2,
                primitives: 1
            }
        );
    }
}
