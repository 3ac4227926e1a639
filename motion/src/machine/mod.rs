//! The machine: axes and channels behind the two traits through which the runtime drives them.
//! Runs: `new`, `bind`, `report` in the background, `tick` and `call` cyclic.
//! Invariant: with the same calls and ticks the same set points, bit for bit.

pub mod background;
pub mod config;
pub mod declarations;
pub mod report;
pub mod trace;

pub use background::Background;
pub use config::{AxisConfig, ChannelConfig, ChannelMode, MachineConfig};
pub use declarations::declarations;
pub use report::{AxisReport, ChannelError, ChannelReport, MachineReport, PulseReport};
pub use trace::Trace;

use crate::axis::Axis;
use crate::channel::{Channel, Link};
use crate::execution::QUEUE;
use crate::feeder::{Environment, Feeder, FeederConfig, Files, Reader};
use crate::natives::{Bound, Core, Frame, bind};
use background::{Half, Pump};
use takt_base::Nanos;
use takt_base::ring::ring;
use takt_image::{BindError, Cyclic, NativeCall, NativeImport, Natives, Trap, TypeTable};

/// Axes, channels and their function blocks.
pub struct Machine {
    core: Core,
    bound: Vec<Bound>,
    half: Half,
    trace: Trace,
    period: Nanos,
    deviation_max_mm: f64,
}

/// Commands and events that may wait between channel and feeder.
const LINK: usize = 16;

impl Machine {
    /// A machine whose part programs are RS274/NGC text. The configuration must be valid.
    pub fn new(config: &MachineConfig, files: Files, background: Background) -> Self {
        Self::with_reader(config, files, crate::feeder::ngc_reader(), background)
    }

    /// A machine whose part programs are read by `reader`. The configuration must be valid.
    pub fn with_reader(config: &MachineConfig, files: Files, reader: Reader, background: Background) -> Self {
        Self::with_environment(config, Environment::reading(files), reader, background)
    }

    /// A machine with everything that is around it. The configuration must be valid.
    pub fn with_environment(config: &MachineConfig, environment: Environment, reader: Reader, background: Background) -> Self {
        let dt = config.servo_period.as_secs();
        let mut axes: Vec<_> = config.axes.iter().map(|a| Axis::new(a.clone(), dt)).collect();
        let (mut channels, mut feeders) = (Vec::new(), Vec::new());
        for c in &config.channels {
            let (channel, feeder) = channel(config, c, dt);
            if channel.pulse_output().is_some() {
                channel.map().iter().flatten().for_each(|&i| axes[i].set_open_loop());
            }
            channels.push(channel);
            feeders.push(feeder);
        }
        let trace = Trace::new(axes.len(), config.trace_ticks);
        let half = Half::start(Pump { feeders, environment, reader }, background);
        let core = Core { axes, channels };
        Self { core, bound: Vec::new(), half, trace, period: config.servo_period, deviation_max_mm: 0.0 }
    }

    /// ST text of the types, blocks and globals of a machine.
    pub fn declarations(config: &MachineConfig) -> String {
        declarations::declarations(config)
    }

    /// Set and actual positions so far.
    pub fn trace(&self) -> &Trace {
        &self.trace
    }

    /// Axes and channels.
    pub fn core(&self) -> &Core {
        &self.core
    }

    /// Axes and channels, for tests and simulations that disturb them.
    pub fn core_mut(&mut self) -> &mut Core {
        &mut self.core
    }

    /// Reads part programs, with [`Background::Manual`]. False if there was nothing to do.
    pub fn pump(&mut self) -> bool {
        match &mut self.half {
            Half::Own(pump, _) => pump.pump(),
            Half::Thread(..) => false,
        }
    }

    /// Distance of the actual position from the path, where a channel moves its axes.
    fn measure(&mut self) {
        for channel in &self.core.channels {
            if !channel.has_axes() || channel.is_locked() || channel.pulse_output().is_some() {
                continue;
            }
            let mut p = channel.position();
            for (p, axis) in p.iter_mut().zip(channel.map()) {
                *p = axis.and_then(|i| self.core.axes.get(i)).map_or(*p, Axis::actual_position);
            }
            let off = channel.executor().deviation(&p);
            if off.is_finite() {
                self.deviation_max_mm = self.deviation_max_mm.max(off);
            }
        }
    }
}

/// Both halves of a channel.
fn channel(machine: &MachineConfig, config: &ChannelConfig, dt: f64) -> (Channel, Feeder) {
    let ((commands, command_rx), (event_tx, events), (out, steps)) = (ring(LINK), ring(LINK), ring(QUEUE));
    let pulse = match config.mode {
        ChannelMode::ReferencePulse { blu_mm, batch_max, .. } => Some((blu_mm, batch_max)),
        ChannelMode::Servo => None,
    };
    let feeder = FeederConfig {
        axes: machine.limits(config),
        work: machine.work(config),
        period_s: dt,
        pulse,
        check_on_load: config.check_on_load,
        modes: config.modes.clone(),
        language: config.language.clone(),
        subs: config.subs.clone(),
        parameter_file: config.parameter_file.clone(),
        tool_table: config.tool_table.clone(),
        dry_run_mm_s: config.dry_run_mm_min / 60.0,
    };
    let channel = Channel::new(config.clone(), machine.axis_map(config), dt, Link { commands, events, steps });
    (channel, Feeder::new(feeder, command_rx, event_tx, out))
}

impl Cyclic for Machine {
    fn period(&self) -> Option<Nanos> {
        (!self.core.axes.is_empty()).then_some(self.period)
    }

    fn tick(&mut self, now: Nanos) {
        if let Half::Own(pump, true) = &mut self.half {
            pump.pump();
        }
        let Core { axes, channels } = &mut self.core;
        channels.iter_mut().for_each(|c| c.tick(axes));
        axes.iter_mut().for_each(Axis::tick);
        channels.iter_mut().for_each(|c| c.refresh(axes));
        self.measure();
        self.trace.record(now, &self.core.axes);
    }

    fn exchange(&mut self, _: Nanos, memory: &mut [u8]) {
        self.core.channels.iter_mut().for_each(|c| c.exchange(memory));
    }

    fn safe_stop(&mut self) {
        self.core.channels.iter_mut().for_each(Channel::abort);
        self.core.axes.iter_mut().for_each(Axis::shut_down);
    }
}

impl Natives for Machine {
    fn bind(&mut self, import: &NativeImport, types: &TypeTable) -> Result<u32, BindError> {
        let bound = bind::bind(import, types)?;
        if bound.block.name == crate::cnc::cnc_aux_handshake::BLOCK.name {
            self.core.channels.iter_mut().for_each(Channel::listen);
        }
        self.bound.push(bound);
        Ok(self.bound.len() as u32 - 1)
    }

    fn call(&mut self, native: u32, call: &mut NativeCall) -> Result<(), Trap> {
        let bound = self.bound.get(native as usize).ok_or(Trap::Reference)?;
        let instance = call.u32(0);
        let mut frame = Frame::new(call.memory, instance, bound).ok_or(Trap::Memory)?;
        (bound.block.call)(&mut self.core, &mut frame);
        Ok(())
    }
}
