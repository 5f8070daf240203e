//! The names of symbols, by their meaning.

use rustc_hash::FxHashMap;

use crate::derivation::{Derivation, RatioDerivatives};
use crate::graph::SymbolId;
use crate::ids::{CoordinateId, InputId, Table, UnknownId};
use crate::model::Mechanism;

/// A symbol with its role, which decides how it is printed. Names are those of the `linkage!` language, such as
/// `theta3` or `z_t`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Name<'a> {
    /// The quantity itself: θ₃.
    Plain(&'a str),
    /// Its first derivative with respect to time: θ̇₃.
    Rate(&'a str),
    /// Its second derivative with respect to time: θ̈₃.
    Acceleration(&'a str),
    /// The velocity ratio ∂`of`/∂`by`.
    Ratio { of: &'a str, by: &'a str },
    /// The derivative of a velocity ratio, ∂²`of`/∂`by`∂`by`.
    RatioDerivative { of: &'a str, by: [&'a str; 2] },
    /// The determinant of J, or of the block of J with this number.
    Determinant(Option<usize>),
    /// The inverse of J, or of the block of J with this number.
    Inverse(Option<usize>),
}

/// The names of coordinates as the user wrote them.
pub(super) fn texts<'a, I>(mechanism: &'a Mechanism, indices: &Table<I, CoordinateId>) -> Table<I, &'a str> {
    indices.iter().map(|&index| mechanism.coordinates[index].name.text.as_str()).collect()
}

/// The name of each symbol.
pub(super) fn names<'a>(
    mechanism: &'a Mechanism,
    derivation: &Derivation,
    inputs: &Table<InputId, &'a str>,
    unknowns: &Table<UnknownId, &'a str>,
) -> FxHashMap<SymbolId, Name<'a>> {
    let mut names = FxHashMap::default();
    for parameter in &mechanism.parameters {
        names.insert(parameter.symbol, Name::Plain(&parameter.name.text));
    }
    let indices = derivation.inputs.iter().zip(inputs).chain(derivation.unknowns.iter().zip(unknowns));
    for (&index, &text) in indices {
        let coordinate = &derivation.coordinates[index];
        names.insert(coordinate.value, Name::Plain(text));
        names.insert(coordinate.rate, Name::Rate(text));
        names.insert(coordinate.acceleration, Name::Acceleration(text));
    }
    for (ratios, &by) in derivation.ratios.iter().zip(inputs) {
        names.extend(ratios.iter().zip(unknowns).map(|(&ratio, &of)| (ratio, Name::Ratio { of, by })));
    }
    if let Some(RatioDerivatives { pairs, names: second, .. }) = &derivation.ratio_derivatives {
        for (of_pair, &(j, k)) in second.iter().zip(pairs) {
            let by = [inputs[j], inputs[k]];
            names.extend(of_pair.iter().zip(unknowns).map(|(&name, &of)| (name, Name::RatioDerivative { of, by })));
        }
    }
    for (first, parameter) in derivation.sensitivity.iter().flat_map(|first| &first.names).zip(&mechanism.parameters) {
        let by = parameter.name.text.as_str();
        names.extend(first.iter().zip(unknowns).map(|(&name, &of)| (name, Name::Ratio { of, by })));
    }
    names
}
