//! Normals, and pbrt-v3's parameters, of surfaces of revolution.

use super::Revolved;
use crate::geometry::Vector;
use crate::per_axis::per_axis;

impl Revolved {
    /// A vector along pbrt-v3's dp/du x dp/dv at a point over the radius: away from the axis,
    /// except for a hyperboloid whose first point is the upper one.
    pub(in crate::shape::quadric) fn normal(&self, point: Vector, radius: f64) -> Vector {
        let Vector { x, y, z } = point;
        match self {
            Revolved::Cone(cut) => {
                let height = cut.z_max / radius;
                Vector::new(x, y, (height - z) / (height * height))
            }
            Revolved::Paraboloid(cut) => Vector::new(x, y, -0.5 / (cut.z_max / radius)),
            Revolved::Hyperboloid(hyperboloid) => {
                // The line turned to the point: pbrt's normal is across it, and across the circle.
                let (p1, p2) = (hyperboloid.p1, hyperboloid.p2);
                let way = per_axis(|k| p2[k] - p1[k]);
                let v = (z - p1[2]) / way[2];
                let line = [0, 1].map(|k| (1.0 - v) * p1[k] + v * p2[k]);
                let [along, across] = [line[0] * x + line[1] * y, line[0] * y - line[1] * x];
                let length = (along * along + across * across).sqrt();
                let (cosine, sine) = match length {
                    0.0 => (1.0, 0.0),
                    length => (along / length, across / length),
                };
                let turned = [
                    way[0] * cosine - way[1] * sine,
                    way[0] * sine + way[1] * cosine,
                ];
                Vector::new(x * way[2], y * way[2], -(x * turned[0] + y * turned[1]))
            }
        }
    }

    /// The z where v is 0, and where it is 1.
    pub(in crate::shape::quadric) fn way(&self) -> [f64; 2] {
        match self {
            Revolved::Hyperboloid(hyperboloid) => [hyperboloid.p1[2], hyperboloid.p2[2]],
            _ => self.ends(),
        }
    }

    /// A point as seen from where the angles start: turned about the axis, and scaled.
    pub(in crate::shape::quadric) fn relative_to_start(&self, point: Vector) -> Vector {
        match self {
            Revolved::Hyperboloid(hyperboloid) => {
                let [x, y] = hyperboloid.relative_to_line(point.to_array());
                Vector::new(x, y, point.z)
            }
            _ => point,
        }
    }
}
