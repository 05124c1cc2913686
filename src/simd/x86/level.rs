//! The macro that builds a level from the operations on its registers.

/// Defines the token `$token` and its lanes, and implements the traits by the functions of the
/// module `ops`, which have the same names at every level. `F` has `$n` registers of `$w` lanes,
/// `D` twice as many, `$wide`, of half the lanes.
macro_rules! level {
    (
        $token:ident, $features:literal, [$($feature:tt),*],
        $n:tt x $w:tt, $wide:tt wide, $f:ty, $d:ty, $m:ty
    ) => {
        /// Proves that the machine has this instruction set.
        #[derive(Debug, Clone, Copy)]
        pub(in crate::simd) struct $token(());

        /// Sixteen `f32`.
        #[derive(Debug, Clone, Copy)]
        pub(in crate::simd) struct F([$f; $n]);

        /// Sixteen `f64`: registers 2k and 2k + 1 are the lanes of register k of [`F`].
        #[derive(Debug, Clone, Copy)]
        pub(in crate::simd) struct D([$d; $wide]);

        /// Sixteen truth values.
        #[derive(Debug, Clone, Copy)]
        pub(in crate::simd) struct M([$m; $n]);

        impl $token {
            /// Returns the token if the machine has the instruction set.
            #[inline]
            pub(in crate::simd) fn detect() -> Option<$token> {
                ($(is_x86_feature_detected!($feature))&&*).then_some($token(()))
            }

            /// Runs `kernel`, compiled with the instruction set.
            pub(in crate::simd) fn run<K: SimdKernel>(self, kernel: K) -> K::Output {
                #[target_feature(enable = $features)]
                fn enabled<K: SimdKernel>(kernel: K, token: $token) -> K::Output {
                    kernel.run(token)
                }
                // SAFETY: the token proves that the machine has the instructions.
                unsafe { enabled(kernel, self) }
            }
        }

        /// Computes a value of `$type`, register by register.
        macro_rules! registers {
            ($type:ident, $count:tt, $k:ident => $value:expr) => {
                // SAFETY: lanes and tokens of this level exist only where its instructions do.
                $type(unrolled!($count, $k => unsafe { $value }))
            };
        }

        impl Lanes for $token {
            type F = F;
            type D = D;
            type M = M;

            #[inline(always)]
            fn splat(self, x: f32) -> F {
                registers!(F, $n, _K => ops::splat(x))
            }
            #[inline(always)]
            fn load(self, from: &[f32; LANES]) -> F {
                let (parts, _) = from.as_chunks::<$w>();
                registers!(F, $n, K => ops::load(&parts[K]))
            }
            #[inline(always)]
            fn splat_wide(self, x: f64) -> D {
                registers!(D, $wide, _K => ops::splat_wide(x))
            }
            #[inline(always)]
            fn load_wide(self, from: &[f64; LANES]) -> D {
                let (parts, _) = from.as_chunks::<{ $w / 2 }>();
                registers!(D, $wide, K => ops::load_wide(&parts[K]))
            }
            #[inline(always)]
            fn pick_wide(self, table: &[f64; TABLE], places: &[u8; LANES]) -> D {
                let (parts, _) = places.as_chunks::<{ $w / 2 }>();
                registers!(D, $wide, K => ops::pick_wide(table, &parts[K]))
            }
            #[inline(always)]
            fn prefetch<T>(self, what: &T) {
                let start: *const T = what;
                for offset in (0..size_of::<T>()).step_by(64) {
                    // SAFETY: SSE is part of x86-64, and a prefetch has no observable effect.
                    unsafe { _mm_prefetch::<_MM_HINT_T0>(start.cast::<i8>().wrapping_add(offset)) }
                }
            }
        }

        macro_rules! operators {
            ($type:ident, $count:tt, $trait:ident $method:ident $function:ident) => {
                impl $trait for $type {
                    type Output = $type;
                    #[inline(always)]
                    fn $method(self, other: $type) -> $type {
                        registers!($type, $count, K => ops::$function(self.0[K], other.0[K]))
                    }
                }
            };
        }
        operators!(F, $n, Add add add);
        operators!(F, $n, Sub sub sub);
        operators!(F, $n, Mul mul mul);
        operators!(F, $n, Div div div);
        operators!(D, $wide, Add add add_wide);
        operators!(D, $wide, Sub sub sub_wide);
        operators!(D, $wide, Mul mul mul_wide);
        operators!(D, $wide, Div div div_wide);
        operators!(M, $n, BitAnd bitand both);
        operators!(M, $n, BitOr bitor either);

        impl Not for M {
            type Output = M;
            #[inline(always)]
            fn not(self) -> M {
                registers!(M, $n, K => ops::neither(self.0[K]))
            }
        }

        impl F32s for F {
            type D = D;
            type M = M;

            #[inline(always)]
            fn store(self, to: &mut [f32; LANES]) {
                let (parts, _) = to.as_chunks_mut::<$w>();
                // SAFETY: lanes of this level exist only where its instructions do.
                unrolled!($n, K => unsafe { ops::store(self.0[K], &mut parts[K]) });
            }
            #[inline(always)]
            fn min(self, other: F) -> F {
                registers!(F, $n, K => ops::min(self.0[K], other.0[K]))
            }
            #[inline(always)]
            fn max(self, other: F) -> F {
                registers!(F, $n, K => ops::max(self.0[K], other.0[K]))
            }
            #[inline(always)]
            fn abs(self) -> F {
                registers!(F, $n, K => ops::abs(self.0[K]))
            }
            #[inline(always)]
            fn floor(self) -> F {
                registers!(F, $n, K => ops::floor(self.0[K]))
            }
            #[inline(always)]
            fn ceil(self) -> F {
                registers!(F, $n, K => ops::ceil(self.0[K]))
            }
            #[inline(always)]
            fn fused_or_not(self, factor: F, addend: F) -> F {
                registers!(F, $n, K => ops::fused_or_not(self.0[K], factor.0[K], addend.0[K]))
            }
            #[inline(always)]
            fn above(self, other: F) -> M {
                registers!(M, $n, K => ops::above(self.0[K], other.0[K]))
            }
            #[inline(always)]
            fn least(self) -> f32 {
                let mut least = self.0[0];
                for register in &self.0[1..] {
                    // SAFETY: lanes of this level exist only where its instructions do.
                    least = unsafe { ops::min(least, *register) };
                }
                // SAFETY: as above.
                unsafe { ops::least(least) }
            }
            #[inline(always)]
            fn widen(self) -> D {
                registers!(D, $wide, K => {
                    if K % 2 == 0 {
                        ops::widen_lower(self.0[K / 2])
                    } else {
                        ops::widen_upper(self.0[K / 2])
                    }
                })
            }
            #[inline(always)]
            fn store_whole(self, to: &mut [i32; LANES]) {
                let (parts, _) = to.as_chunks_mut::<$w>();
                // SAFETY: lanes of this level exist only where its instructions do.
                unrolled!($n, K => unsafe { ops::store_whole(self.0[K], &mut parts[K]) });
            }
        }

        impl F64s for D {
            type F = F;

            #[inline(always)]
            fn store(self, to: &mut [f64; LANES]) {
                let (parts, _) = to.as_chunks_mut::<{ $w / 2 }>();
                // SAFETY: lanes of this level exist only where its instructions do.
                unrolled!($wide, K => unsafe { ops::store_wide(self.0[K], &mut parts[K]) });
            }
            #[inline(always)]
            fn sqrt(self) -> D {
                registers!(D, $wide, K => ops::sqrt_wide(self.0[K]))
            }
            #[inline(always)]
            fn fused_or_not(self, factor: D, addend: D) -> D {
                registers!(D, $wide, K => {
                    ops::fused_or_not_wide(self.0[K], factor.0[K], addend.0[K])
                })
            }
            #[inline(always)]
            fn narrow(self) -> F {
                registers!(F, $n, K => ops::narrow(self.0[2 * K], self.0[2 * K + 1]))
            }
        }

        impl Mask for M {
            type F = F;

            #[inline(always)]
            fn bits(self) -> u32 {
                // SAFETY: lanes of this level exist only where its instructions do.
                let parts = unrolled!($n, K => unsafe { ops::bits(self.0[K]) } << ($w * K));
                parts.into_iter().fold(0, |bits, part| bits | part)
            }
            #[inline(always)]
            fn select(self, yes: F, no: F) -> F {
                registers!(F, $n, K => ops::select(self.0[K], yes.0[K], no.0[K]))
            }
        }
    };
}

pub(super) use level;
