//! Nanoseconds for position, velocity and acceleration of five mechanisms: the emitted functions, the same closed forms
//! written by hand, and dual numbers with LU and Newton's method; medians of alternating rounds, and their ratios to
//! the code by hand in the same run.
//!
//! `cargo bench --bench poses`

#[path = "../by_hand/mod.rs"]
mod by_hand;
mod dual;
mod long_chain;
mod mechanisms;

use std::hint::black_box;
use std::time::Instant;

use by_hand::chain::Loop;
use linkage::nalgebra::SVector;
use linkage::{Elbow, PositionError, Slider};
use long_chain::{Chain, ChainBranch, ChainCoordinates, ChainKinematics, ChainMotion};
use mechanisms::{
    FourBar, FourBarBranch, FourBarCoordinates, FourBarKinematics, FourBarMotion, Jansen, JansenBranch,
    JansenCoordinates, JansenKinematics, JansenMotion, ShortChain, ShortChainBranch, ShortChainCoordinates,
    ShortChainKinematics, ShortChainMotion, SliderCrank, SliderCrankBranch, SliderCrankCoordinates,
    SliderCrankKinematics, SliderCrankMotion, StephensonIII, StephensonIIIBranch, StephensonIIICoordinates,
    StephensonIIIKinematics, StephensonIIIMotion,
};

const COUNT: usize = 1000;
const ROUNDS: usize = 201;
const RATE: f64 = 41.9;
const ACCELERATION: f64 = 3.7;

/// One way to compute: its name, and the nanoseconds for all arguments of one round.
type Way<'a> = (&'a str, Box<dyn Fn() -> f64 + 'a>);

/// A way that takes these arguments one by one.
fn way<'a, A, R: 'a>(name: &'a str, arguments: &'a [A], work: impl Fn(&A) -> R + 'a) -> Way<'a> {
    let time = move || {
        let start = Instant::now();
        for argument in arguments {
            // By reference: a copy of the result would cost a tenth of the evaluation.
            black_box(&work(black_box(argument)));
        }
        start.elapsed().as_secs_f64() * 1e9 / arguments.len() as f64
    };
    (name, Box::new(time))
}

/// Prints the medians, and their ratios to each of the last `references` ways.
fn table(title: &str, ways: &[Way], references: usize) {
    let mut times = vec![Vec::new(); ways.len()];
    for _ in 0..ROUNDS {
        for ((_, time), times) in ways.iter().zip(&mut times) {
            times.push(time());
        }
    }
    let median = |mut times: Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[ROUNDS / 2]
    };
    let medians: Vec<f64> = times.into_iter().map(median).collect();
    println!("{title}");
    for ((name, _), time) in ways.iter().zip(&medians) {
        let ratios = medians[ways.len() - references..].iter().map(|reference| format!(" {:5.2}", time / reference));
        println!("  {name:40} {time:7.1} ns{}", ratios.collect::<String>());
    }
}

/// Angles in small steps.
fn angles() -> Vec<f64> {
    (0..COUNT).map(|index| 0.2 + 0.3 * index as f64 / COUNT as f64).collect()
}

/// The code by hand and that by dual numbers compute what the emitted code does.
fn assert_same<'a>(ours: impl IntoIterator<Item = &'a f64>, theirs: impl IntoIterator<Item = &'a f64>) {
    for (ours, theirs) in ours.into_iter().zip(theirs) {
        assert!((ours - theirs).abs() <= 1e-9 * ours.abs().max(1e-6), "{ours}, another way {theirs}");
    }
}

