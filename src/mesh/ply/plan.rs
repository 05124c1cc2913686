//! Plans what to do with each property, once for all elements of a kind.

use super::header::{Element, Property, Scalar, Shape};
use super::values::Run;

/// What to do with the next values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    Coordinate(usize, Scalar),
    Uv(usize, Scalar),
    Normal(usize, Scalar),
    Corners { count: Scalar, item: Scalar },
    Skip(Run),
    SkipList { count: Scalar, item: Scalar },
}

/// Does with each property what `wanted` says, or skips it, several at once if possible.
pub(super) fn plan(
    properties: &[Property],
    wanted: impl Fn(usize, Shape) -> Option<Step>,
) -> Vec<Step> {
    let mut plan = Vec::new();
    for (at, property) in properties.iter().enumerate() {
        let step = wanted(at, property.shape).unwrap_or(match property.shape {
            Shape::One(kind) => Step::Skip(Run::of(kind, 1)),
            Shape::List { count, item } => Step::SkipList { count, item },
        });
        match (plan.last_mut(), step) {
            (Some(Step::Skip(before)), Step::Skip(run)) => *before = before.plus(run),
            _ => plan.push(step),
        }
    }
    plan
}

/// The values of an element whose lists are all empty.
pub(super) fn least_run(element: &Element) -> Run {
    element
        .properties
        .iter()
        .fold(Run::default(), |run, property| {
            let kind = match property.shape {
                Shape::One(kind) => kind,
                Shape::List { count, .. } => count,
            };
            run.plus(Run::of(kind, 1))
        })
}

/// Faces whose only list is that of their corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Layout {
    /// Values before the list.
    pub(super) lead: Run,
    /// The type of the list's length.
    pub(super) count: Scalar,
    /// The type of the corners.
    pub(super) item: Scalar,
    /// Values after the list.
    pub(super) trail: Run,
}

impl Layout {
    /// The layout of faces with this plan, if they have no other lists.
    pub(super) fn of(plan: &[Step]) -> Option<Layout> {
        let none = Run::default();
        let (lead, list, trail) = match *plan {
            [list] => (none, list, none),
            [Step::Skip(lead), list] => (lead, list, none),
            [list, Step::Skip(trail)] => (none, list, trail),
            [Step::Skip(lead), list, Step::Skip(trail)] => (lead, list, trail),
            _ => return None,
        };
        match list {
            Step::Corners { count, item } => Some(Layout {
                lead,
                count,
                item,
                trail,
            }),
            _ => None,
        }
    }
}
