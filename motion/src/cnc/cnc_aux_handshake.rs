//! CNC_AuxHandshake: M, S and T codes to the PLC program and its answer (S39).
//! Runs: cyclic. One step of [`crate::channel::aux`] a call.

use crate::channel::{Channel, CncState};
use crate::natives::{Core, Frame, rules};
use crate::{block, enable_pins};

block! {
    /// Codes stand one call before their strobes. Fin ends the wait and must fall after the strobes.
    "CNC_AuxHandshake", call;
    InOut Cnc: "CNC_REF";
    Input Enable: "BOOL";
    Input Fin: "BOOL";
    Input Fault: "BOOL";
    Input FaultID: "WORD";
    Input PreFinM: "UINT";
    Output Valid: "BOOL";
    Output Busy: "BOOL";
    Output Error: "BOOL";
    Output ErrorID: "WORD";
    Output Mf: "BOOL";
    Output Sf: "BOOL";
    Output Tf: "BOOL";
    Output MCount: "USINT";
    Output MCode: "ARRAY[0..3] OF UINT";
    Output MParam: "ARRAY[0..3, 0..3] OF LREAL";
    Output SCode: "LREAL";
    Output TCode: "UDINT";
    Output MotionDone: "BOOL";
    Output Dm00: "BOOL";
    Output Dm01: "BOOL";
    Output Dm02: "BOOL";
    Output Dm30: "BOOL";
    Output Cancelled: "BOOL";
    Output Seq: "UDINT";
}

fn call(core: &mut Core, f: &mut Frame) {
    let target = rules::channel(core, f.reference(P::Cnc));
    if let Some(i) = rules::read(f, &enable_pins!(P, Valid), target) {
        let channel = &mut core.channels[i];
        if f.bool(P::Fault) {
            channel.aux_fault(f.u16(P::FaultID));
        }
        channel.aux.call(f.bool(P::Fin), f.u16(P::PreFinM));
        codes(channel, f);
        strobes(channel, f);
    } else {
        for pin in [P::Mf, P::Sf, P::Tf, P::Dm00, P::Dm01, P::Dm02, P::Dm30, P::Cancelled] {
            f.set_bool(pin, false);
        }
    }
}

fn codes(channel: &Channel, f: &mut Frame) {
    let shown = channel.aux.shown();
    f.set_u8(P::MCount, shown.m_count);
    for (i, (m, words)) in (0..).zip(shown.m.iter().zip(&shown.m_param)) {
        f.set_u16_at(P::MCode, i, *m);
        for (k, word) in (0..).zip(words) {
            f.set_lreal_at(P::MParam, 4 * i + k, *word);
        }
    }
    f.set_lreal(P::SCode, shown.s.unwrap_or(0.0));
    f.set_u32(P::TCode, shown.t.unwrap_or(0));
    f.set_u32(P::Seq, channel.aux.seq());
}

fn strobes(channel: &Channel, f: &mut Frame) {
    let aux = &channel.aux;
    f.set_bool(P::Mf, aux.mf());
    f.set_bool(P::Sf, aux.sf());
    f.set_bool(P::Tf, aux.tf());
    f.set_bool(P::Dm00, channel.stop_code() == Some(0));
    f.set_bool(P::Dm01, channel.stop_code() == Some(1));
    f.set_bool(P::Dm02, aux.has_m(2));
    f.set_bool(P::Dm30, aux.has_m(30));
    f.set_bool(P::Cancelled, aux.is_cancelled());
    f.set_bool(P::MotionDone, channel.speed() == 0.0 && channel.state() != CncState::Running);
}
