//! Which language a part program is written in, and what a Fanuc-style control keeps in its parameters.

use std::sync::Arc;

/// The language of part programs.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Dialect {
    /// RS274/NGC as LinuxCNC speaks it.
    #[default]
    LinuxCnc,
    /// Fanuc-style, milling: table A.2 of the book.
    FanucMill,
    /// Fanuc-style, turning, G code system A: table A.1 of the book.
    FanucTurn,
}

impl Dialect {
    /// By the name that command line and project file use.
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "ngc" | "linuxcnc" => Some(Dialect::LinuxCnc),
            "fanuc-mill" => Some(Dialect::FanucMill),
            "fanuc-turn" => Some(Dialect::FanucTurn),
            _ => None,
        }
    }

    /// True for both Fanuc-style dialects.
    pub const fn is_fanuc(self) -> bool {
        !matches!(self, Dialect::LinuxCnc)
    }
}

/// Dialect, strictness and settings: all that says how a text is read.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Language {
    /// The dialect.
    pub dialect: Dialect,
    /// Takes files as users stream them: see the guide.
    pub lenient: bool,
    /// Settings of the Fanuc-style dialects.
    pub fanuc: Arc<Settings>,
}

impl Language {
    /// From the words of the command line or of a project file.
    ///
    /// # Errors
    /// What a word should have been.
    pub fn new(dialect: &str, lenient: bool, settings: &[String]) -> Result<Self, String> {
        let Some(dialect) = Dialect::named(dialect) else {
            return Err(format!("dialect = \"{dialect}\"; write ngc, fanuc-mill or fanuc-turn"));
        };
        let mut fanuc = Settings::default();
        for text in settings {
            fanuc.set(text)?;
        }
        Ok(Language { dialect, lenient, fanuc: Arc::new(fanuc) })
    }
}

/// How a code calls a macro.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum MacroCall {
    /// As G65: the words of the block are arguments.
    Arguments,
    /// As G66: after each block that moves.
    Modal,
    /// As M98.
    Subprogram,
}

/// A G, M or T code that calls a macro.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct UserCode {
    /// `G`, `M` or `T`.
    pub letter: char,
    /// Its number: of a G code in tenths; of T nothing.
    pub number: u32,
    /// The program.
    pub program: u32,
    /// How it is called.
    pub call: MacroCall,
}

/// What a control keeps in parameters. Lengths in mm.
#[derive(Clone, PartialEq, Debug)]
pub struct Settings {
    /// `X100` is 100 mm (calculator type). Else a number without a point counts least input increments: `X100` is 0.1 mm.
    pub calculator: bool,
    /// X and U of turning are diameters.
    pub diameter: bool,
    /// Macros behind G, M and T codes.
    pub codes: Vec<UserCode>,
    /// How far G73 of milling goes back to break chips.
    pub chip_break_mm: f64,
    /// How far above the last depth G83 ends its rapid.
    pub peck_clearance_mm: f64,
    /// Depth of cut and retract of G71 and G72, until the program names others.
    pub rough_depth_mm: f64,
    /// See [`Settings::rough_depth_mm`].
    pub rough_retract_mm: f64,
    /// Retract of G74 and G75 of turning, until the program names another.
    pub groove_retract_mm: f64,
    /// Length of the pull-out at the end of a thread of G92, in leads.
    pub thread_pullout_leads: f64,
    /// How far a chord of polar or cylindrical interpolation and of a NURBS may leave its curve.
    pub chord_tolerance_mm: f64,
    /// Codes G15 and G16 exchanged, as the book prints them.
    pub polar_exchanged: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            calculator: true,
            diameter: true,
            codes: Vec::new(),
            chip_break_mm: 0.5,
            peck_clearance_mm: 0.5,
            rough_depth_mm: 2.0,
            rough_retract_mm: 0.5,
            groove_retract_mm: 0.5,
            thread_pullout_leads: 0.0,
            chord_tolerance_mm: 0.002,
            polar_exchanged: false,
        }
    }
}

impl Settings {
    /// Adds a setting as text: `increments`, `radius`, `G100=9010`, `G101=modal 9011`, `M50=9020`, `M51=sub 9001`, `T=9000`,
    /// or a length such as `rough_depth=1.5`.
    ///
    /// # Errors
    /// What the text should have been.
    pub fn set(&mut self, text: &str) -> Result<(), String> {
        let (name, value) = text.split_once('=').map_or((text.trim(), ""), |(n, v)| (n.trim(), v.trim()));
        match (name, value) {
            ("calculator", "") => self.calculator = true,
            ("increments", "") => self.calculator = false,
            ("diameter", "") => self.diameter = true,
            ("radius", "") => self.diameter = false,
            ("polar_exchanged", "") => self.polar_exchanged = true,
            _ => return self.set_value(name, value).ok_or_else(|| format!("\"{text}\" is no setting; {FORMS}")),
        }
        Ok(())
    }

    fn set_value(&mut self, name: &str, value: &str) -> Option<()> {
        let place = match name {
            "chip_break" => &mut self.chip_break_mm,
            "peck_clearance" => &mut self.peck_clearance_mm,
            "rough_depth" => &mut self.rough_depth_mm,
            "rough_retract" => &mut self.rough_retract_mm,
            "groove_retract" => &mut self.groove_retract_mm,
            "thread_pullout" => &mut self.thread_pullout_leads,
            "chord_tolerance" => &mut self.chord_tolerance_mm,
            _ => return self.add_code(name, value),
        };
        let number: f64 = value.parse().ok()?;
        let least = if matches!(name, "rough_depth" | "chord_tolerance") { 1e-4 } else { 0.0 };
        *place = Some(number).filter(|n| (least..=1000.0).contains(n))?;
        Some(())
    }

    fn add_code(&mut self, name: &str, value: &str) -> Option<()> {
        let letter = name.chars().next().map(|c| c.to_ascii_uppercase()).filter(|c| matches!(c, 'G' | 'M' | 'T'))?;
        let number: f64 = match (letter, &name[1..]) {
            ('T', "") => 0.0,
            ('T', _) => return None,
            (_, digits) => digits.parse().ok().filter(|n| (0.0..1e6).contains(n))?,
        };
        let tenths = if letter == 'G' { number * 10.0 } else { number };
        let (call, program) = match value.split_once(' ') {
            None => (MacroCall::Arguments, value),
            Some(("modal", program)) => (MacroCall::Modal, program),
            Some(("sub", program)) => (MacroCall::Subprogram, program),
            Some(_) => return None,
        };
        let program = program.trim().parse().ok()?;
        let code = UserCode { letter, number: super::super::word::whole(tenths)?, program, call };
        self.codes.retain(|c| (c.letter, c.number) != (code.letter, code.number));
        self.codes.push(code);
        Some(())
    }

    /// The macro behind a code.
    pub fn code(&self, letter: char, number: u32) -> Option<UserCode> {
        self.codes.iter().find(|c| (c.letter, c.number) == (letter, number)).copied()
    }
}

/// What [`Settings::set`] takes.
pub const FORMS: &str = "write calculator, increments, diameter, radius, a code such as G100=9010, M51=sub 9001 or T=9000, or one of \
chip_break=, peck_clearance=, rough_depth=, rough_retract=, groove_retract=, thread_pullout=, chord_tolerance=";
