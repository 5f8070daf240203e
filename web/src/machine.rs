//! A mechanism of a text: its names, its compiled functions, and its documents.

use linkage_interpreter::{Design, Mechanism, Prepared, Program};
use crate::documents::Documents;
use serde::{Deserialize, Serialize};

use crate::Refusal;
use crate::about::About;

/// A mechanism of a text.
pub struct Machine {
    pub about: About,
    pub documents: Documents,
    pub mechanism: Mechanism,
}

/// The names and the documents of a mechanism, as they are written.
struct Written {
    about: About,
    documents: Documents,
}

/// Mechanisms that were compiled, as they are written.
struct All<W, P> {
    about: Vec<W>,
    program: P,
}

impl Machine {
    /// The design with these values of parameters.
    pub fn design(&self, parameters: &[f64]) -> Design {
        self.mechanism.design().with_parameters(parameters)
    }

    /// Mechanisms as [`written`] wrote them.
    pub fn all(text: &str) -> Result<Vec<Self>, Refusal> {
        Err(Refusal::new(text))
    }
}

/// A design that is ready, as far as the mechanism can be moved.
pub fn prepared(design: &Design) -> Result<Prepared<'_>, Refusal> {
    design.prepared().map_err(Refusal::new)
}
