//! From Bezier pieces to short segments.

use super::bezier::BezierPiece;
use crate::geometry::Point;
use crate::shape::{CurvePiece, CurvePoint};

/// The segments of a curve.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Diced {
    /// Directions and points, as [`crate::shape::Geometry::add_curves`] takes them.
    pub points: Vec<CurvePoint>,
    /// The segments of each Bezier piece, counted from 0.
    pub pieces: Vec<CurvePiece>,
}

/// Halves every piece as often as it [asks for](BezierPiece::halvings), and joins pieces that lead
/// into each other (rule R13).
pub fn dice(pieces: &[BezierPiece], is_round: bool) -> Diced {
    let mut diced = Diced::default();
    let mut first_segment = 0;
    for (k, piece) in pieces.iter().enumerate() {
        let [start, end] = piece.directions();
        let is_joined = k > 0 && pieces[k - 1].leads_into(piece);
        let halvings = piece.halvings();
        let count = 1 << halvings;
        // Where pieces are joined, the last point of one is the first of the next.
        let mut part = u32::from(is_joined);
        let mut put = |point: &Point, points: &mut Vec<CurvePoint>| {
            let half_width = 0.5 * piece.width_at(part, count).abs();
            points.push(CurvePoint::at(*point, half_width));
            part += 1;
        };
        if !is_joined {
            diced.points.push(CurvePoint::direction(start));
            put(&piece.points[0], &mut diced.points);
        }
        put_ends(&piece.points, halvings, &mut |point| {
            put(point, &mut diced.points)
        });
        let leads_on = pieces.get(k + 1).is_some_and(|next| piece.leads_into(next));
        if !leads_on {
            diced.points.push(CurvePoint::direction(end));
        }
        diced.pieces.push(CurvePiece {
            first_segment,
            count,
            is_round,
        });
        first_segment += count;
    }
    diced
}

/// Puts the end of each of the parts that halving makes.
fn put_ends(points: &[Point; 4], halvings: u32, put: &mut impl FnMut(&Point)) {
    if halvings == 0 {
        put(&points[3]);
        return;
    }
    for half in BezierPiece::halves(points) {
        put_ends(&half, halvings - 1, put);
    }
}
