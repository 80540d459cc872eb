//! The jobs that points share: each takes as many as it has threads.

use std::sync::{Condvar, Mutex, PoisonError};

pub(super) struct Cores {
    all: usize,
    free: Mutex<usize>,
    given_back: Condvar,
}

/// Some of the [`Cores`], given back when dropped.
pub(super) struct Taken<'a> {
    from: &'a Cores,
    number: usize,
}

impl Cores {
    pub fn new(all: usize) -> Cores {
        Cores {
            all,
            free: Mutex::new(all),
            given_back: Condvar::new(),
        }
    }

    /// Waits for `wanted` of them to be free; whoever wants more than there are gets all.
    pub fn take(&self, wanted: usize) -> Taken<'_> {
        let number = wanted.min(self.all);
        let free = self.free.lock().unwrap_or_else(PoisonError::into_inner);
        let mut free = self
            .given_back
            .wait_while(free, |free| *free < number)
            .unwrap_or_else(PoisonError::into_inner);
        *free -= number;
        Taken { from: self, number }
    }
}

impl Drop for Taken<'_> {
    fn drop(&mut self) {
        *self.from.free.lock().unwrap_or_else(PoisonError::into_inner) += self.number;
        self.from.given_back.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::thread;
    use std::time::Duration;

    use super::*;

    #[test]
    fn no_more_are_busy_than_there_are() {
        let cores = Cores::new(3);
        let (busy, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
        thread::scope(|scope| {
            for wanted in [1, 2, 3, 1, 9, 2, 1, 2] {
                let (cores, busy, most) = (&cores, &busy, &most);
                scope.spawn(move || {
                    let taken = cores.take(wanted);
                    let now = busy.fetch_add(taken.number, Ordering::SeqCst) + taken.number;
                    most.fetch_max(now, Ordering::SeqCst);
                    thread::sleep(Duration::from_millis(2));
                    busy.fetch_sub(taken.number, Ordering::SeqCst);
                });
            }
        });
        assert_eq!(most.load(Ordering::SeqCst), 3);
        assert_eq!(cores.take(3).number, 3, "all were given back");
    }
}
