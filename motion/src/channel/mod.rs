//! A CNC channel: runs a part program on its axes.
//! Runs: cyclic. No allocation. The background half is [`crate::feeder`]; both meet in three rings.
//! Invariant: whatever ends a program, the axes stop on the path. From: N1..N10, CNC function blocks.

mod act;
pub mod aux;
pub mod commands;
pub mod io;
pub mod modes;
pub mod pulses;
pub mod questions;
pub mod state;
pub mod typed;

pub use state::{CncEvent, CncState};

use crate::axis::commands::History;
use crate::axis::{Axis, AxisState, CommandId, Outcome};
use crate::execution::{Demand, PathExecutor, Reached};
use crate::feeder::{Command, Event};
use crate::geometry::{AXES, Point};
use crate::machine::config::ChannelConfig;
use crate::segment::{AuxCodes, ErrorNote, Mark, Planned};
use crate::spindle::Spindle;
use aux::Aux;
use io::{Io, Waiting};
use modes::{Modes, Panel};
use pulses::PulseOutput;
use questions::{Exchange, ProbeResult};
use takt_base::Code;
use takt_base::ring::{Rx, Tx};

/// Cyclic ends of the rings to the feeder.
pub struct Link {
    /// To the feeder.
    pub commands: Tx<Command>,
    /// From the feeder.
    pub events: Rx<Event>,
    /// The planned program.
    pub steps: Rx<Planned>,
}

/// What the channel waits for in AuxWait.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Wait {
    Codes,
    /// Confirmation of M2 or M30.
    End,
    /// M66.
    Input(Waiting),
}

/// A load request and its end.
#[derive(Clone, Copy, Debug)]
enum Load {
    Idle,
    Pending(u32),
    Done { request: u32, lines: u32 },
    Failed { request: u32, code: Code },
}

/// One channel.
pub struct Channel {
    config: ChannelConfig,
    map: [Option<usize>; AXES],
    dt: f64,
    link: Link,
    state: CncState,
    executor: PathExecutor,
    pulses: Option<PulseOutput>,
    /// Handshake with the PLC program.
    pub aux: Aux,
    wait: Wait,
    demand: Demand,
    hold: bool,
    /// The axes belong to this channel.
    joined: bool,
    run: u32,
    command: CommandId,
    history: History,
    load: Load,
    requests: u32,
    program_id: u32,
    mark: Mark,
    error: Option<ErrorNote>,
    stop_code: Option<u16>,
    part_count: u32,
    listened: bool,
    /// FaultID of CNC_AuxHandshake.
    fault_id: u16,
    /// Inputs and outputs.
    pub io: Io,
    /// The simulated spindle.
    pub spindle: Spindle,
    exchange: Exchange,
    probe: ProbeResult,
    modes: Modes,
    panel: Panel,
    pressed: Result<(), Code>,
    /// Those that the program was started with.
    started: Modes,
    /// One block is wanted.
    step: bool,
    /// The next block is kept back.
    kept_back: bool,
    /// One block or a subroutine runs, not the program.
    typed: bool,
    check: typed::Check,
    returned: f64,
}

impl Channel {
    /// A channel whose axes are `map`.
    pub fn new(config: ChannelConfig, map: [Option<usize>; AXES], dt: f64, link: Link) -> Self {
        Self {
            map,
            dt,
            link,
            state: CncState::NotReady,
            executor: PathExecutor::new([0.0; AXES]),
            pulses: PulseOutput::new(&config.mode),
            aux: Aux::default(),
            wait: Wait::Codes,
            demand: Demand::default(),
            hold: false,
            joined: false,
            run: 0,
            command: CommandId::NONE,
            history: History::default(),
            load: Load::Idle,
            requests: 0,
            program_id: 0,
            mark: Mark::default(),
            error: None,
            stop_code: None,
            part_count: 0,
            listened: false,
            fault_id: 0,
            io: Io::default(),
            spindle: Spindle::new(config.spindle_accel_rpm_s / 60.0),
            exchange: Exchange::default(),
            probe: ProbeResult::default(),
            modes: Modes::default(),
            panel: Panel::default(),
            pressed: Ok(()),
            started: Modes::default(),
            step: false,
            kept_back: false,
            typed: false,
            check: typed::Check::Idle,
            returned: 0.0,
            config,
        }
    }

