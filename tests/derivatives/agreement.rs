//! Two independent ways to every number, at random poses of every mechanism of the gallery: the compiler's interpreter
//! against the emitted code, and the emitted derivatives against dual numbers.
//!
//! ```text
//! POSES=1000 cargo test --test derivatives agreement            this many poses of each mechanism
//! MECHANISM=four_bar cargo test --test derivatives agreement    one mechanism, by its file or its name
//! ```

use linkage_compiler::derivation::Quantity;
use linkage_compiler::graph::NodeId;
use linkage_compiler::ids::{ColumnId, Id};
use linkage_gallery::checks::each;
use linkage_gallery::listed::{Listed, Motion, Values, all, same_as, values_of};
use linkage_gallery::source;
use linkage_oracle::{Oracle, Sample, all_close, close};
use nalgebra::{DMatrix, DVector, Dyn};
use num_dual::{Dual2_64, Dual64};

/// Relative error of one formula against another.
const TOLERANCE: f64 = 1e-12;

/// Poses per mechanism.
fn poses() -> usize {
    linkage_trials::count("POSES", 40, 200)
}

/// The expressions of quantities and of their first and second derivative.
fn orders(quantities: &[Quantity]) -> [Vec<NodeId>; 3] {
    let parts: [fn(&Quantity) -> &Vec<NodeId>; 3] = [|q| &q.value, |q| &q.rate, |q| &q.acceleration];
    parts.map(|part| quantities.iter().flat_map(part).copied().collect())
}

/// The entries of the coordinates in these columns.
fn pick(q: &[f64], columns: &[ColumnId]) -> DVector<f64> {
    DVector::from_iterator(columns.len(), columns.iter().map(|column| q[column.index()]))
}

/// The largest magnitude of a list.
fn largest(list: &[f64]) -> f64 {
    list.iter().fold(0.0, |most, value| most.max(value.abs()))
}

/// Compares each output with itself: outputs may differ by orders of magnitude.
fn each_close(what: &str, found: &[f64], expected: &[f64], scale: impl Fn(usize) -> f64) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (index, (&found, &expected)) in found.iter().zip(expected).enumerate() {
        close(format_args!("{what}[{index}]"), found, expected, TOLERANCE * scale(index));
    }
}

/// The emitted functions at given coordinates, rates and accelerations give the values of the derived expressions.
#[test]
fn emitted_is_interpreted() {
    each(all(), emitted_is_interpreted_of);
}

fn emitted_is_interpreted_of(of: &dyn Listed<f64>) {
    let oracle = Oracle::of(of);
    let d = &oracle.derivation;
    let (j_rows, a_rows) = (d.jacobian_unknowns(), d.jacobian_inputs());
    oracle.at_samples(poses(), |_, sample| {
        let Sample { parameters, q, rates, accelerations, .. } = sample;
        let m = of.with_parameters(parameters);
        let pose = m.pose(q);
        let same = |what: &str, found: &[f64], nodes: &[NodeId], scale: f64| {
            all_close(what, found, &oracle.values(sample, nodes), scale, TOLERANCE);
        };

        let scales = pose.residual_scales();
        same("scales", &scales, &d.residual_scales, 0.0);
        same("residual", &pose.residual(), &d.residual, largest(&scales));
        same("gamma", &pose.gamma(rates), &d.gamma, 0.0);
        let full = oracle.matrix(sample, &d.jacobian, d.coordinates.len());
        all_close("jacobian", pose.jacobian().as_slice(), full.as_slice(), 0.0, TOLERANCE);
        let j = oracle.matrix(sample, &j_rows, d.unknowns.len());
        all_close("J", pose.jacobian_unknowns().as_slice(), j.as_slice(), 0.0, TOLERANCE);
        let a = oracle.matrix(sample, &a_rows, d.inputs.len());
        all_close("A", pose.jacobian_inputs().as_slice(), a.as_slice(), 0.0, TOLERANCE);
        // The simplified determinant against that of the matrix.
        let scale: f64 = j.column_iter().map(|column| column.norm()).product();
        close("determinant", pose.determinant(), j.determinant(), TOLERANCE * scale);

        let [value, rate, acceleration] = orders(&d.points);
        same("points", &pose.points().unwrap(), &value, 0.0);
        same("point velocities", &pose.point_velocities(rates).unwrap(), &rate, 0.0);
        same("point accelerations", &pose.point_accelerations(rates, accelerations).unwrap(), &acceleration, 0.0);
        let found = [
            pose.outputs().unwrap(),
            pose.output_rates(rates).unwrap(),
            pose.output_accelerations(rates, accelerations).unwrap(),
        ];
        for (found, nodes) in found.iter().zip(orders(&d.outputs)) {
            let expected = oracle.values(sample, &nodes);
            each_close("outputs", found, &expected, |index| expected[index].abs().max(0.01));
        }
    });
}

