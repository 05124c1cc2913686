//! Arrays written out element by element.

/// An array of `$value` for the indices `$k` from 0 to before the count.
///
/// A loop does the same, and the compiler unrolls it. But some ten thousand such loops in one
/// kernel cost the optimizer 27 s per instruction set, and 1 to 4 s when written out.
macro_rules! unrolled {
    (@ $index:literal, $k:ident, $value:expr) => {{
        const $k: usize = $index;
        $value
    }};
    (1, $k:ident => $value:expr) => {
        [unrolled!(@ 0, $k, $value)]
    };
    (2, $k:ident => $value:expr) => {
        [unrolled!(@ 0, $k, $value), unrolled!(@ 1, $k, $value)]
    };
    (4, $k:ident => $value:expr) => {
        [
            unrolled!(@ 0, $k, $value),
            unrolled!(@ 1, $k, $value),
            unrolled!(@ 2, $k, $value),
            unrolled!(@ 3, $k, $value),
        ]
    };
    (8, $k:ident => $value:expr) => {
        [
            unrolled!(@ 0, $k, $value),
            unrolled!(@ 1, $k, $value),
            unrolled!(@ 2, $k, $value),
            unrolled!(@ 3, $k, $value),
            unrolled!(@ 4, $k, $value),
            unrolled!(@ 5, $k, $value),
            unrolled!(@ 6, $k, $value),
            unrolled!(@ 7, $k, $value),
        ]
    };
    (16, $k:ident => $value:expr) => {
        [
            unrolled!(@ 0, $k, $value),
            unrolled!(@ 1, $k, $value),
            unrolled!(@ 2, $k, $value),
            unrolled!(@ 3, $k, $value),
            unrolled!(@ 4, $k, $value),
            unrolled!(@ 5, $k, $value),
            unrolled!(@ 6, $k, $value),
            unrolled!(@ 7, $k, $value),
            unrolled!(@ 8, $k, $value),
            unrolled!(@ 9, $k, $value),
            unrolled!(@ 10, $k, $value),
            unrolled!(@ 11, $k, $value),
            unrolled!(@ 12, $k, $value),
            unrolled!(@ 13, $k, $value),
            unrolled!(@ 14, $k, $value),
            unrolled!(@ 15, $k, $value),
        ]
    };
}

pub(super) use unrolled;
