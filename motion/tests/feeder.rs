//! The background half of a channel, driven by hand.

use std::sync::{Arc, Mutex};
use takt_base::ring::ring;
use takt_motion::canon::{Canon, Position, Step};
use takt_motion::feeder::{Command, Environment, Feeder, FeederConfig, How, NAME_BYTES, Plain, Reader};
use takt_motion::lookahead::AxisLimits;
use takt_motion::run::Work;

/// A command that comes while a program is being fed into a ring that never fills is obeyed at once, not at the end of the program.
#[test]
fn an_abort_is_obeyed_in_the_middle_of_a_program() {
    let (mut commands, command_rx) = ring(16);
    let (event_tx, mut events) = ring(16);
    let (out, mut released) = ring(1024);
    let config = FeederConfig {
        axes: AxisLimits::uniform(100.0, 1000.0),
        work: Work::default(),
        check_on_load: false,
        ..FeederConfig::default()
    };
    let mut feeder = Feeder::new(config, command_rx, event_tx, out);
    assert!(commands.push(Command::Load { request: 1, name: [b'a'; NAME_BYTES], start: [0.0; 6] }).is_ok());
    assert!(commands.push(Command::Run { run: 1, start: [0.0; 6], how: How::default() }).is_ok());

    let read = Arc::new(Mutex::new(0));
    // The 50th command of the program comes together with the abort; the ring is emptied all the time.
    let program = Mutex::new(Some(Plain({
        let read = Arc::clone(&read);
        let mut line = 0;
        std::iter::from_fn(move || {
            while released.pop().is_some() {}
            line += 1;
            *read.lock().unwrap() = line;
            if line == 50 {
                assert!(commands.push(Command::Abort).is_ok());
            }
            let x = f64::from(line % 2);
            let command =
                if line == 1 { Canon::SetFeedRate(6000.0) } else { Canon::StraightFeed(Position { x, ..Position::default() }) };
            (line < 100_000).then_some(Ok(Step { block: line, line, n: None, command }))
        })
    })));
    let reader: Reader = Box::new(move |_| Box::new(program.lock().unwrap().take().unwrap()));
    let environment = Environment::reading(Box::new(|_| Ok(String::new())));
    while feeder.pump(&environment, &reader) {}
    assert!(events.pop().is_some(), "loaded");
    assert_eq!(*read.lock().unwrap(), 50);
}
