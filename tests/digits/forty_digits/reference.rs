//! One mechanism in 48 digits: its constraints solved, and its condition numbers.

use linkage_compiler::derivation::{Coordinate, Derivation};
use linkage_compiler::graph::{External, NodeId, Number, SymbolId};
use linkage_compiler::ids::{ColumnId, Id};
use linkage_compiler::model::Mechanism;
use linkage_gallery::listed::Listed;
use linkage_gallery::source;
use linkage_oracle::laws;
use linkage_oracle::precise::{Big, Scalar, big, direction};
use linkage_oracle::tape::Tape;
use nalgebra::{DMatrix, DVector};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use super::dimensions;

/// The data of a pose.
#[derive(Clone)]
pub(super) struct Data {
    pub(super) parameters: Vec<f64>,
    pub(super) inputs: Vec<f64>,
    pub(super) rates: Vec<f64>,
    pub(super) accelerations: Vec<f64>,
    pub(super) branch: usize,
    /// q with start values of the unknowns, q' and q'' with the inputs' alone.
    pub(super) coordinates: [Vec<f64>; 3],
}

/// q, q', q'' and the points with their velocities and accelerations.
pub(super) struct Motion {
    pub(super) coordinates: [Vec<f64>; 3],
    pub(super) points: [Vec<f64>; 3],
}

/// The constraints of one mechanism with their first two derivatives in time, and the points with theirs.
pub(super) struct Reference {
    pub(super) mechanism: Mechanism,
    pub(super) derivation: Derivation,
    /// Psi, J u' + A v', J u'' + A v'' + gamma: for changing u, u', u''.
    pub(super) constraints: [Tape; 3],
    /// J by rows.
    pub(super) jacobian: Tape,
    pub(super) points: Tape,
    /// The derivatives of all rows of `constraints` and of `points`, by every datum and then every unknown.
    pub(super) derivatives: Tape,
    pub(super) data: Vec<SymbolId>,
    pub(super) unknowns: Vec<SymbolId>,
}

