//! Lanes against the functions for one position, bit by bit, over random designs, positions and rates; some of the numbers
//! are extreme. The bits include the sign of a zero: another kind of batch has small whole numbers, right angles and zeros,
//! at which many differences vanish.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use linkage::lanes::{Batch, Given, Lanes, Values};
use linkage::nalgebra::ComplexField;
use linkage::{Dim, real};
use linkage_gallery::{
    Fixture, cam_rocker, cart_pendulum, crank_shaper, double_pendulum, every_function, five_bar, geared_five_bar,
    geneva, implied_loops, inverted_slider_crank, jansen, klann, norton_four_bar, offset_slider_crank, pendulum,
    scotch_yoke, sprocket_strand, stephenson_ii, three_link_arm,
};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use crate::by_name::{Bits, S, is_full, same_bits};

/// Lanes of one batch: not a multiple of the width of a block.
const LANES: usize = 1003;

/// Batches of each kind for each mechanism and scalar. `LANE_BATCHES=930` is the full size: 1e8 lanes, half of them in `f32`.
fn batches() -> usize {
    linkage_trials::count("LANE_BATCHES", 1, 4)
}

const EXTREME: [f64; 14] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -0.0,
    f64::MAX,
    f64::MIN_POSITIVE,
    5e-324,
    1e-160,
    1e155,
    1e300,
    -1.0,
    2e5,
    1e22,
];

/// Lengths, angles and rates at which differences vanish.
const PLAIN: [f64; 13] = [0.0, -0.0, 1.0, -1.0, 2.0, 3.0, 5.0, 0.5, FRAC_PI_2, -FRAC_PI_2, PI, -PI, TAU];

/// The numbers of a batch.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Numbers {
    /// Near those of the design, and usual angles and rates.
    Usual,
    /// Some of them are extreme, so that most lanes are rejected.
    Extreme,
    /// Those of [`PLAIN`], and lengths of the design, also in other places.
    Plain,
}

/// Lanes by their fate, and numbers of accepted lanes.
#[derive(Debug, Default)]
struct Tally {
    accepted: usize,
    rejected: usize,
    /// The accepted lanes in which `full_kinematics` returns an error.
    partly: usize,
    zeros: usize,
    negative_zeros: usize,
}

/// Compares one batch.
fn compare<M>(design: &M, branch: <M as Lanes>::Branch, random: &mut SmallRng, numbers: Numbers, tally: &mut Tally)
where
    M: Lanes + Fixture<Scalar = S<M>>,
    S<M>: Bits,
{
    let mut of_design = M::Given::default().array(|_| real::<S<M>>(0.0));
    design.write_parameters(&mut of_design);
    let spread = random.random_range(0.0..0.1);
    let mut number = |place: usize, at_design: S<M>| {
        if numbers == Numbers::Extreme && random.random_bool(0.02) {
            return real(EXTREME[random.random_range(0..EXTREME.len())]);
        }
        let is_parameter = place < M::PARAMETERS;
        if numbers == Numbers::Plain && (!is_parameter || random.random_bool(0.05)) {
            return real(PLAIN[random.random_range(0..PLAIN.len())]);
        }
        if numbers == Numbers::Plain && random.random_bool(0.3) {
            // Equal lengths.
            return of_design.as_ref()[random.random_range(0..M::PARAMETERS)];
        }
        match is_parameter {
            true if numbers == Numbers::Plain => at_design,
            true => at_design * real(1.0 + spread * random.random_range(-1.0..1.0)),
            false => real(random.random_range(-7.0..7.0)),
        }
    };
    let columns: Vec<Vec<S<M>>> = (of_design.as_ref().iter().enumerate())
        .map(|(place, &at_design)| (0..LANES).map(|_| number(place, at_design)).collect())
        .collect();
    // Every second batch is of one design.
    let is_one_design = random.random_bool(0.5);
    let given: Given<M, Values<'_, S<M>>> = M::Given::default().array(|place| {
        let is_same = place < M::PARAMETERS && is_one_design || random.random_bool(0.1);
        if is_same { Values::Same(columns[place][0]) } else { Values::Each(&columns[place]) }
    });
    let batch = Batch::<M>::new(given, branch).unwrap();
    let mut found = vec![vec![real::<S<M>>(0.0); batch.count()]; M::FOUND.len()];
    let mut masks = [vec![false; batch.count()], vec![false; batch.count()]];
    for (has_quantities, accepted) in [false, true].into_iter().zip(&mut masks) {
        let asked = if has_quantities { M::FOUND.len() } else { M::COORDINATES };
        let mut list: Vec<_> = found.iter_mut().enumerate().map(|(n, c)| (n < asked).then_some(&mut **c)).collect();
        let rejected = batch.run(&mut list, accepted).unwrap();
        assert_eq!(rejected, accepted.iter().filter(|accepted| !**accepted).count());
        for lane in 0..batch.count() {
            let of_lane = |column: &[S<M>]| if column.len() == 1 { column[0] } else { column[lane] };
            let given = given.as_ref().iter().map(|values| match values {
                Values::Same(value) => *value,
                Values::Each(column) => of_lane(column),
            });
            let given: Vec<_> = given.collect();
            let alone = if has_quantities { batch.lane(lane) } else { batch.lane_of_coordinates(lane) };
            let in_lane: Vec<_> = found.iter().take(asked).map(|column| column[lane]).collect();
            let is_same = match (&alone, accepted[lane]) {
                (Ok(alone), true) => {
                    tally.accepted += 1;
                    tally.zeros += in_lane.iter().filter(|value| **value == real(0.0)).count();
                    let negative = real::<S<M>>(-0.0).bits();
                    tally.negative_zeros += in_lane.iter().filter(|value| value.bits() == negative).count();
                    let is_full = !has_quantities || is_full::<M>(&given, &in_lane);
                    tally.partly += usize::from(!is_full);
                    let (coordinates, quantities) = in_lane.split_at(M::COORDINATES);
                    same_bits(&in_lane, &alone.as_ref()[..asked])
                        && coordinates.iter().all(ComplexField::is_finite)
                        && is_full != quantities.iter().any(|value| value.is_nan())
                }
                (Err(_), false) => {
                    tally.rejected += 1;
                    in_lane.iter().all(|value| value.is_nan())
                }
                _ => false,
            };
            assert!(
                is_same,
                "{} lane {lane} of {given:?}: accepted {}, alone {alone:?}, found {in_lane:?}",
                <M as Lanes>::NAME,
                accepted[lane],
            );
        }
    }
    assert_eq!(masks[0], masks[1], "{}: the mask depends on the columns", <M as Lanes>::NAME);
}