/// Solutions of linear systems are compared by their residuals, which do not depend on how near the sample is to a
/// singular pose.
#[test]
fn solutions_have_no_residual() {
    each(all(), solutions_have_no_residual_of);
}

fn solutions_have_no_residual_of(of: &dyn Listed<f64>) {
    let oracle = Oracle::of(of);
    let d = &oracle.derivation;
    let (j_rows, a_rows) = (d.jacobian_unknowns(), d.jacobian_inputs());
    let regular = oracle.at_samples(poses(), |_, sample| {
        let Sample { parameters, q, rates, accelerations, .. } = sample;
        let m = of.with_parameters(parameters);
        let pose = m.pose(q);
        let Ok(w) = pose.velocity_ratios() else { return false };
        let j = oracle.matrix(sample, &j_rows, d.unknowns.len());
        let a = oracle.matrix(sample, &a_rows, d.inputs.len());
        let is_zero = |what: &str, residual: DMatrix<f64>, scale: f64| {
            all_close(what, residual.as_slice(), &vec![0.0; residual.len()], scale, TOLERANCE);
        };
        is_zero("J W + A", &j * &w + &a, j.norm() * w.norm() + a.norm());

        let (v1, v2) = (pick(rates, &d.inputs), pick(accelerations, &d.inputs));
        let velocity = pose.velocity(v1.as_slice()).unwrap();
        let u = pick(&velocity, &d.unknowns);
        assert_eq!(pick(&velocity, &d.inputs), v1);
        let scale = j.norm() * u.norm() + a.norm() * v1.norm();
        is_zero("J u' + A v'", (&j * &u + &a * &v1).reshape_generic(Dyn(u.len()), Dyn(1)), scale);

        let found = pose.acceleration(rates, v2.as_slice()).unwrap();
        let u = pick(&found, &d.unknowns);
        assert_eq!(pick(&found, &d.inputs), v2);
        let gamma = DVector::from_vec(oracle.values(sample, &d.gamma));
        let scale = j.norm() * u.norm() + a.norm() * v2.norm() + gamma.norm();
        is_zero("J u'' + A v'' + gamma", (&j * &u + &a * &v2 + &gamma).reshape_generic(Dyn(u.len()), Dyn(1)), scale);

        // W_l v' is the velocity of the point, and of the output, at q' = (W v', v'). W is rounded differently on both
        // sides: the bound is that of W itself.
        let full = oracle.matrix(sample, &d.jacobian, d.coordinates.len());
        let times_v1 = |ratios: Vec<DMatrix<f64>>| -> Vec<f64> {
            ratios.iter().flat_map(|ratio| (ratio * &v1).as_slice().to_vec()).collect()
        };
        let found = times_v1(pose.point_ratios().unwrap());
        let scale = full.norm() * (w.norm() + 1.0) * 10.0;
        all_close("W of points", &found, &pose.point_velocities(&velocity).unwrap(), scale, TOLERANCE);
        let ratios = pose.output_ratios().unwrap();
        let norms: Vec<f64> = ratios.iter().map(|ratio| ratio.norm()).collect();
        let expected = pose.output_rates(&velocity).unwrap();
        let scale = |index: usize| expected[index].abs() + norms[index] * 10.0 + w.norm();
        each_close("W of outputs", &times_v1(ratios), &expected, scale);
        true
    });
    let regular = regular.into_iter().filter(|is_regular| *is_regular).count();
    assert!(regular > poses() / 2, "{regular} regular poses");
}

