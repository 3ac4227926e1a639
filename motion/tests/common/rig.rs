//! A machine with function block instances, called like generated code calls them: the place of the compiler in these tests.

use super::Random;
use std::collections::HashMap;
use std::sync::Arc;
use takt_base::Nanos;
use takt_image::types::{Dim, Record, Section, Type, TypeId};
use takt_image::{Cyclic, Elementary, NativeCall, NativeImport, NativeKind, Natives, TypeTable};
use takt_motion::axis::AxisState;
use takt_motion::canon::Step;
use takt_motion::channel::CncState;
use takt_motion::feeder::{Plain, Reader};
use takt_motion::machine::declarations::CNC_STATUS;
use takt_motion::machine::{AxisConfig, ChannelConfig};
use takt_motion::natives::{BLOCKS, pins};
use takt_motion::{Background, Machine, MachineConfig};

/// Programs by name: the text of a file is its name.
pub type Programs = HashMap<String, Vec<Step>>;

pub struct Rig {
    pub machine: Machine,
    pub memory: Vec<u8>,
    types: TypeTable,
    named: HashMap<&'static str, TypeId>,
    next: u32,
    pub ticks: i64,
}

/// An instance of a block.
#[derive(Clone)]
pub struct Fb {
    native: u32,
    at: u32,
    pub record: Record,
}

pub fn reader(programs: Programs) -> Reader {
    let programs = Arc::new(programs);
    Box::new(move |p| {
        let steps = programs.get(&*p.text).cloned().unwrap_or_default();
        Box::new(Plain(steps.into_iter().map(Ok)))
    })
}

/// An ideal axis: the actual position is what the servo asks for.
pub fn ideal(name: &str) -> AxisConfig {
    AxisConfig {
        v_max_mm_s: 5000.0,
        a_max_mm_s2: 50_000.0,
        travel_min_mm: -10_000.0,
        travel_max_mm: 10_000.0,
        encoder_resolution_mm: 0.0,
        plant_time_constant_s: 0.0,
        kff_acceleration: 0.0,
        following_error_max_mm: 10.0,
        ..AxisConfig::named(name)
    }
}

pub fn one_axis() -> MachineConfig {
    MachineConfig { axes: vec![ideal("X")], ..MachineConfig::default() }
}

pub fn two_axes(handshake: bool) -> MachineConfig {
    let channel = ChannelConfig { axes: vec!["X".into(), "Y".into()], handshake, ..ChannelConfig::default() };
    MachineConfig { axes: vec![ideal("X"), ideal("Y")], channels: vec![channel], ..MachineConfig::default() }
}

impl Rig {
    pub fn new(config: &MachineConfig, programs: Programs, background: Background) -> Self {
        config.validate().expect("a valid configuration");
        let files =
            Box::new(|name: &str| if name.starts_with("no-") { Err("no such file".to_owned()) } else { Ok(name.to_owned()) });
        Self::on(config, Machine::with_reader(config, files, reader(programs), background))
    }

    /// Around a machine made from `config`.
    pub fn on(config: &MachineConfig, machine: Machine) -> Self {
        let mut rig =
            Self { machine, memory: vec![0; 1 << 16], types: TypeTable::new(), named: HashMap::new(), next: 64, ticks: 0 };
        rig.name_types();
        // References: axes at 8, 10, ..; channel at 32.
        for n in 1..=config.axes.len() {
            rig.memory[6 + 2 * n] = n as u8;
        }
        rig.memory[32] = 1;
        rig
    }

    fn name_types(&mut self) {
        for name in ["AXIS_REF", "CNC_REF"] {
            let uint = self.types.intern(Type::Elementary(Elementary::Uint));
            let member = if name == "AXIS_REF" { "AxisNo" } else { "ChannelNo" };
            let record = self.types.record(name, [(member.to_owned(), uint, Section::Var, false)]);
            let id = self.types.add(Type::Struct(record));
            self.named.insert(name, id);
        }
        for name in ["MC_DIRECTION", "MC_BUFFER_MODE", "CNC_STATE", "CNC_START_MODE"] {
            let id = self.types.add(Type::Enum { name: name.to_owned(), base: Elementary::Int, values: Vec::new() });
            self.named.insert(name, id);
        }
        let members: Vec<_> = CNC_STATUS.iter().map(|(n, t)| ((*n).to_owned(), self.ty(t), Section::Var, false)).collect();
        let record = self.types.record("CNC_STATUS", members);
        let id = self.types.add(Type::Struct(record));
        self.named.insert("CNC_STATUS", id);
    }

