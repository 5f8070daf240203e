//! A sweep with rejected rows, as SQL and by `linkage-sweep` alone.
#![allow(dead_code, reason = "compiled into each test file, which calls some of these functions")]

use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use datafusion::arrow::array::{Array, AsArray, RecordBatch};
use datafusion::arrow::datatypes::{DataType, Float32Type, Float64Type, UInt64Type};
use datafusion::physical_plan::ExecutionPlan;
use datafusion::prelude::SessionContext;
use linkage::{Elbow, Real, linkage, real};
use linkage_engine::{EngineError, Family, Mechanisms, Request, register};
use linkage_sweep::{Column, Distribution, Plan, Sequence, Sweep, found};

linkage! {
    /// Crank a, coupler b, rocker c, ground d.
    #[derive(Debug, Clone)]
    pub mechanism Rocker {
        param a = 40, b = 120, c = 80, d = 100;
        input theta2;
        unknown theta3, theta4;
        loop a@theta2 + b@theta3 = c@theta4 + d@0;
        point P = a@theta2 + (b/2, 30)@theta3;
        output mu = theta4 - theta3;
        derive lanes;
    }
}

/// The number of calls of [`lift`].
pub static LIFTS: AtomicUsize = AtomicUsize::new(0);

/// The square of an angle and its derivatives. It counts its calls.
fn lift<T: Real>(phi: T) -> (T, T, T) {
    LIFTS.fetch_add(1, Ordering::Relaxed);
    (phi * phi, phi + phi, real(2.0))
}

linkage! {
    /// A cam with a user function.
    pub mechanism Cam {
        param h = 1;
        input phi;
        unknown s;
        extern fn lift(phi) -> (law, slope, bend);
        equation s = h * law(phi);
        output way = s + h;
        derive lanes;
    }
}

pub const ROWS: u64 = 7 * 13 * 24;

/// 91 designs with 24 rows each, 2184 in all.
pub fn plan() -> Plan {
    let lengths = [
        ("b", Distribution::Uniform { from: 60.0, to: 140.0 }),
        ("c", Distribution::Normal { mean: 80.0, deviation: 5.0 }),
    ];
    let plan = Plan::new().grid("a", 20.0, 110.0, 7).sample(lengths, 13, Sequence::Random);
    plan.turn("theta2", 24).constant("theta2_rate", 2.0).seed(42)
}

pub fn request() -> Request {
    plan().into()
}

pub fn left() -> RockerBranch {
    RockerBranch::new(Elbow::Left)
}

/// The sweep by `linkage-sweep` alone.
pub fn sweep() -> Sweep<Rocker<f64>> {
    Sweep::new(&Rocker::default(), left(), plan()).unwrap()
}

/// The mechanism with two case columns, of which the second counts its calls.
pub fn family(count: impl Fn() + Send + Sync + 'static) -> Family<Rocker<f64>> {
    Family::new(Rocker::default(), left())
        .branch("right", RockerBranch::new(Elbow::Right))
        .case_column("highest", [found("p_y")], |case| {
            case.accepted.iter().all(|accepted| *accepted).then(|| case.columns[0].iter().fold(0.0, |y, p| p.max(y)))
        })
        .case_column("start_mu", [found("mu"), found("p_y")], move |case| {
            count();
            case.accepted[0].then(|| case.columns[0][0])
        })
}

pub fn mechanisms() -> Mechanisms {
    let mut mechanisms = Mechanisms::default();
    mechanisms.register("rocker", family(|| ())).unwrap();
    mechanisms
}

/// A session with a number of partitions and rows per batch.
pub fn context(mechanisms: Mechanisms, partitions: usize, batch: usize) -> SessionContext {
    let config = linkage_engine::session(Mechanisms::default()).copied_config();
    let context = SessionContext::new_with_config(config.with_target_partitions(partitions).with_batch_size(batch));
    register(&context, mechanisms);
    context
}

/// The text of a table function with a request.
pub fn table(function: &str, request: &Request) -> String {
    format!("{function}('rocker', '{}')", request.to_json().unwrap())
}

pub async fn planned(context: &SessionContext, query: &str) -> Result<Arc<dyn ExecutionPlan>, EngineError> {
    Ok(context.sql(query).await?.create_physical_plan().await?)
}

pub async fn rows(context: &SessionContext, query: &str) -> Result<Vec<RecordBatch>, EngineError> {
    Ok(context.sql(query).await?.collect().await?)
}

/// The message of a query that is not answered.
pub async fn message(context: &SessionContext, query: &str) -> String {
    rows(context, query).await.unwrap_err().to_string()
}

/// The only number of a result.
pub async fn number(context: &SessionContext, query: &str) -> i64 {
    let batches = rows(context, query).await.unwrap();
    batches[0].column(0).as_primitive::<datafusion::arrow::datatypes::Int64Type>().value(0)
}

/// The bits of a row, `None` for null.
pub type Line = Vec<Option<u64>>;

/// The bits of all rows, sorted.
pub fn lines(batches: &[RecordBatch]) -> Vec<Line> {
    let mut lines = Vec::new();
    for batch in batches {
        for row in 0..batch.num_rows() {
            let bits = |array: &Arc<dyn Array>| match array.data_type() {
                _ if array.is_null(row) => None,
                DataType::Float64 => Some(array.as_primitive::<Float64Type>().value(row).to_bits()),
                DataType::Float32 => Some(array.as_primitive::<Float32Type>().value(row).to_bits().into()),
                DataType::UInt64 => Some(array.as_primitive::<UInt64Type>().value(row)),
                DataType::Boolean => Some(array.as_boolean().value(row).into()),
                other => panic!("{other}"),
            };
            lines.push(batch.columns().iter().map(bits).collect());
        }
    }
    lines.sort_unstable();
    lines
}

/// A hash of sorted rows.
pub fn digest(lines: &[Line]) -> u64 {
    let mut hasher = DefaultHasher::new();
    lines.hash(&mut hasher);
    hasher.finish()
}

/// The rows of all columns by `linkage-sweep` alone: number, given, found, accepted; sorted.
pub fn expected(sweep: &Sweep<Rocker<f64>>) -> Vec<Line> {
    let mut lines = Vec::new();
    for number in 0..sweep.chunks() {
        let chunk = sweep.chunk(number, &Column::all::<Rocker<f64>>()).unwrap();
        for (row, accepted) in chunk.accepted().iter().enumerate() {
            let bits = |(place, _, values): (linkage_sweep::Place, _, &[f64])| {
                let is_null = matches!(place, linkage_sweep::Place::Found(_)) && !accepted;
                (!is_null).then(|| values[row].to_bits())
            };
            let first = [Some(chunk.first_row() + row as u64)].into_iter();
            lines.push(first.chain(chunk.columns().map(bits)).chain([Some((*accepted).into())]).collect());
        }
    }
    lines.sort_unstable();
    lines
}
