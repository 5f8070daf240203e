//! Position, velocity and acceleration of the gallery at random poses against 48-digit arithmetic: the emitted code
//! against the closures themselves, whose residuals in dashu's floats are brought to nothing.
//!
//! An error is measured in ulp times the condition number: the sum of what a relative change of each datum (lengths,
//! inputs, their rates) and of each term of each closure, of its derivatives and of the point itself does to it. For
//! velocities and accelerations that is R. D. Skeel's condition number of J x = b, |J^-1| (|J| |x| + |b|), with what
//! the position contributes. Without the terms, a point that moves along a straight line whatever its lengths are
//! would have the condition number zero across that line.
//!
//! A condition number speaks of small changes. Some 1e-5 from a change point a rounding is no small one: angular
//! accelerations have two digits left, and a point whose condition number is small, because its links stay as long as
//! they are, moves by the square of what the angles are off. Where a point is off by more than is promised, its
//! condition is therefore not differentiated but measured: datum by datum and closure by closure, the 48-digit answer
//! with one rounding more and with one less.
//!
//! The largest errors of 100 000 poses each, in ulp times condition number. One pose of the coupled wheels, 2.4e-5 rad
//! from a change point, stands at 0.28 by its measured condition, at 9.67 by its differentiated one.
//!
//! | mechanism | position | velocity | acceleration | mechanism | position | velocity | acceleration |
//! |---|---|---|---|---|---|---|---|
//! | andrews                | 1.21 | 0.99 | 1.00 | cam_follower           | 0.72 | 0.68 | 0.68 |
//! | cam_rocker             | 0.57 | 0.42 | 0.42 | cardan                 | 0.39 | 0.22 | 0.27 |
//! | chebyshev              | 0.83 | 0.49 | 0.49 | coupled_wheels         | 2.06 | 1.16 | 1.89 |
//! | crank_shaper           | 0.60 | 0.69 | 0.67 | double_butterfly       | 2.76 | 2.06 | 1.92 |
//! | elliptic_trammel       | 0.32 | 0.37 | 0.45 | five_bar               | 1.02 | 0.55 | 0.51 |
//! | four_bar               | 0.89 | 0.57 | 0.60 | geared_five_bar        | 0.82 | 0.35 | 0.40 |
//! | geneva                 | 0.73 | 0.61 | 0.57 | hart                   | 0.78 | 0.54 | 0.48 |
//! | hoecken                | 1.15 | 0.52 | 0.46 | inverted_slider_crank  | 1.47 | 0.75 | 0.70 |
//! | jansen                 | 1.08 | 0.61 | 0.55 | klann                  | 0.49 | 0.54 | 0.48 |
//! | offset_slider_crank    | 0.57 | 0.39 | 0.44 | pantograph             | 1.21 | 0.60 | 1.62 |
//! | peaucellier            | 1.19 | 0.59 | 0.55 | roberts                | 0.90 | 0.44 | 0.51 |
//! | scotch_yoke            | 0.25 | 0.26 | 0.31 | stephenson_i           | 0.94 | 0.57 | 0.51 |
//! | stephenson_ii          | 2.90 | 2.50 | 2.47 | stephenson_iii         | 1.01 | 0.57 | 0.49 |
//! | v_twin                 | 0.79 | 0.58 | 0.73 | watt_i                 | 1.12 | 0.57 | 0.49 |
//! | watt_ii                | 1.28 | 0.66 | 0.69 | watt_line              | 1.09 | 1.11 | 0.99 |
//! | whitworth              | 0.71 | 0.54 | 0.56 | wiper                  | 2.81 | 1.09 | 1.63 |
//!
//! ```text
//! POSES=100000 cargo test --release --all-features --test forty_digits -- --nocapture
//! ```

#[path = "source/cam_laws.rs"]
mod cam_laws;
#[path = "oracle/laws.rs"]
mod laws;
#[path = "oracle/precise.rs"]
mod precise;
mod source;
#[path = "oracle/tape.rs"]
mod tape;

use linkage_compiler::derivation::{Coordinate, Derivation};
use linkage_compiler::graph::{External, NodeId, Number, SymbolId};
use linkage_compiler::model::{Kind, Mechanism};
use nalgebra::{DMatrix, DVector};
use precise::{Big, Scalar, big, direction};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};
use tape::Tape;

/// The promise: ulp times condition number.
const ULPS: f64 = 8.0;

