//! Lanes against the function for one position, bit by bit, over random designs, positions and rates; some of the numbers
//! are extreme.

use std::env;
use std::fmt::Debug;

use linkage::lanes::{Batch, Given, Lanes, Values};
use linkage::nalgebra::ComplexField;
use linkage::{Dim, Real, real};
use linkage_gallery::{
    cam_rocker, cart_pendulum, crank_shaper, every_function, five_bar, geared_five_bar, geneva, inverted_slider_crank,
    jansen, klann, norton_four_bar, offset_slider_crank, scotch_yoke, stephenson_ii, three_link_arm,
};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

/// Lanes of one batch: not a multiple of the width of a block.
const LANES: usize = 1003;

/// Pairs of batches of each mechanism and scalar. `LANE_BATCHES=2100` is the full size: 1e8 lanes, half of them in `f32`.
fn batches() -> usize {
    env::var("LANE_BATCHES").ok().and_then(|text| text.parse().ok()).unwrap_or(4)
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

/// Lanes by their fate.
#[derive(Debug, Default)]
struct Tally {
    accepted: usize,
    rejected: usize,
}

/// Compares one batch. Where `share` of the numbers are extreme, most lanes are rejected.
fn compare<M: Lanes>(design: &M, branch: M::Branch, random: &mut SmallRng, share: f64, tally: &mut Tally)
where
    M::Scalar: Bits,
{
    let mut of_design = <M::Given as Dim>::array(|_| real::<M::Scalar>(0.0));
    design.write_parameters(&mut of_design);
    let spread = random.random_range(0.0..0.1);
    let mut number = |place: usize, at_design: M::Scalar| {
        if random.random_bool(share) {
            return real(EXTREME[random.random_range(0..EXTREME.len())]);
        }
        match place < M::PARAMETERS {
            true => at_design * real(1.0 + spread * random.random_range(-1.0..1.0)),
            false => real(random.random_range(-7.0..7.0)),
        }
    };
    let columns: Vec<Vec<M::Scalar>> = (of_design.as_ref().iter().enumerate())
        .map(|(place, &at_design)| (0..LANES).map(|_| number(place, at_design)).collect())
        .collect();
    // Every second batch is of one design.
    let is_one_design = random.random_bool(0.5);
    let given: Given<M, Values<'_, M::Scalar>> = <M::Given as Dim>::array(|place| {
        let is_same = place < M::PARAMETERS && is_one_design || random.random_bool(0.1);
        if is_same { Values::Same(columns[place][0]) } else { Values::Each(&columns[place]) }
    });
    let batch = Batch::<M>::new(given, branch).unwrap();
    let mut found = vec![vec![real::<M::Scalar>(0.0); batch.count()]; M::FOUND.len()];
    let mut accepted = vec![false; batch.count()];
    for has_quantities in [false, true] {
        let asked = if has_quantities { M::FOUND.len() } else { M::COORDINATES };
        let mut list: Vec<_> = found.iter_mut().enumerate().map(|(n, c)| (n < asked).then_some(&mut **c)).collect();
        let rejected = batch.run(&mut list, &mut accepted).unwrap();
        assert_eq!(rejected, accepted.iter().filter(|accepted| !**accepted).count());
        for lane in 0..batch.count() {
            let alone = if has_quantities { batch.lane(lane) } else { batch.lane_of_coordinates(lane) };
            let is_same = match (&alone, accepted[lane]) {
                (Ok(alone), true) => {
                    tally.accepted += 1;
                    let pairs = found.iter().zip(alone.as_ref()).take(asked);
                    pairs.clone().all(|(column, value)| column[lane].bits() == value.bits() && value.is_finite())
                }
                (Err(_), false) => {
                    tally.rejected += 1;
                    found.iter().take(asked).all(|column| column[lane].is_nan())
                }
                _ => false,
            };
            assert!(
                is_same,
                "{} lane {lane} of {:?}: accepted {}, alone {alone:?}, found {:?}",
                M::NAME,
                columns.iter().map(|column| column[lane % column.len()]).collect::<Vec<_>>(),
                accepted[lane],
                found.iter().map(|column| column[lane]).collect::<Vec<_>>()
            );
        }
    }
}

/// The bits of a scalar.
trait Bits: Real + Debug {
    fn bits(self) -> u64;
    fn is_nan(self) -> bool;
}

impl Bits for f64 {
    fn bits(self) -> u64 {
        self.to_bits()
    }

    fn is_nan(self) -> bool {
        Self::is_nan(self)
    }
}

impl Bits for f32 {
    fn bits(self) -> u64 {
        self.to_bits().into()
    }

    fn is_nan(self) -> bool {
        Self::is_nan(self)
    }
}

fn check<M: Lanes>(design: &M, branch: M::Branch, least_accepted: f64)
where
    M::Scalar: Bits,
{
    let mut random = SmallRng::seed_from_u64(18);
    let [mut usual, mut extreme] = [Tally::default(), Tally::default()];
    // Newton's method takes much longer where there is no position.
    for _ in 0..batches() / if M::NAME == "StephensonII" { 4 } else { 1 } {
        compare(design, branch, &mut random, 0.0, &mut usual);
        compare(design, branch, &mut random, 0.02, &mut extreme);
    }
    println!("{}: {usual:?}, with extreme numbers {extreme:?}", M::NAME);
    assert!(
        usual.accepted as f64 > least_accepted * (usual.accepted + usual.rejected) as f64,
        "{}: {usual:?}",
        M::NAME
    );
    assert!(extreme.rejected > 0, "{}: {extreme:?}", M::NAME);
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
    every_function: EveryFunction EveryFunctionBranch 0.1;
    five_bar: FiveBar FiveBarBranch 0.1;
    geared_five_bar: GearedFiveBar GearedFiveBarBranch 0.1;
    geneva: Geneva GenevaBranch 0.1;
    inverted_slider_crank: InvertedSliderCrank InvertedSliderCrankBranch 0.1;
    jansen: Jansen JansenBranch 0.1;
    klann: Klann KlannBranch 0.1;
    norton_four_bar: NortonFourBar NortonFourBarBranch 0.1;
    offset_slider_crank: OffsetSliderCrank OffsetSliderCrankBranch 0.1;
    scotch_yoke: ScotchYoke ScotchYokeBranch 0.1;
    stephenson_ii: StephensonII StephensonIIBranch 0.1;
    three_link_arm: ThreeLinkArm ThreeLinkArmBranch 0.99;
}
