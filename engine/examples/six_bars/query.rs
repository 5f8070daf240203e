//! The query, and the rows of its answer.

use datafusion::arrow::array::{Array, Float64Array, RecordBatch, UInt64Array};
use linkage_engine::{EngineError, Request};
use linkage_sweep::{Distribution, Plan, Sequence};

/// The positions of a turn of the crank.
pub const POSITIONS: usize = 24;

/// The designs of the answer.
pub const BEST: usize = 100;

/// The dimensions, relative to the crank, and their ranges.
pub const RANGES: [(&str, f64, f64); 11] = [
    ("coupler", 1.5, 5.0),
    ("rocker", 1.2, 4.0),
    ("ground", 1.5, 5.0),
    ("px", -4.0, 6.0),
    ("py", -5.0, 5.0),
    ("leg", 1.5, 6.0),
    ("lever", 1.0, 5.0),
    ("fx", -4.0, 6.0),
    ("fy", -5.0, 5.0),
    ("u", -8.0, 8.0),
    ("v", -8.0, 8.0),
];

/// The numbers of a design by which the query chooses.
pub const MEASURES: [&str; 4] = ["distance", "min_mu", "size", "clearance"];

/// A design of the answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    pub case: u64,
    /// The crank, which is 1, then the dimensions in the order of [`RANGES`].
    pub lengths: [f64; 12],
    /// The root mean square distance of path and curve, relative to the width of a step.
    pub distance: f64,
    /// The least transmission angle, in radians.
    pub min_mu: f64,
    /// The larger side of the box around all positions, relative to the width of a step.
    pub size: f64,
    /// The height of the lowest joint in all positions, relative to the width of a step.
    pub clearance: f64,
}

/// Random designs, each over a turn of the crank.
pub fn request(designs: u64, seed: u64) -> Request {
    let columns = RANGES.map(|(name, from, to)| (name, Distribution::Uniform { from, to }));
    let plan = Plan::new().sample(columns, designs, Sequence::Random).turn("theta", POSITIONS as u64).seed(seed);
    Request { branch: Some("right".to_owned()), ..Request::from(plan) }
}

/// The query for the best designs of a request.
///
/// # Errors
/// [`EngineError::Request`], if a number is not finite.
pub fn sql(request: &Request) -> Result<String, EngineError> {
    let lengths: Vec<&str> = RANGES.iter().map(|(name, ..)| *name).collect();
    Ok(format!(
        "SELECT case_number, crank, {}, {}\n\
         FROM cases('six_bar', '{}')\n\
         WHERE min_mu > radians(40) AND size < 2.5 AND clearance > 0\n\
         ORDER BY distance, case_number LIMIT {BEST}",
        lengths.join(", "),
        MEASURES.join(", "),
        request.to_json()?
    ))
}

/// The rows of a batch; none if it has other columns than those of the query.
pub fn rows(batch: &RecordBatch) -> Option<Vec<Row>> {
    let cases = batch.column_by_name("case_number")?.as_any().downcast_ref::<UInt64Array>()?;
    let numbers: Option<Vec<&Float64Array>> =
        batch.columns().iter().skip(1).map(|column| column.as_any().downcast_ref::<Float64Array>()).collect();
    let numbers =
        numbers.filter(|numbers| numbers.len() == 16 && numbers.iter().all(|column| column.null_count() == 0))?;
    let row = |(index, case): (usize, &u64)| {
        let number = |column: usize| numbers[column].value(index);
        let [distance, min_mu, size, clearance] = [12, 13, 14, 15].map(number);
        Row { case: *case, lengths: std::array::from_fn(number), distance, min_mu, size, clearance }
    };
    Some(cases.values().iter().enumerate().map(row).collect())
}