/// Poses of each mechanism; the full size is asked for in the environment.
fn poses() -> usize {
    std::env::var("POSES").ok().and_then(|count| count.parse().ok()).unwrap_or(40)
}

/// What a pose is made from.
#[derive(Clone)]
struct Data {
    parameters: Vec<f64>,
    inputs: Vec<f64>,
    rates: Vec<f64>,
    accelerations: Vec<f64>,
    branch: usize,
    /// q with values of the unknowns to start from, q' and q'' with the inputs' alone.
    coordinates: [Vec<f64>; 3],
}

/// q, q', q'' and the points with their velocities and accelerations.
struct Motion {
    coordinates: [Vec<f64>; 3],
    points: [Vec<f64>; 3],
}

/// The closures of one mechanism with their first two derivatives in time, and the points with theirs.
struct Judge {
    mechanism: Mechanism,
    derivation: Derivation,
    /// Psi, J u' + A v', J u'' + A v'' + gamma: for changing u, u', u''.
    closures: [Tape; 3],
    /// J by rows.
    jacobian: Tape,
    points: Tape,
    /// The derivatives of all rows of `closures` and of `points`, by every datum and then every unknown.
    derivatives: Tape,
    data: Vec<SymbolId>,
    unknowns: Vec<SymbolId>,
}

impl Judge {
    fn new(file: &str) -> Self {
        let mechanism = linkage_compiler::read(source::tokens_of(file)).expect(file).remove(0);
        let mut derivation = linkage_compiler::derive(&mechanism).remove(0);
        let parameters: Vec<SymbolId> = mechanism.parameters.iter().map(|parameter| parameter.symbol).collect();
        let d = &mut derivation;
        let symbols = |of: &[usize]| -> [Vec<SymbolId>; 3] {
            let pick =
                |symbol: fn(&Coordinate) -> SymbolId| of.iter().map(|&index| symbol(&d.coordinates[index])).collect();
            [pick(|c| c.value), pick(|c| c.rate), pick(|c| c.acceleration)]
        };
        let by_order = symbols(&d.unknowns);
        let unknowns = by_order.concat();
        let data: Vec<SymbolId> = parameters.into_iter().chain(symbols(&d.inputs).concat()).collect();
        let mut rows = d.residual.clone();
        for order in [1, 2] {
            for (index, row) in d.jacobian.clone().iter().enumerate() {
                let mut terms = Vec::new();
                for (&column, &entry) in row {
                    let coordinate = &d.coordinates[column];
                    let symbol = if order == 1 { coordinate.rate } else { coordinate.acceleration };
                    let rate = d.graph.variable(symbol);
                    terms.push((Number::ONE, d.graph.multiply(entry, rate)));
                }
                if order == 2 {
                    terms.push((Number::ONE, d.gamma[index]));
                }
                rows.push(d.graph.sum(&terms));
            }
        }
        let points: Vec<NodeId> = [0, 1, 2]
            .iter()
            .flat_map(|&order| {
                d.points.iter().flat_map(move |point| [&point.value, &point.rate, &point.acceleration][order].clone())
            })
            .collect();
        let mut derivatives = Vec::new();
        for family in [&rows, &points] {
            for &symbol in data.iter().chain(&unknowns) {
                derivatives.extend(d.graph.partial(family, symbol));
            }
        }
        let zero = d.graph.zero();
        let j: Vec<NodeId> = d
            .jacobian_unknowns()
            .iter()
            .flat_map(|row| (0..d.unknowns.len()).map(|c| row.get(&c).copied().unwrap_or(zero)).collect::<Vec<_>>())
            .collect();
        let n = d.unknowns.len();
        let closures = [0, 1, 2].map(|order| Tape::new(&d.graph, &rows[order * n..(order + 1) * n], &by_order[order]));
        let [jacobian, points, derivatives] = [j, points, derivatives].map(|roots| Tape::new(&d.graph, &roots, &[]));
        Self { closures, jacobian, points, derivatives, data, unknowns, mechanism, derivation }
    }

    fn external(&self) -> impl Fn(&External, &[f64]) -> f64 {
        |external, arguments| {
            // Values of a law are data themselves, and so is its last derivative.
            let given = external.order().map(|order| (order, laws::values(&self.mechanism, external, arguments)));
            given.and_then(|(order, values)| values.get(order).copied()).unwrap_or(0.0)
        }
    }

