//! Two independent roads to every number: the compiler's interpreter against the emitted code, and
//! the emitted derivatives against dual numbers, at random poses.

#[path = "source/cam_laws.rs"]
mod cam_laws;
mod oracle;
mod source;

/// Poses per mechanism.
const POSES: usize = 1000;

/// The promise: relative error of one formula against another.
const TOLERANCE: f64 = 1e-12;

macro_rules! agreement {
    (
        $test:ident, $path:literal, $file:literal, $index:literal,
        $Driver:ident, $Coordinates:ident, $Rates:ident, $Accelerations:ident, $Inputs:ident, $Points:ident,
        $Outputs:ident
    ) => {
        mod $test {
            use linkage::Real;
            use linkage::linkage;
            use linkage::nalgebra::{DMatrix, DVector, Point2, SMatrix, SVector, Vector2};
            use linkage_compiler::ids::{ColumnId, Id};
            use num_dual::{Dual2_64, Dual64};

            use super::oracle::{Oracle, Sample, all_close, close};
            use super::{POSES, TOLERANCE};

            include!($path);

            const COORDINATES: usize = $Coordinates::<()>::NAMES.len();
            const POINTS: usize = $Points::<()>::NAMES.len();
            const OUTPUTS: usize = $Outputs::<()>::NAMES.len();

            fn mechanism<T: Copy>(sample: &Sample, scalar: impl Fn(f64) -> T) -> $Driver<T> {
                $Driver::from(std::array::from_fn(|index| scalar(sample.parameters[index])))
            }

            /// Coordinates, rates or accelerations.
            fn coordinates<T: Real, Q: From<SVector<T, COORDINATES>>>(value: impl Fn(usize) -> T) -> Q {
                SVector::<T, COORDINATES>::from_fn(|row, _| value(row)).into()
            }

            fn array(q: impl Into<SVector<f64, COORDINATES>>) -> Vec<f64> {
                q.into().as_slice().to_vec()
            }

            fn flat_points(points: $Points<Point2<f64>>) -> Vec<f64> {
                listed_points(points).iter().flat_map(|point| [point.x, point.y]).collect()
            }

            fn listed_points<Q>(points: $Points<Q>) -> [Q; POINTS] {
                points.into()
            }

            fn flat(vectors: $Points<Vector2<f64>>) -> Vec<f64> {
                listed_points(vectors).iter().flat_map(|vector| [vector.x, vector.y]).collect()
            }

            fn listed<T>(outputs: $Outputs<T>) -> [T; OUTPUTS] {
                outputs.into()
            }

            #[test]
            fn emitted_is_interpreted() {
                let oracle = Oracle::read($file, $index);
                let d = &oracle.derivation;
                let (j_rows, a_rows) = (d.jacobian_unknowns(), d.jacobian_inputs());
                let mut regular = 0;
                for sample in oracle.samples(POSES) {
                    let m = mechanism(&sample, |x| x);
                    let q: $Coordinates = coordinates(|i| sample.q[i]);
                    let rates: $Rates = coordinates(|i| sample.rate[i]);
                    let accelerations: $Accelerations = coordinates(|i| sample.acceleration[i]);
                    let pose = m.pose_at(&q);

                    let sizes = oracle.values(&sample, &d.sizes);
                    all_close("sizes", m.closure_sizes(&pose).as_slice(), &sizes, 0.0, TOLERANCE);
                    let scale = sizes.iter().copied().fold(0.0, f64::max);
                    let residual = oracle.values(&sample, &d.residual);
                    all_close("residual", m.residual(&pose).as_slice(), &residual, scale, TOLERANCE);
                    let full = oracle.matrix(&sample, &d.jacobian, d.coordinates.len());
                    all_close("jacobian", m.jacobian(&pose).as_slice(), full.as_slice(), 0.0, TOLERANCE);
                    let j = oracle.matrix(&sample, &j_rows, d.unknowns.len());
                    all_close("J", m.jacobian_unknowns(&pose).as_slice(), j.as_slice(), 0.0, TOLERANCE);
                    let a = oracle.matrix(&sample, &a_rows, d.inputs.len());
                    all_close("A", m.jacobian_inputs(&pose).as_slice(), a.as_slice(), 0.0, TOLERANCE);
                    let gamma = oracle.values(&sample, &d.gamma);
                    all_close("gamma", m.gamma(&pose, &rates).as_slice(), &gamma, 0.0, TOLERANCE);
                    // The simplified determinant against that of the matrix as it stands.
                    let size: f64 = j.column_iter().map(|column| column.norm()).product();
                    close("determinant", m.determinant(&pose), j.determinant(), size, TOLERANCE);

                    let points: Vec<_> = d.points.iter().flat_map(|point| point.value.clone()).collect();
                    all_close(
                        "points",
                        &flat_points(m.points(&pose).unwrap()),
                        &oracle.values(&sample, &points),
                        0.0,
                        TOLERANCE,
                    );
                    let points: Vec<_> = d.points.iter().flat_map(|point| point.rate.clone()).collect();
                    let found = flat(m.point_velocities(&pose, &rates).unwrap());
                    all_close("point velocities", &found, &oracle.values(&sample, &points), 0.0, TOLERANCE);
                    let points: Vec<_> = d.points.iter().flat_map(|point| point.acceleration.clone()).collect();
                    let found = flat(m.point_accelerations(&pose, &rates, &accelerations).unwrap());
                    all_close("point accelerations", &found, &oracle.values(&sample, &points), 0.0, TOLERANCE);
                    let values = listed(m.outputs(&pose).unwrap());
                    let output_rates = listed(m.output_velocities(&pose, &rates).unwrap());
                    let output_accelerations = listed(m.output_accelerations(&pose, &rates, &accelerations).unwrap());
                    for (index, output) in d.outputs.iter().enumerate() {
                        let name = $Outputs::<()>::NAMES[index];
                        for (found, node) in [
                            (values[index], output.value[0]),
                            (output_rates[index], output.rate[0]),
                            (output_accelerations[index], output.acceleration[0]),
                        ] {
                            let expected = oracle.values(&sample, &[node])[0];
                            close(name, found, expected, expected.abs().max(0.01), TOLERANCE);
                        }
                    }

                    // Linear systems are judged by what they leave over, which does not depend on how
                    // near a singular pose the sample fell.
                    let Ok(ratios) = m.velocity_ratios(&pose) else { continue };
                    regular += 1;
                    let w = DMatrix::from_column_slice(j.nrows(), a.ncols(), ratios.as_slice());
                    let left = &j * &w + &a;
                    all_close(
                        "J W + A",
                        left.as_slice(),
                        &vec![0.0; left.len()],
                        j.norm() * w.norm() + a.norm(),
                        TOLERANCE,
                    );
                    let pick = |q: &[f64], of: &[ColumnId]| {
                        DVector::from_iterator(of.len(), of.iter().map(|place| q[place.index()]))
                    };
                    let velocity = m.velocity(&pose, $Inputs::from(&rates)).unwrap();
                    let found = array(velocity);
                    let (u, v) = (pick(&found, &d.unknowns), pick(&found, &d.inputs));
                    assert_eq!(v, pick(&sample.rate, &d.inputs));
                    let left = &j * &u + &a * &v;
                    let scale = j.norm() * u.norm() + a.norm() * v.norm();
                    all_close("J u' + A v'", left.as_slice(), &vec![0.0; left.len()], scale, TOLERANCE);
                    let found = array(m.acceleration(&pose, &rates, $Inputs::from(&accelerations)).unwrap());
                    let (u, v) = (pick(&found, &d.unknowns), pick(&found, &d.inputs));
                    let gamma = DVector::from_vec(gamma);
                    let left = &j * &u + &a * &v + &gamma;
                    let scale = j.norm() * u.norm() + a.norm() * v.norm() + gamma.norm();
                    all_close("J u'' + A v'' + gamma", left.as_slice(), &vec![0.0; left.len()], scale, TOLERANCE);

                    // W_l v' is the velocity of the point, and of the output, at q' = (W v', v').
                    let v_rate: Vec<f64> = d.inputs.iter().map(|place| sample.rate[place.index()]).collect();
                    let by_rates = flat(m.point_velocities(&pose, &velocity).unwrap());
                    let ratios: [SMatrix<f64, 2, _>; POINTS] = m.point_ratios(&pose).unwrap().into();
                    let times_rates = |ratio: &[f64], rows: usize| {
                        DMatrix::from_column_slice(rows, v_rate.len(), ratio) * DVector::from_vec(v_rate.clone())
                    };
                    let by_ratios: Vec<f64> =
                        ratios.iter().flat_map(|ratio| times_rates(ratio.as_slice(), 2).as_slice().to_vec()).collect();
                    // The two roads round W differently: the bound is that of W itself.
                    let scale = full.norm() * (w.norm() + 1.0) * 10.0;
                    all_close("W_l of points", &by_ratios, &by_rates, scale, TOLERANCE);
                    let by_rates = listed(m.output_velocities(&pose, &velocity).unwrap());
                    let ratios = listed(m.output_ratios(&pose).unwrap());
                    for (ratio, by_rates) in ratios.iter().zip(by_rates) {
                        let by_ratios = times_rates(ratio.as_slice(), 1)[0];
                        let scale = by_rates.abs() + ratio.norm() * 10.0 + w.norm();
                        close("W_l of outputs", by_ratios, by_rates, scale, TOLERANCE);
                    }

                    // The fused kernel says what its parts say.
                    let motion = m.motion(&q, $Inputs::from(&rates), $Inputs::from(&accelerations)).unwrap();
                    assert_eq!(motion.position, q);
                    all_close("motion velocity", &array(motion.rates), &array(velocity), 0.0, TOLERANCE);
                    let expected = array(m.acceleration(&pose, &velocity, $Inputs::from(&accelerations)).unwrap());
                    all_close("motion acceleration", &array(motion.accelerations), &expected, 0.0, 1e2 * TOLERANCE);
                    let moving: [_; POINTS] = motion.points.into();
                    let expected = flat(m.point_velocities(&pose, &motion.rates).unwrap());
                    let found: Vec<f64> =
                        moving.iter().flat_map(|point| [point.velocity.x, point.velocity.y]).collect();
                    let scale = array(motion.rates).iter().fold(0.0, |a: f64, b| a.max(b.abs())) * full.amax();
                    all_close("motion point velocities", &found, &expected, scale, TOLERANCE);
                    let expected = flat(m.point_accelerations(&pose, &motion.rates, &motion.accelerations).unwrap());
                    let found: Vec<f64> =
                        moving.iter().flat_map(|point| [point.acceleration.x, point.acceleration.y]).collect();
                    let scale = array(motion.accelerations).iter().fold(0.0, |a: f64, b| a.max(b.abs())) * full.amax();
                    all_close("motion point accelerations", &found, &expected, scale, TOLERANCE);
                    let found: Vec<f64> =
                        moving.iter().flat_map(|point| [point.position.x, point.position.y]).collect();
                    all_close("motion points", &found, &flat_points(m.points(&pose).unwrap()), 0.0, TOLERANCE);
                    let moving = listed(motion.outputs);
                    let expected = listed(m.output_accelerations(&pose, &motion.rates, &motion.accelerations).unwrap());
                    let terms = scale + array(motion.rates).iter().map(|rate| rate * rate).sum::<f64>();
                    for index in 0..OUTPUTS {
                        close("motion output", moving[index].value, values[index], values[index].abs(), TOLERANCE);
                        close(
                            "motion output acceleration",
                            moving[index].acceleration,
                            expected[index],
                            terms,
                            TOLERANCE,
                        );
                    }
                }
                assert!(regular > POSES / 2, "{regular}");
            }

            #[test]
            fn emitted_derivatives_are_dual_numbers() {
                let oracle = Oracle::read($file, $index);
                for sample in oracle.samples(POSES) {
                    let m = mechanism(&sample, |x| x);
                    let pose = m.pose_at(&coordinates::<_, $Coordinates>(|i| sample.q[i]));
                    let rates: $Rates = coordinates(|i| sample.rate[i]);
                    let accelerations: $Accelerations = coordinates(|i| sample.acceleration[i]);

                    // Psi_q, column by column.
                    let dual = mechanism(&sample, Dual64::from_re);
                    let jacobian = m.jacobian(&pose);
                    for column in 0..sample.q.len() {
                        let q: $Coordinates<_> =
                            coordinates(|i| Dual64::new(sample.q[i], if i == column { 1.0 } else { 0.0 }));
                        let residual = dual.residual(&dual.pose_at(&q));
                        let expected: Vec<f64> = residual.iter().map(|psi| psi.eps).collect();
                        let found: Vec<f64> = jacobian.column(column).iter().copied().collect();
                        all_close("jacobian", &found, &expected, jacobian.amax(), TOLERANCE);
                    }
                    // gamma is the second derivative of Psi along q'; points and outputs along q' and q''.
                    let dual = mechanism(&sample, Dual2_64::from_re);
                    let along = |second: bool| {
                        coordinates::<_, $Coordinates<_>>(|i| {
                            Dual2_64::new(
                                sample.q[i],
                                sample.rate[i],
                                if second { sample.acceleration[i] } else { 0.0 },
                            )
                        })
                    };
                    let gamma: Vec<f64> =
                        dual.residual(&dual.pose_at(&along(false))).iter().map(|psi| psi.v2).collect();
                    all_close("gamma", m.gamma(&pose, &rates).as_slice(), &gamma, 0.0, TOLERANCE);
                    let moving = dual.pose_at(&along(true));
                    let points = listed_points(dual.points(&moving).unwrap());
                    let expected: Vec<f64> = points.iter().flat_map(|point| [point.x.v1, point.y.v1]).collect();
                    all_close(
                        "velocities",
                        &flat(m.point_velocities(&pose, &rates).unwrap()),
                        &expected,
                        0.0,
                        TOLERANCE,
                    );
                    let expected: Vec<f64> = points.iter().flat_map(|point| [point.x.v2, point.y.v2]).collect();
                    let found = flat(m.point_accelerations(&pose, &rates, &accelerations).unwrap());
                    all_close("accelerations", &found, &expected, 0.0, TOLERANCE);
                    let outputs = listed(dual.outputs(&moving).unwrap());
                    let output_rates = listed(m.output_velocities(&pose, &rates).unwrap());
                    let output_accelerations = listed(m.output_accelerations(&pose, &rates, &accelerations).unwrap());
                    for index in 0..OUTPUTS {
                        let name = $Outputs::<()>::NAMES[index];
                        let Dual2_64 { v1, v2, .. } = outputs[index];
                        close(name, output_rates[index], v1, v1.abs().max(0.01), TOLERANCE);
                        close(name, output_accelerations[index], v2, v2.abs().max(v1 * v1).max(0.01), TOLERANCE);
                    }
                }
            }
        }
    };
}

