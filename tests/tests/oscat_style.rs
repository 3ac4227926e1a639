//! Programs in the style of OSCAT at its scale: CODESYS 2 exports of functions, blocks and types, 10,000 lines of them, and a program
//! that calls each with values that a model in Rust knows (language reference, sections 12 and 17).

use takt_base::Profile;
use takt_tests::plc::{Plc, compile_in};

/// An export with `@N@`, `@K@`, .. for the number and the parameters of a copy.
const TEMPLATES: [&str; 8] = [
    include_str!("../oscat_style/digits.exp"),
    include_str!("../oscat_style/bits.exp"),
    include_str!("../oscat_style/text.exp"),
    include_str!("../oscat_style/mean.exp"),
    include_str!("../oscat_style/calendar.exp"),
    include_str!("../oscat_style/vector.exp"),
    include_str!("../oscat_style/delay.exp"),
    include_str!("../oscat_style/ramp.exp"),
];
/// Copies of each template.
const COPIES: u32 = 45;

/// Parameters of a copy.
struct Copy {
    n: u32,
    /// A small number from 2 on.
    k: u32,
    /// Bit number.
    b: u32,
    /// Added to a shift.
    s: u32,
    /// A character.
    c: u8,
}

impl Copy {
    fn new(n: u32) -> Self {
        Copy { n, k: 2 + n % 35, b: n % 32, s: n % 7, c: 33 + (n % 15) as u8 }
    }

    fn fill(&self, template: &str) -> String {
        let marks = [("@N@", self.n), ("@K@", self.k), ("@B@", self.b), ("@S@", self.s), ("@C@", u32::from(self.c))];
        marks.iter().fold(template.to_owned(), |text, (mark, value)| text.replace(mark, &value.to_string()))
    }

    /// Variables of the program that uses this copy.
    fn variables(&self) -> String {
        let n = self.n;
        format!(
            "digits{n} : INT; mix{n} : DWORD; text{n} : STRING(STRING_LENGTH); mean{n} : REAL; list{n} : ARRAY[0..4] OF REAL := 1.0, 2.0, 3.0, 4.0, 5.0;
             day{n} : INT; vec{n} : VEC_{n}; turned{n} : VEC_{n}; pulse{n} : PULSE_{n}; ramp{n} : RAMP_{n};\n"
        )
    }

    fn calls(&self) -> String {
        let n = self.n;
        let (x, year, month) = (self.x(), 1990 + n, 1 + n % 12);
        format!(
            "digits{n} := DIGITS_{n}({x});
             mix{n} := MIX_{n}({}, {});
             text{n} := CODED_{n}('Ab z9-{n}', {});
             IF first THEN mean{n} := _MEAN_{n}(ADR(list{n}), SIZEOF(list{n})); END_IF;
             day{n} := DAY_{n}({year}, {month}, {});
             vec{n}.Y := {n}.5;
             turned{n} := TURN_{n}(vec{n}, 3);
             pulse{n}(IN := start);
             ramp{n}(X := {n}.0);\n",
            self.word(),
            40 + n,
            n % 26,
            1 + n % 28,
        )
    }

    fn x(&self) -> i64 {
        i64::from(self.n) * 7919 - 100_000
    }

    fn word(&self) -> u32 {
        self.n.wrapping_mul(0x9E37_79B1)
    }

    fn digits(&self) -> u64 {
        let (mut t, mut sum) = (self.x().unsigned_abs(), 0);
        while t > 0 {
            sum += t % u64::from(self.k);
            t /= u64::from(self.k);
        }
        sum
    }

    fn mix(&self) -> u32 {
        let word = self.word();
        let ends = word & 0x7FFF_FFFE | word >> 31 | word << 31;
        let b = ((ends >> 8) as u8 ^ 0x5A) as u32;
        let turns = (40 + self.n) % 32 + self.s;
        let mixed = if ends >> self.b & 1 == 1 {
            ends.rotate_left(turns) ^ b
        } else {
            // b * 3 is computed in the BYTE that b is.
            ends.wrapping_add((b * 3) & 0xFF).wrapping_sub(1)
        };
        mixed & !(1 << self.b)
    }

