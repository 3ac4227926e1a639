//! The pages of the codes P1 to P4: each example gives its code, and no other error.

use super::*;
use takt_base::{Code, Severity};

/// The first ```st block of a page.
fn example(page: &str) -> Option<&str> {
    page.split_once("```st\n").and_then(|(_, rest)| rest.split_once("```")).map(|(text, _)| text)
}

#[test]
fn every_page_has_an_example_that_provokes_its_code() {
    for code in Code::ALL.iter().filter(|c| ["P1", "P2", "P3", "P4", "T0"].iter().any(|p| c.text().starts_with(p))) {
        if matches!(code, Code::KeywordAsName | Code::NoProgram | Code::RetainNotKept) {
            continue; // reported by the parser, by who runs a project, and by nobody any more
        }
        let page = code.page();
        let text = example(page).unwrap_or_else(|| panic!("docs/codes/{}.md has no example", code.text()));
        let built = build(text);
        let found: Vec<_> = built.diags.iter().map(|d| d.code.text()).collect();
        assert!(found.contains(&code.text()), "{}: {found:?}", code.text());
        let others: Vec<_> = built.diags.iter().filter(|d| d.code != *code && d.severity == Severity::Error).collect();
        assert!(others.is_empty(), "{}: {}", code.text(), built.text());
        assert!(page.lines().count() <= 24, "{} is long", code.text());
    }
}

/// Every message says what stands there; every error of types and rules says what to do or names the other place.
#[test]
fn messages_have_labels() {
    for code in Code::ALL {
        if let Some(text) = example(code.page()).filter(|_| code.text().starts_with('P')) {
            for d in build(text).diags {
                assert!(!d.label.is_empty(), "{}: {d:?}", code.text());
            }
        }
    }
}
