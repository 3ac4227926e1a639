//! What the machine is made of: plain data, read from the project file by the command line.
//! Runs: before the start. Units are in the names. `validate` says everything that is wrong, in sentences.

use crate::lookahead::AxisLimits;
use crate::pulse::dda::Preload;
use crate::run::Work;
use takt_base::Nanos;

/// A machine.
#[derive(Clone, PartialEq, Debug)]
pub struct MachineConfig {
    /// Servo period.
    pub servo_period: Nanos,
    /// Axes; `AXIS_REF.AxisNo` counts from 1 in this order.
    pub axes: Vec<AxisConfig>,
    /// CNC channels; `CNC_REF.ChannelNo` counts from 1.
    pub channels: Vec<ChannelConfig>,
    /// Ticks that the trace holds; 0: no trace.
    pub trace_ticks: usize,
}

impl Default for MachineConfig {
    fn default() -> Self {
        Self { servo_period: Nanos::from_millis(1), axes: Vec::new(), channels: Vec::new(), trace_ticks: 200_000 }
    }
}

/// An axis: one drive.
#[derive(Clone, PartialEq, Debug)]
pub struct AxisConfig {
    /// Name of the AXIS_REF variable.
    pub name: String,
    /// Axis letter in part programs: X, Y, Z, A, B, C.
    pub letter: char,
    /// Highest speed.
    pub v_max_mm_s: f64,
    /// Highest acceleration and deceleration.
    pub a_max_mm_s2: f64,
    /// Lower software limit.
    pub travel_min_mm: f64,
    /// Upper software limit.
    pub travel_max_mm: f64,
    /// Encoder resolution; 0: exact.
    pub encoder_resolution_mm: f64,
    /// Position loop, proportional gain in 1/s.
    pub kp: f64,
    /// Integral gain in 1/s2.
    pub ki: f64,
    /// Derivative gain.
    pub kd: f64,
    /// Velocity feed-forward, share of the set velocity.
    pub kff_velocity: f64,
    /// Acceleration feed-forward in seconds; the time constant of the drive cancels its lag.
    pub kff_acceleration: f64,
    /// Time constant of the simulated velocity loop.
    pub plant_time_constant_s: f64,
    /// Following error that stops the axis; 0: not watched.
    pub following_error_max_mm: f64,
    /// From enable to power.
    pub drive_enable_delay_s: f64,
}

impl Default for AxisConfig {
    fn default() -> Self {
        Self {
            name: "X".to_owned(),
            letter: 'X',
            v_max_mm_s: 500.0,
            a_max_mm_s2: 5000.0,
            travel_min_mm: -1000.0,
            travel_max_mm: 1000.0,
            encoder_resolution_mm: 0.001,
            kp: 100.0,
            ki: 0.0,
            kd: 0.0,
            kff_velocity: 1.0,
            kff_acceleration: 0.002,
            plant_time_constant_s: 0.002,
            following_error_max_mm: 1.0,
            drive_enable_delay_s: 0.05,
        }
    }
}

impl AxisConfig {
    /// The defaults under this name; the letter is that of the name if it is one.
    pub fn named(name: &str) -> Self {
        let first = name.chars().next_back().unwrap_or('X').to_ascii_uppercase();
        let letter = if letter_index(first).is_some() { first } else { 'X' };
        Self { name: name.to_owned(), letter, ..Self::default() }
    }
}

/// How a channel drives its axes.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum ChannelMode {
    /// Planned set points at the servo period.
    #[default]
    Servo,
    /// Reference pulses to a step interface, open loop (PC-07).
    ReferencePulse {
        /// Basic length unit.
        blu_mm: f64,
        /// Start of the accumulators.
        preload: Preload,
        /// Most iterations in one tick (PC-13).
        batch_max: u32,
        /// Bytes of the output record (PC-25); 0: none.
        record_max: usize,
    },
}

