//! One mask a row: `accepted` does not depend on the columns of a query, a quantity that does not exist is null in its own
//! column, and SQL gives what the reducers of `linkage-sweep` give.

mod common;

use std::ops::ControlFlow;

use common::{context, lines, number, rows};
use datafusion::arrow::array::AsArray;
use datafusion::arrow::datatypes::{Float64Type, Int64Type, UInt64Type};
use datafusion::prelude::SessionContext;
use linkage::lanes::Lanes;
use linkage::linkage;
use linkage_engine::{Family, Mechanisms, Request};
use linkage_sweep::{Best, Case, Extremes, Front, Histogram, Plan, Progress, Rejected, Sweep, found, given};

linkage! {
    /// A slider-crank that cannot be assembled everywhere, whose outputs have limited domains.
    #[derive(Debug, Clone)]
    pub mechanism Press {
        param r = 2, l = 3, h = 1;
        input th;
        unknown phi, s;
        loop r@th + l@phi = (s, h);
        point P = (sqrt(s - 2), h);
        output root = sqrt(cos(th));
        output steep = 1 / (s - 4);
        output level = ln(s - 2);
        derive lanes;
    }
}

const POSITIONS: usize = 60;

fn plan() -> Plan {
    Plan::new().grid("r", 1.0, 3.0, 7).turn("th", POSITIONS as u64).constant("th_rate", 1.0)
}

fn branch() -> PressBranch {
    PressBranch::all().next().unwrap()
}

fn sweep() -> Sweep<Press> {
    Sweep::new(&Press::default(), branch(), plan()).unwrap().with_case(1).unwrap()
}

/// The largest number of a case, of those that exist.
fn top(case: &Case<'_, f64, 1>) -> Option<f64> {
    case.numbers(0).reduce(f64::max)
}

/// A context with a case column for each found column, and one that is never a number.
fn pressing(partitions: usize) -> SessionContext {
    let family = Press::<f64>::FOUND.iter().fold(Family::new(Press::default(), branch()), |family, name| {
        family.case_column(format!("top_{name}"), [found(*name)], top)
    });
    let family = family.case_column("nothing", [], |_| Some(f64::NAN));
    let mut mechanisms = Mechanisms::default();
    mechanisms.register("press", family).unwrap();
    context(mechanisms, partitions, 100)
}

fn table(function: &str, rows_per_chunk: usize) -> String {
    let request = Request { rows_per_chunk: Some(rows_per_chunk), ..plan().into() };
    format!("{function}('press', '{}')", request.to_json().unwrap())
}

