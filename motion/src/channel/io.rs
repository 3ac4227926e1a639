//! Inputs and outputs of a channel: what CNC_Io connects to the PLC program (M52, M62 .. M68, G38).
//! Runs: cyclic.

use crate::canon::Input;
use crate::run::outputs::{ANALOG, DIGITAL, Output};

/// The image of inputs and outputs.
#[derive(Clone, Debug)]
pub struct Io {
    /// Digital inputs.
    pub inputs: [bool; DIGITAL],
    /// Analog inputs.
    pub analog_inputs: [f64; ANALOG],
    /// Digital outputs.
    pub outputs: [bool; DIGITAL],
    /// Analog outputs.
    pub analog_outputs: [f64; ANALOG],
    /// The probe is in contact.
    pub probe: bool,
    /// Share of the feed that M52 lets through.
    pub adaptive: f64,
    /// Hold that M53 lets through.
    pub feed_hold: bool,
}

impl Default for Io {
    fn default() -> Self {
        Self {
            inputs: [false; DIGITAL],
            analog_inputs: [0.0; ANALOG],
            outputs: [false; DIGITAL],
            analog_outputs: [0.0; ANALOG],
            probe: false,
            adaptive: 1.0,
            feed_hold: false,
        }
    }
}

impl Io {
    /// An output gets a value.
    pub fn set(&mut self, output: &Output) {
        match *output {
            Output::Digital(i, on) => {
                if let Some(place) = self.outputs.get_mut(usize::from(i)) {
                    *place = on;
                }
            }
            Output::Analog(i, value) => {
                if let Some(place) = self.analog_outputs.get_mut(usize::from(i)) {
                    *place = value;
                }
            }
        }
    }

    fn digital(&self, input: &Input) -> bool {
        self.inputs.get(input.number as usize).copied().unwrap_or(false)
    }

    /// Value of an input as `#5399` shows it.
    pub fn value(&self, input: &Input) -> f64 {
        match input.analog {
            true => self.analog_inputs.get(input.number as usize).copied().unwrap_or(0.0),
            false => f64::from(u8::from(self.digital(input))),
        }
    }
}

/// M66 at work.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Waiting {
    input: Input,
    before: bool,
    left_s: f64,
}

impl Waiting {
    /// Begins to look.
    pub fn new(input: Input, io: &Io) -> Self {
        Self { input, before: io.digital(&input), left_s: input.timeout }
    }

    /// One period: the value for `#5399` as soon as the wait is over.
    pub fn tick(&mut self, io: &Io, dt: f64) -> Option<f64> {
        let now = io.digital(&self.input);
        let met = match self.input.wait {
            1 => now && !self.before,
            2 => !now && self.before,
            3 => now,
            4 => !now,
            _ => true,
        };
        self.before = now;
        if met {
            return Some(io.value(&self.input));
        }
        self.left_s -= dt;
        (self.left_s <= 0.0).then_some(-1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// M66 L0 .. L4 of LinuxCNC: at once, rise, fall, high, low; -1 after Q seconds.
    #[test]
    fn kinds_of_waiting() {
        let levels = [true, true, false, false, true, true];
        for (wait, want) in [(0, (0, 1.0)), (1, (4, 1.0)), (2, (2, 0.0)), (3, (0, 1.0)), (4, (2, 0.0))] {
            let mut io = Io::default();
            io.inputs[3] = levels[0];
            let mut w = Waiting::new(Input { number: 3, analog: false, wait, timeout: 1.0 }, &io);
            let found = levels.iter().enumerate().find_map(|(k, level)| {
                io.inputs[3] = *level;
                w.tick(&io, 0.001).map(|value| (k, value))
            });
            assert_eq!(found, Some(want), "L{wait}");
        }
        let io = Io::default();
        let mut w = Waiting::new(Input { number: 0, analog: false, wait: 3, timeout: 0.0025 }, &io);
        assert_eq!([w.tick(&io, 0.001), w.tick(&io, 0.001), w.tick(&io, 0.001)], [None, None, Some(-1.0)]);
    }
}
