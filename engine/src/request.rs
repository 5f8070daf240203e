//! Requests: plans with settings, as JSON.

use linkage_sweep::{Factor, Plan};
use serde::{Deserialize, Serialize};

use crate::EngineError;

/// A [plan](Plan) and its settings, the second argument of a table function.
///
/// ```
/// use linkage_engine::Request;
///
/// let request: Request = r#"{
///     "factors": [
///         {"Sample": {"columns": [["a", {"Uniform": {"from": 30, "to": 50}}]], "count": 1000, "sequence": "Random"}},
///         {"Turn": {"column": "theta2", "count": 360}}
///     ],
///     "constants": [["theta2_rate", 1]],
///     "seed": 7,
///     "branch": "crossed",
///     "case_factors": 1,
///     "rows_per_chunk": 100000
/// }"#.parse()?;
/// assert_eq!((request.factors.len(), request.case_factors), (2, Some(1)));
/// # Ok::<(), linkage_engine::EngineError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Request {
    /// The factors of the plan, the slowest first.
    pub factors: Vec<Factor>,
    /// Columns with the same number in all rows.
    #[serde(default)]
    pub constants: Vec<(String, f64)>,
    /// The seed of samples.
    #[serde(default)]
    pub seed: u64,
    /// The name of the assembly branch; without it that of the registered mechanism.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub branch: Option<String>,
    /// The number of last factors that make a case; without it 1 for `cases`, and no cases for `sweep`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub case_factors: Option<usize>,
    /// The rows per chunk, which are rounded up to whole cases; without it 8192.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rows_per_chunk: Option<usize>,
}

impl Request {
    /// The plan.
    #[must_use]
    pub fn plan(&self) -> Plan {
        Plan { factors: self.factors.clone(), constants: self.constants.clone(), seed: self.seed }
    }

    /// The request as JSON on one line.
    ///
    /// # Errors
    /// [`EngineError::Request`], if a number is not finite.
    pub fn to_json(&self) -> Result<String, EngineError> {
        serde_json::to_string(self).map_err(EngineError::Request)
    }
}

impl From<Plan> for Request {
    fn from(plan: Plan) -> Self {
        let Plan { factors, constants, seed } = plan;
        Self { factors, constants, seed, ..Self::default() }
    }
}

impl std::str::FromStr for Request {
    type Err = EngineError;

    fn from_str(json: &str) -> Result<Self, EngineError> {
        serde_json::from_str(json).map_err(EngineError::Request)
    }
}
