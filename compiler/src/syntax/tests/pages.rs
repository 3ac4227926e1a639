//! The pages `docs/codes/P0*.md`: each explains its code with an example that provokes it, and nothing worse.

use super::*;

/// The text between the fences of a page.
fn example(code: Code) -> &'static str {
    let page = code.page();
    page.split_once("```st\n").and_then(|(_, rest)| rest.split_once("```")).map_or("", |(text, _)| text)
}

#[test]
fn every_example_provokes_its_code() {
    let codes = Code::ALL.iter().copied().filter(|c| c.text().starts_with("P0"));
    for code in codes {
        let (_, diags, sources) = parse(example(code));
        let shown: String = diags.iter().map(|d| render(d, &sources)).collect();
        assert!(diags.iter().any(|d| d.code == code), "{}\n{shown}", code.text());
        let first = |d: &Diag| d.code == code || code == Code::TooMuch;
        assert!(diags.iter().all(first), "{} provokes other codes too\n{shown}", code.text());
        assert!(code.page().trim_end().lines().count() <= 15, "{} is long", code.text());
    }
}

/// `P1002` is the parser's too.
#[test]
fn keyword_as_name_is_provoked() {
    assert_eq!(codes("PROGRAM p VAR to : INT; END_VAR END_PROGRAM"), ["P1002 1:15"]);
}
