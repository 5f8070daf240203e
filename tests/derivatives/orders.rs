//! Jerk, derivatives of the velocity ratios and sensitivities against dual numbers at random poses: with the solutions
//! inserted, the differentiated constraints have no residual. And against finite differences with so many digits that
//! their cancellation does not matter.
//!
//! `MECHANISM=jansen cargo test --test derivatives orders` checks one mechanism, by its file or its name.

use linkage_compiler::ids::Id;
use linkage_gallery::checks::each;
use linkage_gallery::listed::{ListedWithOrders, Values, same_as, values_with_orders_of, with_orders};
use linkage_oracle::{Oracle, Sample, all_close, close};
use nalgebra::{DMatrix, DVector};
use num_dual::{Dual3_64, Dual64, HyperDual64};

/// By finite differences in 90-digit arithmetic, from constraints written by hand: see `oracle/orders.py`.
const DIFFERENCES: &str = include_str!("../oracle/orders.json");

/// Poses per mechanism.
const POSES: usize = 200;

/// Relative error of one formula against another.
const TOLERANCE: f64 = 1e-12;

/// Any jerks: the accelerations of other coordinates.
fn jerks(sample: &Sample) -> Vec<f64> {
    let all = &sample.accelerations;
    (0..all.len()).map(|index| -2.0 * all[(index + 1) % all.len()]).collect()
}

fn pick<I: Id>(q: &[f64], columns: &[I]) -> Vec<f64> {
    columns.iter().map(|column| q[column.index()]).collect()
}

/// Residuals are compared with the scale of the terms that they are the sum of.
fn is_zero(what: &str, residual: &[f64], scale: f64) {
    all_close(what, residual, &vec![0.0; residual.len()], scale, TOLERANCE);
}

/// Psi''' = 0 with the jerks of the unknowns, and the jerks of points and outputs along any q(t).
#[test]
fn jerk_closes_to_third_order() {
    let duals = values_with_orders_of();
    each(with_orders(), |of| jerk_closes_to_third_order_of(of, same_as(&duals, of)));
}

fn jerk_closes_to_third_order_of(of: &dyn ListedWithOrders<f64>, dual: &dyn Values<Dual3_64>) {
    let oracle = Oracle::of(of);
    let d = &oracle.derivation;
    let regular = oracle.at_samples(POSES, |_, sample| {
        let Sample { parameters, q, rates, accelerations, .. } = sample;
        let pose = of.at(parameters, q);
        let given = jerks(sample);

        let constants: Vec<_> = parameters.iter().copied().map(Dual3_64::from_re).collect();
        let along = |jerk: &[f64]| {
            let q: Vec<_> = (0..q.len()).map(|i| Dual3_64::new(q[i], rates[i], accelerations[i], jerk[i])).collect();
            q
        };
        let moving = along(&given);
        let found = pose.point_jerks([rates, accelerations, &given]).unwrap();
        let expected = dual.points(&constants, &moving).unwrap();
        for (found, expected) in found.chunks(2).zip(expected.chunks(2)) {
            all_close("point jerk", found, &[expected[0].v3, expected[1].v3], 0.0, TOLERANCE);
        }
        let found = pose.output_jerks([rates, accelerations, &given]).unwrap();
        for (found, Dual3_64 { v1, v2, v3, .. }) in found.into_iter().zip(dual.outputs(&constants, &moving).unwrap()) {
            let scale = v3.abs() + (v1 * v2).abs() + v1.abs().powi(3) + 0.01;
            close("output jerk", found, v3, TOLERANCE * scale);
        }

        let inputs = pick(&given, &d.inputs);
        let Ok(jerk) = pose.jerk(rates, accelerations, &inputs) else { return false };
        assert_eq!(pick(&jerk, &d.inputs), inputs);
        let third =
            |jerk: &[f64]| -> Vec<f64> { dual.residual(&constants, &along(jerk)).iter().map(|psi| psi.v3).collect() };
        let eta = third(&vec![0.0; q.len()]);
        let norm = |list: &[f64]| DVector::from_row_slice(list).norm();
        is_zero("Psi'''", &third(&jerk), pose.jacobian().norm() * norm(&jerk) + norm(&eta));
        let interpreted = oracle.values(sample, d.eta.as_ref().unwrap());
        all_close("eta", &eta, &interpreted, 0.0, TOLERANCE);
        true
    });
    most_are_regular(&regular);
}

