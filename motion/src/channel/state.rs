//! States of a CNC channel and their moves.
//! Runs: cyclic. From: transitions N1..N10 of the CNC function blocks.

/// State of a channel; the number is that of CNC_STATE.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)] // the names of CNC_STATE
#[repr(i16)]
pub enum CncState {
    NotReady = 0,
    Idle = 1,
    Ready = 2,
    Running = 3,
    Holding = 4,
    Held = 5,
    AuxWait = 6,
    StepStop = 7,
    ProgStop = 8,
    Aborting = 9,
    Fault = 10,
}

/// What may change it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum CncEvent {
    /// The axes have power and no error; no program is loaded.
    AxesReady,
    /// The axes have power and no error; a program is loaded.
    AxesReadyLoaded,
    /// An axis has lost power or has an error.
    AxesLost,
    /// A program has been loaded.
    Loaded,
    /// CNC_Run.
    Run,
    /// CNC_Hold.
    Hold,
    /// The path stands.
    AtRest,
    /// CNC_Resume.
    Resume,
    /// A code waits for the PLC program.
    Wait,
    /// The PLC program has finished it.
    Finished,
    /// The same while a hold is wanted.
    FinishedHeld,
    /// A block has ended, and single blocks are wanted.
    BlockEnd,
    /// M0, or M1 with optional stop.
    ProgramStop,
    /// M2, M30, end of file.
    End,
    /// CNC_Abort, or the axes were taken away.
    Abort,
    /// An error.
    Fault,
    /// CNC_Reset.
    Reset,
}

impl CncState {
    /// All states.
    pub const ALL: [CncState; 11] = {
        use CncState as S;
        [
            S::NotReady,
            S::Idle,
            S::Ready,
            S::Running,
            S::Holding,
            S::Held,
            S::AuxWait,
            S::StepStop,
            S::ProgStop,
            S::Aborting,
            S::Fault,
        ]
    };

    /// True while a program has the axes.
    pub const fn is_active(self) -> bool {
        use CncState as S;
        matches!(self, S::Running | S::Holding | S::Held | S::AuxWait | S::StepStop | S::ProgStop | S::Aborting)
    }

    /// The name in CNC_STATE.
    pub const fn name(self) -> &'static str {
        match self {
            CncState::NotReady => "cncNotReady",
            CncState::Idle => "cncIdle",
            CncState::Ready => "cncReady",
            CncState::Running => "cncRunning",
            CncState::Holding => "cncHolding",
            CncState::Held => "cncHeld",
            CncState::AuxWait => "cncAuxWait",
            CncState::StepStop => "cncStepStop",
            CncState::ProgStop => "cncProgStop",
            CncState::Aborting => "cncAborting",
            CncState::Fault => "cncFault",
        }
    }
}

impl CncEvent {
    /// All events.
    pub const ALL: [CncEvent; 17] = {
        use CncEvent as E;
        [
            E::AxesReady,
            E::AxesReadyLoaded,
            E::AxesLost,
            E::Loaded,
            E::Run,
            E::Hold,
            E::AtRest,
            E::Resume,
            E::Wait,
            E::Finished,
            E::FinishedHeld,
            E::BlockEnd,
            E::ProgramStop,
            E::End,
            E::Abort,
            E::Fault,
            E::Reset,
        ]
    };
}

/// The state after an event. `None`: the command is refused.
pub const fn next(state: CncState, event: CncEvent) -> Option<CncState> {
    use {CncEvent as E, CncState as S};
    Some(match (state, event) {
        (_, E::Fault) => S::Fault,
        (S::Fault, E::Reset) => S::NotReady, // and on from there with N1
        (same, E::Reset) if !same.is_active() => same,
        (S::NotReady, E::AxesReady) => S::Idle,
        (S::NotReady, E::AxesReadyLoaded) => S::Ready,
        (S::Idle | S::Ready, E::AxesLost) => S::NotReady,
        (S::Idle | S::Ready, E::Loaded) => S::Ready,
        (S::NotReady, E::Loaded) => S::NotReady,
        (S::Idle | S::Ready, E::Run) => S::Running, // from Idle a single block (CNC_MDI)
        (S::ProgStop | S::StepStop | S::Held | S::Holding, E::Resume) => S::Running,
        (S::Running, E::Hold) => S::Holding,
        (S::AuxWait, E::Hold | E::Resume) => S::AuxWait, // the strobe stays; the hold counts behind it
        (S::Holding | S::Held, E::Hold) => state,
        (S::Holding, E::AtRest) => S::Held,
        (S::Running, E::Wait) => S::AuxWait,
        (S::AuxWait, E::Finished) => S::Running,
        (S::AuxWait, E::FinishedHeld) => S::Held,
        (S::Running, E::BlockEnd) => S::StepStop,
        (S::Running | S::Holding, E::ProgramStop) => S::ProgStop,
        (S::Running | S::Holding | S::AuxWait, E::End) => S::Ready,
        (S::Aborting, E::AtRest) => S::Ready,
        (active, E::Abort) if active.is_active() => S::Aborting,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// N1..N10, the whole table.
    #[test]
    fn table() {
        let mut text = String::new();
        for state in CncState::ALL {
            text += &format!("{}:\n", state.name());
            for event in CncEvent::ALL {
                let to = next(state, event).map_or("-", CncState::name);
                text += &format!("  {event:?} -> {to}\n");
            }
        }
        crate::snapshot("channel_states", &text);
    }
}
