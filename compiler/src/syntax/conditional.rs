//! Conditional compilation of CODESYS: `{define x}`, `{undefine x}`, `{IF defined(x)} {ELSIF ..} {ELSE} {END_IF}`.
//! Conditions: `defined(name)`, NOT, AND, OR and parentheses. From: language reference §1.4.

use std::collections::HashSet;

/// What has been defined, and the branches that are open.
#[derive(Default)]
pub(crate) struct Conditional {
    defined: HashSet<String>,
    open: Vec<Branch>,
}

/// An IF that is open.
struct Branch {
    /// The text here counts.
    active: bool,
    /// A branch of this IF has been taken, or the IF itself stands in text that does not count.
    taken: bool,
    /// ELSE has come.
    last: bool,
}

/// Why a pragma of this kind can't be followed.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Mistake {
    /// ELSIF, ELSE or END_IF without an IF, or behind its ELSE.
    Unopened,
    /// A condition that is not understood.
    Condition,
}

impl Conditional {
    /// True if the text here counts.
    pub(crate) fn is_active(&self) -> bool {
        self.open.iter().all(|b| b.active)
    }

    /// True if an IF is open.
    pub(crate) fn is_open(&self) -> bool {
        !self.open.is_empty()
    }

    /// Follows a pragma; `None` if it is not one of these.
    pub(crate) fn follow(&mut self, text: &str) -> Option<Result<(), Mistake>> {
        let (word, rest) = text.split_at(text.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(text.len()));
        let name = rest.trim().to_ascii_uppercase();
        match word.to_ascii_uppercase().as_str() {
            "DEFINE" if self.is_active() => drop(self.defined.insert(name)),
            "UNDEFINE" if self.is_active() => drop(self.defined.remove(&name)),
            "DEFINE" | "UNDEFINE" => {}
            "IF" => return Some(self.open(rest)),
            "ELSIF" => return Some(self.next_branch(Some(rest))),
            "ELSE" => return Some(self.next_branch(None)),
            "END_IF" => return Some(self.open.pop().map(drop).ok_or(Mistake::Unopened)),
            _ => return None,
        }
        Some(Ok(()))
    }

    fn open(&mut self, condition: &str) -> Result<(), Mistake> {
        let outer = self.is_active();
        let holds = self.holds(condition);
        let active = outer && holds.as_ref().is_ok_and(|h| *h);
        self.open.push(Branch { active, taken: active || !outer, last: false });
        holds.map(drop)
    }

    fn next_branch(&mut self, condition: Option<&str>) -> Result<(), Mistake> {
        let holds = condition.map_or(Ok(true), |c| self.holds(c));
        let branch = self.open.last_mut().filter(|b| !b.last).ok_or(Mistake::Unopened)?;
        branch.active = !branch.taken && holds.as_ref().is_ok_and(|h| *h);
        branch.taken |= branch.active;
        branch.last = condition.is_none();
        holds.map(drop)
    }

    fn holds(&self, condition: &str) -> Result<bool, Mistake> {
        let mut words = Words { rest: condition };
        let value = self.either(&mut words, 0).ok_or(Mistake::Condition)?;
        if words.next().is_some() { Err(Mistake::Condition) } else { Ok(value) }
    }

    fn either(&self, words: &mut Words<'_>, depth: u32) -> Option<bool> {
        let mut value = self.both(words, depth)?;
        while words.eat("OR") {
            value |= self.both(words, depth)?;
        }
        Some(value)
    }

    fn both(&self, words: &mut Words<'_>, depth: u32) -> Option<bool> {
        let mut value = self.one(words, depth)?;
        while words.eat("AND") {
            value &= self.one(words, depth)?;
        }
        Some(value)
    }

    fn one(&self, words: &mut Words<'_>, depth: u32) -> Option<bool> {
        let depth = (depth < 100).then_some(depth + 1)?;
        if words.eat("NOT") {
            return self.one(words, depth).map(|v| !v);
        }
        if words.eat("(") {
            let value = self.either(words, depth)?;
            return words.eat(")").then_some(value);
        }
        if !words.eat("defined") || !words.eat("(") {
            return None;
        }
        let name = words.next()?.to_ascii_uppercase();
        words.eat(")").then(|| self.defined.contains(&name))
    }
}

/// Words and single signs of a condition.
struct Words<'a> {
    rest: &'a str,
}

impl<'a> Words<'a> {
    fn peek(&self) -> Option<(&'a str, &'a str)> {
        let text = self.rest.trim_start();
        let first = text.chars().next()?;
        let word = text.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(text.len());
        Some(text.split_at(if word == 0 { first.len_utf8() } else { word }))
    }
    fn next(&mut self) -> Option<&'a str> {
        let (word, rest) = self.peek()?;
        self.rest = rest;
        Some(word)
    }
    fn eat(&mut self, wanted: &str) -> bool {
        match self.peek() {
            Some((word, rest)) if word.eq_ignore_ascii_case(wanted) => {
                self.rest = rest;
                true
            }
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn branches_nest_and_the_first_that_holds_counts() {
        let mut c = Conditional::default();
        let mut step = |text: &str| {
            let result = c.follow(text);
            (result.is_none_or(|r| r.is_ok()), c.is_active())
        };
        for (text, active) in [
            ("define a", true),
            ("IF defined (b)", false),
            ("IF defined(a)", false),
            ("ELSE", false),
            ("END_IF", false),
            ("ELSIF NOT (defined(b) OR defined(c)) AND defined(A)", true),
            ("undefine a", true),
            ("ELSIF NOT defined(a)", false),
            ("ELSE", false),
            ("END_IF", true),
            ("region 'x'", true),
        ] {
            assert_eq!(step(text), (true, active), "{text}");
        }
    }

    #[test]
    fn mistakes() {
        let mut c = Conditional::default();
        assert_eq!(c.follow("ELSE"), Some(Err(Mistake::Unopened)));
        assert_eq!(c.follow("IF x > 1"), Some(Err(Mistake::Condition)));
        assert_eq!(c.follow("ELSE"), Some(Ok(())));
        assert_eq!(c.follow("ELSE"), Some(Err(Mistake::Unopened)));
        assert_eq!(c.follow(&format!("IF {}", "(".repeat(10_000))), Some(Err(Mistake::Condition)));
    }
}
