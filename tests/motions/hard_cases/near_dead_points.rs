//! Larger groups near dead points: the rounding errors of a factorisation grow with the inverse of its smallest pivot,
//! most of all those of the entries of J, which come from rounded sines. At a pivot of 1e-9 a library's factorisation of
//! J loses nine of sixteen digits. The emitted functions then compute in twice the precision from the stored angles.
//!
//! Measured on the double butterfly and Stephenson II before they did: relative errors of about 1e-13, 1e-10 and 1e-7 at
//! pivots of 1e-3, 1e-6 and 1e-9; now at most 2.4e-16.

use linkage_compiler::derivation::Derivation;
use linkage_compiler::graph::{NodeId, SymbolId};
use linkage_compiler::ids::Id;
use linkage_gallery::listed::{Built, Listed, listed};
use linkage_gallery::source;
use linkage_oracle::precise::{Big, Scalar, big};
use linkage_oracle::tape::Tape;
use nalgebra::{DMatrix, DVector};

use super::relative;

const RATE: f64 = 1.5;
const ACCELERATION: f64 = -0.7;

/// Four ulp of a double at the lower end of a binade.
const FOUR_ULP: f64 = 4.0 * f64::EPSILON;

/// The equations of motion of a mechanism with one input in 48 digits.
struct Exact {
    derivation: Derivation,
    parameters: Vec<(SymbolId, f64)>,
    /// J and A row by row, then gamma.
    tape: Tape,
}

impl Exact {
    fn of(of: &dyn Listed<f64>) -> Self {
        let mechanism = linkage_compiler::read(source::tokens_of(of.file())).expect("a file of the gallery").remove(0);
        let mut derivation = linkage_compiler::derive(&mechanism).remove(0);
        let zero = derivation.graph.zero();
        let columns: Vec<_> = derivation.unknowns.iter().chain(&derivation.inputs).copied().collect();
        let entries = derivation.jacobian.iter().flat_map(|row| columns.iter().map(|column| row.get(column).copied()));
        let entries = entries.map(|entry| entry.unwrap_or(zero));
        let roots: Vec<NodeId> = entries.chain(derivation.gamma.iter().copied()).collect();
        let tape = Tape::new(&derivation.graph, &roots, &[]);
        let symbols = mechanism.parameters.iter().map(|parameter| parameter.symbol);
        let parameters = symbols.zip(of.defaults()).collect();
        Self { derivation, parameters, tape }
    }

    /// J and A row by row, then gamma.
    fn terms(&self, q: &[f64], rates: &[Big]) -> Vec<Big> {
        let bind = |symbol| {
            let parameter = self.parameters.iter().find(|(other, _)| *other == symbol).map(|(_, value)| big(*value));
            let of_coordinate = || {
                let place = self.derivation.coordinates.iter().position(|c| c.value == symbol);
                place.map(|place| big(q[place]))
            };
            let of_rate = || {
                let place = self.derivation.coordinates.iter().position(|c| c.rate == symbol);
                place.map(|place| rates[place].clone())
            };
            parameter.or_else(of_coordinate).or_else(of_rate).expect("a bound symbol")
        };
        self.tape.evaluate(bind, |_, _| 0.0)
    }

    /// u' and u'' at angles that are doubles.
    fn motion(&self, q: &[f64]) -> [Vec<Big>; 2] {
        let unknowns: Vec<usize> = self.derivation.unknowns.iter().map(|column| column.index()).collect();
        let [input] = [self.derivation.inputs.iter().next().expect("an input").index()];
        let (n, mut rates) = (unknowns.len(), vec![big(0.0); q.len()]);
        let terms = self.terms(q, &rates);
        let right = |factor: f64, gamma: &[Big]| -> Vec<Vec<Big>> {
            let rows = terms.chunks(n + 1).take(n).zip(gamma);
            rows.map(|(row, gamma)| [&row[..n], &[-(&row[n] * big(factor)) - gamma]].concat()).collect()
        };
        let velocities = eliminated(right(RATE, &vec![big(0.0); n]));
        rates[input] = big(RATE);
        for (place, rate) in unknowns.iter().zip(&velocities) {
            rates[*place] = rate.clone();
        }
        let gamma = self.terms(q, &rates).split_off(n * (n + 1));
        let accelerations = eliminated(right(ACCELERATION, &gamma));
        [velocities, accelerations]
    }
}

