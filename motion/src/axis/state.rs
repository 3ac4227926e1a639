//! States of an axis and their moves.
//! Runs: cyclic. From: PLCopen Motion Control part 1 §2.1, transitions A1..A15 and the acceptance of commands in each state.

/// State of an axis.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)] // the standard's names
pub enum AxisState {
    Disabled,
    Standstill,
    Homing,
    DiscreteMotion,
    ContinuousMotion,
    SynchronizedMotion,
    Stopping,
    ErrorStop,
}

/// What may change it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum AxisEvent {
    /// The power stage has come on.
    PowerOn,
    /// Power is no longer wanted, the axis still moves.
    PowerBrake,
    /// The power stage is off because it is not wanted.
    PowerOff,
    /// Axis, drive or controller error.
    Fault,
    /// MC_Reset with power.
    ResetOn,
    /// MC_Reset without power.
    ResetOff,
    /// MC_Home.
    Home,
    /// MC_MoveAbsolute, MC_MoveRelative.
    Move,
    /// MC_MoveVelocity.
    MoveVelocity,
    /// MC_Halt.
    Halt,
    /// MC_Stop.
    Stop,
    /// A channel takes the axis.
    Join,
    /// The command has ended and nothing follows.
    Done,
    /// MC_Stop is done and its Execute is FALSE.
    StopReleased,
}

impl AxisState {
    /// All states.
    pub const ALL: [AxisState; 8] = {
        use AxisState as S;
        [
            S::Disabled,
            S::Standstill,
            S::Homing,
            S::DiscreteMotion,
            S::ContinuousMotion,
            S::SynchronizedMotion,
            S::Stopping,
            S::ErrorStop,
        ]
    };
}

impl AxisEvent {
    /// All events.
    pub const ALL: [AxisEvent; 14] = {
        use AxisEvent as E;
        [
            E::PowerOn,
            E::PowerBrake,
            E::PowerOff,
            E::Fault,
            E::ResetOn,
            E::ResetOff,
            E::Home,
            E::Move,
            E::MoveVelocity,
            E::Halt,
            E::Stop,
            E::Join,
            E::Done,
            E::StopReleased,
        ]
    };
}

/// The state after an event. `None`: the command is refused.
pub const fn next(state: AxisState, event: AxisEvent) -> Option<AxisState> {
    use {AxisEvent as E, AxisState as S};
    Some(match (state, event) {
        (_, E::Fault) => S::ErrorStop,
        (S::ErrorStop, E::ResetOn) => S::Standstill,
        (S::ErrorStop, E::ResetOff) => S::Disabled,
        (same, E::ResetOn | E::ResetOff) => same,
        (S::ErrorStop, E::PowerOn | E::PowerOff) => S::ErrorStop,
        (S::ErrorStop, _) => return None,
        (_, E::PowerOff) => S::Disabled,
        (S::Disabled, E::PowerOn) => S::Standstill,
        (same, E::PowerOn) => same,
        (S::Disabled, _) => return None,
        (_, E::PowerBrake) => S::Stopping,
        (S::Standstill, E::Home) => S::Homing,
        (S::Standstill, E::Join) => S::SynchronizedMotion,
        (S::Standstill | S::DiscreteMotion | S::ContinuousMotion | S::SynchronizedMotion, E::Move | E::Halt) => S::DiscreteMotion,
        (S::Standstill | S::DiscreteMotion | S::ContinuousMotion | S::SynchronizedMotion, E::MoveVelocity) => S::ContinuousMotion,
        (S::Standstill | S::Homing | S::DiscreteMotion | S::ContinuousMotion | S::SynchronizedMotion, E::Stop) => S::Stopping,
        (S::Homing | S::DiscreteMotion | S::SynchronizedMotion, E::Done) => S::Standstill,
        (S::Stopping, E::StopReleased) => S::Standstill,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A1..A15, the whole table.
    #[test]
    fn table() {
        let mut text = String::new();
        for state in AxisState::ALL {
            text += &format!("{state:?}:\n");
            for event in AxisEvent::ALL {
                let to = next(state, event).map_or("-".to_owned(), |s| format!("{s:?}"));
                text += &format!("  {event:?} -> {to}\n");
            }
        }
        crate::snapshot("axis_states", &text);
    }
}