fn go_on(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// The mask of all rows, in order, with these columns in the query.
async fn mask(context: &SessionContext, columns: &str) -> Vec<bool> {
    let query = format!("SELECT row, {columns}accepted FROM {} ORDER BY row", table("sweep", 100));
    let batches = rows(context, &query).await.unwrap();
    let of_batch = |batch: &datafusion::arrow::array::RecordBatch| {
        let accepted = batch.column(batch.num_columns() - 1).as_boolean();
        accepted.iter().map(Option::unwrap).collect::<Vec<_>>()
    };
    batches.iter().flat_map(of_batch).collect()
}

#[tokio::test]
async fn accepted_does_not_depend_on_the_columns_of_a_query() {
    let context = pressing(3);
    let alone = mask(&context, "").await;
    let rejected = alone.iter().filter(|accepted| !**accepted).count();
    assert!(rejected > 30 && alone.len() == 7 * POSITIONS, "{rejected}");
    let reduced = sweep().reduce(&Rejected, go_on).unwrap();
    assert_eq!(reduced.total(), rejected as u64);
    let mut columns = String::new();
    for name in Press::<f64>::FOUND {
        assert_eq!(mask(&context, &format!("{name}, ")).await, alone, "{name}");
        columns += &format!("{name}, ");
        assert_eq!(mask(&context, &columns).await, alone, "{columns}");
    }
    let (table, rejected) = (table("sweep", 70), rejected as i64);
    for (query, expected) in [
        ("SELECT count(*) FROM @ WHERE NOT accepted", rejected),
        ("SELECT count(*) FROM @ WHERE NOT accepted AND root IS NULL", rejected),
        ("SELECT count(s) FROM @", alone.len() as i64 - rejected),
        ("SELECT count(*) FROM @ WHERE accepted AND s IS NULL", 0),
        ("SELECT count(*) FROM @ WHERE NOT accepted AND root IS NOT NULL", 0),
        ("SELECT count(*) FROM @ WHERE isnan(root) OR isnan(steep_acceleration) OR isnan(level)", 0),
        ("SELECT count(*) FROM (SELECT accepted, root FROM @) WHERE NOT accepted", rejected),
        ("WITH all AS (SELECT * FROM @) SELECT count(*) FROM all WHERE NOT accepted", rejected),
        // One sweep joined with itself, with the column on one side only.
        ("SELECT count(*) FROM @ a JOIN @ b ON a.row = b.row WHERE a.accepted != b.accepted", 0),
        ("SELECT count(*) FROM @ a JOIN @ b ON a.row = b.row WHERE NOT a.accepted AND b.level IS NULL", rejected),
        (
            "SELECT count(*) FROM @ a JOIN @ b ON a.row = b.row AND a.accepted = b.accepted WHERE a.root > -1 OR b.s > -9",
            alone.len() as i64 - rejected,
        ),
        (
            "SELECT count(*) FROM (SELECT row, accepted FROM @ EXCEPT SELECT row, accepted FROM @ WHERE root IS NULL OR root > -1)",
            0,
        ),
        (
            "SELECT count(*) FROM @ a WHERE NOT accepted AND EXISTS (SELECT 1 FROM @ b WHERE b.row = a.row AND b.level IS NULL)",
            rejected,
        ),
    ] {
        assert_eq!(number(&context, &query.replace('@', &table)).await, expected, "{query}");
    }
}

/// The numbers of a result with one row; null is NaN.
async fn floats(context: &SessionContext, query: &str) -> Vec<f64> {
    let batches = rows(context, query).await.unwrap();
    let columns = batches.iter().flat_map(|batch| batch.columns());
    columns.map(|column| column.as_primitive::<Float64Type>().iter().next().flatten().unwrap_or(f64::NAN)).collect()
}

#[tokio::test]
async fn reducers_give_the_same_alone_in_tuples_and_through_sql() {
    let context = pressing(2);
    let (all, cases, sweep) = (table("sweep", 70), table("cases", 130), sweep());
    let mut partly = 0;
    for (place, name) in Press::<f64>::FOUND.iter().enumerate() {
        let other = Press::<f64>::FOUND[(place + 3) % Press::<f64>::FOUND.len()];
        let extremes = Extremes::of(found(*name));
        let histogram = Histogram::of(found(*name), -1.0, 2.0, 12);
        let best = Best::new(4, [found(*name)], top);
        let tops =
            |case: &Case<'_, f64, 2>| Some([case.numbers(0).reduce(f64::max)?, case.numbers(1).reduce(f64::max)?]);
        let front = Front::new([found(*name), found(other)], tops);
        let alone = (
            sweep.reduce(&extremes, go_on).unwrap(),
            sweep.reduce(&histogram, go_on).unwrap(),
            sweep.reduce(&best, go_on).unwrap(),
            sweep.reduce(&front, go_on).unwrap(),
        );
        let root = Extremes::of(found("root"));
        let (tuple, _) = sweep.reduce(&((extremes, histogram, best, front), root), go_on).unwrap();
        assert_eq!(tuple, alone, "{name}");
        let (bounds, bins, best, front) = alone;

        let (least, most) = (bounds.least.unwrap(), bounds.most.unwrap());
        let found = floats(&context, &format!("SELECT min({name}), max({name}) FROM {all}")).await;
        assert_eq!(found, [least.value, most.value], "{name}");
        let first =
            format!("SELECT CAST(min(row) AS BIGINT) FROM {all} WHERE {name} = (SELECT min({name}) FROM {all})");
        assert_eq!(number(&context, &first).await, least.row as i64, "{name}");

        let count = number(&context, &format!("SELECT count({name}) FROM {all}")).await;
        assert_eq!(count, bins.total() as i64, "{name}");
        partly += usize::from(count < number(&context, &format!("SELECT count(s) FROM {all}")).await);
        // A quarter is a double, and so are the edges of bins. The end belongs to the last.
        let bin = |bin: usize| {
            let (from, to) = (bins.edge(bin), bins.edge(bin + 1));
            let end = if bin == 11 { "<=" } else { "<" };
            format!("count(*) FILTER (WHERE {name} >= {from} AND {name} {end} {to})")
        };
        let query = format!("SELECT {} FROM {all}", (0..12).map(bin).collect::<Vec<_>>().join(", "));
        let batches = rows(&context, &query).await.unwrap();
        let count = |column: &datafusion::arrow::array::ArrayRef| column.as_primitive::<Int64Type>().value(0) as u64;
        let counts: Vec<u64> = batches.iter().flat_map(|batch| batch.columns()).map(count).collect();
        assert_eq!(counts, bins.counts, "{name}");

        let query = format!(
            "SELECT case_number, top_{name} FROM {cases} WHERE top_{name} IS NOT NULL ORDER BY top_{name} DESC, case_number LIMIT 4"
        );
        let mut ranked = Vec::new();
        for batch in rows(&context, &query).await.unwrap() {
            let (case, score) =
                (batch.column(0).as_primitive::<UInt64Type>(), batch.column(1).as_primitive::<Float64Type>());
            ranked.extend(case.values().iter().copied().zip(score.values().iter().copied()));
        }
        assert_eq!(ranked, best.iter().map(|ranked| (ranked.case, ranked.score)).collect::<Vec<_>>(), "{name}");

        let query = format!(
            "WITH c AS (SELECT case_number, top_{name} AS x, top_{other} AS y FROM {cases} WHERE top_{name} IS NOT NULL AND top_{other} IS NOT NULL)
             SELECT case_number FROM c a WHERE NOT EXISTS (SELECT 1 FROM c b WHERE b.x >= a.x AND b.y >= a.y AND
                 (b.x > a.x OR b.y > a.y OR b.case_number < a.case_number))"
        );
        let mut unbeaten: Vec<u64> = front.iter().map(|case| case.case).collect();
        unbeaten.sort_unstable();
        let expected: Vec<_> = unbeaten.into_iter().map(|case| vec![Some(case)]).collect();
        assert_eq!(lines(&rows(&context, &query).await.unwrap()), expected, "{name} and {other}");
    }
    // Those of root and of the x of P with their derivatives, and level, whose derivatives exist.
    assert_eq!(partly, 7);
    let rejected = sweep.reduce(&Rejected, go_on).unwrap();
    assert_eq!(
        number(&context, &format!("SELECT count(*) FROM {all} WHERE NOT accepted")).await,
        rejected.total() as i64
    );
    // A case is accepted if all its rows are, with any column next to it.
    let mut masks = Vec::new();
    for columns in ["", "top_root, ", "top_s, ", "nothing, ", "r, top_steep_rate, "] {
        let query = format!("SELECT count(*) FROM (SELECT {columns}accepted FROM {cases}) WHERE accepted");
        masks.push(number(&context, &query).await);
    }
    assert!(masks[0] > 0 && masks[0] < 7 && masks.iter().all(|count| *count == masks[0]), "{masks:?}");
    assert_eq!(number(&context, &format!("SELECT count(nothing) FROM {cases}")).await, 0);
}

/// Every column of a whole table, with the bits of `linkage-sweep`: null where it has no number.
#[tokio::test]
async fn nulls_are_where_numbers_do_not_exist() {
    let whole = sweep().with_rows_per_chunk(usize::MAX).unwrap();
    let columns: Vec<_> = [given("r")].into_iter().chain(Press::<f64>::FOUND.iter().map(|name| found(*name))).collect();
    let chunk = whole.chunk(0, &columns).unwrap();
    let row = |row: usize| {
        let numbers = chunk.columns().map(|(_, _, values)| values[row].is_finite().then(|| values[row].to_bits()));
        numbers.chain([Some(u64::from(chunk.accepted()[row]))]).collect::<Vec<_>>()
    };
    let mut expected: Vec<_> = (0..chunk.rows()).map(row).collect();
    expected.sort_unstable();
    let nulls = expected.iter().flatten().filter(|value| value.is_none()).count();
    assert!(nulls > 1000, "{nulls}");
    let query = format!("SELECT r, {}, accepted FROM {}", Press::<f64>::FOUND.join(", "), table("sweep", 50));
    assert_eq!(lines(&rows(&pressing(3), &query).await.unwrap()), expected);
}
