//! What a run looks like while it goes on: a line that is renewed on a terminal, a line now and then elsewhere.

use crate::duration::show;
use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};
use takt_base::Nanos;
use takt_base::ring::{Rx, Tx};
use takt_motion::channel::CncState;
use takt_motion::machine::Machine;
use takt_runtime::ScanInfo;

/// Axes that are shown.
const AXES: usize = 3;
/// Time between two looks at the machine.
const PERIOD: Nanos = Nanos::from_millis(50);

/// What the program thread tells. Small and without heap, so that it can be made between two scans.
#[derive(Clone, Copy, Debug)]
pub struct Sight {
    now: Nanos,
    scans: u64,
    channel: Option<(CncState, u32)>,
    positions: [Option<f64>; AXES],
}

/// The sending half, on the program thread.
pub struct Reporter {
    tx: Tx<Sight>,
    next: Nanos,
}

impl Reporter {
    /// Sends at most every [`PERIOD`]; when nobody listens, nothing is lost but the sight. Runs: cyclic.
    pub fn send(&mut self, scan: &ScanInfo, machine: &Machine) {
        if scan.now < self.next {
            return;
        }
        self.next = scan.now + PERIOD;
        let core = machine.core();
        let mut positions = [None; AXES];
        positions.iter_mut().zip(&core.axes).for_each(|(p, a)| *p = Some(a.actual_position()));
        let channel = core.channels.first().map(|c| (c.state(), c.mark().line));
        let _ = self.tx.push(Sight { now: scan.now, scans: scan.scan, channel, positions });
    }
}

/// Both halves.
pub fn channel() -> (Reporter, Rx<Sight>) {
    let (tx, rx) = takt_base::ring::ring(64);
    (Reporter { tx, next: Nanos::ZERO }, rx)
}

/// The showing half.
pub struct Display {
    rx: Rx<Sight>,
    terminal: bool,
    last: Option<Instant>,
    channel: Option<CncState>,
}

impl Display {
    /// On stderr.
    pub fn new(rx: Rx<Sight>) -> Self {
        Self { rx, terminal: std::io::stderr().is_terminal(), last: None, channel: None }
    }

    /// Shows what came, with the time of the last scan. Elsewhere than on a terminal: when the state changes, and every second.
    pub fn show(&mut self, last_scan: Nanos) {
        while let Some(sight) = self.rx.pop() {
            let state = sight.channel.map(|(s, _)| s);
            let news = state != self.channel || self.last.is_none_or(|t| t.elapsed() > Duration::from_secs(1));
            if self.terminal {
                eprint!("\r\x1b[K{}", line(&sight, last_scan));
                let _ = std::io::stderr().flush();
            } else if news {
                eprintln!("{}", line(&sight, last_scan));
                self.last = Some(Instant::now());
            }
            self.channel = state;
        }
    }

    /// Leaves the line.
    pub fn close(&mut self) {
        if self.terminal {
            eprint!("\r\x1b[K");
        }
    }
}

fn line(s: &Sight, last_scan: Nanos) -> String {
    let mut text = format!("{:7.2} s  scan {} ({})", s.now.as_secs(), s.scans, show(last_scan));
    if let Some((state, block)) = s.channel {
        text += &format!("  {state:?}  line {block}");
    }
    let positions: Vec<_> = s.positions.iter().flatten().map(|p| format!("{p:8.3}")).collect();
    if !positions.is_empty() {
        text += &format!("  at ({})", positions.join(","));
    }
    text
}
