//! Comments that say something: MSG, DEBUG, PRINT, LOG, ABORT (LinuxCNC "Comments").

use super::Run;
use crate::canon::Canon;
use crate::ngc::code::{Code as Arena, Comment, CommentKind, Row};
use crate::ngc::param;
use crate::ngc::state::State;
use takt_base::{Code, Diag, Span};

impl Run<'_, '_> {
    /// All comments of a row; the drop-in form takes the last one, as LinuxCNC does.
    pub fn comments(&mut self, row: &Row, arena: &Arena) {
        let comments = &arena.comments[row.comments.range()];
        let first = if self.state.options.drop_in { comments.len() - 1 } else { 0 };
        for comment in &comments[first..] {
            self.comment(*comment, arena.text(comment.text), arena);
        }
    }

    fn comment(&mut self, comment: Comment, inside: &str, arena: &Arena) {
        let said = || inside.to_owned();
        let state = &*self.state;
        let command = match comment.kind {
            CommentKind::Plain => Canon::Comment(said()),
            CommentKind::Message => Canon::Message(said()),
            CommentKind::Debug if state.params.get(5599) == 0.0 => return,
            CommentKind::Debug => Canon::Message(filled(inside, state, arena)),
            CommentKind::Print => Canon::Print(filled(inside, state, arena)),
            CommentKind::Log => Canon::Log(filled(inside, state, arena)),
            CommentKind::LogOpen => Canon::LogOpen(said()),
            CommentKind::LogAppend => Canon::LogAppend(said()),
            CommentKind::LogClose => Canon::LogClose,
            CommentKind::ProbeOpen | CommentKind::ProbeClose => return,
            CommentKind::Abort => return self.abort(comment, inside, arena),
        };
        self.emit(command);
    }

    fn abort(&mut self, comment: Comment, inside: &str, arena: &Arena) {
        let text = filled(inside, self.state, arena);
        let span = Span { source: self.request.span.source, start: comment.place.0, end: comment.place.1 };
        let diag = Diag::new(Code::ProgramAborted, span, "ABORT stands here").message(text.trim().to_owned());
        self.out.diags.push(diag.help("the program found a state in which it can't go on"));
    }
}

/// `text` with the values of `#5` and `#<name>` in it. `%d`, `%f` and `%.3f` say how many decimals those behind have.
fn filled(text: &str, state: &State, arena: &Arena) -> String {
    let (mut out, mut decimals, mut rest) = (String::new(), 6, text);
    while let Some(c) = rest.chars().next() {
        if let Some((length, places)) = format_of(rest) {
            decimals = places;
            rest = &rest[length..];
        } else if c == '#' {
            let (length, value) = parameter(rest, state, arena);
            match value {
                Some(value) => out += &format!("{value:.decimals$}"),
                None => out += "######",
            }
            rest = &rest[length..];
        } else {
            out.push(c);
            rest = &rest[c.len_utf8()..];
        }
    }
    out
}

fn format_of(rest: &str) -> Option<(usize, usize)> {
    if rest.starts_with("%d") {
        return Some((2, 0));
    }
    if rest.starts_with("%f") {
        return Some((2, 4));
    }
    let bytes = rest.strip_prefix("%.")?.as_bytes();
    let digit = bytes.first().filter(|b| b.is_ascii_digit())?;
    (bytes.get(1) == Some(&b'f')).then_some((4, usize::from(digit - b'0')))
}

/// Bytes of the parameter at the start of `rest`, and its value.
fn parameter(rest: &str, state: &State, arena: &Arena) -> (usize, Option<f64>) {
    let inside = &rest[1..];
    if let Some(name) = inside.strip_prefix('<')
        && let Some(end) = name.find('>')
    {
        let plain: String = name[..end].chars().filter(|c| !c.is_whitespace()).collect::<String>().to_ascii_lowercase();
        let name = arena.names.find(&plain).or_else(|| crate::ngc::param::Names::fixed(&plain));
        let value = name.and_then(|name| state.named(name, arena));
        let outside = || plain.starts_with(crate::ngc::outside::PREFIX).then(|| state.outside_value(&plain)).flatten();
        return (end + 3, value.or_else(outside));
    }
    let digits = inside.bytes().take_while(u8::is_ascii_digit).count();
    let index = inside[..digits].parse().ok().and_then(param::index);
    (1 + digits, index.map(|i| state.numbered(i)))
}
