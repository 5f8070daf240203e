//! Every printed formula of the gallery: none holds a function of numbers whose value is rational, or a term times 0 or
//! 1; each effect of a scene is in its document.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use linkage_compiler::document::{
    Derivation, DriverDocument, FormulaId, FormulaNodes, Part, SceneDerivation, SceneDocument, Table,
};
use linkage_gallery::{FILES, source};
use linkage_report::lend::Lender;

/// The documents of a file of the gallery.
fn documents(file: &str) -> (Vec<DriverDocument>, Vec<SceneDocument>) {
    linkage_compiler::documents(&linkage_compiler::read(source::tokens_of(file)).expect(file)[0]).expect(file)
}

/// Formulas in Unicode.
fn texts(nodes: &FormulaNodes, formulas: &[FormulaId]) -> Vec<String> {
    let lender = Lender::default();
    let table = lender.table(nodes).unwrap();
    formulas.iter().map(|id| table.get(id.get()).unwrap().to_string()).collect()
}

/// The formulas of a record, as often as they are shown.
fn shown_in(mut record: impl Part) -> Vec<FormulaId> {
    let mut formulas = Vec::new();
    record.each(&mut |id| formulas.push(*id));
    formulas
}

/// The formulas of a driver, without those of functions.
fn of_driver(document: &DriverDocument) -> Vec<String> {
    texts(&document.nodes, &shown_in(Derivation { kernels: Vec::new(), ..document.record.clone() }))
}

/// The formulas of a scene, without those of functions.
fn of_scene(document: &SceneDocument) -> Vec<String> {
    texts(&document.nodes, &shown_in(SceneDerivation { kernels: Vec::new(), ..document.record.clone() }))
}

/// A name in Unicode.
fn shown(name: &str) -> String {
    let mut table = Table::default();
    let number = table.plain(name);
    texts(&table.nodes(), &[number]).concat()
}

/// The value of a number, a multiple of pi or a quotient of these; `None` for anything else.
fn value(text: &str) -> Option<f64> {
    let (sign, text) = text.trim().strip_prefix('−').map_or((1.0, text.trim()), |rest| (-1.0, rest));
    let mut quotients = text.split('/').map(|product| {
        let factor = |factor: &str| if factor == "π" { Some(PI) } else { factor.parse::<f64>().ok() };
        product.split('·').map(factor).product::<Option<f64>>()
    });
    let first = quotients.next()??;
    quotients.try_fold(sign * first, |value, divisor| Some(value / divisor?))
}

/// True for a ratio with a small denominator.
fn is_rational(value: f64) -> bool {
    (1..=12).any(|denominator| {
        let scaled = value * f64::from(denominator);
        (scaled - scaled.round()).abs() < 1e-12
    })
}

/// The function of these numbers, if they are numbers.
fn of_numbers(function: &str, arguments: &str) -> Option<f64> {
    let arguments: Vec<f64> = arguments.split(',').map(value).collect::<Option<_>>()?;
    Some(match (function, arguments.as_slice()) {
        ("√", [x]) => x.sqrt(),
        ("sin", [x]) => x.sin(),
        ("cos", [x]) => x.cos(),
        ("tan", [x]) => x.tan(),
        ("arcsin", [x]) => x.asin(),
        ("arccos", [x]) => x.acos(),
        ("arctan", [x]) => x.atan(),
        ("exp", [x]) => x.exp(),
        ("ln", [x]) => x.ln(),
        ("hypot", [x, y]) => x.hypot(*y),
        ("atan2" | "arctan2", [y, x]) => y.atan2(*x),
        _ => return None,
    })
}

/// The fault of a formula: a function of numbers that is rational, a modulus of a number, or a factor 0 or 1.
fn fault(formula: &str) -> Option<String> {
    for (open, _) in formula.match_indices('(') {
        let name: String = formula[..open].chars().rev().take_while(|c| c.is_alphanumeric() || *c == '√').collect();
        let name: String = name.chars().rev().collect();
        let close = formula[open + 1..].find([')', '(']).map_or(formula.len(), |length| open + 1 + length);
        let arguments = &formula[open + 1..close];
        if of_numbers(&name, arguments).is_some_and(is_rational) {
            return Some(format!("{name}({arguments})"));
        }
    }
    let bars: Vec<&str> = formula.split('|').collect();
    if bars.iter().skip(1).step_by(2).any(|inside| value(inside).is_some()) {
        return Some("the modulus of a number".to_owned());
    }
    // A factor is what stands between two of these.
    let is_end = |c: char| " ()·/,|²³".contains(c);
    let mut begin = 0;
    for (place, sign) in formula.char_indices().filter(|(_, c)| is_end(*c)).chain([(formula.len(), ' ')]) {
        let part = &formula[begin..place];
        let (before, after) = (formula[..begin].chars().next_back(), sign);
        let is_factor = before == Some('·') || after == '·';
        // 1·10⁻³ is a number.
        let is_decimal = after == '·' && formula[place..].starts_with("·10");
        let is_term =
            before == Some(' ') && [' ', ')'].contains(&after) && !formula[..begin].trim_end().ends_with(['≠', '≤']);
        if (is_factor && ["0", "1"].contains(&part) && !is_decimal) || (part == "0" && is_term && begin > 0) {
            return Some(format!("`{part}` in `{}`", &formula[..place]));
        }
        begin = place + sign.len_utf8();
    }
    None
}