/// J L_jk + gamma(w_j, w_k) = 0 with the second derivatives L of the unknowns, those of points and outputs, and
/// u'' = W v'' + v' . L v'.
#[test]
fn ratio_derivatives_close_to_second_order() {
    let duals = values_with_orders_of();
    each(with_orders(), |of| ratio_derivatives_close_to_second_order_of(of, same_as(&duals, of)));
}

fn ratio_derivatives_close_to_second_order_of(of: &dyn ListedWithOrders<f64>, dual: &dyn Values<HyperDual64>) {
    let oracle = Oracle::of(of);
    let d = &oracle.derivation;
    let regular = oracle.at_samples(POSES, |_, sample| {
        let Sample { parameters, q, rates, .. } = sample;
        let pose = of.at(parameters, q);
        let Ok(w) = pose.velocity_ratios() else { return false };
        let l = pose.velocity_ratio_derivatives().unwrap();
        let points = pose.point_ratio_derivatives().unwrap();
        let outputs = pose.output_ratio_derivatives().unwrap();
        let constants: Vec<_> = parameters.iter().copied().map(HyperDual64::from_re).collect();
        let j = oracle.matrix(sample, &d.jacobian_unknowns(), d.unknowns.len());
        // The rates of all coordinates for a unit rate of one input.
        let unit = |place: usize, input: usize| match d.unknowns.iter().position(|u| u.index() == place) {
            Some(unknown) => w[(unknown, input)],
            None => f64::from(u8::from(d.inputs.iter().position(|v| v.index() == place) == Some(input))),
        };
        let curved = |place: usize, row: usize, column: usize| {
            d.unknowns.iter().position(|u| u.index() == place).map_or(0.0, |unknown| l[unknown][(row, column)])
        };
        for (row, column) in (0..w.ncols()).flat_map(|row| (0..w.ncols()).map(move |column| (row, column))) {
            let along = |bent: f64| {
                let q: Vec<_> = (0..q.len())
                    .map(|i| HyperDual64::new(q[i], unit(i, row), unit(i, column), bent * curved(i, row, column)))
                    .collect();
                q
            };
            let second = |bent: f64| -> DVector<f64> {
                DVector::from_iterator(
                    j.nrows(),
                    dual.residual(&constants, &along(bent)).iter().map(|psi| psi.eps1eps2),
                )
            };
            let curvature: f64 = l.iter().map(|l| l[(row, column)].powi(2)).sum();
            let scale = j.norm() * curvature.sqrt() + second(0.0).norm();
            is_zero("J L_jk + gamma(w_j, w_k)", second(1.0).as_slice(), scale);

            let moving = along(1.0);
            for (found, expected) in points.chunks(2).zip(dual.points(&constants, &moving).unwrap().chunks(2)) {
                let found = [found[0][(row, column)], found[1][(row, column)]];
                let scale = 10.0 * (1.0 + curvature.sqrt() + w.norm_squared());
                let expected = [expected[0].eps1eps2, expected[1].eps1eps2];
                all_close("point ratio derivatives", &found, &expected, scale, TOLERANCE);
            }
            for (found, expected) in outputs.iter().zip(dual.outputs(&constants, &moving).unwrap()) {
                let product = expected.eps1.abs() * expected.eps2.abs();
                let scale = 1.0 + expected.eps1eps2.abs() + product + curvature.sqrt() + w.norm_squared();
                close("output ratio derivatives", found[(row, column)], expected.eps1eps2, TOLERANCE * scale);
            }
        }

        let v1 = DVector::from_vec(pick(rates, &d.inputs));
        let v2 = DVector::from_vec(pick(&jerks(sample), &d.inputs));
        let velocity = pose.velocity(v1.as_slice()).unwrap();
        let acceleration = pose.acceleration(&velocity, v2.as_slice()).unwrap();
        let a = oracle.matrix(sample, &d.jacobian_inputs(), d.inputs.len());
        let inverse = j.clone().try_inverse().unwrap().norm();
        let gamma = DVector::from_vec(pose.gamma(&velocity)).norm();
        // Both sides solve with J: the scale holds its condition number.
        let scale = inverse * (gamma + a.norm() * v2.norm()) * inverse * j.norm();
        for (unknown, place) in d.unknowns.iter().enumerate() {
            let found = w.row(unknown).transpose().dot(&v2) + v1.dot(&(&l[unknown] * &v1));
            close("W v'' + v' L v'", found, acceleration[place.index()], TOLERANCE * scale);
        }
        true
    });
    most_are_regular(&regular);
}

