//! Files as users stream them: words of 3-D printers and checksums are blanked out before a row is read, each with a warning (N0057), or
//! refused with the reason. Runs: background. Invariant: the row keeps its length, so that places stay right.

use takt_base::{Code, Diag, SourceId, Span};

/// M codes of printers that only concern heat, fans, extruder and screen, and what they do.
const PRINTER: &[(u32, &str)] = &[
    (17, "switches motors on"),
    (18, "switches motors off"),
    (20, "lists files of a printer"),
    (21, "opens the card of a printer"),
    (73, "shows progress"),
    (82, "extruder mode"),
    (83, "extruder mode"),
    (84, "switches motors off"),
    (85, "switches motors off"),
    (92, "steps a millimetre of a printer"),
    (104, "heats a nozzle"),
    (105, "asks for temperatures"),
    (106, "fan of a printer"),
    (107, "fan of a printer"),
    (109, "heats a nozzle"),
    (110, "line number of a stream"),
    (114, "asks for the position"),
    (115, "asks for the firmware"),
    (117, "text for a printer's screen"),
    (118, "text for a terminal"),
    (140, "heats a bed"),
    (141, "heats a chamber"),
    (190, "heats a bed"),
    (191, "heats a chamber"),
    (201, "acceleration of a printer"),
    (203, "speed of a printer"),
    (204, "acceleration of a printer"),
    (205, "jerk of a printer"),
    (206, "offset of a printer"),
    (207, "retraction of a printer"),
    (208, "retraction of a printer"),
    (211, "end stops of a printer"),
    (220, "speed override of a printer"),
    (221, "flow of a printer"),
    (300, "beep of a printer"),
    (400, "waits for moves: every program here does"),
    (420, "levels a bed"),
    (500, "settings of a printer"),
    (501, "settings of a printer"),
    (502, "settings of a printer"),
    (900, "linear advance of a printer"),
];

/// M codes of printers that stop or wait: what would go on without them is not what the program means.
const STOPS: &[(u32, &str)] = &[
    (25, "pauses a printer: write M0"),
    (108, "ends a wait of a printer: remove it"),
    (112, "emergency stop of a printer: write M0"),
    (226, "waits for a pin of a printer: write M66"),
    (600, "changes filament: write M0"),
    (601, "pauses a printer: write M0"),
];

/// A word of a row.
struct Word {
    letter: u8,
    value: f64,
    start: usize,
    end: usize,
}

/// The row without what is passed over, and why; `None` if there is nothing of the kind. `start` is the row's first byte in the file.
pub fn clean(text: &str, source: SourceId, start: usize) -> Option<(String, Vec<Diag>)> {
    let upper = |b: u8| b.to_ascii_uppercase();
    if !text.bytes().any(|b| matches!(upper(b), b'E' | b'M' | b'*' | b'G')) || text.contains(['[', '#', '<', '=']) {
        return None;
    }
    let words = words(text);
    let mut out = Cleaner { bytes: text.as_bytes().to_vec(), source, start, diags: Vec::new() };
    out.checksum(text);
    out.printer_codes(&words, text.len());
    out.extruder(&words);
    if out.diags.is_empty() {
        return None;
    }
    let Cleaner { bytes, diags, .. } = out;
    String::from_utf8(bytes).ok().map(|text| (text, diags))
}

/// Letters with numbers up to the first comment.
fn words(text: &str) -> Vec<Word> {
    let bytes = text.as_bytes();
    let (mut words, mut i) = (Vec::new(), 0);
    while let Some(&b) = bytes.get(i) {
        if matches!(b, b'(' | b';') {
            break;
        }
        let from = i;
        i += 1;
        if !b.is_ascii_alphabetic() {
            continue;
        }
        while bytes.get(i) == Some(&b' ') {
            i += 1;
        }
        if let Some((value, length)) = super::number::scan(&bytes[i..]) {
            i += length;
            words.push(Word { letter: b.to_ascii_uppercase(), value, start: from, end: i });
        } else {
            i = from + 1;
        }
    }
    words
}

struct Cleaner {
    bytes: Vec<u8>,
    source: SourceId,
    start: usize,
    diags: Vec<Diag>,
}

impl Cleaner {
    fn span(&self, from: usize, to: usize) -> Span {
        Span::new(self.source, self.start + from, self.start + to)
    }

