//! `linkage fpcore`: the formulas of functions, for tools that say how many digits a formula loses.

use linkage_lent::Documents;

use super::compiled::of_drivers;
use crate::arguments::Code;
use crate::failure::Failure;
use crate::output::{self, form};

pub fn run(arguments: &Code) -> Result<(), Failure> {
    form(&arguments.output, "this code", &[("FPCore", &["fpcore", "txt"])])?;
    let mut cores = Vec::new();
    for (_, one) in of_drivers(&arguments.source, |lowered| Documents::of(&lowered))? {
        one.each(|document| cores.extend(document.fpcore().iter().map(ToString::to_string)))?;
    }
    if cores.is_empty() {
        let message = "no function has formulas alone: all of them iterate, pivot, or call functions of yours";
        return Err(Failure::Outside(message.to_owned()));
    }
    output::write(&arguments.output, (cores.join("\n\n") + "\n").as_bytes(), &arguments.source.file)
}
