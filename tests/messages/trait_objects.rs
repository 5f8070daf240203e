//! `dyn Mechanism`, which rustc rejects with the reasons, shows what to write instead.

use linkage_tests::programs::written;

use super::checked::messages;

const PROGRAM: &str = "\
use linkage::Kinematic;

linkage::linkage! {
    pub mechanism Crank {
        param r = 2;
        input phi;
        unknown x;
        equation x = r * cos(phi);
    }
}

pub fn all() -> Vec<Box<dyn Kinematic<Scalar = f64>>> {
    vec![Box::new(Crank::default())]
}
";

#[test]
fn a_trait_object_has_a_message_with_its_replacement() {
    let folder = written("trait_objects", [("lib.rs".to_owned(), PROGRAM.to_owned())]);
    let all = messages(&folder, "lib.rs", "lib");
    let text: String = all.iter().filter_map(|line| line["rendered"].as_str()).collect();
    for part in ["E0038", "Instead of `dyn`: a generic function, or your trait for all `M: Kinematic`."] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
}