    /// Blanks bytes out, and says why.
    fn pass_over(&mut self, from: usize, to: usize, label: &str) {
        for b in &mut self.bytes[from..to] {
            *b = b' ';
        }
        let help = "it means nothing for a machine tool; look whether the program was written for another machine";
        self.diags.push(Diag::new(Code::LeftOut, self.span(from, to), label).help(help));
    }

    /// `*71` at the end of a streamed row.
    fn checksum(&mut self, text: &str) {
        let Some(star) = text.rfind('*') else { return };
        let digits = text[star + 1..].trim_end();
        if !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit()) && !text[..star].contains(['(', ';']) {
            self.pass_over(star, text.len(), "checksum of a stream");
        }
    }

    fn printer_codes(&mut self, words: &[Word], length: usize) {
        let code = |w: &&Word| matches!(w.letter, b'G' | b'M');
        let Some(first) = words.iter().find(code) else { return };
        let number = super::word::whole(first.value);
        // Text and parameters of the code go with it, up to a comment.
        let end = self.bytes.iter().position(|b| matches!(b, b'(' | b';')).unwrap_or(length);
        let found = |table: &'static [(u32, &'static str)]| table.iter().find(|row| Some(row.0) == number).map(|row| row.1);
        match first.letter {
            b'M' => {
                if let Some(label) = found(PRINTER) {
                    self.pass_over(first.start, end, label);
                } else if let Some(label) = found(STOPS) {
                    let (what, help) = label.split_once(": ").unwrap_or((label, "remove it"));
                    let span = self.span(first.start, first.end);
                    self.diags.push(Diag::new(Code::NotOfThisControl, span, what).help(help));
                    for b in &mut self.bytes[first.start..end] {
                        *b = b' ';
                    }
                }
            }
            _ => match number {
                Some(29) => self.pass_over(first.start, end, "levels the bed of a printer"),
                Some(10 | 11) if words.iter().all(|w| matches!(w.letter, b'N' | b'G')) && words.len() <= 2 => {
                    self.pass_over(first.start, end, "retracts the filament of a printer");
                }
                _ => {}
            },
        }
    }

    /// E words of moves; `G92 E0` altogether.
    fn extruder(&mut self, words: &[Word]) {
        let is = |letter: u8, value: f64| words.iter().any(|w| w.letter == letter && w.value == value);
        if words.iter().any(|w| w.letter == b'M') || is(b'G', 76.0) || is(b'G', 32.0) || is(b'G', 33.0) || is(b'G', 92.1) {
            return;
        }
        let Some(e) = words.iter().find(|w| w.letter == b'E') else { return };
        let alone = words.iter().all(|w| matches!(w.letter, b'E' | b'N') || (w.letter == b'G' && w.value == 92.0));
        if is(b'G', 92.0) && alone {
            let from = words.iter().filter(|w| w.letter != b'N').map(|w| w.start).min().unwrap_or(e.start);
            self.pass_over(from, words.last().map_or(e.end, |w| w.end), "position of an extruder");
        } else {
            self.pass_over(e.start, e.end, "way of an extruder");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cleaned(text: &str) -> (String, usize) {
        match clean(text, SourceId(0), 0) {
            Some((text, diags)) => (text.trim_end().to_owned(), diags.len()),
            None => (text.to_owned(), 0),
        }
    }

    #[test]
    fn words_of_printers_go_and_the_rest_stays() {
        for (text, want, notes) in [
            ("G1 X1 E2.5 F100", "G1 X1      F100", 1),
            ("G1 E-2 F2400", "G1     F2400", 1),
            ("G92 E0", "", 1),
            ("G92 X0 E0", "G92 X0", 1),
            ("m104 s200 ; hot", "          ; hot", 1),
            ("M117 Hello (world)", "           (world)", 1),
            ("N5 G1 X1*71", "N5 G1 X1", 1),
            ("G29", "", 1),
            ("G10", "", 1),
            ("M112", "", 1),
            ("G10 L2 P1 X5", "G10 L2 P1 X5", 0),
            ("M68 E3 Q5", "M68 E3 Q5", 0),
            ("G76 P1 Z-5 I-1 J1 K2 E1", "G76 P1 Z-5 I-1 J1 K2 E1", 0),
            ("G0 X[2*3]", "G0 X[2*3]", 0),
            ("(M104 E5)", "(M104 E5)", 0),
            ("M30", "M30", 0),
        ] {
            assert_eq!(cleaned(text), (want.to_owned(), notes), "{text}");
        }
    }
}
