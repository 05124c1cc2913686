//! Axis-aligned boxes in `f64`.

use super::Point;

/// A closed box; empty if a lower bound is above its upper one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// The lowest coordinates.
    pub low: Point,
    /// The highest coordinates.
    pub high: Point,
}

impl Bounds {
    /// The empty box.
    pub const EMPTY: Bounds = Bounds {
        low: Point::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        high: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// The smallest box around `points`.
    pub fn of(points: impl IntoIterator<Item = Point>) -> Bounds {
        points.into_iter().fold(Bounds::EMPTY, Bounds::including)
    }

    /// The smallest box around this one and `point`.
    pub fn including(self, point: Point) -> Bounds {
        self.union(Bounds {
            low: point,
            high: point,
        })
    }

    /// The smallest box around both.
    pub fn union(self, other: Bounds) -> Bounds {
        let lower = |a: Point, b: Point| Point::new(a.x.min(b.x), a.y.min(b.y), a.z.min(b.z));
        let upper = |a: Point, b: Point| Point::new(a.x.max(b.x), a.y.max(b.y), a.z.max(b.z));
        Bounds {
            low: lower(self.low, other.low),
            high: upper(self.high, other.high),
        }
    }

    /// The eight corners.
    pub fn corners(&self) -> [Point; 8] {
        let end = |corner: usize, axis: usize| {
            if corner >> axis & 1 == 0 {
                self.low[axis]
            } else {
                self.high[axis]
            }
        };
        std::array::from_fn(|corner| Point::new(end(corner, 0), end(corner, 1), end(corner, 2)))
    }

    /// Whether no point is inside.
    pub fn is_empty(&self) -> bool {
        (0..3).any(|axis| self.low[axis] > self.high[axis])
    }

    /// The middle, without overflow.
    pub fn centre(&self) -> Point {
        let middle = |axis| 0.5 * self.low[axis] + 0.5 * self.high[axis];
        Point::new(middle(0), middle(1), middle(2))
    }
}
