//! The surfaces that textures cut holes into.

use crate::digest::Digester;
use crate::shape::{Alpha, PrimitiveId, PrimitiveKind};
use std::collections::HashSet;
use std::ops::Range;
use std::sync::Arc;

/// The alphas of the primitives in one [`Geometry`](super::Geometry).
#[derive(Debug, Default)]
pub(super) struct CutOuts {
    pub(super) alphas: Vec<Alpha>,
    /// The runs of each kind: triangles, quadrics and segments.
    pub(super) runs: [Vec<Run>; 3],
}

/// Primitives of one kind, from `first` to before `end`, with one alpha.
#[derive(Debug)]
pub(super) struct Run {
    first: u32,
    end: u32,
    alpha: u32,
}

impl CutOuts {
    /// The alpha of a primitive.
    pub(super) fn of(&self, primitive: PrimitiveId) -> Option<&Alpha> {
        let runs = &self.runs[place_of(primitive.kind())];
        let index = primitive.index() as u32;
        let next = runs.partition_point(|run| run.first <= index);
        let run = &runs[next.checked_sub(1)?];
        (index < run.end).then(|| &self.alphas[run.alpha as usize])
    }

    /// Gives an alpha to the primitives of each kind from `before` to `after`, which come after all
    /// that have one.
    pub(super) fn add(&mut self, before: Counts, after: Counts, alpha: Alpha) {
        if !self
            .alphas
            .last()
            .is_some_and(|last| last.is_same_as(&alpha))
        {
            self.alphas.push(alpha);
        }
        let alpha = (self.alphas.len() - 1) as u32;
        for (kind, runs) in self.runs.iter_mut().enumerate() {
            push(runs, before.0[kind]..after.0[kind], alpha);
        }
    }

    /// The memory of it in bytes; images that are shared count for the first that shows them, as
    /// `known` remembers.
    pub(super) fn bytes(&self, known: &mut HashSet<usize>) -> usize {
        let mut images = 0;
        for alpha in &self.alphas {
            alpha.each_image(&mut |texels| {
                if known.insert(Arc::as_ptr(texels) as usize) {
                    images += texels.bytes();
                }
            });
        }
        size_of_val(self)
            + size_of_val(&self.alphas[..])
            + self
                .runs
                .iter()
                .map(|runs| size_of_val(&runs[..]))
                .sum::<usize>()
            + images
    }

    pub(super) fn digest(&self, digester: &mut Digester) {
        digester.word(self.alphas.len() as u64);
        self.alphas.iter().for_each(|alpha| alpha.digest(digester));
        for runs in &self.runs {
            digester.list(runs, |run| {
                [
                    u64::from(run.first) << 32 | u64::from(run.end),
                    run.alpha.into(),
                ]
            });
        }
    }
}

/// The numbers of triangles, quadrics and segments of a geometry at some point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts(pub(super) [usize; 3]);

fn place_of(kind: PrimitiveKind) -> usize {
    match kind {
        PrimitiveKind::Triangle => 0,
        PrimitiveKind::Quadric => 1,
        PrimitiveKind::Segment => 2,
    }
}

/// Adds a run, or extends the last one. Scenes with millions of leaves have few runs.
fn push(runs: &mut Vec<Run>, range: Range<usize>, alpha: u32) {
    let (first, end) = (range.start as u32, range.end as u32);
    if range.is_empty() {
        return;
    }
    match runs.last_mut() {
        Some(last) if last.alpha == alpha && last.end == first => last.end = end,
        _ => runs.push(Run { first, end, alpha }),
    }
}
