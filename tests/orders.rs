//! Jerk, derivatives of the velocity ratios and sensitivities against numbers that carry their own
//! derivatives, at random poses: put into the closures, what was solved for must leave nothing over. And
//! against finite differences in so many digits that nothing of them is lost.

#[path = "source/cam_laws.rs"]
mod cam_laws;
mod oracle;
mod source;

/// By finite differences in 90-digit arithmetic, from closures written by hand: see `oracle/orders.py`.
const DIFFERENCES: &str = include_str!("oracle/orders.json");

/// Poses per mechanism.
const POSES: usize = 200;

/// Relative error of one formula against another.
const TOLERANCE: f64 = 1e-12;

macro_rules! orders {
    (
        $test:ident, $Mechanism:ident, $Coordinates:ident, $Inputs:ident, $Points:ident, $Outputs:ident
    ) => {
        mod $test {
            use linkage::linkage;
            use linkage::nalgebra::{DVector, Point2, RealField, SMatrix, SVector, Vector2};
            use linkage_compiler::ids::Id;
            use num_dual::{Dual3_64, Dual64, HyperDual64};

            use super::oracle::{Oracle, Sample, all_close, close};
            use super::{POSES, TOLERANCE};

            include!(concat!("mechanisms/", stringify!($test), ".rs"));

            const Q: usize = $Coordinates::<()>::NAMES.len();
            const V: usize = $Inputs::<()>::NAMES.len();
            const P: usize = $Mechanism::<f64>::PARAMETERS.len();
            const POINTS: usize = $Points::<()>::NAMES.len();
            const OUTPUTS: usize = $Outputs::<()>::NAMES.len();

            fn oracle() -> Oracle {
                Oracle::read(stringify!($test), 0)
            }

            fn mechanism<T: Copy>(sample: &Sample, scalar: impl Fn(usize, f64) -> T) -> $Mechanism<T> {
                $Mechanism::from(std::array::from_fn(|index| scalar(index, sample.parameters[index])))
            }

            /// Coordinates, or one of their derivatives.
            fn coordinates<T: RealField + Copy, C: From<SVector<T, Q>>>(value: impl Fn(usize) -> T) -> C {
                SVector::<T, Q>::from_fn(|row, _| value(row)).into()
            }

            fn array(q: impl Into<SVector<f64, Q>>) -> [f64; Q] {
                q.into().data.0[0]
            }

            /// Any jerks: the accelerations of other coordinates.
            fn jerk_of(sample: &Sample, place: usize) -> f64 {
                -2.0 * sample.acceleration[(place + 1) % Q]
            }

            /// What is left over beside the terms that it is the sum of.
            fn nothing(what: &str, left: &[f64], scale: f64) {
                all_close(what, left, &vec![0.0; left.len()], scale, TOLERANCE);
            }

            #[test]
            fn jerk_closes_to_third_order() {
                let oracle = oracle();
                let d = &oracle.derivation;
                let mut regular = 0;
                for sample in oracle.samples(POSES) {
                    let m = mechanism(&sample, |_, x| x);
                    let pose = m.pose_at(&coordinates(|i| sample.q[i]));
                    let (rate, acceleration) =
                        (coordinates(|i| sample.rate[i]), coordinates(|i| sample.acceleration[i]));
                    let given = coordinates(|i| jerk_of(&sample, i));

                    // Points and outputs along any q(t).
                    let motion = |jerk: [f64; Q]| {
                        coordinates(|i| Dual3_64::new(sample.q[i], sample.rate[i], sample.acceleration[i], jerk[i]))
                    };
                    let dual = mechanism(&sample, |_, x| Dual3_64::from_re(x));
                    let moving = dual.pose_at(&motion(array(given)));
                    let found: [Vector2<f64>; POINTS] =
                        m.point_jerks(&pose, &rate, &acceleration, &given).unwrap().into();
                    let expected: [Point2<Dual3_64>; POINTS] = dual.points(&moving).unwrap().into();
                    for (found, expected) in found.iter().zip(expected) {
                        all_close("point jerk", found.as_slice(), &[expected.x.v3, expected.y.v3], 0.0, TOLERANCE);
                    }
                    let found: [f64; OUTPUTS] = m.output_jerks(&pose, &rate, &acceleration, &given).unwrap().into();
                    let expected: [Dual3_64; OUTPUTS] = dual.outputs(&moving).unwrap().into();
                    for (found, Dual3_64 { v1, v2, v3, .. }) in found.into_iter().zip(expected) {
                        let scale = v3.abs() + (v1 * v2).abs() + v1.abs().powi(3) + 0.01;
                        close("output jerk", found, v3, scale, TOLERANCE);
                    }

                    let Ok(jerk) = m.jerk(&pose, &rate, &acceleration, $Inputs::from(&given)) else { continue };
                    regular += 1;
                    let jerk = array(jerk);
                    for &input in &d.inputs {
                        assert_eq!(jerk[input.index()], jerk_of(&sample, input.index()));
                    }
                    let third = |jerk: [f64; Q]| dual.residual(&dual.pose_at(&motion(jerk))).map(|psi| psi.v3);
                    let eta = third([0.0; Q]);
                    let size = m.jacobian(&pose).norm() * DVector::from_row_slice(&jerk).norm() + eta.norm();
                    nothing("Psi'''", third(jerk).as_slice(), size);
                    let interpreted = oracle.values(&sample, d.eta.as_ref().unwrap());
                    all_close("eta", eta.as_slice(), &interpreted, 0.0, TOLERANCE);
                }
                assert!(regular > POSES / 2, "{regular}");
            }

            #[test]
            fn ratio_derivatives_close_to_second_order() {
                let oracle = oracle();
                let d = &oracle.derivation;
                let mut regular = 0;
                for sample in oracle.samples(POSES) {
                    let m = mechanism(&sample, |_, x| x);
                    let pose = m.pose_at(&coordinates(|i| sample.q[i]));
                    let Ok(w) = m.velocity_ratios(&pose) else { continue };
                    regular += 1;
                    let l = m.velocity_ratio_derivatives(&pose).unwrap();
                    let points: [[SMatrix<f64, V, V>; 2]; POINTS] = m.point_ratio_derivatives(&pose).unwrap().into();
                    let outputs: [SMatrix<f64, V, V>; OUTPUTS] = m.output_ratio_derivatives(&pose).unwrap().into();
                    let dual = mechanism(&sample, |_, x| HyperDual64::from_re(x));
                    // Of the motion of all coordinates for a unit rate of one input.
                    let unit = |place: usize, input: usize| match d.unknowns.iter().position(|u| u.index() == place) {
                        Some(unknown) => w[(unknown, input)],
                        None => f64::from(u8::from(d.inputs.iter().position(|v| v.index() == place) == Some(input))),
                    };
                    let curved = |place: usize, j: usize, k: usize| {
                        d.unknowns.iter().position(|u| u.index() == place).map_or(0.0, |unknown| l[unknown][(j, k)])
                    };
                    for j in 0..V {
                        for k in 0..V {
                            let along = |bent: f64| {
                                let q = coordinates(|i| {
                                    HyperDual64::new(sample.q[i], unit(i, j), unit(i, k), bent * curved(i, j, k))
                                });
                                dual.pose_at(&q)
                            };
                            let second = |bent: f64| dual.residual(&along(bent)).map(|psi| psi.eps1eps2);
                            let term = second(0.0);
                            let curvature: f64 = l.iter().map(|l| l[(j, k)].powi(2)).sum();
                            let size = m.jacobian_unknowns(&pose).norm() * curvature.sqrt() + term.norm();
                            nothing("J L_jk + gamma(w_j, w_k)", second(1.0).as_slice(), size);

                            let moving = along(1.0);
                            let expected: [Point2<HyperDual64>; POINTS] = dual.points(&moving).unwrap().into();
                            for (found, expected) in points.iter().zip(expected) {
                                let found = [found[0][(j, k)], found[1][(j, k)]];
                                let scale = 10.0 * (1.0 + curvature.sqrt() + w.norm_squared());
                                let expected = [expected.x.eps1eps2, expected.y.eps1eps2];
                                all_close("point ratio derivatives", &found, &expected, scale, TOLERANCE);
                            }
                            let expected: [HyperDual64; OUTPUTS] = dual.outputs(&moving).unwrap().into();
                            for (found, expected) in outputs.iter().zip(expected) {
                                let size = expected.eps1.abs() * expected.eps2.abs();
                                let scale = 1.0 + expected.eps1eps2.abs() + size + curvature.sqrt() + w.norm_squared();
                                let found = found[(j, k)];
                                close("output ratio derivatives", found, expected.eps1eps2, scale, TOLERANCE);
                            }
                        }
                    }

                    // u'' = W v'' + v' . L v'.
                    let inputs: Vec<usize> = d.inputs.iter().map(|input| input.index()).collect();
                    let v1 = SVector::<f64, V>::from_fn(|row, _| sample.rate[inputs[row]]);
                    let v2 = SVector::<f64, V>::from_fn(|row, _| jerk_of(&sample, inputs[row]));
                    let velocity = m.velocity(&pose, v1).unwrap();
                    let acceleration = array(m.acceleration(&pose, &velocity, v2).unwrap());
                    for (unknown, &place) in d.unknowns.iter().enumerate() {
                        let curved = v1.dot(&(l[unknown] * v1));
                        let found = w.row(unknown).transpose().dot(&v2) + curved;
                        let gamma = m.gamma(&pose, &velocity).norm();
                        let inverse = m.jacobian_unknowns(&pose).try_inverse().unwrap().norm();
                        let scale = inverse * (gamma + m.jacobian_inputs(&pose).norm() * v2.norm());
                        // Both roads solve with J, whose condition neither can mend.
                        let scale = scale * inverse * m.jacobian_unknowns(&pose).norm();
                        close("W v'' + v' L v'", found, acceleration[place.index()], scale, TOLERANCE);
                    }
                }
                assert!(regular > POSES / 2, "{regular}");
            }

            #[test]
            fn sensitivities_close_to_first_order() {
                let oracle = oracle();
                let d = &oracle.derivation;
                let mut regular = 0;
                for sample in oracle.samples(POSES) {
                    let m = mechanism(&sample, |_, x| x);
                    let pose = m.pose_at(&coordinates(|i| sample.q[i]));
                    let Ok(s) = m.sensitivity(&pose) else { continue };
                    regular += 1;
                    let points: [SMatrix<f64, 2, P>; POINTS] = m.point_sensitivities(&pose).unwrap().into();
                    let outputs: [SMatrix<f64, 1, P>; OUTPUTS] = m.output_sensitivities(&pose).unwrap().into();
                    let interpreted = oracle.matrix(&sample, &d.sensitivity.as_ref().unwrap().jacobian, P);
                    for p in 0..P {
                        let dual = mechanism(&sample, |i, x| Dual64::new(x, f64::from(u8::from(i == p))));
                        let along = |follow: f64| {
                            let q = coordinates(|i| {
                                let unknown = d.unknowns.iter().position(|u| u.index() == i);
                                Dual64::new(sample.q[i], unknown.map_or(0.0, |unknown| follow * s[(unknown, p)]))
                            });
                            dual.pose_at(&q)
                        };
                        let first = |follow: f64| dual.residual(&along(follow)).map(|psi| psi.eps);
                        let direct = first(0.0);
                        let size = m.jacobian_unknowns(&pose).norm() * s.column(p).norm() + direct.norm();
                        nothing("J du/dp + Psi_p", first(1.0).as_slice(), size);
                        let entries: Vec<f64> = interpreted.column(p).iter().copied().collect();
                        all_close("Psi_p", direct.as_slice(), &entries, 0.0, TOLERANCE);

                        let following = along(1.0);
                        let expected: [Point2<Dual64>; POINTS] = dual.points(&following).unwrap().into();
                        for (found, expected) in points.iter().zip(expected) {
                            let found = [found[(0, p)], found[(1, p)]];
                            let scale = 10.0 * (1.0 + s.column(p).norm());
                            all_close(
                                "point sensitivities",
                                &found,
                                &[expected.x.eps, expected.y.eps],
                                scale,
                                TOLERANCE,
                            );
                        }
                        let expected: [Dual64; OUTPUTS] = dual.outputs(&following).unwrap().into();
                        for (found, expected) in outputs.iter().zip(expected) {
                            let scale = 1.0 + expected.eps.abs() + s.column(p).norm();
                            close("output sensitivities", found[p], expected.eps, scale, TOLERANCE);
                        }
                    }
                }
                assert!(regular > POSES / 2, "{regular}");
            }

            #[test]
            fn finite_differences() {
                let cases: serde_json::Value = serde_json::from_str(super::DIFFERENCES).unwrap();
                let case =
                    cases.as_array().unwrap().iter().find(|case| case["mechanism"] == stringify!($test)).unwrap();
                let numbers = |list: &serde_json::Value| -> Vec<f64> {
                    list.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
                };
                let rows = |list: &serde_json::Value| -> Vec<Vec<f64>> {
                    list.as_array().unwrap().iter().map(numbers).collect()
                };
                let all = |of_unknowns: &str, of_inputs: &str| {
                    let mut all = numbers(&case[of_unknowns]);
                    all.extend(numbers(&case[of_inputs]));
                    all
                };
                let inputs = |name: &str| $Inputs::from(SVector::<f64, V>::from_vec(numbers(&case[name])));
                let m = $Mechanism::from(<[f64; P]>::try_from(numbers(&case["parameters"])).unwrap());
                let given = all("unknowns", "inputs");
                let solution = m.solve(&coordinates(|i| given[i])).unwrap();
                let q = solution.coordinates;
                all_close("position", &array(q), &given, 0.0, TOLERANCE);
                let pose = m.pose_at(&q);

                let velocity = m.velocity(&pose, inputs("input_rates")).unwrap();
                all_close("velocity", &array(velocity), &all("rates", "input_rates"), 0.0, TOLERANCE);
                let acceleration = m.acceleration(&pose, &velocity, inputs("input_accelerations")).unwrap();
                let expected = all("accelerations", "input_accelerations");
                all_close("acceleration", &array(acceleration), &expected, 0.0, TOLERANCE);
                let jerk = m.jerk(&pose, &velocity, &acceleration, inputs("input_jerks")).unwrap();
                let points: [Vector2<f64>; POINTS] =
                    m.point_jerks(&pose, &velocity, &acceleration, &jerk).unwrap().into();
                let outputs: [f64; OUTPUTS] = m.output_jerks(&pose, &velocity, &acceleration, &jerk).unwrap().into();
                let points: Vec<f64> = points.iter().flat_map(|point| [point.x, point.y]).collect();
                same("jerk", &array(jerk)[..Q - V], &points, &outputs, &numbers(&case["jerks"]));

                let ratios = m.velocity_ratio_derivatives(&pose).unwrap();
                let points: [[SMatrix<f64, V, V>; 2]; POINTS] = m.point_ratio_derivatives(&pose).unwrap().into();
                let outputs: [SMatrix<f64, V, V>; OUTPUTS] = m.output_ratio_derivatives(&pose).unwrap().into();
                for (pair, expected) in rows(&case["by_inputs"]).iter().enumerate() {
                    let entry = |matrix: &SMatrix<f64, V, V>| matrix.as_slice()[pair];
                    let points: Vec<f64> = points.as_flattened().iter().map(entry).collect();
                    same("d2/dv dv", &ratios.each_ref().map(entry), &points, &outputs.each_ref().map(entry), expected);
                }

                let unknowns = m.sensitivity(&pose).unwrap();
                let points: [SMatrix<f64, 2, P>; POINTS] = m.point_sensitivities(&pose).unwrap().into();
                let outputs: [SMatrix<f64, 1, P>; OUTPUTS] = m.output_sensitivities(&pose).unwrap().into();
                for (p, expected) in rows(&case["by_parameters"]).iter().enumerate() {
                    let points: Vec<f64> = points.iter().flat_map(|point| [point[(0, p)], point[(1, p)]]).collect();
                    let unknowns: Vec<f64> = unknowns.column(p).iter().copied().collect();
                    same("d/dp", &unknowns, &points, &outputs.map(|output| output[p]), expected);
                }
            }

            /// Unknowns and points beside the largest of them, outputs one by one.
            fn same(what: &str, unknowns: &[f64], points: &[f64], outputs: &[f64], expected: &[f64]) {
                let (expected, of_outputs) = expected.split_at(expected.len() - OUTPUTS);
                let (of_unknowns, of_points) = expected.split_at(unknowns.len());
                all_close(what, unknowns, of_unknowns, 0.0, TOLERANCE);
                all_close(&format!("{what} of points"), points, of_points, 0.0, TOLERANCE);
                for (output, expected) in outputs.iter().zip(of_outputs) {
                    close(&format!("{what} of an output"), *output, *expected, expected.abs().max(0.01), TOLERANCE);
                }
            }
        }
    };
}