    fn ty(&mut self, text: &str) -> TypeId {
        if let Some(id) = self.named.get(text) {
            return *id;
        }
        if let Some(e) = Elementary::from_name(text) {
            return self.types.intern(Type::Elementary(e));
        }
        if let Some(n) = text.strip_prefix("STRING[").and_then(|t| t.strip_suffix(']')) {
            return self.types.intern(Type::String { capacity: n.parse().expect("a length") });
        }
        let (dims, element) = text.strip_prefix("ARRAY[").and_then(|t| t.split_once("] OF ")).expect("an array");
        let dims = dims.split(',').map(|d| {
            let (low, high) = d.trim().split_once("..").expect("bounds");
            Dim { low: low.parse().expect("low"), high: high.parse().expect("high") }
        });
        let dims = dims.collect();
        let element = self.ty(element);
        self.types.intern(Type::Array { element, dims })
    }

    pub fn fb(&mut self, name: &str) -> Fb {
        let block = BLOCKS.iter().find(|b| b.name == name).expect("a block");
        let mut members = Vec::new();
        for pin in block.pins {
            let ty = self.ty(pin.ty);
            let (ty, section) = match pin.section {
                pins::Section::InOut => (self.types.intern(Type::Reference { target: ty }), Section::InOut),
                pins::Section::Input => (ty, Section::Input),
                pins::Section::Output => (ty, Section::Output),
                pins::Section::Private => (ty, Section::Var),
            };
            members.push((pin.st_name(), ty, section, false));
        }
        let record = self.types.record(name, members);
        let ty = self.types.add(Type::Instance(record.clone()));
        let import = NativeImport { name: name.to_owned(), kind: NativeKind::Block { ty } };
        let native = self.machine.bind(&import, &self.types).expect("bindable");
        let fb = Fb { native, at: self.next, record };
        self.next = (self.next + fb.record.size).next_multiple_of(8);
        for pin in block.pins {
            match pin.init {
                "TRUE" => self.set(&fb, pin.name, true),
                "1.0" => self.lreal(&fb, pin.name, 1.0),
                _ => {}
            }
        }
        let reference = if block.pins[0].ty == "AXIS_REF" { 8 } else { 32 };
        self.refer(&fb, reference);
        fb
    }

    /// Axis 1, 2, ... instead of 1.
    pub fn axis_fb(&mut self, name: &str, axis: u32) -> Fb {
        let fb = self.fb(name);
        self.refer(&fb, 6 + 2 * axis);
        fb
    }

    pub fn refer(&mut self, fb: &Fb, place: u32) {
        self.put(fb, &fb.record.fields[0].name, &place.to_le_bytes());
    }

    fn put(&mut self, fb: &Fb, pin: &str, bytes: &[u8]) {
        let at = (fb.at + fb.record.field(pin).expect(pin).offset) as usize;
        self.memory[at..at + bytes.len()].copy_from_slice(bytes);
    }

    fn bytes<const N: usize>(&self, fb: &Fb, pin: &str) -> [u8; N] {
        let at = (fb.at + fb.record.field(pin).expect(pin).offset) as usize;
        self.memory[at..at + N].try_into().expect("bytes")
    }

    pub fn set(&mut self, fb: &Fb, pin: &str, value: bool) {
        self.put(fb, pin, &[u8::from(value)]);
    }
    pub fn lreal(&mut self, fb: &Fb, pin: &str, value: f64) {
        self.put(fb, pin, &value.to_le_bytes());
    }
    pub fn int(&mut self, fb: &Fb, pin: &str, value: i16) {
        self.put(fb, pin, &value.to_le_bytes());
    }
    /// Element of an ARRAY OF BOOL or LREAL, from 0.
    pub fn set_at(&mut self, fb: &Fb, pin: &str, i: usize, value: bool) {
        let at = (fb.at + fb.record.field(pin).expect(pin).offset) as usize + i;
        self.memory[at] = u8::from(value);
    }
    pub fn get_at(&self, fb: &Fb, pin: &str, i: usize) -> bool {
        let at = (fb.at + fb.record.field(pin).expect(pin).offset) as usize + i;
        self.memory[at] != 0
    }
    pub fn lreal_at(&mut self, fb: &Fb, pin: &str, i: usize, value: f64) {
        let at = (fb.at + fb.record.field(pin).expect(pin).offset) as usize + 8 * i;
        self.memory[at..at + 8].copy_from_slice(&value.to_le_bytes());
    }
    pub fn get_lreal_at(&self, fb: &Fb, pin: &str, i: usize) -> f64 {
        let at = (fb.at + fb.record.field(pin).expect(pin).offset) as usize + 8 * i;
        f64::from_le_bytes(self.memory[at..at + 8].try_into().expect("bytes"))
    }
    pub fn get_text(&self, fb: &Fb, pin: &str) -> String {
        let at = (fb.at + fb.record.field(pin).expect(pin).offset) as usize;
        let bytes: Vec<u8> = self.memory[at..].iter().copied().take_while(|&b| b != 0).collect();
        String::from_utf8(bytes).expect("text")
    }
    pub fn word(&mut self, fb: &Fb, pin: &str, value: u32) {
        self.put(fb, pin, &value.to_le_bytes());
    }
    pub fn text(&mut self, fb: &Fb, pin: &str, value: &str) {
        let bytes: Vec<u8> = value.bytes().chain([0]).collect();
        self.put(fb, pin, &bytes);
    }
    pub fn get(&self, fb: &Fb, pin: &str) -> bool {
        self.bytes::<1>(fb, pin) != [0]
    }
    pub fn get_lreal(&self, fb: &Fb, pin: &str) -> f64 {
        f64::from_le_bytes(self.bytes(fb, pin))
    }
    pub fn get_u16(&self, fb: &Fb, pin: &str) -> u16 {
        u16::from_le_bytes(self.bytes(fb, pin))
    }
    pub fn get_i64(&self, fb: &Fb, pin: &str) -> i64 {
        i64::from_le_bytes(self.bytes(fb, pin))
    }
    pub fn get_u32(&self, fb: &Fb, pin: &str) -> u32 {
        u32::from_le_bytes(self.bytes(fb, pin))
    }

