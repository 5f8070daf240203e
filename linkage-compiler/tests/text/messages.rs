//! Messages of texts that the macro never sees, and the places of all.

use linkage_compiler::budget::Budget;
use linkage_compiler::text::{self, Message};

/// The messages of a text, and its mechanisms.
fn compiled(text: &str) -> Result<Vec<String>, Vec<Message>> {
    let compiled = text::compile(text, &Budget::default(), |of| of.program.signatures.driver.clone())?;
    Ok(compiled.into_iter().flat_map(|of| of.drivers).collect())
}

/// The one message of a text.
fn message(text: &str) -> Message {
    let messages = compiled(text).err().unwrap_or_else(|| panic!("{text} is right"));
    let [message] = messages.as_slice() else { panic!("{text}: {messages:?}") };
    message.clone()
}

const CRANK: &str = "mechanism Crank { param r = 2; input v; unknown u; equation u = r * sin(v); }";

#[test]
fn what_is_no_tokens_is_one_message() {
    for (text, place, length, said, help) in [
        ("", "1:1", 0, "the text has no mechanism: write `mechanism NAME { … }`", None),
        ("\u{feff}  \n// nothing\n", "1:1", 0, "the text has no mechanism: write `mechanism NAME { … }`", None),
        ("mechanism A {\n  loop (a + b;\n}", "3:1", 1, "this `}` does not close `(` in line 2, column 8", None),
        ("mechanism A { } }", "1:17", 1, "this `}` closes nothing", None),
        ("mechanism A {\n loop a@b = c@d;\n", "1:13", 1, "this `{` is never closed", None),
        (
            "mechanism A { output p' = 1; }",
            "1:23",
            1,
            "`'` is no part of a name: a name has letters, digits and `_`",
            None,
        ),
        (
            "mechanism A { output p = \"a; }",
            "1:26",
            1,
            "a text in quotation marks is wrong or has no end: outside of doc comments the language has none",
            None,
        ),
        (
            "mechanism A { /* output p = 1; }",
            "1:15",
            2,
            "this comment has no end: write `*/`, or begin each of its lines with `//`",
            None,
        ),
        ("mechanism A { param a = 0x; }", "1:25", 2, "`0x` is not a number", None),
        ("mechanism A { param a = 0b12; }", "1:25", 4, "`0b12` is not a number", None),
        ("// θ\nθ \u{2212} 1", "2:3", 1, "`\u{2212}` (U+2212) is no character of the language", Some("write `-`")),
        ("20\u{b0}", "1:3", 1, "`\u{b0}` (U+00B0) is no character of the language", Some("write `deg`")),
        ("x\u{2032}", "1:2", 1, "`\u{2032}` (U+2032) is no character of the language", Some("write another name")),
        ("a\u{0}b", "1:2", 1, "`\\0` (U+0000) is no character of the language", None),
        ("a \\ b", "1:3", 1, "`\\\\` (U+005C) is no character of the language", None),
    ] {
        let found = message(text);
        assert_eq!(found.to_string(), format!("{place}: {said}"), "{text}");
        assert_eq!((found.length, found.help.as_deref()), (length, help), "{text}");
    }
}

#[test]
fn places_are_those_of_an_editor() {
    // What is missing at the end is missing after the last token. Lines that end as on another system, a mark at the beginning, letters of several bytes.
    for (text, place, length) in [
        ("/// Said of nothing.\n", "1:20", 1),
        ("mechanism A { input v; output o = v; }\n#[derive(Debug)]", "2:16", 1),
        ("mechanism A {\r\n    input θ;\r\n    output ω = θ * ψψ;\r\n}", "3:20", 2),
        ("\u{feff}mechanism A { input θ; output ω = θ * ψψ; }", "1:39", 2),
        ("mechanism A { input v;\n /* one\n two */ output o = v * xy; }", "3:24", 2),
        // A region ends with its first line.
        ("mechanism A { input v; output o = v + hypot(v,\n  v, v); }", "1:39", 8),
    ] {
        let found = message(text);
        assert_eq!((format!("{}:{}", found.line, found.column), found.length), (place.to_owned(), length), "{found:?}");
    }
}

