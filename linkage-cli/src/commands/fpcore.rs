//! `linkage fpcore`: the formulas of functions, for tools that say how many digits a formula loses.

use linkage_report::Document as _;
use linkage_report::lend::Lender;

use super::compiled::of_drivers;
use crate::arguments::Code;
use crate::failure::Failure;
use crate::output::{self, form};

pub fn run(arguments: &Code) -> Result<(), Failure> {
    form(&arguments.output, "this code", &[("FPCore", &["fpcore", "txt"])])?;
    let mut cores = Vec::new();
    for (_, one) in of_drivers(&arguments.source, |lowered| lowered.documents())? {
        let lender = Lender::default();
        let (driver, scenes) = lender.with_functions(&one)?;
        let all =
            driver.iter().flat_map(|driver| driver.fpcore()).chain(scenes.iter().flat_map(|scene| scene.fpcore()));
        cores.extend(all.map(|core| core.to_string()));
    }
    if cores.is_empty() {
        let message = "no function has formulas alone: all of them iterate, pivot, or call functions of yours";
        return Err(Failure::Outside(message.to_owned()));
    }
    output::write(&arguments.output, (cores.join("\n\n") + "\n").as_bytes(), &arguments.source.file)
}