    fn magnitudes(&self, tape: &Tape, data: &Data, y: &[f64]) -> Vec<f64> {
        tape.magnitudes(|symbol| self.bound(data, y, symbol), self.external())
    }

    fn bound<S: Scalar>(&self, data: &Data, y: &[S], symbol: SymbolId) -> S {
        match self.unknowns.iter().position(|&other| other == symbol) {
            Some(place) => y[place].clone(),
            None => S::of(self.datum(data, symbol).expect("a datum or an unknown")),
        }
    }

    fn datum(&self, data: &Data, symbol: SymbolId) -> Option<f64> {
        let all = data.parameters.iter().chain(&data.inputs).chain(&data.rates).chain(&data.accelerations);
        self.data.iter().position(|&other| other == symbol).map(|place| *all.clone().nth(place).expect("a datum"))
    }

    fn evaluate<S: Scalar>(&self, tape: &Tape, data: &Data, y: &[S]) -> Vec<S> {
        tape.evaluate(|symbol| self.bound(data, y, symbol), self.external())
    }

    /// u, u', u'' to 40 digits, from the emitted code's, where the closures and their derivatives have these values:
    /// each residual in full, what it asks for by J^-1 in doubles, some 14 digits a time. None where they do not arrive.
    fn solve(&self, data: &Data, found: &[f64], closed_at: &[f64]) -> Option<Vec<Big>> {
        const TIMES: usize = 20;
        let n = found.len() / 3;
        let inverse = DMatrix::from_row_slice(n, n, &self.evaluate(&self.jacobian, data, found)).try_inverse()?;
        let mut y: Vec<Big> = found.iter().map(|&value| big(value)).collect();
        for (order, tape) in self.closures.iter().enumerate() {
            let (sizes, mut values) = (self.magnitudes(tape, data, found), Vec::new());
            let mut residual = || {
                let bind = |symbol| self.bound(data, &y, symbol);
                let rows = tape.evaluate_again(&mut values, bind, self.external());
                let rows = rows.iter().zip(&closed_at[order * n..]).map(|(row, &value)| (row - big(value)).double());
                let rows = DVector::from_iterator(n, rows);
                let is_solved = rows.iter().zip(&sizes).all(|(row, size)| row.abs() <= 1e-40 * size);
                for (value, step) in y[order * n..].iter_mut().zip((&inverse * rows).iter()) {
                    *value -= big(*step);
                }
                is_solved
            };
            (0..TIMES).any(|_| residual()).then_some(())?;
        }
        Some(y)
    }

    /// The condition numbers of the points, times their values, from changes by one rounding.
    fn measured_conditions(&self, data: &Data, y: &[Big], found: &[f64]) -> Option<Vec<f64>> {
        const EPSILON: f64 = f64::EPSILON;
        let rounded: Vec<f64> = y.iter().map(Scalar::double).collect();
        let exact = self.evaluate(&self.points, data, y);
        let none = vec![0.0; y.len()];
        let mut sum: Vec<f64> = self.magnitudes(&self.points, data, &rounded);
        let mut add = |changed: [(&Data, &[f64]); 2]| {
            let mut most = vec![0.0_f64; exact.len()];
            for (data, offsets) in changed {
                let points = self.evaluate(&self.points, data, &self.solve(data, found, offsets)?);
                for (most, (point, exact)) in most.iter_mut().zip(points.iter().zip(&exact)) {
                    *most = most.max((point - exact).double().abs());
                }
            }
            sum.iter_mut().zip(most).for_each(|(sum, most)| *sum += most / EPSILON);
            Some(())
        };
        for place in 0..self.data.len() {
            let [more, less] = [1.0 + EPSILON, 1.0 - EPSILON].map(|factor| {
                let mut data = data.clone();
                let Data { parameters, inputs, rates, accelerations, .. } = &mut data;
                let datum = [parameters, inputs, rates, accelerations].into_iter().flatten().nth(place);
                *datum.expect("a datum") *= factor;
                data
            });
            add([(&more, &none), (&less, &none)])?;
        }
        let terms: Vec<f64> = self.closures.iter().flat_map(|tape| self.magnitudes(tape, data, &rounded)).collect();
        for (place, size) in terms.iter().enumerate() {
            let [more, less] = [EPSILON * size, -EPSILON * size].map(|offset| {
                let mut offsets = none.clone();
                offsets[place] = offset;
                offsets
            });
            add([(data, &more), (data, &less)])?;
        }
        Some(sum)
    }