    /// Moves the inputs of a motion block.
    pub fn motion(&mut self, fb: &Fb, target: f64, v: f64, a: f64) {
        let pin = if fb.record.field("Position").is_some() { "Position" } else { "Distance" };
        self.lreal(fb, pin, target);
        self.lreal(fb, "Velocity", v);
        self.lreal(fb, "Acceleration", a);
        self.lreal(fb, "Deceleration", a);
    }

    /// One call, with the exclusivity rules R3 and R8 checked.
    pub fn call(&mut self, fb: &Fb) {
        let args = [u64::from(fb.at)];
        let now = self.now();
        let mut call = NativeCall { memory: &mut self.memory, args: &args, result: 0, now };
        self.machine.call(fb.native, &mut call).expect("no trap");
        self.check_exclusive(fb);
    }

    fn check_exclusive(&self, fb: &Fb) {
        if fb.record.field("Execute").is_none() {
            return;
        }
        let on = ["Busy", "Done", "CommandAborted", "Error"]
            .iter()
            .filter(|p| fb.record.field(p).is_some() && self.get(fb, p))
            .count();
        assert!(on <= 1, "{}: R3", fb.record.name);
        assert!(on == 1 || !self.get(fb, "Execute"), "{}: R3, nothing shown", fb.record.name);
    }

    pub fn now(&self) -> Nanos {
        Nanos::from_millis(self.ticks)
    }
    pub fn tick(&mut self) {
        let now = self.now();
        self.machine.tick(now);
        self.machine.exchange(now, &mut self.memory);
        self.ticks += 1;
    }

    /// Calls the blocks and ticks, `n` times.
    pub fn run(&mut self, fbs: &[&Fb], n: usize) {
        for _ in 0..n {
            fbs.iter().for_each(|fb| self.call(fb));
            self.tick();
        }
    }

    /// Runs until `pin` of the last block is TRUE; the number of cycles.
    pub fn until(&mut self, fbs: &[&Fb], fb: &Fb, pin: &str, most: usize) -> usize {
        for n in 0..most {
            fbs.iter().for_each(|fb| self.call(fb));
            if self.get(fb, pin) {
                return n;
            }
            self.tick();
        }
        panic!("{} did not show {pin} in {most} cycles, state {:?}", fb.record.name, self.machine.report());
    }

    pub fn state(&self) -> AxisState {
        self.machine.core().axes[0].state()
    }
    pub fn cnc(&self) -> CncState {
        self.machine.core().channels[0].state()
    }
    pub fn position(&self) -> f64 {
        self.machine.core().axes[0].set_position()
    }
    pub fn velocity(&self) -> f64 {
        self.machine.core().axes[0].set_velocity()
    }

    /// Powers all axes; the MC_Power instances.
    pub fn power_on(&mut self) -> Vec<Fb> {
        let n = self.machine.core().axes.len() as u32;
        let fbs: Vec<_> = (1..=n).map(|i| self.axis_fb("MC_Power", i)).collect();
        for fb in &fbs {
            self.set(fb, "Enable", true);
        }
        let refs: Vec<_> = fbs.iter().collect();
        self.run(&refs, 60);
        assert!(fbs.iter().all(|fb| self.get(fb, "Status")));
        fbs
    }

    /// Loads and starts a program; the CNC_Run.
    pub fn start(&mut self, name: &str) -> Fb {
        let load = self.fb("CNC_LoadProgram");
        self.text(&load, "FileName", name);
        self.set(&load, "Execute", true);
        self.until(&[&load], &load, "Done", 2000);
        let run = self.fb("CNC_Run");
        self.set(&run, "Execute", true);
        run
    }
}

pub fn programs(list: &[(&str, Vec<Step>)]) -> Programs {
    list.iter().map(|(n, p)| ((*n).to_owned(), p.clone())).collect()
}

pub fn random(seed: u64) -> Random {
    Random(seed)
}
