//! Compiled mechanisms as a file.

use linkage_gallery::FILES;
use linkage_interpreter::{Data, Program};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use crate::at_run_time::{given, text_of};
use crate::drawn::Drawn;

#[test]
fn what_is_read_is_what_was_written() {
    for file in FILES {
        let program = Program::compile(&text_of(file)).expect("it compiles");
        let text = serde_json::to_string(&program).expect("it is written");
        let read: Program = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{file}: {error}"));
        assert!(text == serde_json::to_string(&read).expect("it is written again"), "{file}");
        let both = [&program, &read].map(|program| given(program.mechanisms()[0].clone()));
        let mut drawn = Drawn::new(1, 0.0);
        let q = drawn.list(both[0].sizes()[0]);
        let [one, other] = both.map(|mechanism| mechanism.design().call("pose_at", std::slice::from_ref(&q)));
        assert_eq!(one.expect("a pose"), other.expect("a pose"), "{file}");
    }
}

#[test]
fn values_and_designs_are_written() {
    let program = Program::compile(&text_of("four_bar")).expect("it compiles");
    let mechanism = program.mechanism("FourBar").expect("the mechanism");
    let design = mechanism.design().with("l2", 2.5).expect("a parameter");
    let text = serde_json::to_string(&design.by_name()).expect("it is written");
    assert!(text.starts_with("{\"l1\":"), "{text}");
    let read: Data = serde_json::from_str(&text).expect("it is read");
    let again = mechanism.design().with_all(&read).expect("parameters by name");
    assert_eq!(again.parameters(), design.parameters());
    let pose = design.call("pose_at", &[Drawn::new(1, 0.0).list(3)]).expect("a pose");
    let read: Data = serde_json::from_str(&serde_json::to_string(&pose).expect("written")).expect("read");
    assert_eq!(design.call("points", &[read]).expect("points"), design.call("points", &[pose]).expect("points"));
}

/// Mistakes of a caller are one message, with the nearest name.
#[test]
fn mistakes_of_calls() {
    let program = Program::compile(&text_of("four_bar")).expect("it compiles");
    let design = program.mechanism("FourBar").expect("the mechanism").design();
    let branch = |word: &str| Data::fields([("theta3_theta4", word.into())]);
    let message = |result: Result<Data, linkage_interpreter::CallError>| result.expect_err("a mistake").to_string();
    let found = [
        program.mechanism("FourBra").expect_err("no such mechanism").to_string(),
        design.clone().with("l22", 1.0).expect_err("no such parameter").to_string(),
        design.scene("Loaded").expect_err("no such scene").to_string(),
        message(design.call("asemble", &[1.0.into(), branch("left")])),
        message(design.call("assemble", &[1.0.into()])),
        message(design.call("assemble", &[1.0.into(), branch("lefd")])),
        message(design.call("assemble", &[1.0.into(), Data::Nothing])),
        message(design.call("assemble", &["one".into(), branch("left")])),
        message(design.call("assemble", &[Data::fields([("theta", 1.0.into())]), branch("left")])),
    ];
    let expected = [
        "there is no `FourBra`, did you mean `FourBar`?",
        "there is no `l22`, did you mean `l2`?",
        "there is no `Loaded`",
        "there is no `asemble`, did you mean `assemble`?",
        "`assemble` takes inputs, branch",
        "there is no `lefd`, did you mean `Left`?",
        "`theta3_theta4` is not given",
        "expected numbers by name, found Text(\"one\")",
        "there is no `theta`, did you mean `theta2`?",
    ];
    assert_eq!(found, expected);
    let cam = Program::compile(&text_of("cam_rocker")).expect("it compiles");
    let alone = message(cam.mechanisms()[0].design().call("pose_at", &[Drawn::new(1, 0.0).list(4)]));
    assert_eq!(alone, "`turn` is declared by `extern fn` and not given: use `with_function`");
}