/// The solution of a linear system given by rows, each with its right side, by Gauss's elimination.
fn eliminated(mut rows: Vec<Vec<Big>>) -> Vec<Big> {
    let n = rows.len();
    for k in 0..n {
        let size = |row: &Vec<Big>| row[k].double().abs();
        let pivot = (k..n).max_by(|&a, &b| size(&rows[a]).total_cmp(&size(&rows[b]))).expect("a row");
        rows.swap(k, pivot);
        let row = rows[k].clone();
        for other in rows.iter_mut().enumerate().filter(|(place, _)| *place != k).map(|(_, other)| other) {
            let factor = &other[k] / &row[k];
            other.iter_mut().zip(&row).for_each(|(entry, own)| *entry -= &factor * own);
        }
    }
    (0..n).map(|k| &rows[k][n] / &rows[k][k]).collect()
}

/// J of the unknowns.
fn jacobian(m: &dyn Built<f64>, q: &[f64]) -> DMatrix<f64> {
    let j = m.pose(q).jacobian();
    let n = j.nrows();
    j.columns(0, n).into_owned()
}

/// The smallest pivot of J with rows and columns of about 1.
fn smallest_pivot(mut j: DMatrix<f64>) -> f64 {
    for mut row in j.row_iter_mut() {
        let size = row.amax();
        row /= size;
    }
    for mut column in j.column_iter_mut() {
        let size = column.amax();
        column /= size;
    }
    j.lu().u().diagonal().amin()
}

/// Angles with these smallest pivots: from a position some way before a dead point along its velocities, the direction
/// in which J is singular.
fn before_dead_point(m: &dyn Built<f64>, near: &[f64], pivots: [f64; 3]) -> [Vec<f64>; 3] {
    let start = DVector::from_vec(m.solved(near).expect("a position"));
    let direction = DVector::from_vec(m.pose(start.as_slice()).velocity(&[1.0]).expect("a regular position"));
    let direction = direction.normalize();
    let at = |s: f64| (&start + &direction * s).as_slice().to_vec();
    let is_before = |s: f64| jacobian(m, &at(s)).determinant() * jacobian(m, &at(0.0)).determinant() > 0.0;
    let step = [0.2, -0.2].into_iter().find(|s| !is_before(*s)).expect("a dead point nearby");
    let dead = (0..60).fold([0.0, step], |[before, after], _| {
        let middle = 0.5 * (before + after);
        if is_before(middle) { [middle, after] } else { [before, middle] }
    })[0];
    pivots.map(|pivot| {
        // The pivot is in proportion to the distance.
        let nearer = |s: f64| s * pivot / smallest_pivot(jacobian(m, &at(dead - s)));
        at(dead - (0..3).fold(0.1 * dead, |s, _| nearer(s)))
    })
}

/// The largest relative errors of velocities and of accelerations of the unknowns.
fn errors(exact: &Exact, expected: &[Vec<Big>; 2], rates: &[f64], accelerations: &[f64]) -> [f64; 2] {
    let places = exact.derivation.unknowns.iter().map(|column| column.index());
    let mut worst = [0.0_f64; 2];
    for (row, place) in places.enumerate() {
        for (order, found) in [rates, accelerations].into_iter().enumerate() {
            worst[order] = worst[order].max(relative(found[place], &expected[order][row]));
        }
    }
    worst
}

