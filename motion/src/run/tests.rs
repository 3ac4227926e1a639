//! Commands to moves and codes.

use super::*;
use crate::canon::Units;

fn read(work: Work, commands: &[(u32, Canon)]) -> Result<Vec<Item>, RunError> {
    let mut reader = RunReader::new(work, [0.0; 6]);
    let mut items = Vec::new();
    for (block, command) in commands {
        let step = Step { block: *block, line: *block, n: None, command: command.clone() };
        reader.read(&step, &mut |_, item| items.push(item))?;
    }
    reader.finish(&mut |_, item| items.push(item));
    Ok(items)
}

fn at(x: f64, y: f64, z: f64) -> Position {
    Position { x, y, z, ..Position::default() }
}

fn end(item: &Item) -> Point {
    let Item::Move(m) = item else { panic!("{item:?} is no move") };
    m.path.end
}

/// CM-T4, CM-T5, CM-T6: offsets and units renumber; nothing moves.
#[test]
fn units_and_offsets() {
    let items = read(
        Work::default(),
        &[
            (1, Canon::StraightTraverse(at(100., 50., 0.))),
            (2, Canon::SetOriginOffsets(at(10., 20., 0.))),
            (3, Canon::StraightTraverse(at(0., 0., 5.))),
            (4, Canon::UseLengthUnits(Units::Inches)),
            (4, Canon::UseToolLengthOffset(1.0)),
            (5, Canon::StraightTraverse(at(1., 0., 0.))),
        ],
    )
    .unwrap();
    assert_eq!(end(&items[1])[..3], [10., 20., 5.]);
    assert_eq!(end(&items[2])[..3], [35.4, 20., 25.4]);
}

/// CM-T9: in the plane XZ the first axis is Z, the second X.
#[test]
fn plane_xz() {
    let arc = Arc { first_end: 0., second_end: 1., first_axis: 0., second_axis: 0., rotation: 1, ..Arc0::ARC };
    let items = read(
        Work::default(),
        &[
            (1, Canon::StraightTraverse(at(0., 0., 1.))),
            (2, Canon::SelectPlane(Plane::Xz)),
            (2, Canon::SetFeedRate(60.)),
            (2, Canon::ArcFeed(arc)),
        ],
    )
    .unwrap();
    let Item::Move(m) = items[1] else { panic!() };
    assert!((m.path.length - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    assert_eq!(m.path.end[..3], [1., 0., 0.]);
    assert_eq!(m.feed, 1.0);
}

struct Arc0;
impl Arc0 {
    const ARC: Arc = Arc {
        first_end: 0.,
        second_end: 0.,
        first_axis: 0.,
        second_axis: 0.,
        rotation: 0,
        axis_end_point: 0.,
        a: 0.,
        b: 0.,
        c: 0.,
    };
}

/// Scenario S39: codes of a block share a strobe, unless one waits and the other does not.
#[test]
fn codes_of_a_block_go_together() {
    let work = Work { handshake: true, ..Work::default() };
    let items = read(
        work,
        &[
            (1, Canon::SetSpindleSpeed(500.)),
            (1, Canon::StartSpindleClockwise),
            (1, Canon::FloodOn),
            (2, Canon::MistOff),
            (2, Canon::FloodOff),
            (3, Canon::StopSpindleTurning),
            (3, Canon::ProgramEnd(ProgramEnd::M30)),
        ],
    )
    .unwrap();
    let aux: Vec<_> = items
        .iter()
        .filter_map(|i| if let Item::Action(Action::Aux(c)) = i { Some((c.m, c.m_count, c.s, c.wait)) } else { None })
        .collect();
    assert_eq!(
        aux,
        [
            ([3, 0, 0, 0], 1, Some(500.), true),
            ([8, 0, 0, 0], 1, None, false),
            ([9, 0, 0, 0], 1, None, false),
            ([5, 0, 0, 0], 1, None, false)
        ]
    );
}

#[test]
fn what_the_machine_cannot_do() {
    let mut work = Work::default();
    work.exists[5] = false;
    work.max[0] = 100.0;
    let code = |commands: &[(u32, Canon)]| read(work, commands).unwrap_err().code;
    let rotary = Position { c: 1.0, ..Position::default() };
    assert_eq!(code(&[(1, Canon::StraightTraverse(rotary))]), Code::UnknownReference);
    assert_eq!(code(&[(1, Canon::StraightTraverse(at(100.1, 0., 0.)))]), Code::OutsideLimits);
    assert_eq!(code(&[(1, Canon::StraightFeed(at(1., 0., 0.)))]), Code::NoFeed);
    assert_eq!(code(&[(1, Canon::StraightTraverse(at(f64::NAN, 0., 0.)))]), Code::OutsideLimits);
    // CM-T10
    let arc = Arc { first_end: 1., first_axis: 5., rotation: 0, ..Arc0::ARC };
    assert_eq!(code(&[(1, Canon::SetFeedRate(1.)), (1, Canon::ArcFeed(arc))]), Code::RadiusMismatch);
}
