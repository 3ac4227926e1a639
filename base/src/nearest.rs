//! The name that was probably meant: for the help text of a message about an unknown name.

/// The candidate closest to `name` without regard to case, if it is close enough to be a typing error. The first of equals wins.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let name: Vec<char> = name.chars().take(MAX).flat_map(char::to_lowercase).collect();
    let allowed = name.len().div_ceil(3).min(3);
    let near = candidates.into_iter().map(|c| (distance(&name, c), c)).filter(|&(d, _)| d <= allowed);
    near.min_by_key(|&(d, _)| d).map(|(_, c)| c)
}

/// Longer names are compared by their beginnings.
const MAX: usize = 64;

/// Edits (insert, delete, replace, swap of neighbours) from `a`, in lower case, to `b`.
fn distance(a: &[char], b: &str) -> usize {
    let mut before: Vec<usize> = Vec::new();
    let mut row: Vec<usize> = (0..=a.len()).collect();
    let mut last = None;
    for (j, cb) in b.chars().take(MAX).flat_map(char::to_lowercase).enumerate() {
        let mut next = vec![j + 1];
        for i in 0..a.len() {
            let edit = row[i] + usize::from(a[i] != cb);
            let mut best = edit.min(row[i + 1] + 1).min(next[i] + 1);
            if i > 0 && Some(a[i]) == last && a[i - 1] == cb {
                best = best.min(before[i - 1] + 1);
            }
            next.push(best);
        }
        before = std::mem::replace(&mut row, next);
        last = Some(cb);
    }
    row[a.len()]
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn finds_typing_errors_and_nothing_else() {
        let names = ["Level", "Valve", "pressure"];
        for (text, want) in [
            ("levle", Some("Level")),
            ("LEVEL", Some("Level")),
            ("presure", Some("pressure")),
            ("xalve", Some("Valve")),
            ("motor", None),
            ("", None),
        ] {
            assert_eq!(nearest(text, names), want, "{text}");
        }
    }
}