agreement!(
    four_bar,
    "mechanisms/four_bar.rs",
    "four_bar",
    0,
    FourBar,
    FourBarCoordinates,
    FourBarRates,
    FourBarAccelerations,
    FourBarInputs,
    FourBarPoints,
    FourBarOutputs
);
agreement!(
    components,
    "mechanisms/components.rs",
    "components",
    0,
    Components,
    ComponentsCoordinates,
    ComponentsRates,
    ComponentsAccelerations,
    ComponentsInputs,
    ComponentsPoints,
    ComponentsOutputs
);
agreement!(
    introductory,
    "mechanisms/introductory.rs",
    "introductory",
    0,
    Introductory,
    IntroductoryCoordinates,
    IntroductoryRates,
    IntroductoryAccelerations,
    IntroductoryInputs,
    IntroductoryPoints,
    IntroductoryOutputs
);
agreement!(
    engine,
    "mechanisms/slider_crank.rs",
    "slider_crank",
    0,
    Engine,
    SliderCrankCoordinates,
    SliderCrankRates,
    SliderCrankAccelerations,
    EngineInputs,
    SliderCrankPoints,
    SliderCrankOutputs
);
agreement!(
    compressor,
    "mechanisms/slider_crank.rs",
    "slider_crank",
    1,
    Compressor,
    SliderCrankCoordinates,
    SliderCrankRates,
    SliderCrankAccelerations,
    CompressorInputs,
    SliderCrankPoints,
    SliderCrankOutputs
);
agreement!(
    rrr,
    "mechanisms/rrr.rs",
    "rrr",
    0,
    Rrr,
    RrrCoordinates,
    RrrRates,
    RrrAccelerations,
    RrrInputs,
    RrrPoints,
    RrrOutputs
);
agreement!(
    rpr,
    "mechanisms/rpr.rs",
    "rpr",
    0,
    Rpr,
    RprCoordinates,
    RprRates,
    RprAccelerations,
    RprInputs,
    RprPoints,
    RprOutputs
);
agreement!(
    six_bar,
    "mechanisms/six_bar.rs",
    "six_bar",
    0,
    SixBar,
    SixBarCoordinates,
    SixBarRates,
    SixBarAccelerations,
    SixBarInputs,
    SixBarPoints,
    SixBarOutputs
);
agreement!(
    five_bar,
    "mechanisms/five_bar.rs",
    "five_bar",
    0,
    FiveBar,
    FiveBarCoordinates,
    FiveBarRates,
    FiveBarAccelerations,
    FiveBarInputs,
    FiveBarPoints,
    FiveBarOutputs
);
agreement!(
    geared_five_bar,
    "mechanisms/geared_five_bar.rs",
    "geared_five_bar",
    0,
    GearedFiveBar,
    GearedFiveBarCoordinates,
    GearedFiveBarRates,
    GearedFiveBarAccelerations,
    GearedFiveBarInputs,
    GearedFiveBarPoints,
    GearedFiveBarOutputs
);
agreement!(
    scotch_yoke,
    "mechanisms/scotch_yoke.rs",
    "scotch_yoke",
    0,
    ScotchYoke,
    ScotchYokeCoordinates,
    ScotchYokeRates,
    ScotchYokeAccelerations,
    ScotchYokeInputs,
    ScotchYokePoints,
    ScotchYokeOutputs
);
agreement!(
    cam_follower,
    "mechanisms/cam_follower.rs",
    "cam_follower",
    0,
    CamFollower,
    CamFollowerCoordinates,
    CamFollowerRates,
    CamFollowerAccelerations,
    CamFollowerInputs,
    CamFollowerPoints,
    CamFollowerOutputs
);
agreement!(
    cam_rocker,
    "mechanisms/cam_rocker.rs",
    "cam_rocker",
    0,
    CamRocker,
    CamRockerCoordinates,
    CamRockerRates,
    CamRockerAccelerations,
    CamRockerInputs,
    CamRockerPoints,
    CamRockerOutputs
);
agreement!(
    every_function,
    "mechanisms/every_function.rs",
    "every_function",
    0,
    EveryFunction,
    EveryFunctionCoordinates,
    EveryFunctionRates,
    EveryFunctionAccelerations,
    EveryFunctionInputs,
    EveryFunctionPoints,
    EveryFunctionOutputs
);

/// The mechanism of all functions has them all.
#[test]
fn every_operation_is_under_test() {
    let text = source::tokens_of("every_function").to_string();
    for operation in &linkage_compiler::graph::OPERATIONS {
        assert!(text.contains(&format!("f_{} =", operation.name)), "{}", operation.name);
    }
}
