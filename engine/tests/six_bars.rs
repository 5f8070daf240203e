//! The best six-bars: the numbers of the query against those of positions one by one, by other formulas.

use std::error::Error;
use std::f64::consts::TAU;

use datafusion::prelude::{SessionConfig, SessionContext};
use linkage::nalgebra::{Complex, SMatrix, SVector};
use linkage_engine::mechanisms::six_bar::{FootPath, SixBar};
use linkage_engine::{Mechanisms, Request, register, session};

#[path = "../examples/six_bars/legs.rs"]
mod legs;
#[path = "../examples/six_bars/query.rs"]
mod query;

use legs::{FINE, Leg, NAMES, branch};
use query::{POSITIONS, Row, request, rows, sql};

type Failure = Box<dyn Error>;

const DESIGNS: u64 = 3000;

async fn answer(context: &SessionContext, request: &Request) -> Result<Vec<Row>, Failure> {
    let batches = context.sql(&sql(request)?).await?.collect().await?;
    let rows: Option<Vec<_>> = batches.iter().map(rows).collect();
    Ok(rows.ok_or("other columns")?.concat())
}

/// Asserts that two numbers are equal up to rounding errors.
fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-10 * (a.abs() + b.abs()), "{a} and {b}");
}

/// The point at these distances from two points, on the left of the way from the first to the second.
fn left(a: Complex<f64>, from_a: f64, b: Complex<f64>, from_b: f64) -> Complex<f64> {
    let line = b - a;
    let along = (line.norm_sqr() + from_a * from_a - from_b * from_b) / (2.0 * line.norm_sqr());
    a + line * Complex::new(along, (from_a * from_a / line.norm_sqr() - along * along).sqrt())
}

#[test]
fn curve_is_that_of_intersecting_circles() -> Result<(), Failure> {
    let pivot = Complex::new(-38.0, -7.8);
    let foot = |step: u32| {
        let pin = Complex::from_polar(15.0, TAU * f64::from(step) / 720.0);
        let upper = left(pivot, 41.5, pin, 50.0);
        let knee = left(pin, 61.9, pivot, 39.3);
        let back = left(pivot, 40.1, upper, 55.8);
        let ankle = left(knee, 36.7, back, 39.4);
        left(knee, 49.0, ankle, 65.7)
    };
    let feet: Vec<_> = (0..720).map(foot).collect();
    let least = |part: fn(&Complex<f64>) -> f64| feet.iter().map(part).fold(f64::INFINITY, f64::min);
    let most = |part: fn(&Complex<f64>) -> f64| feet.iter().map(part).fold(f64::NEG_INFINITY, f64::max);
    let corner = Complex::new(least(|foot| foot.re), least(|foot| foot.im));
    let width = most(|foot| foot.re) - corner.re;
    let curve = FootPath::new()?.at(72).ok_or("no curve")?;
    assert_eq!(curve.len(), 72);
    for (foot, point) in feet.iter().step_by(10).zip(curve) {
        assert!(((foot - corner) / width - point).norm() < 1e-12, "{foot} and {point}");
    }
    Ok(())
}

/// The root mean square distance by linear least squares with the four unknowns of the motion, at all starts and in both
/// senses.
fn distance(path: &[Complex<f64>], curve: &[Complex<f64>]) -> f64 {
    let of_start = |start: usize, is_forward: bool| {
        let at = |k: usize| path[if is_forward { start + k } else { start + POSITIONS - k } % POSITIONS];
        let matrix = SMatrix::<f64, { 2 * POSITIONS }, 4>::from_fn(|row, column| {
            let z = at(row / 2);
            [[z.re, -z.im, 1.0, 0.0], [z.im, z.re, 0.0, 1.0]][row % 2][column]
        });
        let wanted =
            SVector::<f64, { 2 * POSITIONS }>::from_fn(|row, _| [curve[row / 2].re, curve[row / 2].im][row % 2]);
        let best = (matrix.transpose() * matrix).try_inverse().map(|inverse| inverse * matrix.transpose() * wanted);
        best.map_or(f64::INFINITY, |best| ((matrix * best - wanted).norm_squared() / POSITIONS as f64).sqrt())
    };
    let all = (0..POSITIONS).flat_map(|start| [of_start(start, true), of_start(start, false)]);
    all.fold(f64::INFINITY, f64::min)
}

/// The angle between two lines, at most a right angle.
fn angle(a: Complex<f64>, b: Complex<f64>) -> f64 {
    let angle = (a.conj() * b).arg().abs();
    angle.min(std::f64::consts::PI - angle)
}