#[test]
fn faults_are_found() {
    for wrong in [
        "hypot(1, 0)·l",
        "a·hypot(3, 4)",
        "√(4)",
        "√(9/4)/l",
        "|1|·x",
        "cos(π/3)",
        "2·sin(π/6)·x",
        "exp(0)",
        "ln(1)",
        "1·x",
        "x·1",
        "x·1 + y",
        "0·x",
        "x + 0",
        "(x − 0)·y",
        "a·(0·b + c)",
        "atan2(0, 1)",
        "x·0/y",
    ] {
        assert!(fault(wrong).is_some(), "{wrong}");
    }
    for right in [
        "0",
        "1",
        "1/x",
        "x + 1",
        "x·10",
        "1·10⁻³·x",
        "√(2)·x",
        "sin(1)",
        "sin(π/3)",
        "hypot(1, 1)",
        "l₃ ≠ 0",
        "|x|",
        "x₁·θ₁₀",
        "2·π/3",
        "x − 1/2",
        "f(1, x)",
    ] {
        assert_eq!(fault(right), None, "{right}");
    }
}

#[test]
fn no_function_of_numbers_is_rational() {
    let (mut count, mut wrong) = (0, Vec::new());
    for file in FILES {
        let (documents, scenes) = documents(file);
        let formulas: Vec<String> =
            documents.iter().map(of_driver).chain(scenes.iter().map(of_scene)).flatten().collect();
        count += formulas.len();
        let faults = formulas.iter().filter_map(|formula| {
            let fault = fault(formula).or_else(|| formula.contains("if_nonzero").then(|| "if_nonzero".to_owned()))?;
            Some(format!("{file}: {fault} in {formula}"))
        });
        wrong.extend(faults);
    }
    assert!(count > 10_000, "{count}");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The forces, gravity, frictions, stops and drives of each scene are in its document, by their names, and so are the
/// parameters that only it has.
#[test]
fn every_effect_is_in_its_document() {
    let mut count = 0;
    for file in FILES {
        let mechanism = linkage_compiler::read(source::tokens_of(file)).expect(file).remove(0);
        if mechanism.scenes.iter().next().is_none() {
            continue;
        }
        let (_, documents) = documents(file);
        for scene in mechanism.scenes.iter() {
            let document = documents.iter().find(|document| scene.name == document.record.scene.as_str());
            let document = document.unwrap_or_else(|| panic!("{file}: {}", scene.name));
            let (texts, record) = (of_scene(document), &document.record);
            let of_effects = record.forces.iter().map(|effect| effect.name.as_str());
            let of_contacts = record.frictions_and_stops.iter().map(|contact| contact.name.as_str());
            let names: BTreeSet<&str> = of_effects.chain(of_contacts).collect();
            let laws = scene.laws.iter().map(|law| law.label.clone());
            let contacts = scene.contacts.iter().map(|contact| contact.label.clone());
            let weights = scene.weights.iter().map(|(body, _)| format!("body {}", mechanism.bodies[*body].name.text));
            for effect in laws.chain(contacts).chain(weights) {
                assert!(names.contains(effect.as_str()), "{file}: `{effect}` of {} is missing", scene.name);
                count += 1;
            }
            for drive in &scene.drives {
                let driver = &mechanism.drivers[scene.driver];
                let input = &mechanism.coordinates[driver.inputs[drive.input]].name.text;
                assert!(texts.contains(&shown(input)), "{file}: the drive of {input} is missing");
                count += 1;
            }
            // Each parameter is given, and in a formula.
            for &parameter in &scene.parameters {
                let name = &mechanism.scene_parameters[parameter].name.text;
                let shown = shown(name);
                let is_in = |text: &&String| text.contains(&shown) && **text != shown;
                let is_alone = texts.iter().filter(|text| **text == shown).count() > 1;
                let is_cut = texts.iter().any(|text| text.contains('…'));
                assert!(
                    is_alone || is_cut || texts.iter().any(|text| is_in(&text)),
                    "{file}: {name} of {}",
                    scene.name
                );
            }
        }
    }
    assert!(count > 60, "{count}");
}
