//! Memory that a thread holds, counted where it is taken.
//!
//! A point runs on one thread, so the count of its thread is the point's memory. What another
//! thread frees is missing from the count of the one that took it: counts are signed and approximate
//! by that much.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    // Constant and without destructor: safe to touch from inside the allocator.
    static HELD: Cell<i64> = const { Cell::new(0) };
    static PEAK: Cell<i64> = const { Cell::new(0) };
}

/// The system's allocator with a count per thread.
struct Counting;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn count(change: i64) {
    // Threads that are ending have no count any more.
    let _ = HELD.try_with(|held| {
        let now = held.get() + change;
        held.set(now);
        let _ = PEAK.try_with(|peak| peak.set(peak.get().max(now)));
    });
}

// SAFETY: every call goes to the system's allocator unchanged; counting allocates nothing.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as i64);
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as i64);
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(-(layout.size() as i64));
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(size as i64 - layout.size() as i64);
        unsafe { System.realloc(pointer, layout, size) }
    }
}

/// Starts counting at zero on this thread.
pub(super) fn restart() {
    HELD.set(0);
    PEAK.set(0);
}

/// Most that this thread held at once since [`restart`] [bytes].
pub(super) fn peak() -> u64 {
    PEAK.get().max(0).unsigned_abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_peak_outlives_what_was_freed() {
        restart();
        drop(std::hint::black_box(vec![1_u8; 3_000_000]));
        let small = std::hint::black_box(vec![1_u8; 1000]);
        assert!((3_000_000..3_100_000).contains(&peak()), "{}", peak());
        drop(small);
    }

    #[test]
    fn threads_count_for_themselves() {
        restart();
        std::thread::spawn(|| drop(std::hint::black_box(vec![1_u8; 5_000_000])))
            .join()
            .unwrap();
        assert!(peak() < 1_000_000, "{}", peak());
    }
}
