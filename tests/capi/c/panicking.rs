//! A Rust static library beside carvel's: a panic in a thread of its own is caught, and
//! what it held is dropped. `PREFIX` at its build begins its function's name.

use std::sync::atomic::{AtomicI32, Ordering};

static DROPPED: AtomicI32 = AtomicI32::new(0);

struct Held;

impl Drop for Held {
    fn drop(&mut self) {
        DROPPED.fetch_add(1, Ordering::SeqCst);
    }
}

/// 11: one drop, one panic caught.
#[unsafe(export_name = concat!(env!("PREFIX"), "_panics"))]
pub extern "C" fn panics(number: i32) -> i32 {
    std::panic::set_hook(Box::new(|_| {}));
    let caught = std::thread::spawn(move || {
        let _held = Held;
        assert!(number < 0, "{number}");
    })
    .join()
    .is_err();
    DROPPED.load(Ordering::SeqCst) * 10 + i32::from(caught)
}