/// A CNC channel.
#[derive(Clone, PartialEq, Debug)]
pub struct ChannelConfig {
    /// Name of the CNC_REF variable.
    pub name: String,
    /// Names of its axes.
    pub axes: Vec<String>,
    /// How it drives them.
    pub mode: ChannelMode,
    /// M, S and T codes wait for CNC_AuxHandshake, if the PLC program has one.
    pub handshake: bool,
    /// Longest wait for it; 0: for ever.
    pub aux_timeout_s: f64,
    /// M1 stops.
    pub optional_stop: bool,
    /// The axes must be homed before a program runs.
    pub require_homed: bool,
    /// Codes that stand before every program, such as `G17 G21 G91`.
    pub modes: String,
    /// Dialect, strictness and settings of its part programs.
    pub language: crate::ngc::Language,
    /// CNC_LoadProgram reads the whole program and refuses a wrong one.
    pub check_on_load: bool,
    /// Folders where subroutines are looked for, behind the folder of the program.
    pub subs: Vec<String>,
    /// File of the parameters; without one they last as long as the machine.
    pub parameter_file: Option<String>,
    /// File of the tools; without one every tool is allowed and has no offsets.
    pub tool_table: Option<String>,
    /// Feed of the dry run.
    pub dry_run_mm_min: f64,
    /// Acceleration of the simulated spindle in revolutions a minute per second; 0: it has its speed at once.
    pub spindle_accel_rpm_s: f64,
}

impl Default for ChannelConfig {
    fn default() -> Self {
        Self {
            name: "Cnc".to_owned(),
            axes: Vec::new(),
            mode: ChannelMode::Servo,
            handshake: false,
            aux_timeout_s: 0.0,
            optional_stop: false,
            require_homed: false,
            modes: String::new(),
            language: crate::ngc::Language::default(),
            check_on_load: true,
            subs: Vec::new(),
            parameter_file: None,
            tool_table: None,
            dry_run_mm_min: 3000.0,
            spindle_accel_rpm_s: 6000.0,
        }
    }
}

/// Path coordinate of an axis letter.
pub fn letter_index(letter: char) -> Option<usize> {
    "XYZABC".find(letter.to_ascii_uppercase())
}

impl MachineConfig {
    /// Everything that is wrong, one sentence each.
    pub fn validate(&self) -> Result<(), Vec<String>> {
        let mut wrong = Vec::new();
        if !(Nanos::from_micros(10)..=Nanos::from_millis(100)).contains(&self.servo_period) {
            wrong.push("the servo period must lie between 10 us and 100 ms".to_owned());
        }
        self.check_names(&mut wrong);
        self.axes.iter().for_each(|a| a.check(&mut wrong));
        self.channels.iter().for_each(|c| self.check_channel(c, &mut wrong));
        if wrong.is_empty() { Ok(()) } else { Err(wrong) }
    }

    fn check_names(&self, wrong: &mut Vec<String>) {
        let names: Vec<_> = self.axes.iter().map(|a| &a.name).chain(self.channels.iter().map(|c| &c.name)).collect();
        for (i, name) in names.iter().enumerate() {
            let letters = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
            if !letters || name.starts_with(|c: char| c.is_ascii_digit()) || name.is_empty() {
                wrong.push(format!("`{name}` can't be the name of a variable"));
            }
            if names[..i].iter().any(|n| n.eq_ignore_ascii_case(name)) {
                wrong.push(format!("two axes or channels are called `{name}`"));
            }
        }
    }

    fn check_channel(&self, channel: &ChannelConfig, wrong: &mut Vec<String>) {
        let mut seen = [false; 6];
        for name in &channel.axes {
            let Some(axis) = self.axis_index(name).and_then(|i| self.axes.get(i)) else {
                wrong.push(format!("channel `{}` names the axis `{name}`, which does not exist", channel.name));
                continue;
            };
            if let Some(i) = letter_index(axis.letter) {
                if seen[i] {
                    wrong.push(format!("channel `{}` has two axes with the letter {}", channel.name, axis.letter));
                }
                seen[i] = true;
            }
            let users = self.channels.iter().flat_map(|c| &c.axes).filter(|n| n.eq_ignore_ascii_case(name)).count();
            if users > 1 {
                wrong.push(format!("axis `{name}` belongs to more than one channel"));
            }
        }
        if channel.axes.is_empty() {
            wrong.push(format!("channel `{}` has no axes", channel.name));
        }
        if let ChannelMode::ReferencePulse { blu_mm, batch_max, .. } = channel.mode
            && (!(blu_mm > 0.0 && blu_mm.is_finite()) || batch_max == 0)
        {
            wrong.push(format!("channel `{}`: basic length unit and largest batch must be positive", channel.name));
        }
        if !(channel.dry_run_mm_min > 0.0 && channel.dry_run_mm_min.is_finite()) {
            wrong.push(format!("channel `{}`: dry_run_mm_min must be positive", channel.name));
        }
        if !(channel.spindle_accel_rpm_s >= 0.0 && channel.spindle_accel_rpm_s.is_finite()) {
            wrong.push(format!("channel `{}`: spindle_accel_rpm_s must not be negative", channel.name));
        }
        if !(channel.aux_timeout_s >= 0.0 && channel.aux_timeout_s.is_finite()) {
            wrong.push(format!("channel `{}`: aux_timeout_s must not be negative", channel.name));
        }
    }

