//! The reason why a question has no answer.

use std::fmt::Display;

use linkage_dynamics::MotionError;
use linkage_interpreter::{CallError, Error, Words};
use linkage_runtime::circuits::CircuitError;
use linkage_runtime::{Name, PathError, PositionError};
use serde::Serialize;

use crate::about::About;

/// The reason why a question has no answer, in one sentence.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Refusal {
    /// The sentence.
    pub why: String,
    /// If links do not reach each other, the beginning of the sentence, and the inputs. Where the formulas are known, they say
    /// which links, and by how much.
    #[serde(skip)]
    pub(crate) apart: Option<(String, Vec<f64>)>,
}

impl Refusal {
    pub(crate) fn new(why: impl Display) -> Self {
        Self { why: why.to_string(), apart: None }
    }

    /// The error of a call.
    pub(crate) fn of_call(error: &CallError) -> Self {
        let apart = match error {
            CallError::Function(Error::Position(PositionError::Unbuildable { mechanism, group, inputs, .. })) => {
                let values = inputs.iter().map(|(_, value)| value).collect();
                Some((format!("{mechanism} cannot be assembled at {inputs}: group {group} does not close"), values))
            }
            _ => None,
        };
        Self { apart, ..Self::new(Words::new(&|_| false).call(error)) }
    }

    /// The reason why there is no position.
    pub(crate) fn of_position<N: Name>(error: &PositionError<N>) -> Self {
        Self::new(Words::new(&|_| false).position(error))
    }

    /// The reason why circuits are not found; a page counts modes from 1.
    pub(crate) fn of_circuits<N: Name>(about: &About, error: &CircuitError<N>) -> Self {
        match error {
            CircuitError::Position(error) => Self::of_position(error),
            CircuitError::Path { mode, error } => {
                let why = Self::of_path(about, error).why;
                Self::new(format!("from position {}, {why}: another input may do", mode + 1))
            }
            other => Self::new(other),
        }
    }

    /// The reason why a motion of a mechanism is not followed.
    pub(crate) fn of_path<N: Name>(about: &About, error: &PathError<N>) -> Self {
        Self::new(Words::new(&|name| about.is_angle(name)).path(error))
    }

    /// The reason why a simulation of a mechanism ends.
    pub(crate) fn of_motion<N: Name>(about: &About, error: &MotionError<N>) -> Self {
        Self::new(Words::new(&|name| about.is_angle(name)).motion(error))
    }
}
