//! One split of a list of primitives, by each method.

use super::SplitMethod;
use super::box32::Box32;
use super::build_primitive::{BuildPrimitive, PARALLEL, centre_bounds};
use rayon::prelude::*;

/// What visiting a node costs, in units of testing a primitive.
pub(super) const NODE_COST: f32 = 1.0;

/// Bins an axis of the binned surface area heuristic, at most.
const BINS: usize = 16;

/// Bins for a list of `count` primitives: short lists, most of all, are not worth many.
fn bins_for(count: usize) -> usize {
    (count / 2).clamp(4, BINS)
}

/// Splits lists, each into a left and a right part that are not empty.
#[derive(Debug, Clone, Copy)]
pub(super) struct Splitter {
    pub(super) method: SplitMethod,
    /// Primitives in a leaf at most.
    pub(super) max_leaf: usize,
}

impl Splitter {
    /// Reorders `primitives` (whose box is `bounds`) so that the first ones, as many as are returned, form the left
    /// part; `None` where they should form a leaf.
    pub(super) fn split(&self, primitives: &mut [BuildPrimitive], bounds: &Box32) -> Option<usize> {
        let small = primitives.len() <= self.max_leaf;
        if primitives.len() < 2 || self.method == SplitMethod::None {
            return None;
        }
        match self.method {
            SplitMethod::Sah => self.split_by_sah(primitives, bounds, small),
            _ if small => None,
            SplitMethod::Middle => Some(split_in_the_middle(primitives)),
            _ => Some(split_evenly(primitives)),
        }
    }

    fn split_by_sah(&self, primitives: &mut [BuildPrimitive], bounds: &Box32, small: bool) -> Option<usize> {
        let Some(plane) = best_plane(primitives) else {
            return if small { None } else { Some(split_evenly(primitives)) };
        };
        let leaf_cost = primitives.len() as f32 * bounds.half_area();
        if small && leaf_cost <= NODE_COST * bounds.half_area() + plane.cost {
            return None;
        }
        let count = partition(primitives, |primitive| plane.is_left(primitive));
        Some(if count == 0 || count == primitives.len() { split_evenly(primitives) } else { count })
    }
}

/// Halves a list at the median of its centres along the axis on which they spread most; where all are in one place
/// any half will do.
pub(super) fn split_evenly(primitives: &mut [BuildPrimitive]) -> usize {
    let middle = primitives.len() / 2;
    let extent = centre_bounds(primitives).extent();
    let axis = widest(extent);
    if extent[axis] > 0.0 {
        // Ties are broken by the primitive: the order does not depend on how the list came about.
        primitives.select_nth_unstable_by(middle, |a, b| {
            let (a_centre, b_centre) = (a.doubled_centre()[axis], b.doubled_centre()[axis]);
            a_centre.total_cmp(&b_centre).then(a.primitive.cmp(&b.primitive))
        });
    }
    middle
}

fn split_in_the_middle(primitives: &mut [BuildPrimitive]) -> usize {
    let bounds = centre_bounds(primitives);
    let axis = widest(bounds.extent());
    let middle = 0.5 * (bounds.low[axis] + bounds.high[axis]);
    let count = partition(primitives, |primitive| primitive.doubled_centre()[axis] < middle);
    if count == 0 || count == primitives.len() { split_evenly(primitives) } else { count }
}

/// The axis of the largest extent, the lowest of equal ones.
fn widest(extent: [f32; 3]) -> usize {
    let mut axis = 0;
    for k in 1..3 {
        if extent[k] > extent[axis] {
            axis = k;
        }
    }
    axis
}

/// Moves those for which `is_left` holds to the front and returns how many they are.
fn partition(primitives: &mut [BuildPrimitive], is_left: impl Fn(&BuildPrimitive) -> bool) -> usize {
    let mut left = 0;
    let mut right = primitives.len();
    loop {
        while left < right && is_left(&primitives[left]) {
            left += 1;
        }
        while left < right && !is_left(&primitives[right - 1]) {
            right -= 1;
        }
        if left == right {
            return left;
        }
        primitives.swap(left, right - 1);
    }
}

