//! A cache of coincident primitives, which every ray hits at the same `t`.

use crate::shape::{Coincidence, Form, Geometry, InstancedId, Primitive, SpaceCache};

/// The coincidences that a thread has found.
///
/// Answers depend on the primitives alone, never on earlier questions: forgotten ones are computed
/// again.
#[derive(Debug, Default)]
pub(crate) struct Ties {
    last: Option<(InstancedId, InstancedId, Coincidence)>,
    /// For a primitive another one in its plane. Primitives with the same leader are coplanar.
    leaders: PairCache<InstancedId>,
    /// Pairs that look coplanar but are not.
    apart: PairCache<()>,
    /// The space of the last quadric whose alpha was asked.
    pub(super) spaces: SpaceCache,
}

impl Ties {
    /// How two primitives that can be hit coincide.
    #[inline]
    pub(crate) fn between(
        &mut self,
        geometry: &Geometry,
        a: InstancedId,
        b: InstancedId,
    ) -> Coincidence {
        if let Some((first, second, known)) = self.last
            && first == a
            && second == b
        {
            return known;
        }
        let found = self.find(geometry, a, b);
        self.last = Some((a, b, found));
        found
    }

    fn find(&mut self, geometry: &Geometry, a: InstancedId, b: InstancedId) -> Coincidence {
        let leaders = [a, b].map(|placed| self.leaders.get(placed, placed));
        if leaders[0].is_some() && leaders[0] == leaders[1] {
            return Coincidence::SameHit;
        }
        let has_alpha = |placed: &InstancedId| geometry.alpha_of(*placed).is_some();
        match (geometry.surface(a), geometry.surface(b)) {
            (p, q) if p.is_flat() && q.is_flat() => {
                let leaders = [leaders[0].unwrap_or(a), leaders[1].unwrap_or(b)];
                if self.are_coplanar((a, &p), (b, &q), leaders) {
                    Coincidence::SameHit
                } else {
                    Coincidence::None
                }
            }
            (Primitive::Quadric(p), Primitive::Quadric(q)) => match p.coincidence(&q) {
                // Of two equal surfaces with holes, a ray may hit the near side of one and the far
                // side of the other. Brackets do not tell the sides of a patch apart.
                Coincidence::SameHit if [a, b].iter().any(has_alpha) => match p.form {
                    Form::Patch => Coincidence::None,
                    _ => Coincidence::SameRoots,
                },
                known => known,
            },
            (Primitive::Segment(p), Primitive::Segment(q)) if p == q => Coincidence::SameHit,
            _ => Coincidence::None,
        }
    }

    fn are_coplanar(
        &mut self,
        (a, p): (InstancedId, &Primitive),
        (b, q): (InstancedId, &Primitive),
        leaders: [InstancedId; 2],
    ) -> bool {
        if let Some(known) = p.may_be_coplanar_with(q) {
            return known;
        }
        if self.apart.get(a, b).is_some() {
            return false;
        }
        if !p.is_coplanar_with(q) {
            self.apart.put(a, b, ());
            return false;
        }
        // The smaller leader, so that groups merge instead of exchanging members.
        let [first, second] = leaders;
        let leader = if second < first { second } else { first };
        self.leaders.put(a, a, leader);
        self.leaders.put(b, b, leader);
        true
    }
}

/// Facts about pairs of primitives. Each pair hashes to one place, which keeps the latest entry.
#[derive(Debug)]
struct PairCache<T> {
    /// Empty until the first use.
    places: Vec<Option<(InstancedId, InstancedId, T)>>,
}

impl<T> Default for PairCache<T> {
    fn default() -> PairCache<T> {
        PairCache { places: Vec::new() }
    }
}

impl<T: Copy> PairCache<T> {
    const BITS: u32 = 16;

    fn place(a: InstancedId, b: InstancedId) -> usize {
        // Fibonacci hashing: the upper bits of a product with 2^64 over the golden ratio.
        const FACTOR: u64 = 0x9e37_79b9_7f4a_7c15;
        let word = a.to_bits().wrapping_mul(FACTOR) ^ b.to_bits().rotate_left(32);
        (word.wrapping_mul(FACTOR) >> (64 - Self::BITS)) as usize
    }

    fn get(&self, a: InstancedId, b: InstancedId) -> Option<T> {
        let (first, second, known) = (*self.places.get(Self::place(a, b))?)?;
        (first == a && second == b).then_some(known)
    }

    fn put(&mut self, a: InstancedId, b: InstancedId, known: T) {
        if self.places.is_empty() {
            self.places = vec![None; 1 << Self::BITS];
        }
        self.places[Self::place(a, b)] = Some((a, b, known));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Matrix, Point};
    use crate::shape::PrimitiveId;
    use proptest::prelude::*;

    /// Triangles with integer corners, in planes through the origin or shifted ones.
    fn geometry_of(triangles: &[([[i32; 2]; 3], [i32; 3])]) -> Geometry {
        let mut geometry = Geometry::default();
        for (corners, [slope, other, height]) in triangles {
            let corner = |[x, y]: [i32; 2]| {
                Point::from([x, y, slope * x + other * y + height].map(f64::from))
            };
            geometry
                .add_mesh(
                    corners.map(corner).to_vec(),
                    vec![[0, 1, 2]],
                    &Matrix::IDENTITY,
                    1,
                )
                .unwrap();
        }
        geometry
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(500))]

        /// Earlier questions do not matter, nor does their order.
        #[test]
        fn answers_depend_on_the_pair_alone(
            triangles in prop::collection::vec(
                (
                    prop::array::uniform3(prop::array::uniform2(-9i32..10)),
                    prop::array::uniform3(1i32..3),
                ),
                2..8,
            ),
            order in prop::collection::vec((0usize..8, 0usize..8), 1..40),
        ) {
            let geometry = geometry_of(&triangles);
            let mut ties = Ties::default();
            for (a, b) in order {
                let [a, b] = [a, b].map(|k| k % triangles.len());
                let [p, q] = [a, b].map(|k| InstancedId::alone(PrimitiveId::triangle(k)));
                if [p, q].iter().any(|placed| !geometry.surface(*placed).can_be_hit()) {
                    continue;
                }
                let expected = match triangles[a].1 == triangles[b].1 {
                    true => Coincidence::SameHit,
                    false => Coincidence::None,
                };
                prop_assert_eq!(ties.between(&geometry, p, q), expected);
                prop_assert_eq!(Ties::default().between(&geometry, p, q), expected);
            }
        }
    }

    #[test]
    fn a_cache_forgets_and_does_not_grow() {
        let mut cache = PairCache::default();
        let placed = |k: usize| InstancedId::in_instance(k % 7, PrimitiveId::triangle(k));
        assert_eq!(cache.get(placed(0), placed(1)), None);
        let count = 4 << PairCache::<usize>::BITS;
        for k in 0..count {
            cache.put(placed(k), placed(k + 1), k);
            assert_eq!(cache.get(placed(k), placed(k + 1)), Some(k));
        }
        assert_eq!(cache.places.len(), 1 << PairCache::<usize>::BITS);
        let known: Vec<usize> = (0..count)
            .filter(|k| cache.get(placed(*k), placed(k + 1)) == Some(*k))
            .collect();
        assert!(
            known.len() <= cache.places.len() && known.len() > cache.places.len() / 2,
            "{}",
            known.len()
        );
    }
}