#[test]
fn another_version_is_one_message() {
    let program = Program::compile(&text_of("four_bar")).expect("it compiles");
    let text = serde_json::to_string(&program).expect("it is written");
    let other = text.replacen("\"version\":3", "\"version\":2", 1);
    assert_ne!(other, text);
    let error = serde_json::from_str::<Program>(&other).expect_err("another version").to_string();
    assert!(error.contains("version 2") && error.contains("compile them again"), "{error}");
}

/// A formula that calls a function with another number of arguments is an error of reading.
#[test]
fn a_function_of_other_arguments_is_damage() {
    let source = "mechanism Slide { input x; unknown y; equation y = exp(x); derive intervals; }";
    let text = serde_json::to_string(&Program::compile(source).expect("it compiles")).expect("it is written");
    for other in ["Atan2", "IfNonzero"] {
        let damaged = text.replace("{\"Of\":[\"Exp\",", &format!("{{\"Of\":[\"{other}\","));
        assert_ne!(damaged, text);
        let error = serde_json::from_str::<Program>(&damaged).expect_err("damage").to_string();
        assert!(error.contains("`Slide` is damaged") && error.contains("other arguments"), "{error}");
    }
}

/// The number of a function, a name or a value of another program, which this one does not have, is an error of reading.
#[test]
fn numbers_of_another_program_are_damage() {
    let text = serde_json::to_string(&Program::compile(&text_of("four_bar_effects")).expect("it compiles"));
    let text = text.expect("it is written");
    let damaged = |from: &str, what: &str| {
        let at = text.find(from).unwrap_or_else(|| panic!("{from}")) + from.len();
        let digits = text[at..].find(|one: char| !one.is_ascii_digit()).expect("more");
        let other = format!("{}99999{}", &text[..at], &text[at + digits..]);
        let error = serde_json::from_str::<Program>(&other).expect_err("damage").to_string();
        assert!(error.contains("is damaged") && error.contains(what), "{error}");
    };
    damaged("{\"Own\":[\"Itself\",", "a function does not exist");
    damaged("{\"Given\":", "a slot does not exist");
    damaged("{\"Square\":", "a value refers to a later one");
    let of_field = text.find("{\"Field\":[").expect("a field") + "{\"Field\":[".len();
    let of = &text[of_field..][..=text[of_field..].find(',').expect("two numbers")];
    damaged(&format!("{{\"Field\":[{of}"), "a name does not exist");
}

/// Damaged files are errors, or run: to a value, an error or a defect, without a panic.
#[test]
fn damaged_files_do_not_panic() {
    let mut random = SmallRng::seed_from_u64(7);
    let (mut rejected, mut run) = (0, 0);
    for file in ["four_bar", "double_butterfly", "four_bar_effects"] {
        let text = serde_json::to_string(&Program::compile(&text_of(file)).expect("it compiles")).expect("written");
        for _ in 0..60 {
            let mut damaged = text.clone().into_bytes();
            for _ in 0..random.random_range(1..4) {
                let digits: Vec<usize> = (0..400)
                    .map(|_| random.random_range(0..damaged.len()))
                    .filter(|at| damaged[*at].is_ascii_digit())
                    .collect();
                if let Some(at) = digits.first() {
                    damaged[*at] = b'0' + random.random_range(0..10_u8);
                }
            }
            let Ok(program) = serde_json::from_slice::<Program>(&damaged) else {
                rejected += 1;
                continue;
            };
            for mechanism in program.mechanisms() {
                let mut drawn = Drawn::new(3, 0.0);
                let design = mechanism.design();
                for function in mechanism.functions() {
                    let Ok(arguments) = design.arguments(function) else { continue };
                    let arguments: Vec<Data> = arguments.iter().map(|_| drawn.list(mechanism.sizes()[0])).collect();
                    run += usize::from(design.call(function, &arguments).is_ok());
                }
            }
        }
    }
    assert!(rejected > 10 && run > 10, "{rejected} {run}");
}
