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

#[path = "../source/cam_laws.rs"]
mod cam_laws;
mod judge;
#[path = "../oracle/laws.rs"]
mod laws;
#[path = "../oracle/precise.rs"]
mod precise;
#[path = "../source/mod.rs"]
mod source;
#[path = "../oracle/tape.rs"]
mod tape;
mod verdict;

/// One mechanism of the gallery: how its emitted code is run.
macro_rules! gallery {
    ($($file:ident $Driver:ident $Coordinates:ident $Inputs:ident $Branch:ident $Points:ident $how:ident;)*) => {$(
        mod $file {
            use linkage::linkage;
            use linkage::nalgebra::SVector;

            use super::judge::{Data, Motion};
            use super::verdict::{ULPS, judge, unit_of_length};

            include!(concat!("../mechanisms/", stringify!($file), ".rs"));

            const COORDINATES: usize = $Coordinates::<()>::NAMES.len();
            const POINTS: usize = $Points::<()>::NAMES.len();

            fn flat<P: Into<[f64; 2]>>(points: $Points<P>) -> Vec<f64> {
                let points: [P; POINTS] = points.into();
                points.into_iter().flat_map(Into::into).collect()
            }

            fn array(q: impl Into<SVector<f64, COORDINATES>>) -> Vec<f64> {
                q.into().as_slice().to_vec()
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
