//! The machine of a project file: keys with defaults filled in.

use super::file::{AxisKeys, ChannelKeys, ProjectFile};
use super::load::Problem;
use crate::duration;
use takt_base::{Code, Nanos, SourceId};
use takt_motion::machine::{AxisConfig, ChannelConfig, ChannelMode, MachineConfig};
use takt_motion::ngc::{Language, Options};
use takt_motion::pulse::dda::Preload;

/// Iterations that the reference-pulse mode may do in one servo period.
const BATCH_MAX: u32 = 10_000;
/// Bytes of the record of the port.
const RECORD_MAX: usize = 1 << 20;

/// The machine of a project, or what is wrong with it.
pub fn machine(keys: &ProjectFile) -> Result<MachineConfig, Problem> {
    let motion = &keys.motion;
    let config = MachineConfig {
        servo_period: time("motion.servo_period", motion.servo_period.as_deref(), Nanos::from_millis(1))?,
        axes: motion.axis.iter().map(axis).collect::<Result<_, _>>()?,
        channels: motion.channel.iter().map(channel).collect::<Result<_, _>>()?,
        ..MachineConfig::default()
    };
    config.validate().map_err(|faults| bad(faults.join("; ")))?;
    Ok(config)
}

/// A duration of the file, or its default.
pub fn time(key: &str, text: Option<&str>, default: Nanos) -> Result<Nanos, Problem> {
    let Some(text) = text else { return Ok(default) };
    duration::parse(text).ok_or_else(|| bad(format!("{key} = \"{text}\" is not a duration; write for example \"10ms\"")))
}

fn bad(text: impl Into<String>) -> Problem {
    Problem::File(Code::BadProjectFile, format!("takt.toml: {}", text.into()))
}

fn axis(k: &AxisKeys) -> Result<AxisConfig, Problem> {
    let d = AxisConfig::named(&k.name);
    let delay = time("power_on_delay", k.power_on_delay.as_deref(), Nanos::from_secs_round(d.drive_enable_delay_s))?;
    Ok(AxisConfig {
        letter: k.letter.map_or(d.letter, |l| l.to_ascii_uppercase()),
        v_max_mm_s: k.v_max_mm_s.unwrap_or(d.v_max_mm_s),
        a_max_mm_s2: k.a_max_mm_s2.unwrap_or(d.a_max_mm_s2),
        travel_min_mm: k.travel_min_mm.unwrap_or(d.travel_min_mm),
        travel_max_mm: k.travel_max_mm.unwrap_or(d.travel_max_mm),
        encoder_resolution_mm: k.encoder_resolution_mm.unwrap_or(d.encoder_resolution_mm),
        kp: k.kp.unwrap_or(d.kp),
        ki: k.ki.unwrap_or(d.ki),
        kd: k.kd.unwrap_or(d.kd),
        kff_velocity: k.kff_velocity.unwrap_or(d.kff_velocity),
        kff_acceleration: k.kff_acceleration.unwrap_or(d.kff_acceleration),
        plant_time_constant_s: k.plant_time_constant_s.unwrap_or(d.plant_time_constant_s),
        following_error_max_mm: k.following_error_max_mm.unwrap_or(d.following_error_max_mm),
        drive_enable_delay_s: delay.as_secs(),
        ..d
    })
}

fn channel(k: &ChannelKeys) -> Result<ChannelConfig, Problem> {
    let d = ChannelConfig::default();
    let modes = k.modes.clone().unwrap_or_default();
    let dialect = k.dialect.as_deref().unwrap_or("ngc");
    let settings = k.settings.clone().unwrap_or_default();
    let language = Language::new(dialect, k.lenient.unwrap_or(false), &settings).map_err(bad)?;
    if let Err(diag) = Options::default().with_modes(SourceId(0), &modes) {
        return Err(bad(format!("modes = \"{modes}\": {} ({})", diag.message, diag.label)));
    }
    Ok(ChannelConfig {
        name: k.name.clone(),
        axes: k.axes.clone(),
        mode: mode(k)?,
        handshake: k.handshake.unwrap_or(true),
        aux_timeout_s: time("aux_timeout", k.aux_timeout.as_deref(), Nanos::ZERO)?.as_secs(),
        require_homed: k.require_homed.unwrap_or(d.require_homed),
        modes,
        language,
        optional_stop: k.optional_stop.unwrap_or(d.optional_stop),
        subs: k.subs.iter().map(|folder| folder.trim_end_matches('/').to_owned()).collect(),
        parameter_file: k.parameter_file.clone(),
        tool_table: k.tool_table.clone(),
        dry_run_mm_min: k.dry_run_mm_min.unwrap_or(d.dry_run_mm_min),
        spindle_accel_rpm_s: k.spindle_accel_rpm_s.unwrap_or(d.spindle_accel_rpm_s),
        ..d
    })
}

fn mode(k: &ChannelKeys) -> Result<ChannelMode, Problem> {
    match k.mode.as_deref().unwrap_or("sampled") {
        "sampled" => Ok(ChannelMode::Servo),
        "reference-pulse" => Ok(ChannelMode::ReferencePulse {
            blu_mm: k.blu_mm.unwrap_or(1.0),
            preload: Preload::Half,
            batch_max: BATCH_MAX,
            record_max: RECORD_MAX,
        }),
        other => Err(bad(format!("mode = \"{other}\"; write \"sampled\" or \"reference-pulse\""))),
    }
}
