//! The host of a program: the standard library's natives and the machine, as one.
//! Runs: `bind` before the start, the rest cyclic. The machine is shared with the thread's own report, never with another thread.

use std::cell::RefCell;
use std::rc::Rc;
use takt_base::Nanos;
use takt_image::{BindError, Cyclic, NativeCall, NativeImport, Natives, Trap, TypeTable};
use takt_motion::machine::Machine;
use takt_stdlib::Library;
use takt_stdlib::asserts::Asserts;

/// Where a bound import lives.
#[derive(Clone, Copy)]
enum Owner {
    Library(u32),
    Machine(u32),
}

/// Library and machine.
pub struct PlcHost {
    library: Library,
    machine: Rc<RefCell<Machine>>,
    bound: Vec<Owner>,
}

impl PlcHost {
    /// Around a machine and a log of assertions, which the caller may look at between two steps.
    pub fn new(machine: Rc<RefCell<Machine>>, asserts: Asserts) -> Self {
        Self { library: Library::with_asserts(asserts), machine, bound: Vec::new() }
    }
}

impl Natives for PlcHost {
    fn bind(&mut self, import: &NativeImport, types: &TypeTable) -> Result<u32, BindError> {
        let owner = match self.library.bind(import, types) {
            Err(BindError::Unknown) => Owner::Machine(self.machine.borrow_mut().bind(import, types)?),
            found => Owner::Library(found?),
        };
        self.bound.push(owner);
        Ok(self.bound.len() as u32 - 1)
    }

    fn call(&mut self, native: u32, call: &mut NativeCall) -> Result<(), Trap> {
        match self.bound.get(native as usize) {
            Some(Owner::Library(n)) => self.library.call(*n, call),
            Some(Owner::Machine(n)) => self.machine.borrow_mut().call(*n, call),
            None => Err(Trap::NativePanic),
        }
    }
}

impl Cyclic for PlcHost {
    fn period(&self) -> Option<Nanos> {
        self.machine.borrow().period()
    }
    fn tick(&mut self, now: Nanos) {
        self.machine.borrow_mut().tick(now);
    }
    fn exchange(&mut self, now: Nanos, memory: &mut [u8]) {
        self.machine.borrow_mut().exchange(now, memory);
    }
    fn safe_stop(&mut self) {
        self.machine.borrow_mut().safe_stop();
    }
}
