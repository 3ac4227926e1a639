//! Every program of `corpus/` on LinuxCNC's stand-alone interpreter and on ours, in the drop-in form: the same calls, the same end.
//! Skips itself, with a note, where `rs274` (Debian: linuxcnc-uspace) is not installed.

mod common;

use common::oracle::{Folder, corpus, installed, ours, programs, same_rows, theirs};

/// The first difference of a program, or nothing.
fn difference(program: &str, folder: &Folder) -> Option<String> {
    let ((theirs, their_end), (ours, our_end)) = (theirs(program, &folder.0), ours(program));
    let first = (0..theirs.len().max(ours.len())).find(|&i| match (theirs.get(i), ours.get(i)) {
        (Some(a), Some(b)) => !same_rows(a, b),
        _ => true,
    });
    if first.is_none() && their_end == our_end {
        return None;
    }
    let row = |rows: &[String]| first.and_then(|i| rows.get(i).cloned()).unwrap_or_default();
    Some(format!("{program:?}\n   row {first:?}: LinuxCNC {their_end} {}\n   ours {our_end} {}", row(&theirs), row(&ours)))
}

#[test]
fn corpus_gives_the_same_calls() {
    if !installed() {
        return;
    }
    let differs = programs(include_str!("corpus_differs.txt"));
    let (mut equal, mut total, mut wrong) = (0, 0, Vec::new());
    let programs = corpus();
    let halves: Vec<Vec<(String, Option<String>)>> = std::thread::scope(|scope| {
        let work = |part: usize| {
            let programs = &programs;
            move || {
                let folder = Folder::new(&format!("corpus-{part}"));
                let mine = programs.iter().skip(part).step_by(2);
                mine.map(|p| (p.clone(), difference(p, &folder))).collect::<Vec<_>>()
            }
        };
        let handles = [scope.spawn(work(0)), scope.spawn(work(1))];
        handles.into_iter().map(|h| h.join().unwrap()).collect()
    });
    for (program, difference) in halves.into_iter().flatten() {
        total += 1;
        match difference {
            None => equal += 1,
            Some(_) if differs.contains(&program) => {}
            Some(text) => wrong.push(text),
        }
    }
    println!("{equal} of {total} programs give the same calls as rs274");
    assert!(wrong.is_empty(), "{} programs differ:\n{}", wrong.len(), wrong.join("\n"));
}
