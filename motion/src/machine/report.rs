//! What a machine has done, in numbers: for the command line and the operator panel.
//! Runs: background or between ticks.

use super::Machine;
use crate::axis::AxisState;
use crate::channel::CncState;
use takt_base::Code;

/// A picture of the machine.
#[derive(Clone, PartialEq, Debug)]
pub struct MachineReport {
    /// Axes in the order of the configuration.
    pub axes: Vec<AxisReport>,
    /// Channels in the order of the configuration.
    pub channels: Vec<ChannelReport>,
    /// Largest distance of the actual position from the commanded path so far, in mm.
    pub path_deviation_max_mm: f64,
}

/// An axis.
#[derive(Clone, PartialEq, Debug)]
pub struct AxisReport {
    /// Name.
    pub name: String,
    /// State.
    pub state: AxisState,
    /// Set position in mm.
    pub set_mm: f64,
    /// Actual position in mm.
    pub actual_mm: f64,
    /// Lag of the servo loop in mm.
    pub following_error_mm: f64,
    /// A home position is known.
    pub homed: bool,
    /// Why it is in ErrorStop.
    pub error: Option<Code>,
}

/// A channel.
#[derive(Clone, PartialEq, Debug)]
pub struct ChannelReport {
    /// Name.
    pub name: String,
    /// State.
    pub state: CncState,
    /// Blocks of the part program that were begun in the last run.
    pub blocks: u32,
    /// Feed path length of the last run in mm.
    pub feed_mm: f64,
    /// Ticks of the last run in which the path braked or stood because the background had fallen behind; 0 in virtual time.
    pub late_ticks: u32,
    /// Line in execution; 0: none.
    pub line: u32,
    /// Programs that ran to their end.
    pub part_count: u32,
    /// Last error.
    pub error: Option<ChannelError>,
    /// Reference pulses, in that mode.
    pub pulses: Option<PulseReport>,
}

/// An error with its place in the part program.
#[derive(Clone, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub struct ChannelError {
    pub code: Code,
    pub line: u32,
    pub column: u32,
    pub text: String,
}

/// Reference pulses of a channel.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct PulseReport {
    /// Pulses up of X, Y, Z.
    pub up: [u64; 3],
    /// Pulses down.
    pub down: [u64; 3],
    /// 8-bit counters of the simulated interface.
    pub counters: [u8; 3],
    /// A counter wrapped.
    pub wrapped: [bool; 3],
    /// Iterations in all.
    pub iterations: u64,
    /// Most iterations in one tick (PC-13).
    pub batch_max: u32,
}

impl Machine {
    /// The picture now.
    pub fn report(&self) -> MachineReport {
        let axes = self.core.axes.iter().map(|a| AxisReport {
            name: a.config().name.clone(),
            state: a.state(),
            set_mm: a.set_position(),
            actual_mm: a.actual_position(),
            following_error_mm: a.following_error(),
            homed: a.is_homed(),
            error: a.error(),
        });
        MachineReport {
            axes: axes.collect(),
            channels: self.core.channels.iter().map(channel).collect(),
            path_deviation_max_mm: self.deviation_max_mm,
        }
    }
}

fn channel(c: &crate::channel::Channel) -> ChannelReport {
    let error = c.error().map(|n| ChannelError { code: n.code, line: n.line, column: n.column, text: n.message().to_owned() });
    let pulses = c.pulse_output().map(|p| {
        let ((up, down), (batch_max, iterations)) = (p.driver.port.pulses(), p.batch());
        PulseReport { up, down, counters: p.driver.port.counters(), wrapped: p.driver.port.wrapped(), iterations, batch_max }
    });
    ChannelReport {
        name: c.config().name.clone(),
        state: c.state(),
        blocks: c.executor().blocks,
        feed_mm: c.feed_mm(),
        late_ticks: c.executor().late_ticks,
        line: c.mark().line,
        part_count: c.part_count(),
        error,
        pulses,
    }
}