/// J du/dp + Psi_p = 0 for each parameter, and the derivatives of points and outputs.
#[test]
fn sensitivities_close_to_first_order() {
    let duals = values_with_orders_of();
    each(with_orders(), |of| sensitivities_close_to_first_order_of(of, same_as(&duals, of)));
}

fn sensitivities_close_to_first_order_of(of: &dyn ListedWithOrders<f64>, dual: &dyn Values<Dual64>) {
    let oracle = Oracle::of(of);
    let d = &oracle.derivation;
    let regular = oracle.at_samples(POSES, |_, sample| {
        let Sample { parameters, q, .. } = sample;
        let pose = of.at(parameters, q);
        let Ok(s) = pose.sensitivity() else { return false };
        let j = oracle.matrix(sample, &d.jacobian_unknowns(), d.unknowns.len());
        let points = pose.point_sensitivities().unwrap();
        let outputs = pose.output_sensitivities().unwrap();
        let by_parameters = &d.sensitivity.as_ref().unwrap().jacobian;
        let interpreted: DMatrix<f64> = oracle.matrix(sample, by_parameters, parameters.len());
        for p in 0..parameters.len() {
            let unit = |index| f64::from(u8::from(index == p));
            let constants: Vec<_> = parameters.iter().enumerate().map(|(i, &x)| Dual64::new(x, unit(i))).collect();
            let along = |follow: f64| {
                let rate = |i| d.unknowns.iter().position(|u| u.index() == i).map_or(0.0, |u| follow * s[(u, p)]);
                let q: Vec<_> = (0..q.len()).map(|i| Dual64::new(q[i], rate(i))).collect();
                q
            };
            let first = |follow: f64| -> Vec<f64> {
                dual.residual(&constants, &along(follow)).iter().map(|psi| psi.eps).collect()
            };
            let direct = first(0.0);
            let scale = j.norm() * s.column(p).norm() + DVector::from_row_slice(&direct).norm();
            is_zero("J du/dp + Psi_p", &first(1.0), scale);
            all_close("Psi_p", &direct, interpreted.column(p).as_slice(), 0.0, TOLERANCE);

            let following = along(1.0);
            for (found, expected) in points.iter().zip(dual.points(&constants, &following).unwrap().chunks(2)) {
                let scale = 10.0 * (1.0 + s.column(p).norm());
                let expected = [expected[0].eps, expected[1].eps];
                all_close("point sensitivities", &[found[(0, p)], found[(1, p)]], &expected, scale, TOLERANCE);
            }
            for (found, expected) in outputs.iter().zip(dual.outputs(&constants, &following).unwrap()) {
                let scale = 1.0 + expected.eps.abs() + s.column(p).norm();
                close("output sensitivities", found[p], expected.eps, TOLERANCE * scale);
            }
        }
        true
    });
    most_are_regular(&regular);
}

/// Singular poses have nothing to compare.
fn most_are_regular(regular: &[bool]) {
    let regular = regular.iter().filter(|is_regular| **is_regular).count();
    assert!(regular > POSES / 2, "{regular} regular poses");
}