    /// State.
    pub fn state(&self) -> CncState {
        self.state
    }
    /// Configuration.
    pub fn config(&self) -> &ChannelConfig {
        &self.config
    }
    /// Axes by path coordinate.
    pub fn map(&self) -> &[Option<usize>; AXES] {
        &self.map
    }
    /// Place in the part program that is being executed.
    pub fn mark(&self) -> Mark {
        self.mark
    }
    /// The last error, with line and column.
    pub fn error(&self) -> Option<&ErrorNote> {
        self.error.as_ref()
    }
    /// ErrorID of the last error; 0: none.
    pub fn error_id(&self) -> u16 {
        match &self.error {
            Some(_) if self.fault_id != 0 => self.fault_id,
            Some(note) => run_code(note.code).error_id(),
            None => 0,
        }
    }
    /// The path and its place.
    pub fn executor(&self) -> &PathExecutor {
        &self.executor
    }
    /// The step interface, in reference-pulse mode.
    pub fn pulse_output(&self) -> Option<&PulseOutput> {
        self.pulses.as_ref()
    }
    /// Programs that ran to their end.
    pub fn part_count(&self) -> u32 {
        self.part_count
    }
    /// Number of the loaded program; 0: none.
    pub fn program_id(&self) -> u32 {
        self.program_id
    }
    /// The M code of a program stop in force: 0 or 1.
    pub fn stop_code(&self) -> Option<u16> {
        self.stop_code.filter(|_| self.state == CncState::ProgStop)
    }
    /// Override of feed moves in force.
    pub fn feed_override(&self) -> f64 {
        self.demand.feed
    }
    /// Path speed in mm/s.
    pub fn speed(&self) -> f64 {
        self.executor.speed()
    }
    /// Feed path length of the run so far in mm.
    pub fn feed_mm(&self) -> f64 {
        self.executor.feed_mm + self.pulses.as_ref().map_or(0.0, |p| p.feed_mm)
    }
    /// True if the axes follow this channel.
    pub fn has_axes(&self) -> bool {
        self.joined
    }

    /// One servo period: sets the positions of the axes.
    pub fn tick(&mut self, axes: &mut [Axis]) {
        self.take_events();
        self.watch(axes);
        let at = self.position();
        self.spindle.tick(self.dt, &at);
        if !self.joined {
            // Left-overs of an aborted run make room for the next. What comes while they go waits for the next tick.
            (0..self.link.steps.len()).map_while(|_| self.link.steps.pop()).for_each(drop);
            return;
        }
        self.executor.fill(&mut self.link.steps, self.run);
        self.aux_tick();
        self.look_at_probe(axes);
        self.release_block();
        self.path_tick();
        self.probed();
        self.drive(axes);
        self.rest_tick(axes);
    }

    /// After the axes have ticked: what the program sees of both in the next scan fits together.
    pub fn refresh(&mut self, axes: &[Axis]) {
        if !self.joined {
            self.watch(axes);
        }
    }

    fn event(&mut self, event: CncEvent) -> bool {
        let next = state::next(self.state, event);
        self.state = next.unwrap_or(self.state);
        next.is_some()
    }

    fn take_events(&mut self) {
        while let Some(event) = self.link.events.pop() {
            match (event, self.load) {
                (Event::Loaded { request, lines }, Load::Pending(r)) if r == request => {
                    self.load = Load::Done { request, lines };
                    self.program_id = request;
                    self.event(CncEvent::Loaded);
                }
                (Event::LoadFailed { request, note }, Load::Pending(r)) if r == request => {
                    let code = if note.code == Code::ProgramFile { Code::ProgramFile } else { Code::ProgramError };
                    self.load = Load::Failed { request, code };
                    self.error = Some(note);
                }
                (Event::NotStored(note), _) => self.error = Some(note),
                (event, _) => self.take_typed(&event),
            }
        }
    }

