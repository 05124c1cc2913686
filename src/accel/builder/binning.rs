//! Finds the split plane of least cost by the binned surface area heuristic (Wald, 2007).

use super::build_primitive::BuildPrimitive;
use super::centre_grid::CentreGrid;
use super::f32x4::LaneBox;
use super::full_leaves::LeafSize;

/// The largest number of bins along an axis.
const BINS: usize = 16;

/// The number of bins for a list of `count` primitives. Short lists, the most frequent, do not
/// deserve many.
fn bins_for(count: usize) -> usize {
    (count / 4).clamp(4, BINS)
}

/// Longer lists are split by the plane that is best for a sample.
const LONG: usize = 2 * SAMPLE;
const SAMPLE: usize = 1 << 9;

/// One primitive from each of [`SAMPLE`] equal parts of the list. Its place varies from part to
/// part, because lists have patterns, such as the rows of a grid.
fn sample(primitives: &[BuildPrimitive]) -> Vec<BuildPrimitive> {
    let step = primitives.len() / SAMPLE;
    // The fractions of multiples of the golden ratio are spread evenly.
    let fraction = |part: usize| u64::from((part as u32).wrapping_mul(0x9e37_79b9));
    let place = |part: usize| part * step + ((fraction(part) * step as u64) >> 32) as usize;
    (0..SAMPLE).map(|part| primitives[place(part)]).collect()
}

/// A plane between two bins.
#[derive(Debug, Clone, Copy)]
pub(super) struct SplitPlane {
    pub(super) axis: usize,
    /// Primitives with a smaller doubled centre go left.
    pub(super) at: f32,
}

/// The contents of one or several bins.
#[derive(Clone, Copy)]
struct Bin {
    bounds: LaneBox,
    count: u32,
}

impl Bin {
    const EMPTY: Bin = Bin {
        bounds: LaneBox::EMPTY,
        count: 0,
    };

    #[inline(always)]
    fn with(self, other: Bin) -> Bin {
        Bin {
            bounds: self.bounds.union(other.bounds),
            count: self.count + other.count,
        }
    }

    /// The expected number of leaves that a ray meets in the bin, times an area that all bins
    /// share.
    fn cost(self, leaf_size: LeafSize) -> f32 {
        if self.count == 0 {
            return 0.0;
        }
        leaf_size.approximate_leaves(self.count) * self.bounds.half_area()
    }
}

/// The contents of each bin of each axis.
struct Bins {
    bounds: [[LaneBox; BINS]; 3],
    counts: [[u32; BINS]; 3],
}

impl Bins {
    fn of(grid: &CentreGrid, primitives: &[BuildPrimitive]) -> Bins {
        let mut bins = Bins {
            bounds: [[LaneBox::EMPTY; BINS]; 3],
            counts: [[0; BINS]; 3],
        };
        for primitive in primitives {
            let cells = grid.cells(primitive);
            for axis in 0..3 {
                let place = cells[axis] as usize % BINS;
                let bounds = &mut bins.bounds[axis][place];
                *bounds = primitive.bounds().union(*bounds);
                bins.counts[axis][place] += 1;
            }
        }
        bins
    }

    fn bin(&self, axis: usize, place: usize) -> Bin {
        Bin {
            bounds: self.bounds[axis][place],
            count: self.counts[axis][place],
        }
    }

    /// For each of the first `count` bins of an axis, the cost of that bin and all to its right.
    fn costs_from_the_right(&self, axis: usize, count: usize, leaf_size: LeafSize) -> [f32; BINS] {
        let mut costs = [0.0; BINS];
        let mut right = Bin::EMPTY;
        for place in (1..count).rev() {
            right = right.with(self.bin(axis, place));
            costs[place] = right.cost(leaf_size);
        }
        costs
    }
}

/// The plane of the least cost over all axes; `None` if all centres coincide.
pub(super) fn best_plane(primitives: &[BuildPrimitive], leaf_size: LeafSize) -> Option<SplitPlane> {
    if primitives.len() > LONG {
        // Each primitive stands for many, so it counts whether or not it fills a leaf.
        return best_plane_of_all(&sample(primitives), LeafSize(1));
    }
    best_plane_of_all(primitives, leaf_size)
}

fn best_plane_of_all(primitives: &[BuildPrimitive], leaf_size: LeafSize) -> Option<SplitPlane> {
    let count = bins_for(primitives.len());
    let grid = CentreGrid::new(primitives, count as u32 - 1);
    let bins = Bins::of(&grid, primitives);
    let mut best = None;
    let mut least = f32::INFINITY;
    for axis in (0..3).filter(|axis| grid.has_extent(*axis)) {
        let right_costs = bins.costs_from_the_right(axis, count, leaf_size);
        let mut left = Bin::EMPTY;
        for left_bins in 1..count {
            left = left.with(bins.bin(axis, left_bins - 1));
            if left.count == 0 || left.count as usize == primitives.len() {
                continue;
            }
            let cost = left.cost(leaf_size) + right_costs[left_bins];
            if best.is_none() || cost < least {
                let at = grid.boundary(axis, left_bins);
                best = Some(SplitPlane { axis, at });
                least = cost;
            }
        }
    }
    best
}