#[test]
fn messages_of_all_stages_come_in_the_order_of_places() {
    let text = format!(
        "{CRANK}\nmechanism Far {{ input v; unknown u; equation u = 1e200 * v; output o = (u * 1e200)^2; }}\n\
         mechanism Crank {{ input v; output o = sn(v); parm a = 2; }}\nmechanisn Last {{ input v; }}"
    );
    let found = compiled(&text).unwrap_err();
    let lines: Vec<usize> = found.iter().map(|message| message.line).collect();
    assert!(found.is_sorted() && [2, 3, 4].iter().all(|line| lines.contains(line)), "{found:?}");
    assert!(found.iter().any(|message| message.text.contains("is declared twice")), "{found:?}");
}

#[test]
fn help_is_the_rest_of_a_message() {
    let found = compiled("mechanism A { input v; output o = v; derive something; }").unwrap_err();
    assert_eq!(found[0].text, "unknown keyword `something` after `derive`");
    assert!(found[0].help.as_ref().is_some_and(|help| help.starts_with("keywords: limits")), "{found:?}");
}

/// Words that Rust alone understands are read and have no effect, except `cfg`.
#[test]
fn words_for_rust_have_no_effect() {
    let of_rust = format!(
        "/// A crank.\n#[derive(Debug, Clone)]\n#[allow(dead_code, reason = \"an example\")]\npub(crate) {CRANK}"
    );
    let of_rust = of_rust.replace("param", "derive serde, limits; param");
    assert_eq!(compiled(&of_rust), Ok(vec!["Crank".to_owned()]));
    let found = message(&format!("#[cfg(test)]\n{CRANK}"));
    assert_eq!((found.line, found.column, found.length), (1, 3, 3), "{found:?}");
    assert!(found.text.starts_with("`cfg` has no meaning in a text"), "{found:?}");
}

#[test]
fn texts_beyond_a_bound_are_one_message_with_the_bound() {
    let long = format!("{CRANK}{}", " ".repeat(text::LONGEST));
    let found = message(&long);
    assert_eq!(found.text, format!("the text has {} bytes, more than {}: split it", long.len(), text::LONGEST));
    let many = format!("mechanism A {{ {} }}", "a ".repeat(text::MOST_TOKENS));
    let found = message(&many);
    assert_eq!(found.text, format!("more than {} tokens; split the invocation", text::MOST_TOKENS));
    assert_eq!((found.line, found.column), (1, 15 + 2 * (text::MOST_TOKENS - 3)));
    let deep = format!("mechanism A {{ let a = {}1{}; }}", "(".repeat(1000), ")".repeat(1000));
    assert!(message(&deep).text.starts_with("nested deeper than 64 levels"));
    for word in ["a".repeat(257), "1".repeat(257), format!("0x{}", "f".repeat(255))] {
        let found = message(&format!("mechanism A {{ let b = 1;\nlet c = {word}; }}"));
        assert_eq!((found.line, found.column, found.length), (2, 9, 257));
        assert_eq!(found.text, "a name or a number has at most 256 letters");
    }
    let messages = text::compile(CRANK, &Budget::new(10), |_| ()).err().unwrap_or_default();
    assert!(matches!(messages.as_slice(), [one] if one.text.contains("budget of work")), "{messages:?}");
}

/// The function that a driver is handed to may compile another text.
#[test]
fn texts_are_compiled_within_texts() {
    let text =
        format!("{CRANK}\nmechanism Far {{ input v; unknown u; equation u = 1e200 * v; output o = (u * 1e200)^2; }}");
    let found = text::compile(&text, &Budget::default(), |_| message("mechanism A {").to_string());
    let messages = found.err().unwrap_or_default();
    assert!(messages.iter().all(|message| message.line == 2) && !messages.is_empty(), "{messages:?}");
}
