//! Wild pointers: any number is read and written through pointers of many types. Each access is legal or a fault, memory out of reach
//! stays as it is, and interpreter and native code agree.

use takt_base::Profile;
use takt_image::{Trap, header};
use takt_tests::plc::Plc;
use takt_tests::rng::Rng;

const ACCESSES: [&str; 14] = [
    "b := pb^;",
    "pb^ := b;",
    "d := pd^;",
    "pd^ := d;",
    "l := pl^;",
    "pl^ := l;",
    "s := ps^;",
    "ps^ := s;",
    "r := pr^;",
    "pr^ := r;",
    "d := pa^[i];",
    "pa^[i] := d;",
    "pr^.n := pr^.n + 1;",
    "x := pp^^;",
];

fn program(access: &str) -> String {
    format!(
        "TYPE R : STRUCT n : INT; t : ARRAY [0..3] OF LINT; c : BOOL; END_STRUCT END_TYPE
        PROGRAM Main VAR at_ : DWORD; i : INT; pb : POINTER TO BYTE; pd : POINTER TO DWORD; pl : POINTER TO LREAL; ps : POINTER TO STRING(40);
            pr : POINTER TO R; pa : POINTER TO ARRAY [0..9] OF DWORD; pp : POINTER TO POINTER TO INT; b : BYTE; d : DWORD; l : LREAL; s : STRING(40);
            r : R; x : INT; in AT %IW0 : WORD; out AT %QW0 : WORD; done : BOOL; END_VAR
            pb := at_; pd := at_; pl := at_; ps := at_; pr := at_; pa := at_; pp := at_;
            {access}
            done := TRUE;
        END_PROGRAM"
    )
}

#[test]
fn any_number_is_a_legal_access_or_a_fault() {
    let mut rng = Rng::new(2026);
    let (mut legal, mut faults) = (0, 0);
    for access in ACCESSES {
        let text = program(access);
        for round in 0..60 {
            let mut plc = Plc::new_in(Profile::Codesys2, &text);
            let size = plc.image.memory.size();
            let data = plc.image.memory.data;
            let at = match round % 6 {
                0 => rng.bits() as u32,
                1 => rng.range(0, size),
                2 => rng.range(data.start, data.end()),
                3 => rng.range(0, header::SIZE + 8),
                4 => rng.range(data.end() - 64, data.end() + 64),
                _ => rng.range(size - 64, size + 64),
            };
            plc.set("Main.at_", &format!("16#{at:X}"));
            plc.set("Main.i", &(rng.below(12) as i32 - 1).to_string());
            match plc.scan(0).map_err(|f| f.trap) {
                Ok(()) => legal += 1,
                Err(Trap::NullReference | Trap::WildPointer | Trap::Index) => faults += 1,
                Err(other) => panic!("{access} at {at}: {other:?}"),
            }
            // Whatever it has written, the next scan ends too, and both engines agree on it.
            let _ = plc.scan(10);
        }
    }
    assert!(legal > 100 && faults > 100, "{legal} legal, {faults} faults");
}