orders!(
    norton_four_bar,
    NortonFourBar,
    NortonFourBarCoordinates,
    NortonFourBarInputs,
    NortonFourBarPoints,
    NortonFourBarOutputs
);
orders!(components, Components, ComponentsCoordinates, ComponentsInputs, ComponentsPoints, ComponentsOutputs);
orders!(
    offset_slider_crank,
    OffsetSliderCrank,
    OffsetSliderCrankCoordinates,
    OffsetSliderCrankInputs,
    OffsetSliderCrankPoints,
    OffsetSliderCrankOutputs
);
orders!(five_bar, FiveBar, FiveBarCoordinates, FiveBarInputs, FiveBarPoints, FiveBarOutputs);
orders!(
    geared_five_bar,
    GearedFiveBar,
    GearedFiveBarCoordinates,
    GearedFiveBarInputs,
    GearedFiveBarPoints,
    GearedFiveBarOutputs
);
orders!(
    elliptic_trammel,
    EllipticTrammel,
    EllipticTrammelCoordinates,
    EllipticTrammelInputs,
    EllipticTrammelPoints,
    EllipticTrammelOutputs
);
orders!(jansen, Jansen, JansenCoordinates, JansenInputs, JansenPoints, JansenOutputs);
orders!(
    double_butterfly,
    DoubleButterfly,
    DoubleButterflyCoordinates,
    DoubleButterflyInputs,
    DoubleButterflyPoints,
    DoubleButterflyOutputs
);
orders!(
    every_function,
    EveryFunction,
    EveryFunctionCoordinates,
    EveryFunctionInputs,
    EveryFunctionPoints,
    EveryFunctionOutputs
);
