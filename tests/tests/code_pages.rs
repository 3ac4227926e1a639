//! The pages of codes: each has an example, and the example provokes the code. (G-code pages are checked in `motion/tests`, pages of
//! project and image files in `cli/tests`.)

use takt_base::Code;
use takt_tests::plc::{compile_st, fault};

/// Codes whose example can't be shown in a few lines; tests elsewhere provoke them.
const WITHOUT_EXAMPLE: &[&str] = &["P0011", "P0013", "P3014"];

/// Language and text of the first example of a page.
fn example(code: Code) -> Option<(String, String)> {
    let (_, rest) = code.page().split_once("```")?;
    let (language, rest) = rest.split_once('\n')?;
    let (text, _) = rest.split_once("```")?;
    Some((language.to_owned(), text.to_owned()))
}

#[test]
fn every_page_has_an_example_and_says_what_to_do() {
    for code in Code::ALL {
        let page = code.page();
        assert!(page.lines().count() >= 4, "docs/codes/{}.md says too little", code.text());
        let fault_number = code.text().starts_with('F');
        assert!(fault_number || example(*code).is_some(), "docs/codes/{}.md has no example", code.text());
    }
}

#[test]
fn examples_of_compiler_codes_provoke_them() {
    let mut wrong = Vec::new();
    for code in Code::ALL.iter().filter(|c| c.text().starts_with('P') && !WITHOUT_EXAMPLE.contains(&c.text())) {
        let Some((language, text)) = example(*code).filter(|(language, _)| language != "st,run") else { continue };
        let found: Vec<_> = compile_st(&text).diags.iter().map(|d| d.code.text()).collect();
        if language != "st" || !found.contains(&code.text()) {
            wrong.push(format!("{}: {found:?}", code.text()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn examples_of_faults_provoke_them() {
    let mut count = 0;
    for code in Code::ALL.iter().filter(|c| c.text().starts_with('F')) {
        if let Some((_, text)) = example(*code).filter(|(language, _)| language == "st,fault") {
            assert_eq!(fault(&text).0.code(), *code, "docs/codes/{}.md", code.text());
            count += 1;
        }
    }
    assert!(count >= 7);
}
