//! The mechanisms of the gallery at run time.

use linkage_gallery::{cam_laws, source};
use linkage_interpreter::{Mechanism, Program};

/// The text of a file of the gallery, between the braces of its `linkage!`.
pub fn text_of(file: &str) -> String {
    let text = source::text_of(file);
    let from = text.find("linkage! {").expect("one `linkage!`") + "linkage! {".len();
    text[from..text.rfind('}').expect("its end")].to_owned()
}

/// The mechanisms of a file, with their user functions.
pub fn mechanisms(file: &str) -> Vec<Mechanism> {
    let program = Program::compile(&text_of(file)).unwrap_or_else(|messages| panic!("{file}: {messages:?}"));
    program.mechanisms().iter().cloned().map(given).collect()
}

/// The mechanism with its user functions.
pub fn given(mechanism: Mechanism) -> Mechanism {
    match mechanism.name() {
        "CamFollower" => {
            let lift = |at: &[f64]| {
                let (lift, lift1, lift2, lift3) = cam_laws::polynomial_strokes(at[0], at[1], at[2]);
                vec![lift, lift1, lift2, lift3]
            };
            mechanism.with_function("lift", lift).expect("its function")
        }
        "CamRocker" => {
            let turn = |at: &[f64]| {
                let (turn, turn1, turn2) = cam_laws::cycloidal_strokes(at[0], at[1], at[2]);
                vec![turn, turn1, turn2]
            };
            mechanism.with_function("turn", turn).expect("its function")
        }
        _ => mechanism,
    }
}

/// The mechanism of a file with this name.
pub fn of(file: &str, name: &str) -> Mechanism {
    mechanisms(file).into_iter().find(|mechanism| mechanism.name() == name).expect("the mechanism")
}
