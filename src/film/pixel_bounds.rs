//! Rectangles of pixels.

/// A rectangle of film pixels: `x` to the right, `y` downwards, upper ends exclusive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct PixelBounds {
    /// The first column.
    pub x0: u32,
    /// The column after the last one.
    pub x1: u32,
    /// The first (topmost) row.
    pub y0: u32,
    /// The row after the last one.
    pub y1: u32,
}

impl PixelBounds {
    /// All pixels of a film of `width` by `height`.
    pub fn of_film(width: u32, height: u32) -> PixelBounds {
        PixelBounds { x0: 0, x1: width, y0: 0, y1: height }
    }

    /// Columns; none where the ends are crossed.
    pub fn width(&self) -> u32 {
        self.x1.saturating_sub(self.x0)
    }

    /// Rows; none where the ends are crossed.
    pub fn height(&self) -> u32 {
        self.y1.saturating_sub(self.y0)
    }

    /// Pixels.
    pub fn area(&self) -> u64 {
        u64::from(self.width()) * u64::from(self.height())
    }

    /// Whether there is no pixel inside.
    pub fn is_empty(&self) -> bool {
        self.area() == 0
    }

    /// Whether pixel (`x`, `y`) is inside.
    pub fn contains(&self, x: u32, y: u32) -> bool {
        (self.x0..self.x1).contains(&x) && (self.y0..self.y1).contains(&y)
    }

    /// Whether every pixel of `other` is inside.
    pub fn contains_bounds(&self, other: &PixelBounds) -> bool {
        other.is_empty() || (self.contains(other.x0, other.y0) && self.contains(other.x1 - 1, other.y1 - 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measures_beyond_32_bits() {
        assert_eq!(PixelBounds::of_film(u32::MAX, u32::MAX).area(), u64::from(u32::MAX).pow(2));
    }

    #[test]
    fn crossed_ends_hold_no_pixel() {
        let crossed = PixelBounds { x0: 3, x1: 2, y0: 0, y1: 9 };
        assert!(crossed.is_empty() && !crossed.contains(2, 0) && !crossed.contains(3, 0));
    }

    #[test]
    fn upper_ends_are_outside() {
        let bounds = PixelBounds { x0: 1, x1: 3, y0: 5, y1: 6 };
        assert!(bounds.contains(1, 5) && bounds.contains(2, 5));
        assert!(!bounds.contains(3, 5) && !bounds.contains(1, 6) && !bounds.contains(0, 5));
        assert!(PixelBounds::of_film(3, 6).contains_bounds(&bounds));
        assert!(!PixelBounds::of_film(2, 6).contains_bounds(&bounds));
    }
}