/// `motion` gives the results of the functions that it combines.
#[test]
fn motion_is_its_parts() {
    each(all(), motion_is_its_parts_of);
}

fn motion_is_its_parts_of(of: &dyn Listed<f64>) {
    let oracle = Oracle::of(of);
    let d = &oracle.derivation;
    oracle.at_samples(poses(), |_, sample| {
        let Sample { parameters, q, rates, accelerations, .. } = sample;
        let m = of.with_parameters(parameters);
        let pose = m.pose(q);
        let (v1, v2) = (pick(rates, &d.inputs), pick(accelerations, &d.inputs));
        let Ok(motion) = m.motion(q, v1.as_slice(), v2.as_slice()) else {
            assert!(pose.velocity_ratios().is_err(), "no motion at {q:?}");
            return;
        };
        let Motion { coordinates: [position, first, second], points, outputs } = &motion;
        assert_eq!(position, q);
        let velocity = pose.velocity(v1.as_slice()).unwrap();
        all_close("velocity", first, &velocity, 0.0, TOLERANCE);
        let expected = pose.acceleration(&velocity, v2.as_slice()).unwrap();
        all_close("acceleration", second, &expected, 0.0, 1e2 * TOLERANCE);

        let full = pose.jacobian().amax();
        all_close("points", &points[0], &pose.points().unwrap(), 0.0, TOLERANCE);
        let expected = pose.point_velocities(first).unwrap();
        all_close("point velocities", &points[1], &expected, largest(first) * full, TOLERANCE);
        let scale = largest(second) * full;
        let expected = pose.point_accelerations(first, second).unwrap();
        all_close("point accelerations", &points[2], &expected, scale, TOLERANCE);

        let expected = pose.outputs().unwrap();
        each_close("outputs", &outputs[0], &expected, |index| expected[index].abs());
        let terms = scale + first.iter().map(|rate| rate * rate).sum::<f64>();
        let expected = pose.output_rates(first).unwrap();
        each_close("output rates", &outputs[1], &expected, |index| largest(first) * full + expected[index].abs());
        let expected = pose.output_accelerations(first, second).unwrap();
        // Both add the same terms in different orders: the last bits of the terms or of the sum may differ.
        let last_bits = |index: usize| 4.0 * f64::EPSILON / TOLERANCE * expected[index].abs();
        each_close("output accelerations", &outputs[2], &expected, |index| last_bits(index).max(0.1 * terms));
    });
}

/// `kinematics` gives the results of the separate calls, determinants included; `tests/digits/forty_digits` measures the errors.
#[test]
fn kinematics_is_its_parts() {
    each(all(), kinematics_is_its_parts_of);
}

fn kinematics_is_its_parts_of(of: &dyn Listed<f64>) {
    let oracle = Oracle::of(of);
    let d = &oracle.derivation;
    let close_to = |what: &str, found: &[f64], expected: &[f64]| all_close(what, found, expected, 0.0, 1e-9);
    oracle.at_samples(poses(), |number, sample| {
        let Sample { parameters, q, rates, accelerations, .. } = sample;
        let m = of.with_parameters(parameters);
        let (v1, v2) = (pick(rates, &d.inputs), pick(accelerations, &d.inputs));
        let branch = number % of.branch_count();
        let Ok(parts) = m.moving_by_parts(q, branch, v1.as_slice(), v2.as_slice()) else { return };
        let fused = m.moving(q, branch, v1.as_slice(), v2.as_slice(), false).unwrap();
        close_to("position", &fused.pose.coordinates(), &parts.pose.coordinates());
        let [found, expected] = [&fused.pose, &parts.pose].map(|pose| pose.block_determinants());
        close_to("determinants", &found, &expected);
        close_to("rates", &fused.rates, &parts.rates);
        close_to("accelerations", &fused.accelerations, &parts.accelerations);
    });
}