/// A plane between two bins.
struct Plane {
    bins: Bins,
    axis: usize,
    /// Bins to the left of it.
    left_bins: usize,
    /// Half areas of both sides times their counts.
    cost: f32,
}

impl Plane {
    fn is_left(&self, primitive: &BuildPrimitive) -> bool {
        self.bins.index(primitive.doubled_centre()[self.axis], self.axis) < self.left_bins
    }
}

/// Maps doubled centres to bins, on each axis.
#[derive(Clone, Copy)]
struct Bins {
    low: [f32; 3],
    /// Bins per unit; 0 on an axis without extent.
    per_unit: [f32; 3],
    count: usize,
}

impl Bins {
    fn new(centres: &Box32, count: usize) -> Bins {
        let per_unit = centres.extent().map(|extent| if extent > 0.0 { count as f32 / extent } else { 0.0 });
        Bins { low: centres.low, per_unit, count }
    }

    #[inline]
    fn index(&self, centre: f32, axis: usize) -> usize {
        // A NaN, from infinite boxes, becomes 0.
        (((centre - self.low[axis]) * self.per_unit[axis]) as u32 as usize).min(self.count - 1)
    }
}

#[derive(Clone, Copy)]
struct Bin {
    bounds: Box32,
    count: u32,
}

const EMPTY_BINS: [[Bin; BINS]; 3] = [[Bin { bounds: Box32::EMPTY, count: 0 }; BINS]; 3];

fn fill(bins: &Bins, primitives: &[BuildPrimitive]) -> [[Bin; BINS]; 3] {
    let mut filled = EMPTY_BINS;
    for primitive in primitives {
        let centre = primitive.doubled_centre();
        for axis in 0..3 {
            let bin = &mut filled[axis][bins.index(centre[axis], axis)];
            bin.bounds = bin.bounds.union(&primitive.bounds);
            bin.count += 1;
        }
    }
    filled
}

fn fill_in_parallel(bins: &Bins, primitives: &[BuildPrimitive]) -> [[Bin; BINS]; 3] {
    if primitives.len() < PARALLEL {
        return fill(bins, primitives);
    }
    let add = |mut a: [[Bin; BINS]; 3], b: [[Bin; BINS]; 3]| {
        for (a, b) in a.iter_mut().flatten().zip(b.iter().flatten()) {
            a.bounds = a.bounds.union(&b.bounds);
            a.count += b.count;
        }
        a
    };
    primitives.par_chunks(PARALLEL / 4).map(|chunk| fill(bins, chunk)).reduce(|| EMPTY_BINS, add)
}

/// The plane of the least cost over all axes; `None` where all centres are in one place.
fn best_plane(primitives: &[BuildPrimitive]) -> Option<Plane> {
    let centres = centre_bounds(primitives);
    let bins = Bins::new(&centres, bins_for(primitives.len()));
    let filled = fill_in_parallel(&bins, primitives);
    let mut best: Option<Plane> = None;
    for axis in (0..3).filter(|axis| bins.per_unit[*axis] > 0.0) {
        let right_costs = costs_from_the_right(&filled[axis][..bins.count]);
        let mut left = Bin { bounds: Box32::EMPTY, count: 0 };
        for left_bins in 1..bins.count {
            let bin = &filled[axis][left_bins - 1];
            left = Bin { bounds: left.bounds.union(&bin.bounds), count: left.count + bin.count };
            if left.count == 0 || left.count as usize == primitives.len() {
                continue;
            }
            let cost = left.count as f32 * left.bounds.half_area() + right_costs[left_bins];
            if best.as_ref().is_none_or(|best| cost < best.cost) {
                best = Some(Plane { bins, axis, left_bins, cost });
            }
        }
    }
    best
}

/// For each bin, half area times count of it and all to its right.
fn costs_from_the_right(bins: &[Bin]) -> [f32; BINS] {
    let mut costs = [0.0; BINS];
    let mut right = Bin { bounds: Box32::EMPTY, count: 0 };
    for k in (1..bins.len()).rev() {
        right = Bin { bounds: right.bounds.union(&bins[k].bounds), count: right.count + bins[k].count };
        costs[k] = if right.count > 0 { right.count as f32 * right.bounds.half_area() } else { 0.0 };
    }
    costs
}
