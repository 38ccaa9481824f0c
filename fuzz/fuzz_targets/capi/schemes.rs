//! Schemes, and what they tell.

use crate::Run;
use carvel::capi::*;
use std::ptr::null_mut;

impl Run<'_> {
    pub fn scheme(&mut self) {
        let fraction = |run: &mut Self| carvel_fraction {
            numerator: run.number(8) as i64,
            denominator: run.number(40) as i64,
        };
        let passes: Vec<_> = (0..self.bytes.below(4)).map(|_| fraction(self)).collect();
        let family = self.number(9) as i32;
        let lists = matches!(family, CARVEL_SCHEME_AVERAGING | CARVEL_SCHEME_PRIMAL);
        let averaging = lists || self.rarely();
        // Fields of other families must be refused.
        let option = |run: &mut Self, families: &[i32]| {
            if families.contains(&family) || run.rarely() { run.number(2) as i32 } else { 0 }
        };
        let creasing = option(self, &[CARVEL_SCHEME_CATMULL_CLARK, CARVEL_SCHEME_LOOP]);
        let triangle_rule = option(self, &[CARVEL_SCHEME_CATMULL_CLARK]);
        let loop_weights = option(self, &[CARVEL_SCHEME_LOOP]);
        let extraordinary = option(self, &[CARVEL_SCHEME_THREE_POINT]);
        let corner_rule = if (5..8).contains(&family) { 0 } else { self.number(2) as i32 };
        let absurd = self.rarely();
        let desc = carvel_scheme_desc {
            struct_size: self.size_of::<carvel_scheme_desc>(),
            family,
            corner_rule,
            boundary: self.number(3) as i32,
            w: if family == CARVEL_SCHEME_THREE_POINT && self.bytes.byte() & 1 != 0 {
                fraction(self)
            } else {
                carvel_fraction::default()
            },
            degree: if family == CARVEL_SCHEME_B_SPLINE { self.number(9) } else { 0 },
            passes: passes.as_ptr(),
            pass_count: match (absurd, averaging) {
                (true, _) => self.bytes.word() | 1 << 20,
                (_, true) => passes.len() as u64,
                _ => 0,
            },
            creasing,
            triangle_rule,
            loop_weights,
            extraordinary,
        };
        // SAFETY: `passes` are there unless their count is absurd.
        let made =
            self.create(|out, error| unsafe { carvel_scheme_create(&raw const desc, out, error) });
        self.schemes.extend(made);
    }

    pub fn list_passes(&mut self) {
        let scheme = self.pick(|run| &run.schemes);
        let mut needed = 0;
        // SAFETY: a scheme that lives, or NULL.
        let status =
            unsafe { carvel_scheme_passes(scheme, null_mut(), 0, &raw mut needed, self.error) };
        if self.answer(status) {
            assert!(needed <= 64);
            // SAFETY: as above; the buffer has its capacity.
            self.list(needed, |out, capacity, count, error| unsafe {
                carvel_scheme_passes(scheme, out, capacity, count, error)
            });
        }
    }

    pub fn list_holes(&mut self) {
        let (scheme, mesh) = (self.pick(|run| &run.schemes), self.pick(|run| &run.meshes));
        let mut needed = 0;
        // SAFETY: objects that live, or NULL.
        let status = unsafe {
            carvel_scheme_holes(scheme, mesh, null_mut(), 0, &raw mut needed, self.error)
        };
        if self.answer(status) {
            assert!(self.counts(mesh).is_some_and(|counts| needed <= counts.faces));
            // SAFETY: as above; the buffer has its capacity.
            self.list(needed, |out: *mut u32, capacity, count, error| unsafe {
                carvel_scheme_holes(scheme, mesh, out, capacity, count, error)
            });
        }
    }
}
