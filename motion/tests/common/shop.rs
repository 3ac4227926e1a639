//! A machine with g-code files, kept files and PLC variables, for tests of channels.

use super::rig::{Fb, Rig, ideal};
use std::collections::HashMap;
use std::sync::{Arc, Mutex};
use takt_base::Code;
use takt_image::Elementary;
use takt_image::image::Place;
use takt_motion::feeder::{Environment, ngc_reader};
use takt_motion::machine::ChannelConfig;
use takt_motion::plc::{PlcError, Symbols, Variable, symbols};
use takt_motion::{Background, Machine, MachineConfig};

/// Files by name, shared with the machine.
pub type Disk = Arc<Mutex<HashMap<String, String>>>;

/// PLC variables of the tests, from byte 60000 on: `level` LREAL, `count` INT, `flag` BOOL, `door` BOOL that is an input, `name` no number,
/// `v0` .. `v19` LREAL.
pub const LEVEL: usize = 60_000;
pub const COUNT: usize = 60_008;
pub const FLAG: usize = 60_010;
pub const V: usize = 60_016;

struct Table;

impl Symbols for Table {
    fn find(&self, path: &str) -> Result<Variable, PlcError> {
        let at = |offset: usize, ty, writable| {
            let (low, high) = symbols::range(ty).expect("a number");
            Ok(Variable { place: Place::Byte(offset as u32), ty, low, high, writable })
        };
        let error = |code| Err(PlcError { code, label: format!("`{path}`"), help: "none".to_owned() });
        match path {
            "level" => at(LEVEL, Elementary::Lreal, true),
            "main.count" => at(COUNT, Elementary::Int, true),
            "flag" => at(FLAG, Elementary::Bool, true),
            "door" => at(FLAG + 1, Elementary::Bool, false),
            "main.timer.et" => error(Code::PlcVariableType),
            other => match other.strip_prefix(['v', 'a']).and_then(|n| n.parse::<usize>().ok()).filter(|n| *n < 20) {
                Some(n) => at(V + 8 * n, Elementary::Lreal, true),
                None => error(Code::UnknownPlcVariable),
            },
        }
    }
}

pub fn three_axes(channel: ChannelConfig) -> MachineConfig {
    let names = ["X", "Y", "Z"];
    let channel = ChannelConfig { axes: names.map(str::to_owned).to_vec(), ..channel };
    MachineConfig { axes: names.map(ideal).to_vec(), channels: vec![channel], ..MachineConfig::default() }
}

pub fn disk(files: &[(&str, &str)]) -> Disk {
    Arc::new(Mutex::new(files.iter().map(|(n, t)| ((*n).to_owned(), (*t).to_owned())).collect()))
}

pub fn environment(disk: &Disk) -> Environment {
    let (reading, writing) = (disk.clone(), disk.clone());
    let files = move |name: &str| reading.lock().unwrap().get(name).cloned().ok_or_else(|| "no such file".to_owned());
    let save = move |name: &str, text: &str| {
        if name.starts_with("bad/") {
            return Err("read-only".to_owned());
        }
        writing.lock().unwrap().insert(name.to_owned(), text.to_owned());
        Ok(())
    };
    Environment { files: Arc::new(Box::new(files)), save: Some(Arc::new(Box::new(save))), symbols: Some(Arc::new(Table)) }
}

/// A powered machine.
pub fn shop(config: &MachineConfig, disk: &Disk) -> Rig {
    config.validate().expect("a valid configuration");
    let machine = Machine::with_environment(config, environment(disk), ngc_reader(), Background::Inline);
    let mut rig = Rig::on(config, machine);
    rig.power_on();
    rig
}

/// The same with one program, `a.ngc`, that is loaded and started; its CNC_Run.
pub fn running(channel: ChannelConfig, text: &str) -> (Rig, Fb) {
    let mut rig = shop(&three_axes(channel), &disk(&[("a.ngc", text)]));
    let run = rig.start("a.ngc");
    (rig, run)
}

impl Rig {
    pub fn real(&self, at: usize) -> f64 {
        f64::from_le_bytes(self.memory[at..at + 8].try_into().expect("bytes"))
    }
    pub fn set_real(&mut self, at: usize, value: f64) {
        self.memory[at..at + 8].copy_from_slice(&value.to_le_bytes());
    }
    pub fn axis(&self, i: usize) -> f64 {
        self.machine.core().axes[i].set_position()
    }
    /// The error of the channel, if it has one: code and message.
    pub fn error(&self) -> Option<(Code, String)> {
        self.machine.core().channels[0].error().map(|n| (n.code, n.message().to_owned()))
    }
}