/// Both tables of a mechanism: from the input, and at coordinates.
macro_rules! compare {
    ($title:literal, $Mechanism:ty, $branch:expr, $checked:expr, $bare:expr, $at:expr, $dual:expr) => {{
        let m = &black_box(<$Mechanism>::default());
        let branch = $branch;
        let thetas = angles();
        let coordinates = |&theta: &f64| m.assemble(theta, branch).expect("a position").coordinates();
        let positions: Vec<_> = thetas.iter().map(coordinates).collect();
        // From a guess half a degree away.
        let starts: Vec<_> = thetas.iter().copied().zip(positions.iter().skip(29)).collect();
        let (checked, bare, at, dual) = ($checked, $bare, $at, $dual);
        for (&(theta, guess), q) in starts.iter().zip(&positions) {
            let ours = m.motion(q, RATE, ACCELERATION).expect("a motion").numbers();
            assert_same(&ours, &at(m, q).expect("a motion").numbers());
            let [_, rates, accelerations] = dual(m, theta, guess).expect("a motion");
            assert_same(&ours, rates.iter().chain(&accelerations));
        }
        let (ours, theirs) = (m.kinematics(0.3, branch, RATE, ACCELERATION), checked(m, 0.3));
        let (ours, theirs) = (ours.expect("a motion").numbers(), theirs.expect("a motion").numbers());
        assert_same(&ours, &theirs);
        let ways = [
            way("kinematics", &thetas, |&theta| m.kinematics(theta, branch, RATE, ACCELERATION)),
            way("assemble, velocity, acceleration", &thetas, |&theta| {
                let pose = m.assemble(theta, branch)?;
                let rates = m.velocity(&pose, RATE)?;
                let accelerations = m.acceleration(&pose, &rates, ACCELERATION)?;
                Ok::<_, PositionError>((pose, rates, accelerations))
            }),
            way("dual numbers, LU, Newton's method", &starts, |&(theta, guess)| dual(m, theta, guess)),
            way("by hand, the same result and checks", &thetas, |&theta| checked(m, theta)),
            way("by hand, link vectors, no checks", &thetas, |&theta| bare(m, theta)),
        ];
        table(concat!($title, ", from the input"), &ways, 2);
        let ways = [
            way("motion", &positions, |q| m.motion(q, RATE, ACCELERATION)),
            way("pose_at, velocity, acceleration", &positions, |q| {
                let pose = m.pose_at(q);
                let rates = m.velocity(&pose, RATE)?;
                let accelerations = m.acceleration(&pose, &rates, ACCELERATION)?;
                Ok::<_, PositionError>((pose, rates, accelerations))
            }),
            way("by hand, the same sines", &positions, |q| at(m, q)),
        ];
        table(concat!($title, ", at coordinates"), &ways, 1);
    }};
}

fn main() {
    compare!(
        "Four-bar",
        FourBar,
        FourBarBranch::new(Elbow::Left),
        |m: &FourBar, theta| by_hand::four_bar::checked(m, theta, RATE, ACCELERATION, 1.0),
        |m: &FourBar, theta| by_hand::four_bar::bare(m, theta, RATE, ACCELERATION, 1.0),
        |m: &FourBar, q: &FourBarCoordinates| by_hand::four_bar::at(m, q, RATE, ACCELERATION),
        |m: &FourBar, theta, q: &FourBarCoordinates| {
            dual::two(m, theta, RATE, ACCELERATION, [q.theta3, q.theta4].into())
        }
    );
    compare!(
        "Slider-crank",
        SliderCrank,
        SliderCrankBranch::new(Slider::Far),
        |m: &SliderCrank, theta| by_hand::slider_crank::checked(m, theta, RATE, ACCELERATION, 1.0),
        |m: &SliderCrank, theta| by_hand::slider_crank::bare(m, theta, RATE, ACCELERATION, 1.0),
        |m: &SliderCrank, q: &SliderCrankCoordinates| by_hand::slider_crank::at(m, q, RATE, ACCELERATION),
        |m: &SliderCrank, theta, q: &SliderCrankCoordinates| {
            dual::two(m, theta, RATE, ACCELERATION, [q.phi, q.s].into())
        }
    );
    compare!(
        "Stephenson III",
        StephensonIII,
        StephensonIIIBranch::new(Elbow::Left, Elbow::Left),
        |m: &StephensonIII, theta| by_hand::stephenson_iii::checked(m, theta, RATE, ACCELERATION, [1.0; 2]),
        |m: &StephensonIII, theta| by_hand::stephenson_iii::bare(m, theta, RATE, ACCELERATION, [1.0; 2]),
        |m: &StephensonIII, q: &StephensonIIICoordinates| by_hand::stephenson_iii::at(m, q, RATE, ACCELERATION),
        |m: &StephensonIII, theta, q: &StephensonIIICoordinates| {
            dual::four(m, theta, RATE, ACCELERATION, [q.theta3, q.theta4, q.theta5, q.theta6].into())
        }
    );
    let sides = [1.0, 1.0, -1.0, -1.0, -1.0];
    compare!(
        "Jansen leg",
        Jansen,
        JansenBranch::new(Elbow::Left, Elbow::Left, Elbow::Right, Elbow::Right, Elbow::Left),
        |m: &Jansen, theta| by_hand::jansen::checked(m, theta, RATE, ACCELERATION, sides),
        |m: &Jansen, theta| by_hand::jansen::bare(m, theta, RATE, ACCELERATION, sides),
        |m: &Jansen, q: &JansenCoordinates| by_hand::jansen::at(m, q, RATE, ACCELERATION),
        |m: &Jansen, theta, q: &JansenCoordinates| {
            dual::ten(m, theta, RATE, ACCELERATION, SVector::from(*q).fixed_rows::<10>(0).into_owned())
        }
    );
    let lengths = &black_box([[1.0, 3.0, 2.0, 3.0]; 4]);
    compare!(
        "Chain of 4 four-bars",
        ShortChain,
        ShortChainBranch::all().last().expect("branches"),
        |_: &ShortChain, theta| by_hand::chain::checked(lengths, theta, RATE, ACCELERATION, &[-1.0; 4]),
        |_: &ShortChain, theta| by_hand::chain::bare(lengths, theta, RATE, ACCELERATION, &[-1.0; 4]),
        |_: &ShortChain, q: &ShortChainCoordinates| {
            let angles = links(SVector::<f64, 9>::from(*q).as_slice());
            by_hand::chain::at(lengths, q.theta, &angles, RATE, ACCELERATION)
        },
        |_: &ShortChain, theta, q: &ShortChainCoordinates| {
            dual::eight(lengths, theta, RATE, ACCELERATION, SVector::from(*q).fixed_rows::<8>(0).into_owned())
        }
    );
    let lengths = &black_box([[1.0, 3.0, 2.0, 3.0]; 16]);
    compare!(
        "Chain of 16 four-bars",
        Chain,
        ChainBranch::all().last().expect("branches"),
        |_: &Chain, theta| by_hand::chain::checked(lengths, theta, RATE, ACCELERATION, &[-1.0; 16]),
        |_: &Chain, theta| by_hand::chain::bare(lengths, theta, RATE, ACCELERATION, &[-1.0; 16]),
        |_: &Chain, q: &ChainCoordinates| {
            let angles = links(SVector::<f64, 33>::from(*q).as_slice());
            by_hand::chain::at(lengths, q.theta, &angles, RATE, ACCELERATION)
        },
        |_: &Chain, theta, q: &ChainCoordinates| {
            dual::thirty_two(lengths, theta, RATE, ACCELERATION, SVector::from(*q).fixed_rows::<32>(0).into_owned())
        }
    );
}

