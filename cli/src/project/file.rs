//! The keys of `takt.toml`. Unknown keys are errors; `takt explain takt.toml` prints [`super::REFERENCE`].

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use takt_base::Profile;

/// The whole file.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct ProjectFile {
    pub project: ProjectKeys,
    /// Dialects of single files or folders, by path.
    pub profiles: BTreeMap<String, LanguageProfile>,
    pub task: TaskKeys,
    pub run: RunKeys,
    pub motion: MotionKeys,
}

#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct ProjectKeys {
    pub name: Option<String>,
    pub sources: Option<Vec<String>>,
    pub profile: LanguageProfile,
}

/// Dialect of the sources: [`takt_base::Profile`] as a key.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum LanguageProfile {
    /// IEC 61131-3 as it stands.
    #[default]
    Std,
    /// CODESYS 3 and TwinCAT 3.
    Codesys,
    /// CODESYS 2.
    Codesys2,
    /// MATIEC, Beremiz, OpenPLC.
    OpenPlc,
}

impl From<LanguageProfile> for Profile {
    fn from(key: LanguageProfile) -> Profile {
        match key {
            LanguageProfile::Std => Profile::Std,
            LanguageProfile::Codesys => Profile::Codesys,
            LanguageProfile::Codesys2 => Profile::Codesys2,
            LanguageProfile::OpenPlc => Profile::OpenPlc,
        }
    }
}

#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct TaskKeys {
    pub interval: Option<String>,
}

#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct RunKeys {
    pub stimulus: Option<String>,
    pub duration: Option<String>,
    pub stop_when: Option<String>,
    pub on_fault: Option<String>,
    pub watchdog: Option<String>,
    pub picture: Option<String>,
    pub retain: Option<String>,
}

#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct MotionKeys {
    pub servo_period: Option<String>,
    pub axis: Vec<AxisKeys>,
    pub channel: Vec<ChannelKeys>,
}

#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct AxisKeys {
    pub name: String,
    pub letter: Option<char>,
    pub v_max_mm_s: Option<f64>,
    pub a_max_mm_s2: Option<f64>,
    pub travel_min_mm: Option<f64>,
    pub travel_max_mm: Option<f64>,
    pub encoder_resolution_mm: Option<f64>,
    pub kp: Option<f64>,
    pub ki: Option<f64>,
    pub kd: Option<f64>,
    pub kff_velocity: Option<f64>,
    pub kff_acceleration: Option<f64>,
    pub plant_time_constant_s: Option<f64>,
    pub following_error_max_mm: Option<f64>,
    pub power_on_delay: Option<String>,
}

#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct ChannelKeys {
    pub name: String,
    pub axes: Vec<String>,
    pub mode: Option<String>,
    pub blu_mm: Option<f64>,
    pub handshake: Option<bool>,
    pub modes: Option<String>,
    pub dialect: Option<String>,
    pub lenient: Option<bool>,
    pub settings: Option<Vec<String>>,
    pub require_homed: Option<bool>,
    pub aux_timeout: Option<String>,
    pub optional_stop: Option<bool>,
    pub subs: Vec<String>,
    pub parameter_file: Option<String>,
    pub tool_table: Option<String>,
    pub dry_run_mm_min: Option<f64>,
    pub spindle_accel_rpm_s: Option<f64>,
}