impl Reference {
    pub(super) fn new(of: &dyn Listed<f64>) -> Self {
        let (file, name) = (of.file(), of.name());
        let mechanism = linkage_compiler::read(source::tokens_of(file)).expect(file).remove(0);
        let driver = mechanism.drivers.iter().position(|driver| driver.name == name).expect(name);
        let mut derivation = linkage_compiler::derive(&mechanism).remove(driver);
        let parameters: Vec<SymbolId> = mechanism.parameters.iter().map(|parameter| parameter.symbol).collect();
        let d = &mut derivation;
        let symbols = |of: &[ColumnId]| -> [Vec<SymbolId>; 3] {
            let pick =
                |symbol: fn(&Coordinate) -> SymbolId| of.iter().map(|&index| symbol(&d.coordinates[index])).collect();
            [pick(|c| c.value), pick(|c| c.rate), pick(|c| c.acceleration)]
        };
        let by_order = symbols(&d.unknowns);
        let unknowns = by_order.concat();
        let data: Vec<SymbolId> = parameters.into_iter().chain(symbols(&d.inputs).concat()).collect();
        let mut rows = d.residual.to_vec();
        for order in [1, 2] {
            for (index, row) in d.jacobian.clone().enumerated() {
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
            .flat_map(|row| d.unknowns.ids().map(|c| row.get(&c).copied().unwrap_or(zero)).collect::<Vec<_>>())
            .collect();
        let n = d.unknowns.len();
        let constraints =
            [0, 1, 2].map(|order| Tape::new(&d.graph, &rows[order * n..(order + 1) * n], &by_order[order]));
        let [jacobian, points, derivatives] = [j, points, derivatives].map(|roots| Tape::new(&d.graph, &roots, &[]));
        Self { constraints, jacobian, points, derivatives, data, unknowns, mechanism, derivation }
    }

    pub(super) fn external(&self) -> impl Fn(&External, &[f64]) -> f64 {
        |external, arguments| {
            // Values of a law are data themselves, and so is its last derivative.
            let given = external.order().map(|order| (order, laws::values(&self.mechanism, external, arguments)));
            given.and_then(|(order, values)| values.get(order).copied()).unwrap_or(0.0)
        }
    }

    pub(super) fn magnitudes(&self, tape: &Tape, data: &Data, y: &[f64]) -> Vec<f64> {
        tape.magnitudes(|symbol| self.bound(data, y, symbol), self.external())
    }

    pub(super) fn bound<S: Scalar>(&self, data: &Data, y: &[S], symbol: SymbolId) -> S {
        match self.unknowns.iter().position(|&other| other == symbol) {
            Some(place) => y[place].clone(),
            None => S::of(self.datum(data, symbol).expect("a datum or an unknown")),
        }
    }

    pub(super) fn datum(&self, data: &Data, symbol: SymbolId) -> Option<f64> {
        let all = data.parameters.iter().chain(&data.inputs).chain(&data.rates).chain(&data.accelerations);
        self.data.iter().position(|&other| other == symbol).map(|place| *all.clone().nth(place).expect("a datum"))
    }

    pub(super) fn evaluate<S: Scalar>(&self, tape: &Tape, data: &Data, y: &[S]) -> Vec<S> {
        tape.evaluate(|symbol| self.bound(data, y, symbol), self.external())
    }

    /// u, u', u'' to 40 digits, from the emitted code's, where the constraints and their derivatives have these values:
    /// each residual in full, its correction by J^-1 in doubles, some 14 digits a step. None if it does not converge.
    pub(super) fn solve(&self, data: &Data, found: &[f64], closed_at: &[f64]) -> Option<Vec<Big>> {
        const TIMES: usize = 20;
        let n = found.len() / 3;
        let inverse = DMatrix::from_row_slice(n, n, &self.evaluate(&self.jacobian, data, found)).try_inverse()?;
        let mut y: Vec<Big> = found.iter().map(|&value| big(value)).collect();
        for (order, tape) in self.constraints.iter().enumerate() {
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

    /// The condition numbers of the points, times their values, from changes by one ulp.
    pub(super) fn measured_conditions(&self, data: &Data, y: &[Big], found: &[f64]) -> Option<Vec<f64>> {
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
        let terms: Vec<f64> = self.constraints.iter().flat_map(|tape| self.magnitudes(tape, data, &rounded)).collect();
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
    pub(super) fn conditions(&self, data: &Data, y: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let (x, n) = (self.data.len(), self.unknowns.len());
        let flat = self.evaluate(&self.derivatives, data, y);
        let (rows, points) = flat.split_at(n * (x + n));
        let rows = DMatrix::from_column_slice(n, x + n, rows);
        let points = DMatrix::from_column_slice(points.len() / (x + n), x + n, points);
        let inverse = rows.columns(x, n).into_owned().try_inverse().expect("regular");
        let by_data = -&inverse * rows.columns(0, x);
        let sizes = data.parameters.iter().chain(&data.inputs).chain(&data.rates).chain(&data.accelerations);
        let sizes = DVector::from_iterator(x, sizes.map(|x| x.abs()));
        let terms = self.constraints.iter().flat_map(|tape| self.magnitudes(tape, data, y));
        let terms = DVector::from_iterator(n, terms);
        let points_by_data = points.columns(0, x) + points.columns(x, n) * &by_data;
        let points_by_terms = points.columns(x, n) * &inverse;
        let of_points = DVector::from_vec(self.magnitudes(&self.points, data, y));
        let of_points = of_points + points_by_data.abs() * &sizes + points_by_terms.abs() * &terms;
        let of_unknowns = by_data.abs() * &sizes + inverse.abs() * &terms;
        (of_unknowns.as_slice().to_vec(), of_points.as_slice().to_vec())
    }

    /// The length exponents of the parameters and of the coordinates in the order of q, with or without the points;
    /// None if a length is written as a number.
    pub(super) fn powers_of_length(&self, with_points: bool) -> Option<Vec<f64>> {
        let d = &self.derivation;
        let points = d.points.iter().filter(|_| with_points).flat_map(|point| point.value.clone());
        let powers = dimensions::powers_of_length(&self.mechanism, d, &points.collect::<Vec<_>>())?;
        let parameters = self.mechanism.parameters.iter().map(|parameter| parameter.symbol);
        let symbols = parameters.chain(d.coordinates.iter().map(|coordinate| coordinate.value));
        Some(symbols.map(|symbol| powers.get(&symbol).copied().unwrap_or(0.0)).collect())
    }

    /// The data in another unit of length.
    pub(super) fn scaled(&self, data: &Data, powers: &[f64], scale: f64) -> Data {
        let (of_parameters, of_coordinates) = powers.split_at(data.parameters.len());
        let times = |values: &[f64], powers: &[f64]| -> Vec<f64> {
            values.iter().zip(powers).map(|(value, &power)| value * scale.powf(power)).collect()
        };
        let of_inputs: Vec<f64> = self.derivation.inputs.iter().map(|&place| of_coordinates[place.index()]).collect();
        Data {
            parameters: times(&data.parameters, of_parameters),
            inputs: times(&data.inputs, &of_inputs),
            rates: times(&data.rates, &of_inputs),
            accelerations: times(&data.accelerations, &of_inputs),
            branch: data.branch,
            coordinates: [0, 1, 2].map(|order| times(&data.coordinates[order], of_coordinates)),
        }
    }

    /// |det J| relative to the product of the norms of its columns.
    pub(super) fn regularity(&self, data: &Data, found: &[f64]) -> f64 {
        let n = found.len() / 3;
        let j = DMatrix::from_row_slice(n, n, &self.evaluate(&self.jacobian, data, found));
        j.determinant().abs() / j.column_iter().map(|column| column.norm()).product::<f64>()
    }

    pub(super) fn data(&self, random: &mut SmallRng, branches: usize) -> Data {
        let mut draw =
            |count: usize, size: f64| (0..count).map(|_| random.random_range(-size..size)).collect::<Vec<_>>();
        let d = &self.derivation;
        let inputs = draw(d.inputs.len(), 3.2);
        let (rates, accelerations) = (draw(d.inputs.len(), 2.0), draw(d.inputs.len(), 5.0));
        let mut coordinates =
            [draw(d.coordinates.len(), 3.2), vec![0.0; d.coordinates.len()], vec![0.0; d.coordinates.len()]];
        for (all, given) in coordinates.iter_mut().zip([&inputs, &rates, &accelerations]) {
            for (&place, &value) in d.inputs.iter().zip(given) {
                all[place.index()] = value;
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