/// The rates and accelerations of the unknowns, one after the other.
trait Numbers {
    fn numbers(&self) -> Vec<f64>;
}

impl<const N: usize> Numbers for [[[f64; 2]; N]; 2] {
    fn numbers(&self) -> Vec<f64> {
        self.as_flattened().as_flattened().to_vec()
    }
}

impl<const N: usize> Numbers for [Loop; N] {
    fn numbers(&self) -> Vec<f64> {
        assert!(self.iter().all(|solved| solved.determinant > 0.0), "all to the right");
        let (rates, accelerations) = (self.map(|solved| solved.rates), self.map(|solved| solved.accelerations));
        let angles = self.map(|solved| solved.links.map(|[x, y]| y.atan2(x)));
        [rates, accelerations].numbers().into_iter().chain(angles.as_flattened().iter().copied()).collect()
    }
}

macro_rules! numbers {
    ($($Motion:ty, $Kinematics:ty, $unknowns:literal;)*) => {$(
        impl Numbers for $Kinematics {
            fn numbers(&self) -> Vec<f64> {
                let position: SVector<f64, { $unknowns + 1 }> = self.pose.coordinates().into();
                let both: [SVector<f64, { $unknowns + 1 }>; 2] = [self.rates.into(), self.accelerations.into()];
                let moving = both.iter().flat_map(|all| all.iter().take($unknowns));
                moving.chain(&position).copied().collect()
            }
        }

        impl Numbers for $Motion {
            fn numbers(&self) -> Vec<f64> {
                let both: [SVector<f64, { $unknowns + 1 }>; 2] = [self.rates.into(), self.accelerations.into()];
                both.iter().flat_map(|all| all.iter().take($unknowns).copied()).collect()
            }
        }
    )*};
}

numbers! {
    FourBarMotion, FourBarKinematics, 2;
    SliderCrankMotion, SliderCrankKinematics, 2;
    StephensonIIIMotion, StephensonIIIKinematics, 4;
    JansenMotion, JansenKinematics, 10;
    ShortChainMotion, ShortChainKinematics, 8;
    ChainMotion, ChainKinematics, 32;
}

/// The angles of couplers and rockers.
fn links<const N: usize>(q: &[f64]) -> [[f64; 2]; N] {
    std::array::from_fn(|index| [q[2 * index], q[2 * index + 1]])
}
