//! A seeded generator of part programs.
#![allow(dead_code)] // each test uses a part

/// Numbers from a seed (splitmix64).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }
    /// 0..n
    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n.max(1) as u64) as usize
    }
    pub fn pick<'a, T>(&mut self, items: &'a [T]) -> &'a T {
        &items[self.below(items.len())]
    }
    /// lo..=hi in steps of 1/8: exact in decimals.
    pub fn eighths(&mut self, lo: i64, hi: i64) -> f64 {
        (lo * 8 + self.below(((hi - lo) * 8 + 1) as usize) as i64) as f64 / 8.0
    }
}

/// A valid program of `blocks` blocks: moves, arcs of all forms and planes, modes, dwells.
pub fn program(random: &mut Random, blocks: usize) -> String {
    let mut writer = Writer { plane: 0, text: String::from("G21 G17 G90 G91.1\nF600\nG0 X1 Y2 Z3\n") };
    for n in 0..blocks {
        if random.below(4) == 0 {
            writer.text += &format!("N{} ", n * 10);
        }
        writer.block(random);
        writer.text.push('\n');
    }
    writer.text + "M2\n"
}

struct Writer {
    plane: usize,
    text: String,
}

/// Axis and offset letters of G17, G18, G19: first, second, third.
const PLANES: [([char; 3], [char; 2]); 3] =
    [(['X', 'Y', 'Z'], ['I', 'J']), (['Z', 'X', 'Y'], ['K', 'I']), (['Y', 'Z', 'X'], ['J', 'K'])];

impl Writer {
    fn block(&mut self, random: &mut Random) {
        match random.below(12) {
            0..=2 => self.straight(random, "G0"),
            3..=5 => self.straight(random, "G1"),
            6 | 7 => self.full_or_part_circle(random),
            8 => self.arc_by_radius(random),
            9 => self.text += &format!("G4 P{}", random.eighths(1, 3)),
            10 => {
                let (number, plane) = *random.pick(&[(17, 0), (18, 1), (19, 2)]);
                self.plane = plane;
                self.text += &format!("G{number}");
            }
            _ => {
                let modes =
                    ["G90", "G91", "G20", "G21", "G61", "G61.1", "G64 P0.125", "F900", "S500 M3", "M5", "M8", "M9", "G54"];
                let mode: &&str = random.pick(&modes);
                self.text += mode;
            }
        }
    }

    fn straight(&mut self, random: &mut Random, code: &str) {
        self.text += code;
        for axis in ['X', 'Y', 'Z', 'A', 'B', 'C'] {
            if random.below(3) == 0 {
                self.text += &format!(" {axis}{}", random.eighths(-20, 20));
            }
        }
    }

    /// An arc in G91 with an end on the circle: a multiple of a quarter, possibly with turns and a helix.
    fn full_or_part_circle(&mut self, random: &mut Random) {
        let ([first, second, third], [i, j]) = PLANES[self.plane];
        let (u, v) = (random.eighths(1, 9), random.eighths(-9, 9));
        let (du, dv) = [(0.0, 0.0), (u + v, v - u), (2.0 * u, 2.0 * v), (u - v, v + u)][random.below(4)];
        let code = random.pick(&["G2", "G3"]);
        self.text += &format!("G91 {code} {first}{du} {second}{dv} {i}{u} {j}{v}");
        if random.below(3) == 0 {
            self.text += &format!(" {third}{}", random.eighths(-5, 5));
        }
        if random.below(3) == 0 {
            self.text += &format!(" P{}", 1 + random.below(4));
        }
        if random.below(4) == 0 {
            self.text += &format!(" A{}", random.eighths(-90, 90));
        }
    }

    fn arc_by_radius(&mut self, random: &mut Random) {
        let ([first, second, third], _) = PLANES[self.plane];
        let (du, dv) = (random.eighths(1, 6), random.eighths(-6, 6));
        let r = random.eighths(10, 20) * if random.below(2) == 0 { 1.0 } else { -1.0 };
        let code = random.pick(&["G2", "G3"]);
        self.text += &format!("G91 {code} {first}{du} {second}{dv} R{r}");
        if random.below(3) == 0 {
            self.text += &format!(" {third}{}", random.eighths(-5, 5));
        }
    }
}
