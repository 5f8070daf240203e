//! Documents that were written and read again make the same sheets; damaged ones are an error, or make another sheet.

use std::fs;
use std::path::Path;

use linkage_compiler::budget::Budget;
use linkage_compiler::document::{Documents, FormulaNodes};
use linkage_compiler::text;
use linkage_report::Document;
use linkage_report::lend::{Lender, Unsound};
use linkage_report::report::Mobility;
use linkage_report::sheet::Language;
use serde_json::Value;

/// A mechanism with every kind of document: groups, points, outputs, a scene with friction and a stop, forces in joints.
const TEXT: &str = "mechanism FourBar {
    param l1 = 80, l2 = 20, l3 = 50, l4 = 70, m = 2, c = 0.1, mu = 0.2, e = 0.5;
    input theta2;
    unknown theta3, theta4;
    loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
    point C = l2@theta2 + l3@theta3;
    output angle = theta4 - theta2;
    body Load { mass m; inertia 0; center C; angle 0; }
    scene Falling {
        inertia; gravity (0, -9.81); damper c on theta2; friction mu, 5, 3 on theta4; stop theta4 in -1..4, restitution e;
    }
    derive sheet, jerk, velocity_ratio_derivatives, sensitivity;
}";

fn documents(text: &str) -> Vec<Documents> {
    let compiled = text::compile(text, &Budget::default(), |lowered| lowered.documents()).unwrap();
    compiled.into_iter().flat_map(|compiled| compiled.drivers).collect()
}

/// Everything that is written of documents.
fn sheets(documents: &Documents) -> Result<Vec<String>, Unsound> {
    let mut all = Vec::new();
    let lender = Lender::default();
    if let Some(mut sheet) = lender.whole(documents)? {
        all.extend([sheet.to_html(), sheet.to_latex(), sheet.to_text(), sheet.language(Language::Italian).to_text()]);
    }
    let (driver, scenes) = lender.with_functions(documents)?;
    let functions = scenes.iter().flat_map(|scene| scene.fpcore());
    all.extend(driver.iter().flat_map(|driver| driver.fpcore()).chain(functions).map(|core| core.to_string()));
    if let Some(derivation) = driver {
        all.push(format!("{:?}", Mobility::of(&derivation)));
        all.push(derivation.to_text());
    }
    Ok(all)
}

#[test]
fn documents_that_were_read_make_the_same_sheets() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let folders = ["linkages", "machines"].map(|folder| examples.join(folder).read_dir().unwrap());
    let files: Vec<_> = folders.into_iter().flatten().map(|entry| entry.unwrap().path()).collect();
    assert!(files.len() >= 12);
    for file in files {
        for original in documents(&fs::read_to_string(&file).unwrap()) {
            let written = serde_json::to_string(&original).unwrap();
            let read: Documents = serde_json::from_str(&written).unwrap();
            assert!(sheets(&read).unwrap() == sheets(&original).unwrap(), "{}", file.display());
            assert_eq!(serde_json::to_string(&read).unwrap(), written);
        }
    }
}

/// The places of all numbers and texts.
fn places(value: &Value, at: &str, found: &mut Vec<String>) {
    match value {
        Value::Number(_) | Value::String(_) => found.push(at.to_owned()),
        Value::Array(items) => {
            items.iter().enumerate().for_each(|(index, item)| places(item, &format!("{at}/{index}"), found));
        }
        Value::Object(fields) => fields.iter().for_each(|(name, field)| places(field, &format!("{at}/{name}"), found)),
        _ => {}
    }
}