/// First and second derivatives.
fn derivatives(values: &[Dual2_64]) -> [Vec<f64>; 2] {
    [values.iter().map(|x| x.v1).collect(), values.iter().map(|x| x.v2).collect()]
}

/// The emitted derivatives are those that dual numbers carry through `residual`, `points` and `outputs`.
#[test]
fn derivatives_are_dual_numbers() {
    let (one, two) = (values_of(), values_of());
    each(all(), |of| derivatives_are_dual_numbers_of(of, same_as(&one, of), same_as(&two, of)));
}

fn derivatives_are_dual_numbers_of(of: &dyn Listed<f64>, one: &dyn Values<Dual64>, two: &dyn Values<Dual2_64>) {
    let oracle = Oracle::of(of);
    oracle.at_samples(poses(), |_, sample| {
        let Sample { parameters, q, rates, accelerations, .. } = sample;
        let m = of.with_parameters(parameters);
        let pose = m.pose(q);

        // Psi_q, column by column.
        let constants: Vec<_> = parameters.iter().copied().map(Dual64::from_re).collect();
        let jacobian = pose.jacobian();
        for column in 0..q.len() {
            let unit = |index| if index == column { 1.0 } else { 0.0 };
            let q: Vec<_> = q.iter().enumerate().map(|(index, &q)| Dual64::new(q, unit(index))).collect();
            let expected: Vec<f64> = one.residual(&constants, &q).iter().map(|psi| psi.eps).collect();
            let found: Vec<f64> = jacobian.column(column).iter().copied().collect();
            all_close("jacobian", &found, &expected, jacobian.amax(), TOLERANCE);
        }

        // gamma is the second derivative of Psi along q'; points and outputs along q' and q''.
        let constants: Vec<_> = parameters.iter().copied().map(Dual2_64::from_re).collect();
        let along = |bent: f64| {
            let q = q.iter().zip(rates).zip(accelerations);
            q.map(|((&q, &first), second)| Dual2_64::new(q, first, bent * second)).collect::<Vec<_>>()
        };
        let gamma: Vec<f64> = two.residual(&constants, &along(0.0)).iter().map(|psi| psi.v2).collect();
        all_close("gamma", &pose.gamma(rates), &gamma, 0.0, TOLERANCE);
        let moving = along(1.0);
        let points = two.points(&constants, &moving).unwrap();
        let [first, second] = derivatives(&points);
        all_close("velocities", &pose.point_velocities(rates).unwrap(), &first, 0.0, TOLERANCE);
        let found = pose.point_accelerations(rates, accelerations).unwrap();
        all_close("accelerations", &found, &second, 0.0, TOLERANCE);
        let outputs = two.outputs(&constants, &moving).unwrap();
        let [first, second] = derivatives(&outputs);
        let found = pose.output_rates(rates).unwrap();
        each_close("output rates", &found, &first, |index| first[index].abs().max(0.01));
        let found = pose.output_accelerations(rates, accelerations).unwrap();
        each_close("output accelerations", &found, &second, |index| {
            second[index].abs().max(first[index].powi(2)).max(0.01)
        });
    });
}

/// The mechanism `every_function` has all functions.
#[test]
fn every_operation_is_under_test() {
    let text = source::text_of("every_function");
    for operation in linkage_compiler::graph::written() {
        assert!(text.contains(&format!("f_{} =", operation.function.name())), "{}", operation.function.name());
    }
}
