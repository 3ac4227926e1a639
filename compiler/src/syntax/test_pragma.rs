//! `{test 'name', scans := 20, interval := T#10ms}` before a PROGRAM: it is a unit test, see docs/guide/testing.md.

use takt_base::Nanos;
use takt_image::{Elementary, literal_time};

/// Most scans of a test.
const SCANS_MAX: u64 = 1_000_000_000;
/// Period of a test that names none.
const INTERVAL: Nanos = Nanos::from_millis(10);

/// What the pragma says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TestPragma {
    /// Name for people; the program's own if there is none.
    pub name: Option<String>,
    /// How often the body runs.
    pub scans: u64,
    /// Virtual time between two scans.
    pub interval: Nanos,
}

/// True for the text of a pragma that begins with the word `test`.
pub(crate) fn is_test(text: &str) -> bool {
    let word = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').next().unwrap_or("");
    word.eq_ignore_ascii_case("test")
}

impl TestPragma {
    /// From the text between the braces; the part that is wrong if one is.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let mut rest = text.get("test".len()..).unwrap_or("").trim();
        let mut test = Self { name: None, scans: 1, interval: INTERVAL };
        if let Some(quoted) = rest.strip_prefix('\'') {
            let (name, behind) = quoted.split_once('\'').ok_or("the name has no closing quote")?;
            (test.name, rest) = (Some(name.to_owned()), behind.trim());
            rest = rest.strip_prefix(',').unwrap_or(rest);
        }
        for part in rest.split(',').map(str::trim).filter(|p| !p.is_empty()) {
            test.key(part).ok_or_else(|| format!("`{part}`"))?;
        }
        Ok(test)
    }

    fn key(&mut self, part: &str) -> Option<()> {
        let (key, value) = part.split_once(":=")?;
        let (key, value) = (key.trim().to_ascii_lowercase(), value.trim());
        match key.as_str() {
            "scans" => self.scans = value.parse().ok().filter(|n| (1..=SCANS_MAX).contains(n))?,
            "interval" => self.interval = literal_time::parse_time(Elementary::Time, value).filter(|n| *n > 0).map(Nanos)?,
            _ => return None,
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms() {
        let of = |name: Option<&str>, scans, ms| {
            Ok(TestPragma { name: name.map(str::to_owned), scans, interval: Nanos::from_millis(ms) })
        };
        assert_eq!(TestPragma::parse("test"), of(None, 1, 10));
        assert_eq!(TestPragma::parse("TEST 'a, b'"), of(Some("a, b"), 1, 10));
        assert_eq!(TestPragma::parse("test 'a', scans := 20, interval := T#5ms"), of(Some("a"), 20, 5));
        assert_eq!(TestPragma::parse("test scans:=3"), of(None, 3, 10));
        for wrong in
            ["test 'a", "test scans := 0", "test cycles := 3", "test interval := T#0s", "test scans := x", "test nonsense"]
        {
            assert!(TestPragma::parse(wrong).is_err(), "{wrong}");
        }
        assert!(is_test("test") && is_test("Test scans := 1") && !is_test("testing") && !is_test("attribute 'test'"));
    }
}
