//! Values of expressions as tables that people read (`conformance/iec/values/*.md`):
//!
//! ```text
//! ## INT
//!
//! | expression       | value |
//! |---|---|
//! | REAL_TO_INT(2.5) | 2     |
//! ```
//!
//! The heading is the type of the variable that the expression is assigned to; the value is an expression of that type too, usually
//! a literal, or `NaN`. A bar in a string is not possible.

pub use crate::markdown::TableError;
use crate::markdown::sections;

/// One row.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Expression {
    /// From 1.
    pub line: usize,
    /// Type of the value.
    pub ty: String,
    /// In ST.
    pub text: String,
    /// What comes out, in ST, or `NaN`.
    pub value: String,
}

/// Reads all tables of a file.
pub fn parse(text: &str) -> Result<Vec<Expression>, TableError> {
    let mut all = Vec::new();
    for section in sections(text)? {
        for (i, (line, cells)) in section.rows.iter().enumerate() {
            match (i, &cells[..]) {
                (0, ["expression", "value"]) => {}
                (0, _) => return Err(TableError::new(*line, "the header is not `expression`, `value`")),
                (_, [text, value]) if !text.is_empty() && !value.is_empty() => all.push(Expression {
                    line: *line,
                    ty: section.heading.to_owned(),
                    text: (*text).to_owned(),
                    value: (*value).to_owned(),
                }),
                _ => return Err(TableError::new(*line, "empty cell")),
            }
        }
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_read() {
        let all = parse("## INT\n| expression | value |\n|---|---|\n| 1 + 2 | 3 |\n").unwrap();
        let want = Expression { line: 4, ty: "INT".to_owned(), text: "1 + 2".to_owned(), value: "3".to_owned() };
        assert_eq!(all, [want]);
    }

    #[test]
    fn mistakes_have_a_place() {
        for (text, line, message) in [
            ("## INT\n| a | b |\n| 1 | 2 |", 2, "the header is not `expression`, `value`"),
            ("## INT\n| expression | value |\n| 1 | |", 3, "empty cell"),
        ] {
            assert_eq!(parse(text), Err(TableError::new(line, message)), "{text}");
        }
    }
}
