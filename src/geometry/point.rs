//! Points and vectors: different types, so that only meaningful sums compile.

use crate::exact::ExactVector;
use std::ops::{Add, Index, Mul, Neg, Sub};

/// A position, in the space that the variable's name says.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Point {
    /// First coordinate.
    pub x: f64,
    /// Second coordinate.
    pub y: f64,
    /// Third coordinate.
    pub z: f64,
}

/// A displacement or direction, in the space that the variable's name says; not normalized unless
/// stated.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Vector {
    /// First component.
    pub x: f64,
    /// Second component.
    pub y: f64,
    /// Third component.
    pub z: f64,
}

macro_rules! three_components {
    ($name:ident) => {
        impl $name {
            /// From its three components.
            pub const fn new(x: f64, y: f64, z: f64) -> $name {
                $name { x, y, z }
            }

            /// Its components in order.
            pub const fn to_array(self) -> [f64; 3] {
                [self.x, self.y, self.z]
            }

            /// Whether no component is infinite or NaN.
            pub fn is_finite(self) -> bool {
                self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
            }
        }

        impl From<$name> for ExactVector {
            /// # Panics
            /// If a component is not finite.
            fn from(v: $name) -> ExactVector {
                v.to_array().into()
            }
        }

        impl From<[f64; 3]> for $name {
            fn from([x, y, z]: [f64; 3]) -> $name {
                $name { x, y, z }
            }
        }

        impl Index<usize> for $name {
            type Output = f64;

            #[inline]
            fn index(&self, axis: usize) -> &f64 {
                match axis {
                    0 => &self.x,
                    1 => &self.y,
                    2 => &self.z,
                    _ => panic!("axis {axis} of three"),
                }
            }
        }
    };
}

three_components!(Point);
three_components!(Vector);

impl Vector {
    /// `a0*b0 + a1*b1 + a2*b2`, summed from the left.
    pub fn dot(self, other: Vector) -> f64 {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The cross product; exactly antisymmetric, because both products of a component are rounded
    /// alike.
    pub fn cross(self, other: Vector) -> Vector {
        Vector {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// The absolute value of every component.
    pub fn absolute(self) -> Vector {
        Vector {
            x: self.x.abs(),
            y: self.y.abs(),
            z: self.z.abs(),
        }
    }

    /// The cross product with absolute values of all products, added: a bound on its terms.
    pub fn absolute_cross(self, other: Vector) -> Vector {
        let (a, b) = (self.absolute(), other.absolute());
        Vector {
            x: a.y * b.z + a.z * b.y,
            y: a.z * b.x + a.x * b.z,
            z: a.x * b.y + a.y * b.x,
        }
    }

    /// The largest absolute value of a component.
    pub fn largest(self) -> f64 {
        let [x, y, z] = self.to_array().map(f64::abs);
        x.max(y).max(z)
    }

    /// The vector divided by its length `sqrt((x*x+y*y)+z*z)`, component by component (rule R2);
    /// NaN for the zero vector.
    pub fn normalized(self) -> Vector {
        let length = self.dot(self).sqrt();
        Vector {
            x: self.x / length,
            y: self.y / length,
            z: self.z / length,
        }
    }

    /// The axis of the component with the largest absolute value; the lowest of equal ones.
    pub fn largest_axis(self) -> usize {
        let [x, y, z] = self.to_array().map(f64::abs);
        if x >= y && x >= z {
            0
        } else if y >= z {
            1
        } else {
            2
        }
    }
}

impl Sub for Point {
    type Output = Vector;

    fn sub(self, other: Point) -> Vector {
        Vector {
            x: self.x - other.x,
            y: self.y - other.y,
            z: self.z - other.z,
        }
    }
}

impl Add<Vector> for Point {
    type Output = Point;

    fn add(self, offset: Vector) -> Point {
        Point {
            x: self.x + offset.x,
            y: self.y + offset.y,
            z: self.z + offset.z,
        }
    }
}

impl Mul<f64> for Vector {
    type Output = Vector;

    fn mul(self, factor: f64) -> Vector {
        Vector {
            x: self.x * factor,
            y: self.y * factor,
            z: self.z * factor,
        }
    }
}

impl Neg for Vector {
    type Output = Vector;

    fn neg(self) -> Vector {
        Vector {
            x: -self.x,
            y: -self.y,
            z: -self.z,
        }
    }
}
