//! Arrays written out element by element.

/// An array of `$value` for the indices `$k` from 0 to before the count.
///
/// A loop does the same, and the compiler unrolls it. But some ten thousand such loops in one
/// kernel cost the optimizer 27 s per instruction set, and 1 to 4 s when written out.
macro_rules! unrolled {
    (@ $k:ident, $value:expr; $($index:literal)*) => {
        [$({
            const $k: usize = $index;
            $value
        }),*]
    };
    (1, $k:ident => $value:expr) => {
        unrolled!(@ $k, $value; 0)
    };
    (2, $k:ident => $value:expr) => {
        unrolled!(@ $k, $value; 0 1)
    };
    (4, $k:ident => $value:expr) => {
        unrolled!(@ $k, $value; 0 1 2 3)
    };
    (8, $k:ident => $value:expr) => {
        unrolled!(@ $k, $value; 0 1 2 3 4 5 6 7)
    };
    (16, $k:ident => $value:expr) => {
        unrolled!(@ $k, $value; 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15)
    };
}

pub(super) use unrolled;
