//! A mechanism of a text: its names, its compiled functions, and its documents.

use linkage_compiler::derivation::Reach;
use linkage_interpreter::{Design, Mechanism, Prepared, Program};
use linkage_ir::document::Documents;
use serde::{Deserialize, Serialize};

use crate::Refusal;
use crate::about::About;

/// A mechanism of a text.
pub struct Machine {
    pub about: About,
    pub documents: Documents,
    pub mechanism: Mechanism,
    /// The formulas that say which links do not reach; none of a mechanism that was compiled before.
    pub reach: Option<Reach>,
}

/// The names and the documents of a mechanism, as they are written.
#[derive(Serialize, Deserialize)]
struct Written {
    about: About,
    documents: Documents,
}

/// Mechanisms that were compiled, for a file: `program` is a `Program`.
#[derive(Serialize, Deserialize)]
struct All<P> {
    machines: Vec<Written>,
    program: P,
}

impl Machine {
    /// The design with these values of parameters.
    pub fn design(&self, parameters: &[f64]) -> Design {
        self.mechanism.design().with_parameters(parameters)
    }

    /// A reason with the links that do not reach each other at these values of the parameters, on the first branch.
    pub fn explained(&self, refusal: Refusal, parameters: &[f64]) -> Refusal {
        let missing = |(cannot, inputs): &(String, Vec<f64>)| {
            Some(format!("{cannot}, since {}", self.reach.as_ref()?.missing(parameters, inputs, &[])?))
        };
        match refusal.apart.as_ref().and_then(missing) {
            Some(why) => Refusal { why, ..refusal },
            None => refusal,
        }
    }

    /// Mechanisms that were compiled, for a file.
    #[cfg(feature = "compiler")]
    pub fn written(machines: Vec<Self>) -> Result<String, Refusal> {
        let program: Program = machines.iter().map(|machine| machine.mechanism.clone()).collect();
        let machines = machines.into_iter().map(|Self { about, documents, .. }| Written { about, documents });
        serde_json::to_string(&All { machines: machines.collect(), program }).map_err(Refusal::new)
    }

    /// Mechanisms as [`written`](Self::written) wrote them.
    pub fn all(text: &str) -> Result<Vec<Self>, Refusal> {
        let All { machines, program }: All<Program> = serde_json::from_str(text).map_err(Refusal::new)?;
        let pairs = program.mechanisms().iter().cloned().zip(machines);
        let machine = |(mechanism, Written { about, documents })| Self { about, documents, mechanism, reach: None };
        Ok(pairs.map(machine).collect())
    }
}

/// A design that is ready, as far as the mechanism can be moved.
pub fn prepared(design: &Design) -> Result<Prepared<'_>, Refusal> {
    design.prepared().map_err(Refusal::new)
}
