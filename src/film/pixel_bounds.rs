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
    /// A limit on the sides of a film, in pixels.
    pub const MAX_SIDE: u32 = 1 << 24;

    /// All pixels of a film of `width` by `height`.
    pub fn of_film(width: u32, height: u32) -> PixelBounds {
        PixelBounds {
            x0: 0,
            x1: width,
            y0: 0,
            y1: height,
        }
    }

    /// The pixels of a crop window in fractions of a film: x0, x1, y0, y1. Each end is `ceil` of
    /// its product with the resolution (pbrt-v3), so that adjacent windows share no pixel. Ends are
    /// put in order and clamped to the film.
    pub fn of_crop_window([x0, x1, y0, y1]: [f64; 4], [width, height]: [u32; 2]) -> PixelBounds {
        let pixel =
            |fraction: f64, count: u32| (fraction.clamp(0.0, 1.0) * f64::from(count)).ceil() as u32;
        PixelBounds {
            x0: pixel(x0.min(x1), width),
            x1: pixel(x0.max(x1), width),
            y0: pixel(y0.min(y1), height),
            y1: pixel(y0.max(y1), height),
        }
    }

    /// The intersection.
    pub fn intersection(&self, other: &PixelBounds) -> PixelBounds {
        PixelBounds {
            x0: self.x0.max(other.x0),
            x1: self.x1.min(other.x1),
            y0: self.y0.max(other.y0),
            y1: self.y1.min(other.y1),
        }
    }

    /// The width; 0 if the ends are in the wrong order.
    pub fn width(&self) -> u32 {
        self.x1.saturating_sub(self.x0)
    }

    /// The height; 0 if the ends are in the wrong order.
    pub fn height(&self) -> u32 {
        self.y1.saturating_sub(self.y0)
    }

    /// The number of pixels.
    pub fn area(&self) -> u64 {
        u64::from(self.width()) * u64::from(self.height())
    }

    /// Returns true if there is no pixel inside.
    pub fn is_empty(&self) -> bool {
        self.area() == 0
    }

    /// Returns true if pixel (`x`, `y`) is inside.
    pub fn contains(&self, x: u32, y: u32) -> bool {
        (self.x0..self.x1).contains(&x) && (self.y0..self.y1).contains(&y)
    }

    /// Returns true if every pixel of `other` is inside.
    pub fn contains_bounds(&self, other: &PixelBounds) -> bool {
        other.is_empty()
            || (self.contains(other.x0, other.y0) && self.contains(other.x1 - 1, other.y1 - 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_exceed_32_bits() {
        assert_eq!(
            PixelBounds::of_film(u32::MAX, u32::MAX).area(),
            u64::from(u32::MAX).pow(2)
        );
    }

    #[test]
    fn adjacent_crop_windows_share_no_pixel() {
        let left = PixelBounds::of_crop_window([0.0, 0.3, 0.0, 1.0], [7, 5]);
        let right = PixelBounds::of_crop_window([0.3, 1.0, 0.0, 1.0], [7, 5]);
        assert_eq!((left.x0, left.x1, right.x0, right.x1), (0, 3, 3, 7));
        assert_eq!(
            PixelBounds::of_crop_window([1.0, -4.0, 2.0, 0.0], [7, 5]),
            PixelBounds::of_film(7, 5)
        );
        assert!(PixelBounds::of_crop_window([0.5, 0.5, 0.0, 1.0], [7, 5]).is_empty());
    }

    #[test]
    fn intersections_may_be_empty() {
        let film = PixelBounds::of_film(4, 4);
        let bounds = PixelBounds {
            x0: 2,
            x1: 9,
            y0: 1,
            y1: 3,
        };
        assert_eq!(
            film.intersection(&bounds),
            PixelBounds {
                x0: 2,
                x1: 4,
                y0: 1,
                y1: 3
            }
        );
        assert!(
            film.intersection(&PixelBounds {
                x0: 5,
                x1: 9,
                y0: 0,
                y1: 4
            })
            .is_empty()
        );
    }

    #[test]
    fn bounds_with_crossed_ends_are_empty() {
        let crossed = PixelBounds {
            x0: 3,
            x1: 2,
            y0: 0,
            y1: 9,
        };
        assert!(crossed.is_empty() && !crossed.contains(2, 0) && !crossed.contains(3, 0));
    }

    #[test]
    fn upper_ends_are_outside() {
        let bounds = PixelBounds {
            x0: 1,
            x1: 3,
            y0: 5,
            y1: 6,
        };
        assert!(bounds.contains(1, 5) && bounds.contains(2, 5));
        assert!(!bounds.contains(3, 5) && !bounds.contains(1, 6) && !bounds.contains(0, 5));
        assert!(PixelBounds::of_film(3, 6).contains_bounds(&bounds));
        assert!(!PixelBounds::of_film(2, 6).contains_bounds(&bounds));
    }
}