/// All derivatives at one pose against finite differences.
fn finite_differences(of: &dyn ListedWithOrders<f64>, case: &serde_json::Value) {
    let numbers = |list: &serde_json::Value| -> Vec<f64> {
        list.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
    };
    let rows = |name: &str| -> Vec<Vec<f64>> { case[name].as_array().unwrap().iter().map(numbers).collect() };
    let all = |of_unknowns: &str, of_inputs: &str| [numbers(&case[of_unknowns]), numbers(&case[of_inputs])].concat();
    let parameters = numbers(&case["parameters"]);
    let given = all("unknowns", "inputs");
    let q = of.with_parameters(&parameters).solved(&given).unwrap();
    all_close("position", &q, &given, 0.0, TOLERANCE);
    let pose = of.at(&parameters, &q);

    let velocity = pose.velocity(&numbers(&case["input_rates"])).unwrap();
    all_close("velocity", &velocity, &all("rates", "input_rates"), 0.0, TOLERANCE);
    let acceleration = pose.acceleration(&velocity, &numbers(&case["input_accelerations"])).unwrap();
    all_close("acceleration", &acceleration, &all("accelerations", "input_accelerations"), 0.0, TOLERANCE);
    let jerk = pose.jerk(&velocity, &acceleration, &numbers(&case["input_jerks"])).unwrap();
    let order: [&[f64]; 3] = [&velocity, &acceleration, &jerk];
    let (points, outputs) = (pose.point_jerks(order).unwrap(), pose.output_jerks(order).unwrap());
    let unknowns = numbers(&case["unknowns"]).len();
    same("jerk", &jerk[..unknowns], &points, &outputs, &numbers(&case["jerks"]));

    let entry = |matrices: &[DMatrix<f64>], pair: usize| -> Vec<f64> {
        matrices.iter().map(|matrix| matrix.as_slice()[pair]).collect()
    };
    let ratios = pose.velocity_ratio_derivatives().unwrap();
    let points = pose.point_ratio_derivatives().unwrap();
    let outputs = pose.output_ratio_derivatives().unwrap();
    for (pair, expected) in rows("by_inputs").iter().enumerate() {
        same("d2/dv dv", &entry(&ratios, pair), &entry(&points, pair), &entry(&outputs, pair), expected);
    }

    let column = |matrix: &DMatrix<f64>, p: usize| matrix.column(p).as_slice().to_vec();
    let unknowns = pose.sensitivity().unwrap();
    let points = pose.point_sensitivities().unwrap();
    let outputs = pose.output_sensitivities().unwrap();
    for (p, expected) in rows("by_parameters").iter().enumerate() {
        let [points, outputs] =
            [&points, &outputs].map(|all| all.iter().flat_map(|matrix| column(matrix, p)).collect::<Vec<_>>());
        same("d/dp", &column(&unknowns, p), &points, &outputs, expected);
    }
}

/// Unknowns and points relative to the largest of them, outputs one by one.
fn same(what: &str, unknowns: &[f64], points: &[f64], outputs: &[f64], expected: &[f64]) {
    let (expected, of_outputs) = expected.split_at(expected.len() - outputs.len());
    let (of_unknowns, of_points) = expected.split_at(unknowns.len());
    all_close(what, unknowns, of_unknowns, 0.0, TOLERANCE);
    all_close(&format!("{what} of points"), points, of_points, 0.0, TOLERANCE);
    for (output, expected) in outputs.iter().zip(of_outputs) {
        close(format_args!("{what} of an output"), *output, *expected, TOLERANCE * expected.abs().max(0.01));
    }
}

#[test]
fn derivatives_are_finite_differences() {
    let cases: Vec<serde_json::Value> = serde_json::from_str(DIFFERENCES).unwrap();
    let case = |of: &dyn ListedWithOrders<f64>| cases.iter().find(|case| case["mechanism"] == of.file());
    let compared: Vec<_> = with_orders().iter().copied().filter(|of| case(*of).is_some()).collect();
    assert_eq!(compared.len(), cases.len());
    each(&compared, |of| finite_differences(of, case(of).unwrap()));
}