    /// The condition numbers of y and of the points, times their values.
    fn conditions(&self, data: &Data, y: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let (x, n) = (self.data.len(), self.unknowns.len());
        let flat = self.evaluate(&self.derivatives, data, y);
        let (rows, points) = flat.split_at(n * (x + n));
        let rows = DMatrix::from_column_slice(n, x + n, rows);
        let points = DMatrix::from_column_slice(points.len() / (x + n), x + n, points);
        let inverse = rows.columns(x, n).into_owned().try_inverse().expect("regular");
        let by_data = -&inverse * rows.columns(0, x);
        let sizes = data.parameters.iter().chain(&data.inputs).chain(&data.rates).chain(&data.accelerations);
        let sizes = DVector::from_iterator(x, sizes.map(|x| x.abs()));
        let terms = self.closures.iter().flat_map(|tape| self.magnitudes(tape, data, y));
        let terms = DVector::from_iterator(n, terms);
        let points_by_data = points.columns(0, x) + points.columns(x, n) * &by_data;
        let points_by_terms = points.columns(x, n) * &inverse;
        let of_points = DVector::from_vec(self.magnitudes(&self.points, data, y));
        let of_points = of_points + points_by_data.abs() * &sizes + points_by_terms.abs() * &terms;
        let of_unknowns = by_data.abs() * &sizes + inverse.abs() * &terms;
        (of_unknowns.as_slice().to_vec(), of_points.as_slice().to_vec())
    }

    /// Which parameters, and which coordinates in the order of q, are lengths.
    fn lengths(&self) -> Vec<bool> {
        let parameters = self.mechanism.parameters.iter().map(|p| match p.name.field.as_str() {
            // Numbers that multiply a length, and lengths that no vector is made of.
            "part" | "ratio" => false,
            "height" | "prime" | "roller" | "offset" | "r" => true,
            _ => p.kind == Kind::Length,
        });
        let kind = |name: &str| self.mechanism.coordinates.iter().find(|c| c.name.field == name).map(|c| c.kind);
        let coordinates =
            self.derivation.coordinates.iter().map(|c| c.name == "x" || kind(&c.name) == Some(Kind::Length));
        parameters.chain(coordinates).collect()
    }

    /// The same in another unit of length.
    fn scaled(&self, data: &Data, is_length: &[bool], scale: f64) -> Data {
        let (of_parameters, of_coordinates) = is_length.split_at(data.parameters.len());
        let times = |values: &[f64], is_length: &[bool]| -> Vec<f64> {
            values
                .iter()
                .zip(is_length)
                .map(|(value, is_length)| if *is_length { value * scale } else { *value })
                .collect()
        };
        let of_inputs: Vec<bool> = self.derivation.inputs.iter().map(|&place| of_coordinates[place]).collect();
        Data {
            parameters: times(&data.parameters, of_parameters),
            inputs: times(&data.inputs, &of_inputs),
            rates: times(&data.rates, &of_inputs),
            accelerations: times(&data.accelerations, &of_inputs),
            branch: data.branch,
            coordinates: [0, 1, 2].map(|order| times(&data.coordinates[order], of_coordinates)),
        }
    }

    fn data(&self, random: &mut SmallRng, branches: usize) -> Data {
        let mut draw =
            |count: usize, size: f64| (0..count).map(|_| random.random_range(-size..size)).collect::<Vec<_>>();
        let d = &self.derivation;
        let inputs = draw(d.inputs.len(), 3.2);
        let (rates, accelerations) = (draw(d.inputs.len(), 2.0), draw(d.inputs.len(), 5.0));
        let mut coordinates =
            [draw(d.coordinates.len(), 3.2), vec![0.0; d.coordinates.len()], vec![0.0; d.coordinates.len()]];
        for (all, given) in coordinates.iter_mut().zip([&inputs, &rates, &accelerations]) {
            for (&place, &value) in d.inputs.iter().zip(given) {
                all[place] = value;
            }
        }
        // Every other mechanism has lengths of its own.
        let is_default = random.random_bool(0.5);
        let mut scaled = |value: f64| if is_default { value } else { value * random.random_range(0.95..1.05) };
        let default = |node| self.mechanism.graph.constant_value(node).expect("a number");
        let defaults = self.mechanism.parameters.iter().map(|parameter| default(parameter.default.expect("a default")));
        let parameters = defaults.map(&mut scaled).collect();
        Data { parameters, inputs, rates, accelerations, branch: random.random_range(0..branches), coordinates }
    }
}