fn keeps_its_digits(of: &dyn Listed<f64>, near: &[f64]) {
    let (m, exact) = (of.with_parameters(&of.defaults()), Exact::of(of));
    let pivots = [1e-3, 1e-6, 1e-9];
    for (q, pivot) in before_dead_point(&*m, near, pivots).iter().zip(pivots) {
        let j = jacobian(&*m, q);
        let found = smallest_pivot(j.clone());
        assert!((0.8..1.25).contains(&(found / pivot)), "a pivot of {found:.1e}");
        let pose = m.pose(q);
        let expected = exact.motion(q);
        let within = |from: &str, [velocity, acceleration]: [f64; 2]| {
            println!("{}, {pivot:.0e}, {from}: {velocity:.1e}, {acceleration:.1e}", of.file());
            assert!(velocity <= FOUR_ULP && acceleration <= FOUR_ULP, "{from}: {velocity:e}, {acceleration:e}");
        };
        let rates = pose.velocity(&[RATE]).unwrap();
        let accelerations = pose.acceleration(&rates, &[ACCELERATION]).unwrap();
        within("velocity, acceleration", errors(&exact, &expected, &rates, &accelerations));
        let motion = m.motion(q, &[RATE], &[ACCELERATION]).unwrap();
        let [_, rates, accelerations] = &motion.coordinates;
        within("motion", errors(&exact, &expected, rates, accelerations));
        let ratios = pose.velocity_ratios().unwrap();
        for (ratio, expected) in ratios.iter().zip(&expected[0]) {
            let error = relative(ratio * RATE, expected);
            assert!(error <= FOUR_ULP, "velocity ratios: {error:e}");
        }
        // A library's factorisation of J in doubles loses these digits.
        let by_input = pose.jacobian().column(j.ncols()) * -RATE;
        let library = j.lu().solve(&by_input).unwrap();
        let lost = library.iter().zip(&expected[0]).map(|(found, expected)| relative(*found, expected));
        let lost = lost.fold(0.0, f64::max);
        println!("{}, {pivot:.0e}, library: {lost:.1e}", of.file());
        assert!(pivot > 1e-5 || lost > 1e-19 / pivot, "{lost:e}");
    }
}

/// From guesses ever nearer to the last position of the input, at the angles that Newton's method finds.
fn keeps_its_digits_by_newton(of: &dyn Listed<f64>, near: &[f64]) {
    let (m, exact) = (of.with_parameters(&of.defaults()), Exact::of(of));
    let [beyond, ..] = before_dead_point(&*m, near, [1e-3; 3]);
    let mut last = m.solved(near).unwrap();
    let input = exact.derivation.inputs.iter().next().expect("an input").index();
    // Bisection between the last position and an input without position.
    let (mut step, mut least) = (2.0 * (beyond[input] - last[input]), f64::INFINITY);
    for _ in 0..30 {
        let mut guess = last.clone();
        guess[input] += step;
        step *= 0.5;
        let Ok(moving) = m.moving(&guess, 0, &[RATE], &[ACCELERATION], false) else { continue };
        last = moving.pose.coordinates();
        let pivot = smallest_pivot(jacobian(&*m, &last));
        if pivot > 0.01 {
            continue;
        }
        least = least.min(pivot);
        let [velocity, acceleration] = errors(&exact, &exact.motion(&last), &moving.rates, &moving.accelerations);
        assert!(velocity <= FOUR_ULP && acceleration <= FOUR_ULP, "{pivot:e}: {velocity:e}, {acceleration:e}");
    }
    assert!(least < 1e-3, "{least:e}");
}

const DOUBLE_BUTTERFLY: [f64; 7] = [0.587, -2.177, 2.918, -0.014, 3.026, 0.496, 2.690];
const STEPHENSON_II: [f64; 5] = [-0.944, -0.871, 0.178, 2.315, 2.283];

#[test]
fn double_butterfly() {
    let of = listed("double_butterfly", "DoubleButterfly");
    keeps_its_digits(of, &DOUBLE_BUTTERFLY);
    keeps_its_digits_by_newton(of, &DOUBLE_BUTTERFLY);
}

#[test]
fn stephenson_ii() {
    let of = listed("stephenson_ii", "StephensonII");
    keeps_its_digits(of, &STEPHENSON_II);
    keeps_its_digits_by_newton(of, &STEPHENSON_II);
}
