//! The parallel-port axis driver, and a simulated device behind it: counters, converters, plotter.
//! Runs: cyclic. Memory for the record is taken at the start. From: PC-30..PC-36, tables 1 and 2.

use super::StepPort;
use crate::pulse::dda::Pulse;

/// Clock bits of X, Y, Z in the byte K.
pub const CLOCK: [u8; 3] = [1, 2, 4];
/// Direction bits; 1 counts up.
pub const UP: [u8; 3] = [8, 16, 32];
/// All clock bits.
const CLOCKS: u8 = 7;

/// The byte K of one iteration (PC-30, PC-31).
pub fn k_byte(pulse: &Pulse) -> u8 {
    let bits = |flags: &[bool; 3], masks: &[u8; 3]| (0..3).filter(|&i| flags[i]).map(|i| masks[i]).sum::<u8>();
    bits(&pulse.step, &CLOCK) | bits(&pulse.up, &UP)
}

/// Makes port writes of iterations: direction first, then the clock edge, then the clock low again (PC-32).
#[derive(Clone, Debug)]
pub struct StepDriver<P> {
    /// The port.
    pub port: P,
    last: u8,
    record: Vec<u8>,
    record_max: usize,
}

impl<P: StepPort> StepDriver<P> {
    /// Drives `port`, which is reset; keeps up to `record_max` bytes K (PC-25).
    pub fn new(mut port: P, record_max: usize) -> Self {
        port.reset();
        Self { port, last: 0, record: Vec::with_capacity(record_max), record_max }
    }

    /// One iteration.
    pub fn pulse(&mut self, pulse: &Pulse) {
        let k = k_byte(pulse);
        if (k ^ self.last) & !CLOCKS != 0 {
            self.port.write(k & !CLOCKS);
        }
        self.port.write(k);
        self.port.write(k & !CLOCKS);
        self.last = k & !CLOCKS;
        if self.record.len() < self.record_max {
            self.record.push(k);
        }
    }

    /// The bytes K so far.
    pub fn record(&self) -> &[u8] {
        &self.record
    }
}

/// Simulated interface: per axis an 8-bit up/down counter, a converter and a plotter axis (PC-34, PC-35).
#[derive(Clone, Debug, Default)]
pub struct SimulatedPort {
    data: u8,
    counters: [u8; 3],
    wrapped: [bool; 3],
    pulses_up: [u64; 3],
    pulses_down: [u64; 3],
    writes: u64,
    setup_errors: u64,
    resets: u32,
    max: [u8; 3],
}

/// Volts of one bit (PC-36).
pub const VOLTS_PER_BIT: f64 = 0.02;
/// Volts that move the pen by one centimetre (PC-34).
pub const VOLTS_PER_CM: f64 = 0.1;

impl SimulatedPort {
    /// Counter of each axis.
    pub fn counters(&self) -> [u8; 3] {
        self.counters
    }
    /// A counter passed its end (PC-35).
    pub fn wrapped(&self) -> [bool; 3] {
        self.wrapped
    }
    /// Highest count of each axis.
    pub fn max_counters(&self) -> [u8; 3] {
        self.max
    }
    /// Pulses counted up and down.
    pub fn pulses(&self) -> ([u64; 3], [u64; 3]) {
        (self.pulses_up, self.pulses_down)
    }
    /// Bytes written.
    pub fn writes(&self) -> u64 {
        self.writes
    }
    /// Clock edges that came together with a change of their direction bit: the hardware would count at random.
    pub fn setup_errors(&self) -> u64 {
        self.setup_errors
    }
    /// Reset pulses.
    pub fn resets(&self) -> u32 {
        self.resets
    }
    /// Output of each converter in volts.
    pub fn volts(&self) -> [f64; 3] {
        self.counters.map(|c| f64::from(c) * VOLTS_PER_BIT)
    }
    /// Pen position in centimetres.
    pub fn pen_cm(&self) -> [f64; 2] {
        let [x, y, _] = self.volts().map(|v| v / VOLTS_PER_CM);
        [x, y]
    }

    fn count(&mut self, i: usize, up: bool) {
        let (next, wrap) = if up { self.counters[i].overflowing_add(1) } else { self.counters[i].overflowing_sub(1) };
        self.counters[i] = next;
        self.wrapped[i] |= wrap;
        self.max[i] = self.max[i].max(next);
        let pulses = if up { &mut self.pulses_up } else { &mut self.pulses_down };
        pulses[i] += 1;
    }
}

impl StepPort for SimulatedPort {
    fn write(&mut self, data: u8) {
        let rising = data & !self.data;
        let changed = data ^ self.data;
        for i in 0..3 {
            if rising & CLOCK[i] != 0 {
                self.setup_errors += u64::from(changed & UP[i] != 0);
                self.count(i, data & UP[i] != 0);
            }
        }
        self.data = data;
        self.writes += 1;
    }

    fn reset(&mut self) {
        self.counters = [0; 3];
        self.wrapped = [false; 3];
        self.resets += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pc_30_bits() {
        assert_eq!(k_byte(&Pulse { step: [true, true, false], up: [true, true, false] }), 27);
        assert_eq!(k_byte(&Pulse { step: [false, true, false], up: [true, true, false] }), 26);
        assert_eq!(k_byte(&Pulse { step: [true, false, true], up: [false, false, true] }), 37);
    }

    /// PC-32: two writes a pulse; a change of direction is written ahead of the edge.
    #[test]
    fn pc_32_writes() {
        let mut driver = StepDriver::new(SimulatedPort::default(), 10);
        let x = |up| Pulse { step: [true, false, false], up: [up, false, false] };
        driver.pulse(&x(true));
        driver.pulse(&x(true));
        driver.pulse(&x(false));
        assert_eq!((driver.port.writes(), driver.port.setup_errors()), (8, 0));
        assert_eq!((driver.port.counters(), driver.record()), ([1, 0, 0], &[9, 9, 1][..]));
    }

    /// PC-33, PC-34, PC-35
    #[test]
    fn pc_35_counters_wrap_and_plot() {
        let mut driver = StepDriver::new(SimulatedPort::default(), 0);
        let up = Pulse { step: [false, true, false], up: [false, true, false] };
        (0..150).for_each(|_| driver.pulse(&up));
        let [_, y] = driver.port.pen_cm();
        assert!((y - 30.0).abs() < 1e-9);
        (0..106).for_each(|_| driver.pulse(&up));
        assert_eq!((driver.port.counters()[1], driver.port.wrapped()[1]), (0, true));
        driver.port.reset();
        assert_eq!((driver.port.wrapped()[1], driver.port.resets()), (false, 2));
    }
}