/// The oracle's sines, by addition, against dashu's own; each a second time from an angle nearby, as Newton's method
/// asks for them.
#[test]
fn directions_by_addition() {
    let mut random = SmallRng::seed_from_u64(3);
    for _ in 0..200 {
        let angle = big(random.random_range(-7.0..7.0)) + big(random.random_range(-1e-17..1e-17));
        let near = &angle + big(10_f64.powi(-random.random_range(9..40)) * random.random_range(-0.9..0.9));
        for angle in [angle, near] {
            let (cosine, sine) = direction(&angle);
            let (expected_sine, expected_cosine) = angle.sin_cos();
            assert!((sine - expected_sine).double().abs() < 3e-48, "sine of {angle}");
            assert!((cosine - expected_cosine).double().abs() < 3e-48, "cosine of {angle}");
        }
    }
}

/// The largest error in ulp times condition number, and where.
#[derive(Default, Clone)]
struct Worst {
    error: f64,
    place: String,
}

impl Worst {
    fn note(&mut self, found: &[f64], expected: &[Big], conditions: &[f64], place: impl Fn(usize) -> String) {
        for (index, ((&found, expected), condition)) in found.iter().zip(expected).zip(conditions).enumerate() {
            assert!(found.is_finite(), "{}", place(index));
            let size = condition.max(expected.double().abs());
            let error = (big(found) - expected).double().abs();
            let error = if error == 0.0 { 0.0 } else { error / (f64::EPSILON * size) };
            if error > self.error {
                *self = Self { error, place: place(index) };
            }
        }
    }
}

fn judge(file: &str, branches: usize, run: impl Fn(&Data) -> Option<Motion>) -> [Worst; 3] {
    let judge = Judge::new(file);
    let mut random = SmallRng::seed_from_u64(20_091_121);
    let mut worst: [Worst; 3] = Default::default();
    let (mut count, mut missed) = (0, 0);
    let (unknowns, place_of) = (&judge.derivation.unknowns, &judge.derivation.coordinates);
    while count < poses() {
        let data = judge.data(&mut random, branches);
        let Some(motion) = run(&data) else {
            missed += 1;
            assert!(missed < 50 * poses(), "{file}: hardly anything can be assembled");
            continue;
        };
        let found: Vec<f64> = motion.coordinates.iter().flat_map(|q| unknowns.iter().map(|&place| q[place])).collect();
        let Some(y) = judge.solve(&data, &found, &vec![0.0; found.len()]) else {
            panic!("{file}: nothing near {:?} closes {:?} at {:?}", motion.coordinates, data.parameters, data.inputs)
        };
        count += 1;
        let n = unknowns.len();
        let rounded: Vec<f64> = y.iter().map(Scalar::double).collect();
        let (of_unknowns, of_points) = judge.conditions(&data, &rounded);
        let points = judge.evaluate(&judge.points, &data, &y);
        let third = points.len() / 3;
        for (order, worst) in worst.iter_mut().enumerate() {
            let at =
                |what: String| format!("{what} at {:?}, branch {}, of {:?}", data.inputs, data.branch, data.parameters);
            let part = order * n..(order + 1) * n;
            worst.note(&found[part.clone()], &y[part.clone()], &of_unknowns[part], |index| {
                at(place_of[unknowns[index]].name.clone())
            });
            let part = order * third..(order + 1) * third;
            let (expected, conditions) = (&points[part.clone()], &of_points[part.clone()]);
            let of_point = |index| at(format!("point {}", index / 2 + 1));
            let mut off = Worst::default();
            off.note(&motion.points[order], expected, conditions, of_point);
            if off.error > ULPS {
                println!("{file}: {:.2} ulp x condition as differentiated, {}", off.error, off.place);
                let measured = judge.measured_conditions(&data, &y, &found).expect("positions a rounding away");
                off = Worst::default();
                off.note(&motion.points[order], expected, &measured[part], of_point);
                println!("{file}: {:.2} ulp x condition as measured, {}", off.error, off.place);
            }
            if off.error > worst.error {
                *worst = off;
            }
        }
    }
    for (order, worst) in ["position", "velocity", "acceleration"].iter().zip(&worst) {
        println!("{file:22} {order:13} {:6.2} ulp x condition: {}", worst.error, worst.place);
    }
    worst
}

