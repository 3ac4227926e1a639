//! JSON forms of values: the contract of `takt sim --format json` (docs/guide/command-line.md).

use serde_json::{Number, Value as Json};
use takt_image::literal_time::format_time;
use takt_image::value::Value;

/// Largest integer that a JSON reader is sure to keep.
const SAFE: i128 = 1 << 53;

/// The JSON form of a value.
pub fn value(v: &Value) -> Json {
    match v {
        Value::Bool(b) => Json::Bool(*b),
        Value::Int(i) => integer(*i),
        Value::Real(r) => real(f64::from(*r), &takt_image::literal::format_real(*r)),
        Value::Lreal(r) => real(*r, &takt_image::literal::format_lreal(*r)),
        Value::String(_) | Value::WString(_) => Json::String(v.as_text().unwrap_or_default()),
        Value::Time(ty, ns) => format_time(*ty, *ns).map_or_else(|| Json::String(v.to_string()), Json::String),
        Value::Enum(name) => Json::String(name.clone()),
        Value::Array(items) => Json::Array(items.iter().map(value).collect()),
        Value::Struct(members) => Json::Object(members.iter().map(|(n, v)| (n.clone(), value(v))).collect()),
        Value::Reference(offset) => integer(i128::from(*offset)),
    }
}

fn integer(i: i128) -> Json {
    if i.abs() > SAFE { Json::String(i.to_string()) } else { Json::Number(Number::from(i as i64)) }
}

/// The shortest number that reads back the same; a REAL is shortened as a REAL.
fn real(wide: f64, shortest: &str) -> Json {
    if wide.is_nan() {
        return Json::String("NaN".into());
    }
    if wide.is_infinite() {
        return Json::String(if wide > 0.0 { "Infinity" } else { "-Infinity" }.into());
    }
    let number = shortest.parse().ok().and_then(Number::from_f64);
    number.map_or(Json::Null, Json::Number)
}