    fn day_of_year(&self) -> u32 {
        let (year, month) = (1990 + self.n, self.n as usize % 12);
        let leap = u32::from(year % 4 == 0 && (year % 100 != 0 || year % 400 == 0));
        let lengths = [31, 28 + leap, 31, 30, 31, 30, 31, 31, 30, 31, 30];
        lengths[..month].iter().sum::<u32>() + 1 + self.n % 28
    }

    fn text(&self) -> String {
        let given = format!("Ab z9-{}", self.n);
        let key = (self.n % 26) as u8;
        let coded = given.bytes().map(|c| match c {
            b'0'..=b'9' => 57 - (c - 48),
            b'A'..=b'Z' => 65 + (c - 65 + key) % 26,
            b'a'..=b'z' => 97 + (c - 97 + key) % 26,
            b' ' => b'_',
            _ => self.c,
        });
        let text: String = coded.map(char::from).collect();
        format!("'{}{}'", text.replace('$', "$$").replace('\'', "$'"), given.len())
    }
}

/// The whole project as one export.
fn project() -> String {
    let copies: Vec<Copy> = (0..COPIES).map(Copy::new).collect();
    let units: String = copies.iter().flat_map(|c| TEMPLATES.iter().map(|t| c.fill(t))).collect();
    let (variables, calls): (Vec<_>, Vec<_>) = copies.iter().map(|c| (c.variables(), c.calls())).unzip();
    format!(
        "{units}(* @PATH := '' *)\nPROGRAM main\nVAR\nfirst : BOOL := TRUE; start : BOOL;\n{}END_VAR\n(* @END_DECLARATION := '0' *)\n{}first := FALSE;\nEND_PROGRAM\n",
        variables.concat(),
        calls.concat()
    )
}

#[test]
fn a_library_of_10_000_lines_computes_what_the_model_does() {
    let text = project().replace('\n', "\r\n");
    assert!(text.lines().count() > 10_000, "{}", text.lines().count());
    let mut plc = Plc::new_in(Profile::Codesys2, &text);
    plc.set("main.start", "TRUE");
    plc.scan(0).unwrap();
    for copy in (0..COPIES).map(Copy::new) {
        let n = copy.n;
        let get = |name: &str| plc.get(&format!("main.{name}{n}"));
        assert_eq!(get("digits"), copy.digits().to_string(), "DIGITS_{n}");
        assert_eq!(get("mix"), copy.mix().to_string(), "MIX_{n}");
        assert_eq!(get("text"), copy.text(), "CODED_{n}");
        assert_eq!(get("mean"), format!("{}.0", 3 * copy.k), "_MEAN_{n}");
        assert_eq!(get("day"), copy.day_of_year().to_string(), "DAY_{n}");
        let member = |name: &str, member: &str| plc.get(&format!("main.{name}{n}.{member}"));
        assert_eq!((member("turned", "X"), member("turned", "Y")), (format!("{n}.5"), "-1.0".into()), "TURN_{n}");
        assert_eq!((member("turned", "W[1]"), member("vec", "X")), ((1 + copy.k).to_string(), "1.0".into()), "TURN_{n}");
        assert_eq!(member("pulse", "Q"), "TRUE");
        let limited = n.min(copy.k) as f64;
        assert_eq!(
            (member("ramp", "Y"), member("ramp", "AT_LIMIT")),
            (format!("{:?}", limited / 4.0), (n >= copy.k).to_string().to_uppercase())
        );
    }
    // The pulses of 10 ms times their number end one after the other.
    for now in (10..=400).step_by(10) {
        plc.scan(now).unwrap();
        for copy in (0..COPIES).map(Copy::new) {
            let want = if now >= i64::from(copy.k) * 10 { "1" } else { "0" };
            assert_eq!(plc.get(&format!("main.pulse{}.CNT", copy.n)), want, "PULSE_{} at {now} ms", copy.n);
        }
    }
}

#[test]
fn warnings_name_what_codesys_lets_pass() {
    let c = compile_in(Profile::Codesys2, &project());
    assert!(c.diags.iter().all(|d| d.severity != takt_base::Severity::Error));
    let inputs = c.diags.iter().filter(|d| d.code == takt_base::Code::AssignToInput).count();
    assert_eq!(inputs, 3 * COPIES as usize, "MIX assigns N twice and TURN assigns v once");
}