#[tokio::test]
async fn numbers_are_those_of_single_positions() -> Result<(), Failure> {
    let context = session(Mechanisms::built_in()?);
    let rows = answer(&context, &request(DESIGNS, 0)).await?;
    assert!(rows.len() > 10, "{} rows", rows.len());
    let key = |row: &Row| (row.distance, row.case);
    assert!(rows.windows(2).all(|pair| key(&pair[0]) < key(&pair[1])), "not sorted");
    let curve = FootPath::new()?;
    let coarse = curve.at(POSITIONS).ok_or("no curve")?;
    for row in rows {
        assert!(row.min_mu > 40_f64.to_radians() && row.size < 2.5 && row.clearance > 0.0, "{row:?}");
        let design = SixBar::from(row.lengths);
        let mut feet = Vec::new();
        let mut least = f64::INFINITY;
        for step in 0..POSITIONS {
            let pose = design.assemble(TAU * step as f64 / POSITIONS as f64, branch())?;
            let points = design.points(&pose)?;
            let [b, c, d, p, q, f] = [points.b, points.c, points.d, points.p, points.q, points.f]
                .map(|point| Complex::new(point.x, point.y));
            feet.push(Complex::new(points.foot.x, points.foot.y));
            // C and Q are on the sides that the page states.
            assert!(((d - b).conj() * (c - b)).im > 0.0 && ((f - p).conj() * (q - p)).im < 0.0, "{row:?}");
            least = least.min(angle(c - b, c - d)).min(angle(q - p, q - f));
        }
        close(row.min_mu, least);
        close(row.distance, distance(&feet, &coarse));

        let leg = Leg::new(&curve, row.clone())?;
        let every: Vec<_> = leg.positions.iter().step_by(FINE / POSITIONS).collect();
        // The crank as it is drawn turns by equal steps in the sense that the page states.
        let step = TAU / FINE as f64 * if leg.is_clockwise { -1.0 } else { 1.0 };
        for pair in leg.positions.windows(2) {
            let [before, after] = [&pair[0], &pair[1]].map(|points| points[1] - points[0]);
            close((before.conj() * after).arg(), step);
        }
        // The leg as it is drawn has the distance, the size and the clearance of the query.
        let gaps = every.iter().zip(&coarse).map(|(points, given)| (points[7] - given).norm_sqr());
        close(leg.row.distance, (gaps.sum::<f64>() / POSITIONS as f64).sqrt());
        let range = |part: fn(&Complex<f64>) -> f64, names: &[&str]| {
            let is_named = |place: &usize| names.contains(&NAMES[*place]);
            let points = every.iter().flat_map(|points| points.iter().enumerate().filter(|(place, _)| is_named(place)));
            points
                .map(|(_, point)| part(point))
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
        };
        let [[left, right], [low, high]] = [range(|point| point.re, &NAMES), range(|point| point.im, &NAMES)];
        close(row.size, (right - left).max(high - low));
        assert!((range(|point| point.im, &["A", "B", "C", "D", "P", "Q", "F"])[0] - row.clearance).abs() < 1e-12);
    }
    Ok(())
}

#[tokio::test]
async fn answer_does_not_depend_on_partitions_and_chunks() -> Result<(), Failure> {
    let wanted = answer(&session(Mechanisms::built_in()?), &request(DESIGNS, 5)).await?;
    for (partitions, rows_per_chunk) in [(1, 24), (3, 1000), (7, 100_000)] {
        let mut config = SessionConfig::new().with_target_partitions(partitions);
        config.options_mut().sql_parser.enable_ident_normalization = false;
        let context = SessionContext::new_with_config(config);
        register(&context, Mechanisms::built_in()?);
        let request = Request { rows_per_chunk: Some(rows_per_chunk), ..request(DESIGNS, 5) };
        assert!(answer(&context, &request).await? == wanted, "other rows with {partitions} partitions");
    }
    Ok(())
}

#[tokio::test]
async fn turns_without_a_curve_have_no_distance() -> Result<(), Failure> {
    let context = session(Mechanisms::built_in()?);
    let count = async |positions: u64| -> Result<usize, Failure> {
        let turn = format!(r#"{{"factors": [{{"Turn": {{"column": "theta", "count": {positions}}}}}]}}"#);
        let query =
            format!("SELECT distance FROM cases('six_bar', '{turn}') WHERE distance IS NOT NULL AND min_mu > 0");
        Ok(context.sql(&query).await?.count().await?)
    };
    assert_eq!([count(24).await?, count(23).await?, count(360).await?], [1, 0, 1]);
    Ok(())
}
