//! One direction of a NURBS surface: its knots, and the curves along it.

/// A point times its weight, and the weight.
pub type Homogeneous = [f64; 4];

/// The largest order: the time of a point grows with its cube.
pub const MOST_ORDER: usize = 32;

/// A direction of the surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction {
    count: usize,
    order: usize,
    knots: Vec<f64>,
    range: [f64; 2],
}

/// What is wrong with the numbers of a direction, in words for a message.
#[derive(Debug, Clone, PartialEq)]
pub enum Mistake {
    /// The knots.
    Knots(String),
    /// A knot, by its place.
    Knot(usize, String),
    /// An end of the range of the parameter, by its place.
    Range(usize, String),
}

impl Direction {
    /// A direction with `count` control points and curves of degree `order - 1`. The surface is cut
    /// to `range`, where `None` is the end of the knots that matter.
    ///
    /// # Errors
    /// The knots are not `count + order` finite numbers that never decrease, there are fewer
    /// control points than the order, or the range is beyond the knots.
    ///
    /// # Panics
    /// The order is not from 2 to [`MOST_ORDER`].
    pub fn new(
        count: usize,
        order: usize,
        knots: &[f64],
        range: [Option<f64>; 2],
    ) -> Result<Direction, Mistake> {
        assert!((2..=MOST_ORDER).contains(&order));
        if count < order {
            let message = format!("{count} control points for the order {order}");
            return Err(Mistake::Knots(message));
        }
        if knots.len() != count + order {
            let (found, expected) = (knots.len(), count + order);
            let message = format!(
                "{found} knots, expected {expected}: {count} control points and the order {order}"
            );
            return Err(Mistake::Knots(message));
        }
        let decreases = |k: &usize| *k > 0 && knots[*k] < knots[*k - 1];
        if let Some(k) = (0..knots.len()).find(|k| !knots[*k].is_finite() || decreases(k)) {
            let message = format!("knot {}, number {} of them", knots[k], k + 1);
            return Err(Mistake::Knot(k, message));
        }
        let ends = [knots[order - 1], knots[count]];
        if ends[0] == ends[1] {
            let message = format!("all knots that matter are {}", ends[0]);
            return Err(Mistake::Knots(message));
        }
        let range = [0, 1].map(|k| range[k].unwrap_or(ends[k]));
        let is_within = |t: &f64| (ends[0]..=ends[1]).contains(t);
        if let Some(k) = (0..2).find(|k| !is_within(&range[*k])) {
            let ([low, high], t) = (ends, range[k]);
            let message = format!("{t} is beyond the knots, which go from {low} to {high}");
            return Err(Mistake::Range(k, message));
        }
        Ok(Direction {
            count,
            order,
            knots: knots.to_vec(),
            range,
        })
    }

    /// The number of control points.
    pub fn count(&self) -> usize {
        self.count
    }

    /// `count` values of the parameter, from one end of the range to the other.
    pub(super) fn steps(&self, count: usize) -> Vec<f64> {
        let [a, b] = self.range;
        let step = |k: usize| {
            let share = k as f64 / (count - 1) as f64;
            ((1.0 - share) * a + share * b).clamp(a.min(b), a.max(b))
        };
        (0..count).map(step).collect()
    }

    /// The span of knots around `t`: the first one that has a width and does not end before it, by
    /// the place of its first knot.
    pub(super) fn span_of(&self, t: f64) -> usize {
        let spans = self.order - 1..self.count;
        let is_around = |k: &usize| self.knots[*k] < self.knots[*k + 1] && t <= self.knots[*k + 1];
        spans.clone().find(is_around).unwrap_or(self.count - 1)
    }

    /// The curve at `t` in this span, and its derivative (C. de Boor, "On calculating with
    /// B-splines", 1972). `control` gives its control points.
    pub(super) fn evaluate(
        &self,
        span: usize,
        t: f64,
        control: impl Fn(usize) -> Homogeneous,
    ) -> (Homogeneous, Homogeneous) {
        let order = self.order;
        let first = span + 1 - order;
        let mut points = [[0.0; 4]; MOST_ORDER];
        for (k, point) in points.iter_mut().take(order).enumerate() {
            *point = control(first + k);
        }
        let knot = |k: usize| self.knots[k];
        for round in 0..order - 2 {
            for k in 0..order - 1 - round {
                let (low, high) = (knot(first + 1 + k + round), knot(span + 1 + k));
                let weight = (high - t) / (high - low);
                points[k] = mix(points[k], points[k + 1], weight);
            }
        }
        let (low, high) = (knot(span), knot(span + 1));
        let weight = (high - t) / (high - low);
        let factor = (order - 1) as f64 / (high - low);
        let change = [0, 1, 2, 3].map(|k: usize| (points[1][k] - points[0][k]) * factor);
        (mix(points[0], points[1], weight), change)
    }
}

fn mix(a: Homogeneous, b: Homogeneous, weight: f64) -> Homogeneous {
    [0, 1, 2, 3].map(|k: usize| a[k] * weight + b[k] * (1.0 - weight))
}