#[test]
fn damaged_documents_do_not_panic() {
    let mut written = serde_json::to_value(&documents(TEXT)[0]).unwrap();
    let mut all = Vec::new();
    places(&written, "", &mut all);
    let (mut rejected, mut unsound, mut written_all) = (0, 0, 0);
    // A prime number of places apart, so that each other value comes at all kinds of places.
    for (step, at) in all.iter().enumerate().step_by(23) {
        let original = written.pointer(at).unwrap().clone();
        let value = original.as_u64().unwrap_or(0);
        *written.pointer_mut(at).unwrap() = match original {
            Value::Number(_) => [0, 1, value / 2, value.saturating_add(1), 1 << 31, u64::MAX][step % 6].into(),
            _ => ["", "_", "é_9", "the ", "body"][step % 5].into(),
        };
        match serde_json::from_value::<Documents>(written.clone()) {
            Err(_) => rejected += 1,
            Ok(read) => match sheets(&read) {
                Err(_) => unsound += 1,
                Ok(_) => written_all += 1,
            },
        }
        *written.pointer_mut(at).unwrap() = original;
    }
    assert!(rejected > 10 && unsound > 10 && written_all > 10, "{rejected} {unsound} {written_all} of {}", all.len());
}

/// A number of formulas in a check that its kind does not have.
#[test]
fn a_check_without_formulas_is_rejected() {
    let mut written = serde_json::to_value(&documents(TEXT)[0]).unwrap();
    let kernels = written.pointer_mut("/driver/record/kernels").unwrap().as_array_mut().unwrap();
    let mut checks = kernels.iter_mut().filter_map(|kernel| kernel["code"]["checks"].get_mut(0));
    let check = checks.next().unwrap().as_object_mut().unwrap();
    check.values_mut().next().unwrap().as_array_mut().unwrap().clear();
    assert!(serde_json::from_value::<Documents>(written).is_err());
}

fn is_read(nodes: &str, parts: &str) -> bool {
    serde_json::from_str::<FormulaNodes>(&format!(r#"{{"nodes": {nodes}, "names": ["f"], "parts": {parts}}}"#)).is_ok()
}

#[test]
fn tables_with_nodes_out_of_order_are_rejected() {
    assert!(is_read(r#"["Pi", {"Power": [1, 2]}]"#, "[]"));
    assert!(!is_read(r#"["Pi", {"Power": [0, 2]}]"#, "[]"));
    assert!(!is_read(r#"["Pi", {"Power": [2, 2]}]"#, "[]"));
    assert!(is_read(r#"["Pi", {"Sum": [0, 1]}]"#, "[-1]"));
    assert!(!is_read(r#"["Pi", {"Sum": [0, 1]}]"#, "[3]"));
    assert!(!is_read(r#"["Pi", {"Sum": [0, 2]}]"#, "[1]"));
    assert!(!is_read(r#"[{"Name": 1}]"#, "[]"));
}

/// Each node twice in the next one is a short file and a formula without end; one in one, a formula of any depth.
#[test]
fn tables_of_formulas_without_end_are_rejected() {
    let nested = |count: usize, of: &dyn Fn(usize) -> String| {
        let nodes: Vec<String> = (1..count).map(of).collect();
        let parts: Vec<String> = (1..count).map(|number| number.to_string()).collect();
        is_read(&format!(r#"["Pi", {}]"#, nodes.join(", ")), &format!("[{}]", parts.join(", ")))
    };
    let doubled = |number: usize| format!(r#"{{"Quotient": [{number}, {number}]}}"#);
    assert!(nested(8, &doubled));
    assert!(!nested(64, &doubled));
    let single = |number: usize| format!(r#"{{"Product": [{}, 1]}}"#, number - 1);
    assert!(nested(200, &single));
    assert!(!nested(100_000, &single));
    let squared = |number: usize| format!(r#"{{"Power": [{number}, 2]}}"#);
    assert!(nested(8, &squared));
    assert!(!nested(64, &squared));
    assert!(!is_read(r#"["Pi", {"Power": [1, 4294967295]}]"#, "[]"));
    assert!(!is_read(r#"["Pi", {"External": [0, 4294967295, 0, 1]}]"#, "[1]"));
}