fn check<M>(design: &M, branch: <M as Lanes>::Branch, least_accepted: f64)
where
    M: Lanes + Fixture<Scalar = S<M>>,
    S<M>: Bits,
{
    let name = <M as Lanes>::NAME;
    let mut random = SmallRng::seed_from_u64(linkage_trials::seed(18));
    let [mut usual, mut extreme, mut plain] =
        [const { Tally { accepted: 0, rejected: 0, partly: 0, zeros: 0, negative_zeros: 0 } }; 3];
    // Newton's method takes much longer where there is no position.
    for _ in 0..batches().div_ceil(if name == "StephensonII" { 4 } else { 1 }) {
        compare(design, branch, &mut random, Numbers::Usual, &mut usual);
        compare(design, branch, &mut random, Numbers::Extreme, &mut extreme);
        compare(design, branch, &mut random, Numbers::Plain, &mut plain);
    }
    println!("{name}: {usual:?}, with extreme numbers {extreme:?}, with plain numbers {plain:?}");
    assert!(usual.accepted as f64 > least_accepted * (usual.accepted + usual.rejected) as f64, "{name}: {usual:?}");
    assert!(extreme.rejected > 0, "{name}: {extreme:?}");
    assert!(plain.zeros > 100 && plain.negative_zeros > 10, "{name}: {plain:?}");
}

macro_rules! same_bits {
    ($($file:ident: $Mechanism:ident $Branch:ident $accepted:literal;)*) => {$(
        #[test]
        fn $file() {
            let design = $file::$Mechanism::default();
            let branch = $file::$Branch::all().next().unwrap();
            check(&design, branch, $accepted);
            check(&design.map(|parameter| parameter as f32), branch, $accepted);
        }
    )*};
}

// The share of random lanes that can be assembled differs.
same_bits! {
    cam_rocker: CamRocker CamRockerBranch 0.1;
    cart_pendulum: CartPendulum CartPendulumBranch 0.99;
    crank_shaper: CrankShaper CrankShaperBranch 0.1;
    double_pendulum: DoublePendulum DoublePendulumBranch 0.99;
    every_function: EveryFunction EveryFunctionBranch 0.1;
    five_bar: FiveBar FiveBarBranch 0.1;
    geared_five_bar: GearedFiveBar GearedFiveBarBranch 0.1;
    geneva: Geneva GenevaBranch 0.1;
    implied_loops: ImpliedLoops ImpliedLoopsBranch 0.1;
    inverted_slider_crank: InvertedSliderCrank InvertedSliderCrankBranch 0.1;
    jansen: Jansen JansenBranch 0.1;
    klann: Klann KlannBranch 0.1;
    norton_four_bar: NortonFourBar NortonFourBarBranch 0.1;
    offset_slider_crank: OffsetSliderCrank OffsetSliderCrankBranch 0.1;
    pendulum: Pendulum PendulumBranch 0.99;
    scotch_yoke: ScotchYoke ScotchYokeBranch 0.1;
    sprocket_strand: SprocketStrand SprocketStrandBranch 0.1;
    stephenson_ii: StephensonII StephensonIIBranch 0.1;
    three_link_arm: ThreeLinkArm ThreeLinkArmBranch 0.99;
}