    /// Number of the axis of this name, from 0.
    pub fn axis_index(&self, name: &str) -> Option<usize> {
        self.axes.iter().position(|a| a.name.eq_ignore_ascii_case(name))
    }

    /// For each path coordinate the axis of a channel.
    pub fn axis_map(&self, channel: &ChannelConfig) -> [Option<usize>; 6] {
        let mut map = [None; 6];
        for name in &channel.axes {
            if let Some(axis) = self.axis_index(name)
                && let Some(i) = letter_index(self.axes[axis].letter)
            {
                map[i] = Some(axis);
            }
        }
        map
    }

    /// Limits of the axes of a channel.
    pub fn limits(&self, channel: &ChannelConfig) -> AxisLimits {
        let map = self.axis_map(channel);
        let of = |f: fn(&AxisConfig) -> f64| map.map(|i| i.and_then(|i| self.axes.get(i)).map_or(f64::INFINITY, f));
        AxisLimits { v: of(|a| a.v_max_mm_s), a: of(|a| a.a_max_mm_s2) }
    }

    /// What a part program on this channel may ask for.
    pub fn work(&self, channel: &ChannelConfig) -> Work {
        let map = self.axis_map(channel);
        let axis = |i: Option<usize>| i.and_then(|i| self.axes.get(i));
        Work {
            exists: map.map(|i| i.is_some()),
            min: map.map(|i| axis(i).map_or(f64::NEG_INFINITY, |a| a.travel_min_mm)),
            max: map.map(|i| axis(i).map_or(f64::INFINITY, |a| a.travel_max_mm)),
            handshake: channel.handshake,
        }
    }
}

impl AxisConfig {
    fn check(&self, wrong: &mut Vec<String>) {
        let mut need = |ok: bool, what: &str| {
            if !ok {
                wrong.push(format!("axis `{}`: {what}", self.name));
            }
        };
        let positive = |v: f64| v > 0.0 && v.is_finite();
        let not_negative = |v: f64| v >= 0.0 && v.is_finite();
        need(letter_index(self.letter).is_some(), "the letter must be one of X, Y, Z, A, B, C");
        need(positive(self.v_max_mm_s), "v_max_mm_s must be positive");
        need(positive(self.a_max_mm_s2), "a_max_mm_s2 must be positive");
        need(self.travel_min_mm < self.travel_max_mm, "travel_min_mm must be below travel_max_mm");
        need(positive(self.kp), "kp must be positive");
        let rest = [
            (self.encoder_resolution_mm, "encoder_resolution_mm"),
            (self.ki, "ki"),
            (self.kd, "kd"),
            (self.kff_velocity, "kff_velocity"),
            (self.kff_acceleration, "kff_acceleration"),
            (self.plant_time_constant_s, "plant_time_constant_s"),
            (self.following_error_max_mm, "following_error_max_mm"),
            (self.drive_enable_delay_s, "drive_enable_delay_s"),
        ];
        for (value, name) in rest {
            need(not_negative(value), &format!("{name} must not be negative"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_are_valid_and_mistakes_are_named() {
        let mut config = MachineConfig {
            axes: vec![AxisConfig::named("X"), AxisConfig::named("AxisY")],
            channels: vec![ChannelConfig { axes: vec!["x".into(), "AxisY".into()], ..ChannelConfig::default() }],
            ..MachineConfig::default()
        };
        assert_eq!(config.validate(), Ok(()));
        assert_eq!(config.axis_map(&config.channels[0]), [Some(0), Some(1), None, None, None, None]);
        config.axes[1].letter = 'X';
        config.axes[1].kp = f64::NAN;
        config.channels[0].axes.push("W".into());
        config.channels[0].name = "x".into();
        assert_eq!(config.validate().map_err(|w| w.len()), Err(4));
    }
}
