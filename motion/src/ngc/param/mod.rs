//! Parameters: numbered `#1` .. `#5601` and named `#<local>`, `#<_global>`, and those that show the state of the interpreter.
//! Runs: background. From: RS274/NGC §3.2.1, LinuxCNC "Parameters".

pub mod file;
pub mod names;
pub mod predefined;

pub use names::{Kind, Name, Names};
pub use predefined::Predefined;

/// Numbered parameters go from 1 to this.
pub const LAST: u16 = 5601;
/// `#1` .. `#30` belong to the subroutine that runs.
pub const LOCALS: usize = 30;

/// The number of a parameter, if `value` is one: whole to within 0.0001.
pub fn index(value: f64) -> Option<u16> {
    let near = (value + 0.5) as i64;
    ((value - near as f64).abs() <= 1e-4 && (1..=i64::from(LAST)).contains(&near)).then_some(near as u16)
}

/// Values of all parameters that a program can set.
#[derive(Clone, Debug)]
pub struct Params {
    numbered: Vec<f64>,
    globals: Vec<Option<f64>>,
    locals: Vec<(u32, f64)>,
    /// Start of the locals of each call, and its caller's `#1` .. `#30`.
    frames: Vec<(usize, [f64; LOCALS])>,
    /// Value of the last `return` or `endsub`, and whether there was one.
    pub returned: Option<f64>,
}

impl Default for Params {
    fn default() -> Self {
        Params {
            numbered: vec![0.0; usize::from(LAST) + 1],
            globals: Vec::new(),
            locals: Vec::new(),
            frames: Vec::new(),
            returned: None,
        }
    }
}

impl Params {
    /// Value of a numbered parameter.
    pub fn get(&self, index: u16) -> f64 {
        self.numbered.get(usize::from(index)).copied().unwrap_or(0.0)
    }

    /// Sets a numbered parameter.
    pub fn set(&mut self, index: u16, value: f64) {
        if let Some(place) = self.numbered.get_mut(usize::from(index)) {
            *place = value;
        }
    }

    /// Value of a local or global name.
    pub fn named(&self, name: Name) -> Option<f64> {
        match name.kind {
            Kind::Local => self.local(name.id).map(|i| self.locals[i].1),
            _ => self.globals.get(name.id as usize).copied().flatten(),
        }
    }

    /// Sets a local or global name.
    pub fn set_named(&mut self, name: Name, value: f64) {
        if name.kind == Kind::Local {
            match self.local(name.id) {
                Some(i) => self.locals[i].1 = value,
                None => self.locals.push((name.id, value)),
            }
            return;
        }
        let id = name.id as usize;
        if self.globals.len() <= id {
            self.globals.resize(id + 1, None);
        }
        self.globals[id] = Some(value);
    }

    fn local(&self, id: u32) -> Option<usize> {
        let base = self.frames.last().map_or(0, |f| f.0);
        self.locals[base..].iter().position(|l| l.0 == id).map(|i| base + i)
    }

    /// A subroutine starts with these arguments.
    pub fn enter(&mut self, args: &[f64]) {
        let mut saved = [0.0; LOCALS];
        saved.copy_from_slice(&self.numbered[1..=LOCALS]);
        self.frames.push((self.locals.len(), saved));
        for (i, place) in self.numbered[1..=LOCALS].iter_mut().enumerate() {
            *place = args.get(i).copied().unwrap_or(0.0);
        }
    }

    /// The subroutine ends.
    pub fn leave(&mut self) {
        if let Some((base, saved)) = self.frames.pop() {
            self.locals.truncate(base);
            self.numbered[1..=LOCALS].copy_from_slice(&saved);
        }
    }

    /// Calls in progress.
    pub fn depth(&self) -> usize {
        self.frames.len()
    }

    /// Ends all calls, as M2 does.
    pub fn leave_all(&mut self) {
        while !self.frames.is_empty() {
            self.leave();
        }
    }
}