/// Everything at lengths 2^k times as long has the same bits but for its exponent; angles have the same.
fn unit_of_length(file: &str, branches: usize, run: impl Fn(&Data) -> Option<Motion>) {
    let judge = Judge::new(file);
    let is_length = judge.lengths();
    let mut random = SmallRng::seed_from_u64(5);
    let mut found = 0;
    for _ in 0..200 {
        let data = judge.data(&mut random, branches);
        let Some(plain) = run(&data) else { continue };
        found += 1;
        for k in [-300, -37, -1, 2, 101, 300] {
            let scale = 2_f64.powi(k);
            let scaled = judge.scaled(&data, &is_length, scale);
            let other = run(&scaled).unwrap_or_else(|| panic!("{file} at 2^{k}: no position at {:?}", data.inputs));
            let of_coordinates = &is_length[judge.mechanism.parameters.len()..];
            for order in 0..3 {
                let pairs = plain.coordinates[order].iter().zip(&other.coordinates[order]).zip(of_coordinates);
                for ((&one, &other), &is_length) in pairs {
                    assert_eq!(if is_length { one * scale } else { one }, other, "{file} at 2^{k}, order {order}");
                }
                // The pen of the five-bar stands where numbers say, whatever the unit.
                if file == "five_bar" {
                    continue;
                }
                for (&one, &other) in plain.points[order].iter().zip(&other.points[order]) {
                    assert_eq!(one * scale, other, "{file} at 2^{k}: a point, order {order}");
                }
            }
        }
    }
    assert!(found > 10, "{file}: {found}");
}

/// One mechanism of the gallery: how its emitted code is run.
macro_rules! gallery {
    ($($file:ident $Driver:ident $Coordinates:ident $Inputs:ident $Branch:ident $Points:ident $how:ident;)*) => {$(
        mod $file {
            use linkage::linkage;
            use linkage::nalgebra::{SVector, Vector2};

            use super::{Data, Motion, ULPS, judge, unit_of_length};

            include!(concat!("mechanisms/", stringify!($file), ".rs"));

            const COORDINATES: usize = $Coordinates::<()>::NAMES.len();
            const POINTS: usize = $Points::<()>::NAMES.len();

            fn flat(points: $Points<Vector2<f64>>) -> Vec<f64> {
                let points: [Vector2<f64>; POINTS] = points.into();
                points.iter().flat_map(|point| [point.x, point.y]).collect()
            }

            fn array(q: $Coordinates<f64>) -> Vec<f64> {
                SVector::<f64, COORDINATES>::from(q).as_slice().to_vec()
            }

            fn run(data: &Data) -> Option<Motion> {
                let m = $Driver::from(std::array::from_fn(|index| data.parameters[index]));
                let q = |order: usize| $Coordinates::from(SVector::<f64, COORDINATES>::from_column_slice(&data.coordinates[order]));
                let inputs = |order: usize| $Inputs::from(&q(order));
                let pose = gallery!($how m data q inputs $Branch);
                let velocity = m.velocity(&pose, inputs(1)).ok()?;
                let acceleration = m.acceleration(&pose, &velocity, inputs(2)).ok()?;
                Some(Motion {
                    coordinates: [array(pose.coordinates()), array(velocity), array(acceleration)],
                    points: [
                        flat(m.points(&pose).ok()?),
                        flat(m.point_velocities(&pose, &velocity).ok()?),
                        flat(m.point_accelerations(&pose, &velocity, &acceleration).ok()?),
                    ],
                })
            }

            /// The unit of length changes exponents and no bit else.
            #[test]
            fn scale_free() {
                unit_of_length(stringify!($file), gallery!(branches $how $Branch), run);
            }

            #[test]
            fn eight_ulps() {
                for worst in judge(stringify!($file), gallery!(branches $how $Branch), run) {
                    assert!(worst.error <= ULPS, "{} ulp x condition: {}", worst.error, worst.place);
                }
            }
        }
    )*};
    (closed $m:ident $data:ident $q:ident $inputs:ident $Branch:ident) => {
        $m.assemble($inputs(0), $Branch::all().nth($data.branch)?).ok()?
    };
    (newton $m:ident $data:ident $q:ident $inputs:ident $Branch:ident) => {
        $m.pose_at(&$m.solve(&$q(0)).ok()?.coordinates)
    };
    (branches closed $Branch:ident) => { $Branch::all().count() };
    (branches newton $Branch:ident) => { 1 };
}

