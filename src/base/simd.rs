//! The same code compiled twice: for the baseline and, where the processor has it, for AVX2;
//! four numbers in one register; and memory asked for ahead of its use.
//!
//! What is gained are instructions that name three registers and load a weight into all
//! lanes at once. Products and sums stay separate, so that both give the same bits.

#![allow(unsafe_code)]

use std::ops::{Add, Mul, Sub};

/// Something to do that is worth being compiled for newer processors.
pub(crate) trait InnerLoop {
    /// What it gives.
    type Output;

    /// Does it. `#[inline(always)]`, and so must be what it calls, or that part stays what
    /// the baseline makes of it.
    fn run(self) -> Self::Output;
}

/// Does some work with the widest instructions that the processor has.
#[inline]
pub(crate) fn with_widest<L: InnerLoop>(work: L) -> L::Output {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has AVX2, which is all that the function asks for.
        return unsafe { with_avx2(work) };
    }
    work.run()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn with_avx2<L: InnerLoop>(work: L) -> L::Output {
    work.run()
}

/// A number, or several that are treated alike.
pub(crate) trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Add<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// The same number in all places.
    fn all(x: f64) -> Self;
}

impl Number for f64 {
    #[inline(always)]
    fn all(x: f64) -> Self {
        x
    }
}

/// Four numbers, in one register where the processor has such.
///
/// The compiler puts arrays into registers as it sees fit, which for long sums is not well.
pub(crate) trait Quad: Number {
    /// What [`Quad::numbers`] gives back.
    fn new(numbers: [f64; 4]) -> Self;

    /// The four.
    fn numbers(self) -> [f64; 4];
}

/// An operation of a [`Quad`] with another or with a number.
macro_rules! operation {
    ($trait:ident, $name:ident, $quad:ty, |$one:ident, $other:ident| $work:expr) => {
        impl $trait for $quad {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                let ($one, $other) = (self.0, other.0);
                Self($work)
            }
        }

        impl $trait<f64> for $quad {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: f64) -> Self {
                self.$name(Self::all(other))
            }
        }
    };
}

/// On any processor.
#[derive(Clone, Copy)]
pub(crate) struct Plain([f64; 4]);

impl Number for Plain {
    #[inline(always)]
    fn all(x: f64) -> Self {
        Self([x; 4])
    }
}

impl Quad for Plain {
    #[inline(always)]
    fn new(numbers: [f64; 4]) -> Self {
        Self(numbers)
    }

    #[inline(always)]
    fn numbers(self) -> [f64; 4] {
        self.0
    }
}

operation!(Add, add, Plain, |a, b| [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]]);
operation!(Sub, sub, Plain, |a, b| [a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]]);
operation!(Mul, mul, Plain, |a, b| [a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]]);

#[cfg(target_arch = "x86_64")]
mod avx {
    use super::{Add, Mul, Number, Quad, Sub};
    use std::arch::x86_64::{
        __m256d, _mm256_add_pd, _mm256_loadu_pd, _mm256_mul_pd, _mm256_set1_pd, _mm256_storeu_pd,
        _mm256_sub_pd,
    };

    /// What only `quads_with_avx2` names, which runs where the processor has AVX2.
    #[derive(Clone, Copy)]
    pub(super) struct Register(__m256d);

    impl Number for Register {
        #[inline(always)]
        fn all(x: f64) -> Self {
            // SAFETY: the processor has AVX2, as for all below.
            Self(unsafe { _mm256_set1_pd(x) })
        }
    }

    impl Quad for Register {
        #[inline(always)]
        fn new(numbers: [f64; 4]) -> Self {
            // SAFETY: as above; four numbers are read, wherever they are.
            Self(unsafe { _mm256_loadu_pd(numbers.as_ptr()) })
        }

        #[inline(always)]
        fn numbers(self) -> [f64; 4] {
            let mut numbers = [0.0; 4];
            // SAFETY: as above; four numbers are written.
            unsafe { _mm256_storeu_pd(numbers.as_mut_ptr(), self.0) };
            numbers
        }
    }

    operation!(Add, add, Register, |a, b| {
        // SAFETY: as above.
        unsafe { _mm256_add_pd(a, b) }
    });
    operation!(Sub, sub, Register, |a, b| {
        // SAFETY: as above.
        unsafe { _mm256_sub_pd(a, b) }
    });
    operation!(Mul, mul, Register, |a, b| {
        // SAFETY: as above.
        unsafe { _mm256_mul_pd(a, b) }
    });
}

/// Something to do by [`Quad`]s.
pub(crate) trait QuadLoop {
    /// What it gives.
    type Output;

    /// Does it; for inlining [`InnerLoop::run`] counts.
    fn run<Q: Quad>(self) -> Self::Output;
}

/// Does some work with the widest registers that the processor has.
#[inline]
pub(crate) fn with_quads<L: QuadLoop>(work: L) -> L::Output {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has AVX2, which is all that the function asks for.
        return unsafe { quads_with_avx2(work) };
    }
    work.run::<Plain>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn quads_with_avx2<L: QuadLoop>(work: L) -> L::Output {
    work.run::<avx::Register>()
}

/// Asks the processor to bring an element near before it is needed; without effect on results.
#[inline(always)]
pub(crate) fn fetch_ahead<T>(list: &[T], at: usize) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        let element = list.as_ptr().wrapping_add(at);
        // SAFETY: every x86-64 processor has the instruction, and it reads nothing, wherever that is.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(element.cast()) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (list, at);
}
