//! A bounded single-producer, single-consumer ring: the one road between the background and the cyclic side.
//!
//! Runs: both. Wait-free; all memory is allocated when the ring is made.
//! Invariant: `tail` is written by the consumer alone, `head` by the producer alone; slots in `tail..head` are initialised.
#![allow(unsafe_code)] // A slot is handed over by an index, which the type system can't express.

use std::cell::UnsafeCell;
use std::mem::MaybeUninit;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

struct Shared<T> {
    slots: Box<[UnsafeCell<MaybeUninit<T>>]>,
    /// Count of elements ever put in.
    head: AtomicUsize,
    /// Count of elements ever taken out.
    tail: AtomicUsize,
}

// SAFETY: a slot is touched by one side at a time; `head` and `tail` hand it over with release/acquire.
unsafe impl<T: Send> Sync for Shared<T> {}

/// The producer's end.
pub struct Tx<T>(Arc<Shared<T>>);
/// The consumer's end.
pub struct Rx<T>(Arc<Shared<T>>);

/// A ring that holds at least `capacity` elements (rounded up to a power of two, at least 2).
pub fn ring<T>(capacity: usize) -> (Tx<T>, Rx<T>) {
    let n = capacity.max(2).next_power_of_two();
    let slots = (0..n).map(|_| UnsafeCell::new(MaybeUninit::uninit())).collect();
    let shared = Arc::new(Shared { slots, head: AtomicUsize::new(0), tail: AtomicUsize::new(0) });
    (Tx(shared.clone()), Rx(shared))
}

impl<T> Shared<T> {
    fn len(&self) -> usize {
        let tail = self.tail.load(Ordering::Acquire);
        self.head.load(Ordering::Acquire).wrapping_sub(tail)
    }
    fn slot(&self, count: usize) -> *mut MaybeUninit<T> {
        self.slots[count & (self.slots.len() - 1)].get()
    }
}

impl<T> Tx<T> {
    /// Puts an element in, or gives it back if the ring is full.
    pub fn push(&mut self, item: T) -> Result<(), T> {
        let s = &*self.0;
        let head = s.head.load(Ordering::Relaxed);
        if head.wrapping_sub(s.tail.load(Ordering::Acquire)) == s.slots.len() {
            return Err(item);
        }
        // SAFETY: the slot is free, and only the producer writes free slots.
        unsafe { (*s.slot(head)).write(item) };
        s.head.store(head.wrapping_add(1), Ordering::Release);
        Ok(())
    }
    /// Elements waiting in the ring.
    pub fn len(&self) -> usize {
        self.0.len()
    }
    /// True if nothing waits in the ring.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// True if the next `push` would fail.
    pub fn is_full(&self) -> bool {
        self.len() == self.capacity()
    }
    /// Elements that fit.
    pub fn capacity(&self) -> usize {
        self.0.slots.len()
    }
}

impl<T> Rx<T> {
    /// Takes the oldest element out.
    pub fn pop(&mut self) -> Option<T> {
        let s = &*self.0;
        let tail = s.tail.load(Ordering::Relaxed);
        if s.head.load(Ordering::Acquire) == tail {
            return None;
        }
        // SAFETY: the slot is initialised, and only the consumer reads it; advancing `tail` gives it up.
        let item = unsafe { (*s.slot(tail)).assume_init_read() };
        s.tail.store(tail.wrapping_add(1), Ordering::Release);
        Some(item)
    }
    /// The oldest element, left in place.
    pub fn peek(&self) -> Option<&T> {
        let s = &*self.0;
        let tail = s.tail.load(Ordering::Relaxed);
        if s.head.load(Ordering::Acquire) == tail {
            return None;
        }
        // SAFETY: as in `pop`; the shared borrow of `self` keeps the consumer from advancing.
        Some(unsafe { (*s.slot(tail)).assume_init_ref() })
    }
    /// Elements waiting in the ring.
    pub fn len(&self) -> usize {
        self.0.len()
    }
    /// True if nothing waits in the ring.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl<T> Drop for Shared<T> {
    fn drop(&mut self) {
        let (mut tail, head) = (*self.tail.get_mut(), *self.head.get_mut());
        while tail != head {
            // SAFETY: both ends are gone; slots in tail..head are initialised.
            unsafe { (*self.slot(tail)).assume_init_drop() };
            tail = tail.wrapping_add(1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fills_empties_and_wraps() {
        let (mut tx, mut rx) = ring(3);
        for round in 0..10 {
            for i in 0..4 {
                assert_eq!(tx.push(round * 4 + i), Ok(()));
            }
            assert_eq!(tx.push(99), Err(99));
            assert_eq!(rx.peek(), Some(&(round * 4)));
            assert_eq!(
                (0..5).map(|_| rx.pop()).collect::<Vec<_>>(),
                [0, 1, 2, 3].map(|i| Some(round * 4 + i)).into_iter().chain([None]).collect::<Vec<_>>()
            );
        }
    }

    #[test]
    fn two_threads_keep_order() {
        let (mut tx, mut rx) = ring(8);
        let producer = std::thread::spawn(move || {
            for i in 0..100_000u32 {
                let mut item = i;
                while let Err(back) = tx.push(item) {
                    item = back;
                    std::thread::yield_now();
                }
            }
        });
        let mut next = 0;
        while next < 100_000 {
            match rx.pop() {
                Some(i) => {
                    assert_eq!(i, next);
                    next += 1;
                }
                None => std::thread::yield_now(),
            }
        }
        producer.join().unwrap();
    }

    #[test]
    fn what_is_left_is_dropped() {
        let item = Arc::new(());
        let (mut tx, rx) = ring(4);
        assert!(tx.push(item.clone()).is_ok() && tx.push(item.clone()).is_ok());
        drop((tx, rx));
        assert_eq!(Arc::strong_count(&item), 1);
    }
}