gallery! {
    andrews Andrews AndrewsCoordinates AndrewsInputs AndrewsBranch AndrewsPoints closed;
    cam_follower CamFollower CamFollowerCoordinates CamFollowerInputs CamFollowerBranch CamFollowerPoints closed;
    cam_rocker CamRocker CamRockerCoordinates CamRockerInputs CamRockerBranch CamRockerPoints closed;
    cardan Cardan CardanCoordinates CardanInputs CardanBranch CardanPoints closed;
    chebyshev ChebyshevRocker ChebyshevCoordinates ChebyshevRockerInputs ChebyshevRockerBranch ChebyshevPoints closed;
    coupled_wheels CoupledWheels CoupledWheelsCoordinates CoupledWheelsInputs CoupledWheelsBranch CoupledWheelsPoints closed;
    crank_shaper CrankShaper CrankShaperCoordinates CrankShaperInputs CrankShaperBranch CrankShaperPoints closed;
    double_butterfly DoubleButterfly DoubleButterflyCoordinates DoubleButterflyInputs DoubleButterflyBranch DoubleButterflyPoints newton;
    elliptic_trammel EllipticTrammel EllipticTrammelCoordinates EllipticTrammelInputs EllipticTrammelBranch EllipticTrammelPoints closed;
    five_bar FiveBar FiveBarCoordinates FiveBarInputs FiveBarBranch FiveBarPoints closed;
    four_bar FourBar FourBarCoordinates FourBarInputs FourBarBranch FourBarPoints closed;
    geared_five_bar GearedFiveBar GearedFiveBarCoordinates GearedFiveBarInputs GearedFiveBarBranch GearedFiveBarPoints closed;
    geneva Geneva GenevaCoordinates GenevaInputs GenevaBranch GenevaPoints closed;
    hart Hart HartCoordinates HartInputs HartBranch HartPoints closed;
    hoecken Hoecken HoeckenCoordinates HoeckenInputs HoeckenBranch HoeckenPoints closed;
    inverted_slider_crank InvertedSliderCrank InvertedSliderCrankCoordinates InvertedSliderCrankInputs InvertedSliderCrankBranch InvertedSliderCrankPoints closed;
    jansen Jansen JansenCoordinates JansenInputs JansenBranch JansenPoints closed;
    klann Klann KlannCoordinates KlannInputs KlannBranch KlannPoints closed;
    offset_slider_crank OffsetSliderCrank OffsetSliderCrankCoordinates OffsetSliderCrankInputs OffsetSliderCrankBranch OffsetSliderCrankPoints closed;
    pantograph Pantograph PantographCoordinates PantographInputs PantographBranch PantographPoints closed;
    peaucellier Peaucellier PeaucellierCoordinates PeaucellierInputs PeaucellierBranch PeaucellierPoints closed;
    roberts Roberts RobertsCoordinates RobertsInputs RobertsBranch RobertsPoints closed;
    scotch_yoke ScotchYoke ScotchYokeCoordinates ScotchYokeInputs ScotchYokeBranch ScotchYokePoints closed;
    stephenson_i StephensonI StephensonICoordinates StephensonIInputs StephensonIBranch StephensonIPoints closed;
    stephenson_ii StephensonII StephensonIICoordinates StephensonIIInputs StephensonIIBranch StephensonIIPoints newton;
    stephenson_iii StephensonIII StephensonIIICoordinates StephensonIIIInputs StephensonIIIBranch StephensonIIIPoints closed;
    v_twin VTwin VTwinCoordinates VTwinInputs VTwinBranch VTwinPoints closed;
    watt_i WattI WattICoordinates WattIInputs WattIBranch WattIPoints closed;
    watt_ii WattII WattIICoordinates WattIIInputs WattIIBranch WattIIPoints closed;
    watt_line WattLine WattLineCoordinates WattLineInputs WattLineBranch WattLinePoints closed;
    whitworth Whitworth WhitworthCoordinates WhitworthInputs WhitworthBranch WhitworthPoints closed;
    wiper Wiper WiperCoordinates WiperInputs WiperBranch WiperPoints closed;
}
