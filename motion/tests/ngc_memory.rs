//! The interpreter allocates nothing for a row once it is under way, and holds no more of a long program than of a short one.
#![allow(unsafe_code)] // A global allocator can't be written without.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::io;
use takt_base::SourceId;
use takt_motion::canon::{MotionMode, Units};
use takt_motion::ngc::text::{ReadAt, Stamp};
use takt_motion::ngc::{Interpreter, Options, Style, Text, tool};
use takt_motion::print::rs274::Listing;

thread_local! {
    static CALLS: Cell<usize> = const { Cell::new(0) };
    static LIVE: Cell<isize> = const { Cell::new(0) };
    static PEAK: Cell<isize> = const { Cell::new(0) };
}

/// Counts what this thread asks for and gives back: the harness has threads of its own.
struct Counting;

fn count(bytes: isize) {
    CALLS.set(CALLS.get() + 1);
    LIVE.set(LIVE.get() + bytes);
    PEAK.set(PEAK.get().max(LIVE.get()));
}

// SAFETY: everything goes to the system allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as isize);
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, p: *mut u8, layout: Layout) {
        count(-(layout.size() as isize));
        unsafe { System.dealloc(p, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn options() -> Options {
    let tools = tool::read(SourceId(0), "T1 P1 D2\n", 1.0).unwrap();
    Options { tools: Some(tools.into()), style: Style::Ngc, ..Options::default() }
}

/// Calls of the allocator while the second half of the commands is read. The first half has seen all there is to see.
fn calls(text: impl Into<Text>, options: Options) -> usize {
    let text = text.into();
    let all = Interpreter::new(SourceId(0), text.clone(), options.clone()).map(Result::unwrap).count();
    assert!(all > 3000, "{all} commands");
    let mut interpreter = Interpreter::new(SourceId(0), text, options);
    let mut read = |n: usize| {
        for _ in 0..n {
            interpreter.next_ref().unwrap().unwrap();
        }
    };
    read(all / 2);
    let before = CALLS.get();
    read(all / 2 - 100);
    CALLS.get() - before
}

fn rows(n: usize, row: impl Fn(usize) -> String) -> String {
    (0..n).fold("T1 M6 G40 F100\n".to_owned(), |text, i| text + &row(i) + "\n")
}

#[test]
fn rows_do_not_allocate() {
    let cases = [
        ("lines", rows(8000, |i| format!("N{i} G1 X{i} Y-{}.5", i % 7))),
        ("arcs", rows(8000, |i| ["G2 X10 Y0 I5 J0", "G3 X0 I-5", "G2 X10 R8", "G3 X0 R8"][i % 4].to_owned())),
        ("expressions", rows(8000, |i| format!("G1 X[SIN[{i}] * #<a> + 2] Y#[100 + #5]\n#5 = [#5 MOD 50 + 1] #<_seen> = #<_x>")))
            .map_text(|t| t.replace("F100\n", "F100\n#<a> = 1 #5 = 1\n")),
        ("cycles", rows(2000, |i| format!("G{} X{i} Y1 Z-3 R1", ["81", "82 P1", "83 Q1", "73 Q1"][i % 4]))),
        ("compensation", rows(8000, |i| ["G1 X50 Y0", "G1 Y50", "G3 X0 I-25", "G1 Y0"][i % 4].to_owned()))
            .map_text(|t| t.replace("F100\n", "F100\nG0 X-9 Y-9\nG41 D1 G1 X0 Y0\n")),
        ("modes", rows(8000, |i| ["G91 M8 G1 X1", "G90 M9 G1 Y1", "G20 G4 P1 G1 X1", "G21 S100 F200 G1 X2"][i % 4].to_owned())),
        (
            "calls",
            "o100 sub\nG1 X#1 Y[#2 + #<_value>]\no100 endsub [#1 + 1]\nF100\n".to_owned() + &"o100 call [3] [4]\n".repeat(8000),
        ),
        (
            "loops",
            format!("{SUB}F100 #<n> = 0\no1 while [#<n> LT 8000]\no<a> call [#<n>] [#<n> / 2]\n#<n> = [#<n> + 1]\no1 endwhile\n"),
        ),
        ("repeats", "F100\no1 repeat [90]\no2 repeat [90]\nG1 X[#5420 + 1]\no2 endrepeat\no1 endrepeat\n".to_owned()),
        ("M98", "F100\nM98 P100 L9000\nM2\nO100\nG91 G1 X1\nM99\n".to_owned()),
    ];
    for (name, text) in cases {
        assert_eq!(calls(text.as_str(), options()), 0, "{name}");
        let drop_in = Options { drop_in: true, control: MotionMode::Continuous(0.0), table_units: Units::Inches, ..options() };
        if name != "M98" && name != "repeats" {
            assert_eq!(calls(text + "G40\nM2\n", drop_in), 0, "{name}, as rs274");
        }
    }
}

const SUB: &str = "o<a> sub\n#<x> = [#1 + 1]\no3 if [#<x> MOD 2 EQ 0]\nG1 X#<x>\no3 else\nG1 Y#2\no3 endif\no<a> endsub\n";

trait MapText {
    fn map_text(self, f: impl Fn(String) -> String) -> Self;
}

impl MapText for (&'static str, String) {
    fn map_text(self, f: impl Fn(String) -> String) -> Self {
        (self.0, f(self.1))
    }
}

/// A file that nobody has: line `i` is made when it is read.
struct Generated {
    lines: u64,
}

/// Bytes of a line.
const LINE: u64 = 24;

impl Generated {
    fn line(&self, i: u64) -> String {
        let row = match i {
            0 => "F100".to_owned(),
            _ if i + 1 == self.lines => "M2".to_owned(),
            _ => format!("G1 X{}.{} Y{}", i % 100, i % 10, i % 77),
        };
        format!("{row:<23}\n")
    }
}

impl ReadAt for Generated {
    fn read_at(&self, buffer: &mut [u8], offset: u64) -> io::Result<usize> {
        let (line, part) = (offset / LINE, (offset % LINE) as usize);
        if line >= self.lines {
            return Ok(0);
        }
        let text = self.line(line);
        let n = (text.len() - part).min(buffer.len());
        buffer[..n].copy_from_slice(&text.as_bytes()[part..part + n]);
        Ok(n)
    }
    fn stamp(&self) -> io::Result<Stamp> {
        Ok(Stamp { len: self.lines * LINE, modified: None })
    }
}

/// Most bytes held while a program of so many lines is listed.
fn held(lines: u64) -> isize {
    let text = Text::streamed(Generated { lines }).unwrap();
    let before = LIVE.get();
    PEAK.set(before);
    let mut interpreter = Interpreter::new(SourceId(0), text.clone(), options());
    let (mut listing, mut rows, mut count) = (Listing::new(25.4), Vec::new(), 0);
    while let Some(step) = interpreter.next_ref() {
        rows.clear();
        listing.step(step.unwrap(), &mut rows);
        count += 1;
    }
    assert!(count >= lines - 2, "{count} commands");
    let peak = PEAK.get() - before;
    assert_eq!(text.lines(), Ok(lines as u32));
    peak
}

/// 24 bytes a line: the larger program has 7 MB, and would have 240 MB with ten million lines; the index of that needs 40 kB.
#[test]
fn a_long_program_needs_no_more_memory_than_a_short_one() {
    let (short, long) = (held(20_000), held(300_000));
    assert!(short < 500_000, "{short} bytes");
    assert!(long < short + 5000, "{long} bytes for 300000 lines, {short} for 20000");
}

/// 100,000 rows in one loop: what is kept of them is bounded.
#[test]
fn the_rows_of_a_long_loop_are_kept_up_to_a_bound() {
    let text: String = (0..100_000).map(|i| format!("G1 X{i} Y[#5 + {i}]\n")).collect();
    let text = Text::from(format!("F100\no1 repeat [2]\n{text}o1 endrepeat\nM2\n"));
    let before = LIVE.get();
    PEAK.set(before);
    let moves = Interpreter::new(SourceId(0), text, options()).filter(|s| s.is_ok()).count();
    assert!(moves > 200_000);
    assert!(PEAK.get() - before < 24 << 20, "{} bytes", PEAK.get() - before);
}
