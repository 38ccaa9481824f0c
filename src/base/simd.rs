//! The same code compiled twice: for the baseline and, where the processor has it, for AVX2;
//! and memory asked for ahead of its use.
//!
//! What is gained are instructions that name three registers and load a weight into all
//! lanes at once. Products and sums stay separate, so that both give the same bits.

#![allow(unsafe_code)]

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

/// Asks the processor to bring an element near before it is needed; without effect on results.
#[inline(always)]
pub(crate) fn fetch_ahead<T>(list: &[T], at: usize) {
    #[cfg(target_arch = "x86_64")]
    if let Some(element) = list.get(at) {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: every x86-64 processor has the instruction, and it reads nothing.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(element).cast()) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (list, at);
}
