//! The N-four-bar of the benchmark library of IFToMM (problem A02, lim.ii.udc.es/mbsbenchmark) in its official size:
//! forty windows of 81 uniform bars of 1 m and 1 kg start upright with 1 m/s and turn for 20 s. Twice a turn all bars
//! are in line, at a change point of 41 motions.
//!
//! `cargo run --release --example windows` prints the error of the first joint relative to the exact solution of phi''
//! = k sin(phi), k = g/l ((N + 1)/2 + N) / ((N + 1)/3 + N), computed with 25 digits.

use std::time::Instant;

use linkage::linkage;
use linkage::simulation::{Start, simulate};

/// A chain of windows, each given by left upright, bar, right upright, their bodies and its number.
macro_rules! windows {
    ($mechanism:ident, $scene:ident, $first:ident, $([$left:ident $bar:ident $right:ident $upright:ident $beam:ident $at:tt])*) => {
        linkage! {
            /// Uprights on the ground, one metre apart, joined by bars; angles from the horizontal.
            #[derive(Debug, Clone, PartialEq)]
            pub mechanism $mechanism {
                param l = 1, m = 1, g = 9.81;
                input $first;
                unknown $($bar, $right),*;
                $(loop (($at - 1) * l, 0) + l@$left + l@$bar = ($at * l, 0) + l@$right;)*

                let j = m * l^2 / 12;
                body upright0 { mass m; inertia j; center (l/2)@$first; angle $first; }
                $(body $upright { mass m; inertia j; center ($at * l, 0) + (l/2)@$right; angle $right; })*
                $(body $beam { mass m; inertia j; center (($at - 1) * l, 0) + l@$left + (l/2)@$bar; angle $bar; })*

                scene $scene { inertia; gravity (0, -g); energy; }
            }
        }

        impl FortyWindowsCoordinates {
            fn upright() -> Self {
                let up = std::f64::consts::FRAC_PI_2;
                Self { $first: up, $($bar: 0.0, $right: up),* }
            }

            /// The deviations of the uprights from parallel, and of the bars from horizontal.
            fn spread(&self) -> f64 {
                [$(self.$right - self.$first, self.$bar),*].into_iter().fold(0.0, |spread, angle| spread.max(angle.abs()))
            }
        }
    };
}

windows! {
    FortyWindows, Falling, phi0,
    [phi0 psi1 phi1 upright1 bar1 1] [phi1 psi2 phi2 upright2 bar2 2]
    [phi2 psi3 phi3 upright3 bar3 3] [phi3 psi4 phi4 upright4 bar4 4]
    [phi4 psi5 phi5 upright5 bar5 5] [phi5 psi6 phi6 upright6 bar6 6]
    [phi6 psi7 phi7 upright7 bar7 7] [phi7 psi8 phi8 upright8 bar8 8]
    [phi8 psi9 phi9 upright9 bar9 9] [phi9 psi10 phi10 upright10 bar10 10]
    [phi10 psi11 phi11 upright11 bar11 11] [phi11 psi12 phi12 upright12 bar12 12]
    [phi12 psi13 phi13 upright13 bar13 13] [phi13 psi14 phi14 upright14 bar14 14]
    [phi14 psi15 phi15 upright15 bar15 15] [phi15 psi16 phi16 upright16 bar16 16]
    [phi16 psi17 phi17 upright17 bar17 17] [phi17 psi18 phi18 upright18 bar18 18]
    [phi18 psi19 phi19 upright19 bar19 19] [phi19 psi20 phi20 upright20 bar20 20]
    [phi20 psi21 phi21 upright21 bar21 21] [phi21 psi22 phi22 upright22 bar22 22]
    [phi22 psi23 phi23 upright23 bar23 23] [phi23 psi24 phi24 upright24 bar24 24]
    [phi24 psi25 phi25 upright25 bar25 25] [phi25 psi26 phi26 upright26 bar26 26]
    [phi26 psi27 phi27 upright27 bar27 27] [phi27 psi28 phi28 upright28 bar28 28]
    [phi28 psi29 phi29 upright29 bar29 29] [phi29 psi30 phi30 upright30 bar30 30]
    [phi30 psi31 phi31 upright31 bar31 31] [phi31 psi32 phi32 upright32 bar32 32]
    [phi32 psi33 phi33 upright33 bar33 33] [phi33 psi34 phi34 upright34 bar34 34]
    [phi34 psi35 phi35 upright35 bar35 35] [phi35 psi36 phi36 upright36 bar36 36]
    [phi36 psi37 phi37 upright37 bar37 37] [phi37 psi38 phi38 upright38 bar38 38]
    [phi38 psi39 phi39 upright39 bar39 39] [phi39 psi40 phi40 upright40 bar40 40]
}

/// The exact angle from upright at 10 s and 20 s.
const EXACT: [(f64, f64); 2] = [(10.0, 31.597_433_743_985_77), (20.0, 63.255_295_368_190_93)];

fn main() -> Result<(), linkage::Error> {
    let scene = Falling::default();
    println!("tolerance   error of joint B0, m, at 10 s and 20 s   uprights   right-hand sides   change points    s");
    for tolerance in [1e-8, 1e-10, 1e-12, 1e-14] {
        let clock = Instant::now();
        let mut motion = simulate(
            &scene,
            Start { t: 0.0, q: FortyWindowsCoordinates::upright(), input_rates: -1.0 },
            20.0,
            tolerance,
        )?;
        let (mut off, mut spread) = (Vec::new(), 0.0_f64);
        for state in motion.at(EXACT.map(|(t, _)| t)) {
            let q = state?.q;
            let (_, angle) = EXACT[off.len()];
            off.push((q.phi0.cos() - angle.sin()).hypot(q.phi0.sin() - angle.cos()));
            spread = spread.max(q.spread());
        }
        let (evaluations, passages) = (motion.counts().evaluations, motion.passages().change_points);
        let (ten, twenty, seconds) = (off[0], off[1], clock.elapsed().as_secs_f64());
        println!(
            "{tolerance:9.0e} {ten:19.1e} {twenty:12.1e} {spread:16.0e} {evaluations:18} {passages:15} {seconds:8.2}"
        );
    }
    Ok(())
}