    fn axes<'a>(&self, axes: &'a [Axis]) -> impl Iterator<Item = &'a Axis> {
        let map = self.map;
        map.into_iter().flatten().filter_map(|i| axes.get(i))
    }

    /// N1, and what happens to the axes while a program has them.
    fn watch(&mut self, axes: &[Axis]) {
        let lost = self.axes(axes).any(|a| matches!(a.state(), AxisState::Disabled | AxisState::ErrorStop));
        if !self.joined {
            let ready = if self.program_id == 0 { CncEvent::AxesReady } else { CncEvent::AxesReadyLoaded };
            self.event(if lost { CncEvent::AxesLost } else { ready });
            return;
        }
        let failed = self.axes(axes).find_map(|a| if a.state() == AxisState::ErrorStop { a.error() } else { None });
        if let Some(code) = failed {
            if self.state != CncState::Fault {
                self.fail(ErrorNote::new(code, self.mark.line, 1, code.title()));
            }
        } else if self.axes(axes).any(|a| a.state() != AxisState::SynchronizedMotion) {
            self.abort_run();
        }
    }

    fn aux_tick(&mut self) {
        if self.state != CncState::AuxWait {
            return;
        }
        if let Wait::Input(waiting) = self.wait {
            return self.input_tick(waiting);
        }
        if self.aux.take_finished() {
            match (self.wait, self.hold) {
                (Wait::End, _) => self.end_program(),
                (_, false) => drop(self.event(CncEvent::Finished)),
                (_, true) => drop(self.event(CncEvent::FinishedHeld)),
            }
        } else if self.aux.wait(self.dt, self.config.aux_timeout_s) {
            self.fail(ErrorNote::new(Code::AuxTimeout, self.mark.line, 1, Code::AuxTimeout.title()));
        }
    }

    /// True if the path may go on.
    fn is_moving_state(&self) -> bool {
        matches!(self.state, CncState::Running | CncState::Holding | CncState::Aborting | CncState::Fault)
    }

    fn path_tick(&mut self) {
        if !self.is_moving_state() {
            return;
        }
        let mut demand = self.demand_now();
        let mut left = self.dt;
        if let Some(p) = &mut self.pulses {
            p.begin_tick(left);
        }
        for _ in 0..2 * crate::execution::QUEUE {
            if let Some(p) = &mut self.pulses
                && !p.advance(demand.hold)
            {
                break;
            }
            let reached = self.executor.advance(left, &demand);
            self.mark = self.executor.mark();
            if self.executor.take_reversal() {
                self.spindle.reverse();
            }
            match reached {
                // What was done may change what the path sees: the sense of the spindle, for one.
                Reached::Action(step, rest) if self.act(&step) => (left, demand) = (rest, self.demand_now()),
                reached => {
                    if reached == Reached::Block {
                        self.block_end();
                    }
                    if let Some(p) = &mut self.pulses {
                        p.rest();
                    }
                    break;
                }
            }
        }
    }

    fn wait_for(&mut self, codes: AuxCodes, wait: Wait) -> bool {
        self.aux.begin(codes);
        self.wait = wait;
        self.event(CncEvent::Wait);
        false
    }

    fn end_program(&mut self) {
        self.event(CncEvent::End);
        self.part_count = self.part_count.saturating_add(u32::from(!self.typed));
        self.history.end(self.command, Outcome::Done);
        self.step = false;
        // A full ring means that the feeder is behind; then it keeps what it had before.
        let _ = self.link.commands.push(Command::Ended { run: self.run });
        if self.program_id == 0 {
            self.state = CncState::Idle;
        }
    }

    fn fail(&mut self, note: ErrorNote) {
        self.event(CncEvent::Fault);
        self.history.end(self.command, Outcome::Error(run_code(note.code)));
        self.error = Some(note);
        self.stop_feeding();
    }

    fn abort_run(&mut self) {
        if self.state.is_active() && self.state != CncState::Aborting {
            self.event(CncEvent::Abort);
            self.history.end(self.command, Outcome::Aborted);
            self.stop_feeding();
        }
    }

    fn stop_feeding(&mut self) {
        self.aux.cancel();
        self.hold = false;
        self.step = false;
        self.spindle.stop();
        self.forget_exchange();
        // A full ring means that the feeder is behind; the number of the next run makes what it still sends harmless.
        let _ = self.link.commands.push(Command::Abort);
    }

    /// The path at rest ends a hold, an abort, a fault and a program.
    fn rest_tick(&mut self, axes: &mut [Axis]) {
        if !self.is_at_rest() {
            return;
        }
        match self.state {
            CncState::Holding => drop(self.event(CncEvent::AtRest)),
            CncState::Aborting => {
                self.event(CncEvent::AtRest);
                self.release(axes);
            }
            CncState::Idle | CncState::Ready | CncState::Fault => self.release(axes),
            _ => {}
        }
    }

    fn is_at_rest(&self) -> bool {
        self.executor.is_held() && self.pulses.as_ref().is_none_or(|p| !p.is_busy() || p.is_held())
    }

    fn release(&mut self, axes: &mut [Axis]) {
        self.joined = false;
        if let Some(p) = &mut self.pulses {
            p.abort();
        }
        self.executor.halt();
        for axis in self.map.iter().flatten() {
            if let Some(axis) = axes.get_mut(*axis) {
                axis.leave();
            }
        }
    }

    /// Set positions of the axes.
    fn drive(&self, axes: &mut [Axis]) {
        let position = self.position();
        for (i, (p, axis)) in position.iter().zip(self.map).enumerate() {
            if let Some(axis) = axis.and_then(|i| axes.get_mut(i)) {
                axis.follow(if self.has_lock(i) { axis.set_position() } else { *p });
            }
        }
    }

    /// Set position of the path.
    pub fn position(&self) -> Point {
        match &self.pulses {
            Some(p) => p.position(),
            None => self.executor.position(),
        }
    }
}

/// ErrorID of CNC_Run for an error: that of a part program is F0601 whatever its own code is.
fn run_code(code: Code) -> Code {
    if code.error_id() == 0 { Code::ProgramError } else { code }
}
