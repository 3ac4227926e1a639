//! G5, G5.1, G5.2, G5.3: splines in the plane XY as NURBS (LinuxCNC "G5 Cubic Spline" and behind).

use super::{check_feed, need, target};
use crate::canon::{Canon, Nurbs, Plane};
use crate::ngc::execute::{Done, Run};
use crate::ngc::modal::{FeedMode, Motion};
use crate::ngc::request::{bad_value, missing, not_now};
use takt_base::{Code, Diag};

/// Control points that one NURBS may have.
const POINTS_MAX: usize = 100_000;

/// Makes a spline block.
///
/// # Errors
/// A word is missing, or the mode does not fit.
pub fn run(run: &mut Run, motion: Motion) -> Done {
    let at = run.request.motion_span();
    if run.state.modal.plane != Plane::Xy {
        return Err(Box::new(not_now(at, format!("{} outside of the plane XY", motion.text()), "write G17 before it")));
    }
    run.uncompensated(at, motion.text())?;
    if motion != Motion::NurbsEnd {
        if run.state.modal.feed_mode == FeedMode::InverseTime {
            return Err(Box::new(not_now(at, format!("{} with G93", motion.text()), "write G94 and F before it")));
        }
        check_feed(run, motion)?;
    }
    if let Some(word) = ['Z', 'A', 'B', 'C'].into_iter().find_map(|l| run.request.word(l)) {
        let diag = Diag::new(Code::UnusedWord, word.span, "a spline moves X and Y alone");
        return Err(Box::new(diag.help("move the other axes before or behind it")));
    }
    match motion {
        Motion::Cubic => cubic(run),
        Motion::Quadratic => quadratic(run),
        Motion::Nurbs => control_point(run),
        _ => finish(run),
    }
}

/// G5: I and J lead from the start, P and Q to the end. Without I and J the spline goes on as the one before ended.
fn cubic(run: &mut Run) -> Done {
    let request = run.request;
    let from = run.state.modal.position;
    let end = target(request, run.state)?;
    let (Some(p), Some(q)) = (request.value('P'), request.value('Q')) else {
        return Err(Box::new(
            missing(request.motion_span(), "P and Q").help("they lead from the end to the second control point"),
        ));
    };
    let lead = match (request.value('I'), request.value('J'), run.state.spline_end) {
        (None, None, Some([x, y])) => [x, y],
        (None, None, None) => [0.0, 0.0],
        (Some(i), Some(j), _) => [i, j],
        _ => return Err(Box::new(missing(request.motion_span(), "both I and J").help("they lead to the first control point"))),
    };
    let first = [from.x + lead[0], from.y + lead[1], 1.0];
    let second = [end.x + p, end.y + q, 1.0];
    run.emit(Canon::NurbsFeed(Nurbs { order: 4, points: vec![[from.x, from.y, 1.0], first, second, [end.x, end.y, 1.0]] }));
    run.modal().position = end;
    run.state.spline_end = Some([-p, -q]);
    run.modal().motion = None;
    Ok(())
}

/// G5.1: I and J lead to the one control point.
fn quadratic(run: &mut Run) -> Done {
    let request = run.request;
    let (Some(i), Some(j)) = (request.value('I'), request.value('J')) else {
        return Err(Box::new(missing(request.motion_span(), "both I and J").help("they lead to the control point")));
    };
    let from = run.state.modal.position;
    let end = target(request, run.state)?;
    let middle = [from.x + i, from.y + j, 1.0];
    run.emit(Canon::NurbsFeed(Nurbs { order: 3, points: vec![[from.x, from.y, 1.0], middle, [end.x, end.y, 1.0]] }));
    run.modal().position = end;
    run.modal().motion = None;
    Ok(())
}

/// G5.2: one control point a block, with its weight P; L of the first block is the order.
fn control_point(run: &mut Run) -> Done {
    let request = run.request;
    let weight = need(request, 'P', "P is the weight of the control point, above 0")?;
    if weight.value <= 0.0 {
        return Err(Box::new(bad_value(weight, "no weight", "write a number above 0")));
    }
    let from = run.state.modal.position;
    if run.state.nurbs.is_none() {
        let order = match request.word('L') {
            None => 3,
            Some(word) => match word.whole().filter(|o| (3..=32).contains(o)) {
                Some(order) => order,
                None => return Err(Box::new(bad_value(word, "no order of a NURBS", "write a whole number from 3"))),
            },
        };
        run.state.nurbs = Some((order, vec![[from.x, from.y, 1.0]]));
    }
    let end = target(request, run.state)?;
    if let Some((_, points)) = &mut run.state.nurbs {
        if points.len() >= POINTS_MAX {
            let at = request.motion_span();
            return Err(Box::new(Diag::new(Code::BadValue, at, "more than 100000 control points").help("write several curves")));
        }
        points.push([end.x, end.y, weight.value]);
    }
    run.modal().position = end;
    Ok(())
}

/// G5.3.
fn finish(run: &mut Run) -> Done {
    let at = run.request.motion_span();
    let Some((order, points)) = run.state.nurbs.take() else {
        return Err(Box::new(not_now(at, "G5.3 without G5.2", "write the control points with G5.2 first")));
    };
    run.modal().motion = None;
    if points.len() < order as usize {
        let label = format!("{} control points", points.len());
        let help = format!("a NURBS of order {order} has at least {order} control points");
        return Err(Box::new(Diag::new(Code::BadValue, at, label).help(help)));
    }
    run.emit(Canon::NurbsFeed(Nurbs { order, points }));
    Ok(())
}
