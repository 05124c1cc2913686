//! The part of a rectangle that other rectangles do not cover.

use crate::film::PixelBounds;

/// The pixels of a window that no part covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Holes {
    pub(super) count: u64,
    /// The leftmost of the topmost holes.
    pub(super) first: Option<[u32; 2]>,
}

impl Holes {
    /// The pixels of `window` that no part covers. Visits bands of rows with the same parts, not
    /// single pixels.
    pub(super) fn of(window: &PixelBounds, parts: &[PixelBounds]) -> Holes {
        let mut holes = Holes {
            count: 0,
            first: None,
        };
        each(window, parts, |hole| {
            holes.count += hole.area();
            holes.first = holes.first.or(Some([hole.x0, hole.y0]));
        });
        holes
    }
}

/// Visits the rectangles of `window` that `parts` leave uncovered, from the top.
pub(super) fn each(
    window: &PixelBounds,
    parts: &[PixelBounds],
    mut visit: impl FnMut(&PixelBounds),
) {
    let mut parts: Vec<PixelBounds> = parts.iter().map(|part| part.intersection(window)).collect();
    parts.retain(|part| !part.is_empty());
    parts.sort_unstable_by_key(|part| part.x0);
    let mut cuts: Vec<u32> = parts.iter().flat_map(|part| [part.y0, part.y1]).collect();
    cuts.extend([window.y0, window.y1]);
    cuts.sort_unstable();
    cuts.dedup();
    for band in cuts.windows(2) {
        let in_band = parts
            .iter()
            .filter(|part| part.y0 <= band[0] && band[1] <= part.y1);
        let mut covered = window.x0;
        for part in in_band
            .map(|part| [part.x0, part.x1])
            .chain([[window.x1, window.x1]])
        {
            if part[0] > covered {
                visit(&PixelBounds {
                    x0: covered,
                    x1: part[0],
                    y0: band[0],
                    y1: band[1],
                });
            }
            covered = covered.max(part[1]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn bounds(x0: u32, width: u32, y0: u32, height: u32) -> PixelBounds {
        PixelBounds {
            x0,
            x1: x0 + width,
            y0,
            y1: y0 + height,
        }
    }

    #[test]
    fn a_window_without_parts_is_one_hole() {
        assert_eq!(
            Holes::of(&bounds(3, 4, 5, 6), &[]),
            Holes {
                count: 24,
                first: Some([3, 5])
            }
        );
        assert_eq!(
            Holes::of(&bounds(3, 4, 5, 6), &[bounds(0, 9, 0, 20)]),
            Holes {
                count: 0,
                first: None
            }
        );
    }

    proptest! {
        #[test]
        fn holes_are_the_pixels_in_no_part(
            parts in prop::collection::vec((0u32..12, 0u32..8, 0u32..12, 0u32..8), 0..9),
        ) {
            let window = bounds(2, 11, 1, 12);
            let parts = parts.into_iter().map(|(x, w, y, h)| bounds(x, w, y, h));
            let parts: Vec<PixelBounds> = parts.collect();
            let row = |y| (window.x0..window.x1).map(move |x| [x, y]);
            let is_hole = |[x, y]: &[u32; 2]| parts.iter().all(|part| !part.contains(*x, *y));
            let pixels = (window.y0..window.y1).flat_map(row);
            let holes: Vec<[u32; 2]> = pixels.filter(is_hole).collect();
            let expected = Holes { count: holes.len() as u64, first: holes.first().copied() };
            prop_assert_eq!(Holes::of(&window, &parts), expected);
        }
    }
}
