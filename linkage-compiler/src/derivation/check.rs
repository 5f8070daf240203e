//! What can be told of a mechanism only once it is derived.

use super::Derivation;
use crate::diagnostics::Diagnostics;
use crate::model::Mechanism;

/// A derivation of more expressions than this is refused: emitting it takes longer than anybody waits.
pub const LARGEST: usize = 16_000;

/// Reports what no choice of numbers can make a mechanism.
pub fn check(mechanism: &Mechanism, derivations: &[Derivation], diagnostics: &mut Diagnostics) {
    for (driver, derivation) in mechanism.drivers.iter().zip(derivations) {
        // du/dp is full, and solved for only when it is emitted.
        let entries = derivation.sensitivity.iter().map(|first| first.names.len() * derivation.unknowns.len());
        let size = derivation.graph.len() + entries.sum::<usize>();
        if size > LARGEST {
            diagnostics.error(
                driver.name.span(),
                format_args!(
                    "the derivatives of `{}` take {size} expressions, more than {LARGEST}; split the mechanism",
                    driver.name,
                ),
            );
        }
        for block in &derivation.blocks {
            if block.determinant.is_some_and(|determinant| derivation.graph.is_zero(determinant.value)) {
                let names: Vec<String> = block
                    .unknowns
                    .iter()
                    .map(|&place| format!("`{}`", mechanism.coordinates[driver.unknowns[place]].name.text))
                    .collect();
                diagnostics.error(
                    driver.name.span(),
                    format_args!(
                        "`{}` is singular at every position: the closures for {} say the same of both",
                        driver.name,
                        names.join(" and ")
                    ),
                );
            }
        }
    }
}
