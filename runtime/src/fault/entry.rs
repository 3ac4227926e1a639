//! The native entry: where generated code calls its host.
//! Runs: cyclic. Invariant: no panic crosses a frame of generated code; a failure is a trap number that the code raises by itself.
#![allow(unsafe_code)] // The code passes raw pointers.

use super::CURRENT;
use crate::load::Bound;
use std::panic::{AssertUnwindSafe, catch_unwind};
use takt_base::Nanos;
use takt_image::natives::MAX_SLOTS;
use takt_image::{NativeCall, Natives, Trap};

/// What a call needs, as pointers made from the borrows that `activate` holds.
pub(super) struct Context {
    memory: *mut u8,
    size: usize,
    natives: *mut (dyn Natives + 'static),
    imports: *const [Bound],
    now: Nanos,
    /// Number of the last trap that a native returned.
    trap: u32,
}

impl Context {
    pub(super) fn new(memory: *mut u8, size: usize, natives: &mut dyn Natives, imports: &[Bound], now: Nanos) -> Self {
        // SAFETY: only the lifetime goes, which a pointer can't carry; `activate` keeps the borrow until the call is over.
        let natives = unsafe { std::mem::transmute::<*mut dyn Natives, *mut (dyn Natives + 'static)>(natives) };
        Self { memory, size, natives, imports, now, trap: 0 }
    }
    pub(super) fn trap(&self) -> u32 {
        self.trap
    }

    /// Calls the import; the result is 0 or the trap number.
    ///
    /// # Safety
    /// The pointers are those of a running activation, and `args` and `result` those that the code passed for this import.
    unsafe fn call(&mut self, import: u32, args: *const u64, result: *mut u64) -> Result<(), Trap> {
        // SAFETY: the caller's promise; the code holds no borrow of memory or natives while it calls.
        let (memory, natives, imports) =
            unsafe { (std::slice::from_raw_parts_mut(self.memory, self.size), &mut *self.natives, &*self.imports) };
        let bound = imports.get(import as usize).ok_or(Trap::NativePanic)?;
        let slots = (bound.slots as usize).min(MAX_SLOTS);
        // SAFETY: the code passes one word per slot; with no slots the pointer may be anything.
        let args = if slots == 0 || args.is_null() { &[] } else { unsafe { std::slice::from_raw_parts(args, slots) } };
        let mut call = NativeCall { memory, args, result: 0, now: self.now };
        catch_unwind(AssertUnwindSafe(|| natives.call(bound.native, &mut call))).unwrap_or(Err(Trap::NativePanic))?;
        if !result.is_null() {
            // SAFETY: the code passes a place for one word, or null.
            unsafe { result.write(call.result) };
        }
        Ok(())
    }
}

/// The address for `header::NATIVE_ENTRY`.
pub fn address() -> u64 {
    native_entry as extern "sysv64" fn(*mut u8, u32, *const u64, *mut u64) -> u32 as usize as u64
}

/// See the signature in `takt_image::natives`. The memory is known from the activation and not taken from the code.
extern "sysv64" fn native_entry(_memory: *mut u8, import: u32, args: *const u64, result: *mut u64) -> u32 {
    let current = CURRENT.get();
    if current.is_null() {
        return Trap::NativePanic as u32;
    }
    // SAFETY: the code runs, so the activation further down on this thread lives. The handler touches other fields alone.
    let context = unsafe { &mut (*current).call };
    // SAFETY: the pointers are those of this activation.
    match unsafe { context.call(import, args, result) } {
        Ok(()) => 0,
        Err(trap) => {
            context.trap = trap as u32;
            trap as u32
        }
    }
}
