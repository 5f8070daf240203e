//! Evaluates one function of a mechanism of the bench a number of times, for `tests/instructions.rs`.
//!
//! `cargo bench --bench kernels -- four_bar kinematics 1000` calls it a thousand times.

mod mechanisms;

use std::hint::black_box;

use linkage::lanes::Lanes;
use linkage::{Elbow, Slider};
use mechanisms::{
    FourBar, FourBarBranch, FourBarInputs, Jansen, JansenBranch, JansenInputs, ShortChain, ShortChainBranch,
    SliderCrank, SliderCrankBranch, StephensonIII, StephensonIIIBranch,
};

const RATE: f64 = 41.9;
const ACCELERATION: f64 = 3.7;

fn repeat<R>(calls: usize, work: impl Fn(f64) -> R) {
    for call in 0..calls {
        black_box(&work(black_box(0.2 + 1e-4 * call as f64)));
    }
}

macro_rules! functions {
    ($m:expr, $branch:expr, $function:expr, $calls:expr) => {{
        let (m, branch) = (&black_box($m), $branch);
        let pose = m.assemble(0.3, branch).expect("a position");
        let (pose, q) = (&black_box(pose), &black_box(pose.coordinates()));
        let rates = &black_box(m.velocity(pose, RATE).expect("a velocity"));
        match $function {
            "kinematics" => repeat($calls, |theta| m.kinematics(theta, branch, RATE, ACCELERATION)),
            "assemble" => repeat($calls, |theta| m.assemble(theta, branch)),
            "velocity" => repeat($calls, |rate| m.velocity(pose, rate)),
            "acceleration" => repeat($calls, |acceleration| m.acceleration(pose, rates, acceleration)),
            "pose_at" => repeat($calls, |_| m.pose_at(q)),
            "motion" => repeat($calls, |rate| m.motion(q, rate, ACCELERATION)),
            other => panic!("no function {other}"),
        }
    }};
}

/// Eight lanes a call, without vector instructions that not every machine has.
macro_rules! lanes {
    ($Mechanism:ident, $Inputs:ident, $branch:expr, $calls:expr) => {{
        let angles: [f64; 8] = std::array::from_fn(|lane| 0.2 + 0.03 * lane as f64);
        let start = $Inputs { theta: angles.as_slice() };
        let batch = $Mechanism::batch($Mechanism::default(), start, $branch, RATE.into(), ACCELERATION.into());
        let (batch, mut accepted) = (batch.expect("one column"), [false; 8]);
        let mut columns = [[0.0; 8]; 40];
        let mut asked = columns.iter_mut().map(|column| Some(column.as_mut_slice()));
        let mut list: Vec<_> = (0..$Mechanism::<f64>::FOUND.len())
            .map(|place| if place < $Mechanism::<f64>::COORDINATES { asked.next().flatten() } else { None })
            .collect();
        for _ in 0..$calls {
            assert_eq!(black_box(&batch).run(&mut list, &mut accepted), Ok(0));
        }
    }};
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    let [mechanism, function, calls] = arguments.as_slice() else { panic!("a mechanism, a function, a number") };
    let (function, calls) = (function.as_str(), calls.parse().expect("a number of calls"));
    let (left, right) = (Elbow::Left, Elbow::Right);
    match mechanism.as_str() {
        "four_bar" if function == "lanes" => lanes!(FourBar, FourBarInputs, FourBarBranch::new(left), calls),
        "jansen" if function == "lanes" => {
            lanes!(Jansen, JansenInputs, JansenBranch::new(left, left, right, right, left), calls);
        }
        "four_bar" => functions!(FourBar::default(), FourBarBranch::new(left), function, calls),
        "slider_crank" => functions!(SliderCrank::default(), SliderCrankBranch::new(Slider::Far), function, calls),
        "stephenson_iii" => functions!(StephensonIII::default(), StephensonIIIBranch::new(left, left), function, calls),
        "jansen" => functions!(Jansen::default(), JansenBranch::new(left, left, right, right, left), function, calls),
        "chain" => {
            functions!(ShortChain::default(), ShortChainBranch::new(right, right, right, right), function, calls);
        }
        other => panic!("no mechanism {other}"),
    }
}
