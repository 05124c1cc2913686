//! A level of lanes from the operations on its registers.

/// Defines the token `$token` and its lanes, and implements the traits through the functions of the module `ops`, which
/// are the same for every level. `F` has `$n` registers of `$w` lanes, `D` twice as many of half the lanes.
macro_rules! level {
    ($token:ident, $features:literal, [$($feature:tt),*], $n:literal x $w:literal, $f:ty, $d:ty, $m:ty) => {
        /// Proof that the machine has the instructions of this level.
        #[derive(Debug, Clone, Copy)]
        pub(in crate::simd) struct $token(());

        /// Sixteen `f32`.
        #[derive(Debug, Clone, Copy)]
        pub(in crate::simd) struct F([$f; $n]);

        /// Sixteen `f64`: registers 2k and 2k + 1 are the lanes of register k of [`F`].
        #[derive(Debug, Clone, Copy)]
        pub(in crate::simd) struct D([$d; 2 * $n]);

        /// Registers of [`D`].
        const WIDE: usize = 2 * $n;

        /// Sixteen truth values.
        #[derive(Debug, Clone, Copy)]
        pub(in crate::simd) struct M([$m; $n]);

        impl $token {
            /// The token, where the machine has the instructions.
            #[inline]
            pub(in crate::simd) fn detect() -> Option<$token> {
                ($(is_x86_feature_detected!($feature))&&*).then_some($token(()))
            }

            /// Runs `kernel`, compiled with the instructions.
            pub(in crate::simd) fn run<K: Kernel>(self, kernel: K) -> K::Output {
                #[target_feature(enable = $features)]
                fn enabled<K: Kernel>(kernel: K, token: $token) -> K::Output {
                    kernel.run(token)
                }
                // SAFETY: the token proves that the machine has the instructions.
                unsafe { enabled(kernel, self) }
            }
        }

        /// A value of `$type`, register by register.
        macro_rules! registers {
            ($type:ident, $zero:ident, $count:expr, $k:ident => $value:expr) => {{
                // SAFETY: whoever has lanes or a token of this level has its instructions.
                let mut registers = [unsafe { ops::$zero() }; $count];
                for $k in 0..$count {
                    // SAFETY: as above.
                    registers[$k] = unsafe { $value };
                }
                $type(registers)
            }};
        }

        impl Lanes for $token {
            type F = F;
            type D = D;
            type M = M;

            #[inline(always)]
            fn splat(self, x: f32) -> F {
                registers!(F, zero, $n, _k => ops::splat(x))
            }
            #[inline(always)]
            fn load(self, from: &[f32; LANES]) -> F {
                let (parts, _) = from.as_chunks::<$w>();
                registers!(F, zero, $n, k => ops::load(&parts[k]))
            }
            #[inline(always)]
            fn splat_wide(self, x: f64) -> D {
                registers!(D, zero_wide, 2 * $n, _k => ops::splat_wide(x))
            }
            #[inline(always)]
            fn load_wide(self, from: &[f64; LANES]) -> D {
                let (parts, _) = from.as_chunks::<{ $w / 2 }>();
                registers!(D, zero_wide, 2 * $n, k => ops::load_wide(&parts[k]))
            }
            #[inline(always)]
            fn prefetch<T>(self, what: &T) {
                let start: *const T = what;
                for offset in (0..size_of::<T>()).step_by(64) {
                    // SAFETY: SSE is part of x86-64, and fetching ahead reads nothing that the program could notice.
                    unsafe { _mm_prefetch::<_MM_HINT_T0>(start.cast::<i8>().wrapping_add(offset)) }
                }
            }
        }

        macro_rules! operators {
            ($type:ident, $zero:ident, $count:expr, $trait:ident $method:ident $function:ident) => {
                impl $trait for $type {
                    type Output = $type;
                    #[inline(always)]
                    fn $method(self, other: $type) -> $type {
                        registers!($type, $zero, $count, k => ops::$function(self.0[k], other.0[k]))
                    }
                }
            };
        }
        operators!(F, zero, $n, Add add add);
        operators!(F, zero, $n, Sub sub sub);
        operators!(F, zero, $n, Mul mul mul);
        operators!(F, zero, $n, Div div div);
        operators!(D, zero_wide, WIDE, Add add add_wide);
        operators!(D, zero_wide, WIDE, Sub sub sub_wide);
        operators!(D, zero_wide, WIDE, Mul mul mul_wide);
        operators!(D, zero_wide, WIDE, Div div div_wide);
        operators!(M, none, $n, BitAnd bitand both);
        operators!(M, none, $n, BitOr bitor either);

        impl Not for M {
            type Output = M;
            #[inline(always)]
            fn not(self) -> M {
                registers!(M, none, $n, k => ops::neither(self.0[k]))
            }
        }

        impl F32s for F {
            type D = D;
            type M = M;

            #[inline(always)]
            fn store(self, to: &mut [f32; LANES]) {
                let (parts, _) = to.as_chunks_mut::<$w>();
                for k in 0..$n {
                    // SAFETY: lanes of this level exist only where its instructions do.
                    unsafe { ops::store(self.0[k], &mut parts[k]) }
                }
            }
            #[inline(always)]
            fn min(self, other: F) -> F {
                registers!(F, zero, $n, k => ops::min(self.0[k], other.0[k]))
            }
            #[inline(always)]
            fn max(self, other: F) -> F {
                registers!(F, zero, $n, k => ops::max(self.0[k], other.0[k]))
            }
            #[inline(always)]
            fn abs(self) -> F {
                registers!(F, zero, $n, k => ops::abs(self.0[k]))
            }
            #[inline(always)]
            fn floor(self) -> F {
                registers!(F, zero, $n, k => ops::floor(self.0[k]))
            }
            #[inline(always)]
            fn ceil(self) -> F {
                registers!(F, zero, $n, k => ops::ceil(self.0[k]))
            }
            #[inline(always)]
            fn fused_or_not(self, factor: F, addend: F) -> F {
                registers!(F, zero, $n, k => ops::fused_or_not(self.0[k], factor.0[k], addend.0[k]))
            }
            #[inline(always)]
            fn above(self, other: F) -> M {
                registers!(M, none, $n, k => ops::above(self.0[k], other.0[k]))
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
                registers!(D, zero_wide, 2 * $n, k => {
                    if k % 2 == 0 { ops::widen_lower(self.0[k / 2]) } else { ops::widen_upper(self.0[k / 2]) }
                })
            }
            #[inline(always)]
            fn store_whole(self, to: &mut [i32; LANES]) {
                let (parts, _) = to.as_chunks_mut::<$w>();
                for k in 0..$n {
                    // SAFETY: lanes of this level exist only where its instructions do.
                    unsafe { ops::store_whole(self.0[k], &mut parts[k]) }
                }
            }
        }

        impl F64s for D {
            type F = F;

            #[inline(always)]
            fn store(self, to: &mut [f64; LANES]) {
                let (parts, _) = to.as_chunks_mut::<{ $w / 2 }>();
                for k in 0..2 * $n {
                    // SAFETY: lanes of this level exist only where its instructions do.
                    unsafe { ops::store_wide(self.0[k], &mut parts[k]) }
                }
            }
            #[inline(always)]
            fn sqrt(self) -> D {
                registers!(D, zero_wide, 2 * $n, k => ops::sqrt_wide(self.0[k]))
            }
            #[inline(always)]
            fn fused_or_not(self, factor: D, addend: D) -> D {
                registers!(D, zero_wide, 2 * $n, k => ops::fused_or_not_wide(self.0[k], factor.0[k], addend.0[k]))
            }
            #[inline(always)]
            fn narrow(self) -> F {
                registers!(F, zero, $n, k => ops::narrow(self.0[2 * k], self.0[2 * k + 1]))
            }
        }

        impl Mask for M {
            type F = F;

            #[inline(always)]
            fn bits(self) -> u32 {
                let mut bits = 0;
                for k in 0..$n {
                    // SAFETY: lanes of this level exist only where its instructions do.
                    bits |= unsafe { ops::bits(self.0[k]) } << ($w * k);
                }
                bits
            }
            #[inline(always)]
            fn select(self, yes: F, no: F) -> F {
                registers!(F, zero, $n, k => ops::select(self.0[k], yes.0[k], no.0[k]))
            }
        }
    };
}

pub(super) use level;
