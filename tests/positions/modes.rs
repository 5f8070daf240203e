//! Positions by number: all positions of groups of two and three loops.

use linkage::{AssemblyMode, Branches, Mechanism, PositionError, linkage};
use linkage_gallery::double_butterfly::*;
use linkage_gallery::slider_triad::*;
use linkage_gallery::stephenson_far::*;
use linkage_gallery::stephenson_iii::*;
use linkage_gallery::swivel_triad::*;
use linkage_gallery::three_rrr::*;
use linkage_gallery::two_triads::*;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

linkage! {
    /// The robot 3-RPR by the lengths of its legs: three distances give a position and an angle.
    #[derive(Debug, Clone)]
    mechanism Platform {
        param b = 2, c = 1.5, delta = 1, a2x = 5, a3x = 2, a3y = 4;
        input l1, l2, l3;
        unknown x, y, phi;
        equation norm((x, y)) = l1;
        equation norm((x, y) + b@phi - (a2x, 0)) = l2;
        equation norm((x, y) + c@(phi + delta) - (a3x, a3y)) = l3;
    }

    /// Levers at one height, each with two positions.
    #[derive(Debug, Clone)]
    mechanism Comb {
        param r = 1;
        input h;
        unknown a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15, a16;
        equation r * sin(a0) = h;
        equation r * sin(a1) = h;
        equation r * sin(a2) = h;
        equation r * sin(a3) = h;
        equation r * sin(a4) = h;
        equation r * sin(a5) = h;
        equation r * sin(a6) = h;
        equation r * sin(a7) = h;
        equation r * sin(a8) = h;
        equation r * sin(a9) = h;
        equation r * sin(a10) = h;
        equation r * sin(a11) = h;
        equation r * sin(a12) = h;
        equation r * sin(a13) = h;
        equation r * sin(a14) = h;
        equation r * sin(a15) = h;
        equation r * sin(a16) = h;
    }
}

/// The listed positions with their branches: the equations hold, `assemble` finds each by its branch, and so does
/// `assemble_near` from its coordinates without a number.
macro_rules! listed {
    ($m:expr, $inputs:expr) => {{
        let (m, inputs) = (&$m, $inputs);
        let mut found = Vec::new();
        for one in m.branches(inputs).unwrap() {
            let q = one.pose.coordinates();
            assert_eq!(m.assemble(inputs, one.branch).unwrap().coordinates(), q);
            let near = m.assemble_near(&q, m.branch_of(&one.pose)).unwrap();
            for pose in [one.pose, near] {
                for (residual, scale) in m.residual(&pose).iter().zip(&m.residual_scales(&pose)) {
                    assert!(residual.abs() <= 4.0 * f64::EPSILON * scale, "{residual} of {scale}");
                }
            }
            found.push((one.branch, q));
        }
        assert_eq!(found, m.all_positions(inputs.into()).unwrap().collect::<Vec<_>>());
        found
    }};
}

/// True if two angles differ by full turns at most.
fn is_same_angle(one: f64, other: f64) -> bool {
    (one - other).sin().abs() < 1e-7 && (one - other).cos() > 0.0
}

/// The counts of the real positions are those of the Dixon determinant in another program.
#[test]
fn double_butterfly() {
    let m = DoubleButterfly::default();
    for (crank, count) in [(0.0, 8), (1.0, 8), (2.5, 10)] {
        let found = listed!(m, crank);
        assert_eq!(found.len(), count, "{crank}");
        let numbers = (0..count).map(AssemblyMode::Number);
        let of_group = |branch: &DoubleButterflyBranch| branch.coupler_upper_rocker_lower_link_strut;
        assert!(found.iter().map(|(branch, _)| of_group(branch)).eq(numbers));
        assert!(found.is_sorted_by(|(_, one), (_, next)| one.coupler < next.coupler));
        let beyond = DoubleButterflyBranch { coupler_upper_rocker_lower_link_strut: AssemblyMode::Number(count) };
        let error = m.assemble(crank, beyond).unwrap_err();
        assert!(matches!(error, PositionError::NoMode { number, count: all, .. } if number == count && all == count));
    }
    let error = m.assemble(1.0, DoubleButterflyBranch::default()).unwrap_err();
    assert!(matches!(error, PositionError::NoClosedForm { mechanism: "DoubleButterfly", .. }));
    assert!(matches!(m.branches(f64::NAN).map(Iterator::count), Err(PositionError::NotFinite { .. })));
}

/// The chain driven from its far side has the positions that it has with the crank driven: those are in closed form.
#[test]
fn stephenson_from_both_sides() {
    let (near, far) = (StephensonIII::default(), StephensonFar::default());
    let (mut planted, mut most) = (0, 0);
    for step in 0..40 {
        for one in near.branches(0.15 + 0.157 * f64::from(step)).unwrap() {
            let p = one.pose.coordinates();
            let found = listed!(far, p.theta6);
            // With the two positions of the dyad after them.
            most = most.max(found.len());
            let is_planted = |q: &StephensonFarCoordinates| {
                let pairs = [(q.crank, p.theta2), (q.coupler, p.theta3), (q.rocker, p.theta4), (q.rod, p.theta5)];
                pairs.into_iter().all(|(one, other)| is_same_angle(one, other))
            };
            let places: Vec<_> = found.iter().filter(|(_, q)| is_planted(q)).map(|(branch, _)| *branch).collect();
            assert_eq!(places.len(), 2, "{p:?}");
            assert_eq!(places[0].crank_coupler_rocker_rod, places[1].crank_coupler_rocker_rod);
            assert_ne!(places[0].link_arm, places[1].link_arm);
            planted += 1;
            for (_, q) in found {
                let back = near.branches(q.crank).unwrap().map(|one| one.pose.coordinates());
                assert!(back.into_iter().any(|p| is_same_angle(p.theta6, q.swing)), "{q:?}");
            }
        }
    }
    println!("{planted} positions, at most {most} at one input");
    assert!(planted > 80 && most <= 12);
}

/// Chains with a slider, driven from the rocker, have the positions that they have with the crank driven: those are in
/// closed form. The last argument is the length.
macro_rules! from_both_sides {
    ($near:expr, $far:expr, $slider:ident) => {{
        let (near, far) = ($near, $far);
        let (mut planted, mut most) = (0, 0);
        for step in 0..80 {
            for one in near.branches(0.15 + 0.0785 * f64::from(step)).unwrap() {
                let p = one.pose.coordinates();
                let found = listed!(far, p.swing);
                most = most.max(found.len());
                let same = found.iter().filter(|(_, q)| {
                    let pairs = [(q.crank, p.crank), (q.coupler, p.coupler), (q.rod, p.rod)];
                    (q.$slider - p.$slider).abs() < 1e-6
                        && pairs.into_iter().all(|(one, other)| is_same_angle(one, other))
                });
                assert_eq!(same.count(), 1, "{p:?}");
                planted += 1;
                for (_, q) in found {
                    let mut back = near.branches(q.crank).unwrap().map(|one| one.pose.coordinates());
                    let is_there =
                        back.any(|p| is_same_angle(p.swing, q.swing) && (q.$slider - p.$slider).abs() < 1e-6);
                    assert!(is_there, "{q:?}");
                }
            }
        }
        println!("{planted} positions, at most {most} at one input");
        assert!(planted > 120);
        most
    }};
}

/// A length along a given line.
#[test]
fn slider_from_both_sides() {
    assert_eq!(from_both_sides!(SliderTriadNear::default(), SliderTriadFar::default(), slide), 6);
}

/// A length along a line that turns with an unknown angle.
#[test]
fn swivel_from_both_sides() {
    assert_eq!(from_both_sides!(SwivelTriadNear::default(), SwivelTriadFar::default(), reach), 6);
}

#[test]
fn three_legs() {
    let m = ThreeRrr::default();
    let mut most = 0;
    for step in 0..200 {
        let angle = |rate: f64| f64::from(step) * rate;
        let inputs = ThreeRrrInputs { first: angle(0.37), second: angle(1.13), third: angle(2.71) };
        let found = listed!(m, inputs);
        most = most.max(found.len());
        assert!(found.len() <= 6 && found.len() % 2 == 0);
        for (_, q) in &found {
            for angle in [q.platform, q.rod1, q.rod2, q.rod3] {
                assert!(angle.abs() <= std::f64::consts::PI);
            }
        }
    }
    println!("at most {most}");
    assert_eq!(most, 6);
}

/// A second group for each position of the first, joint angles, and a clockwise angle.
#[test]
fn groups_in_a_row() {
    let m = TwoTriads::default();
    let found = listed!(m, 1.0);
    let planted = TwoTriadsCoordinates {
        v: 1.0,
        psi: 0.475,
        chi: 1.69,
        u1: 0.4,
        u2: -1.1,
        u3: -2.0,
        u4: 0.9,
        w1: 1.9,
        w2: 0.3,
        w3: 2.6,
        w4: -0.5,
    };
    let branch = m.branch_near(&planted);
    assert_eq!(branch.u1_u2_u3_u4, AssemblyMode::OfGuess);
    let near = m.assemble_near(&planted, branch).unwrap().coordinates();
    let is_planted = |(other, q): &&(TwoTriadsBranch, TwoTriadsCoordinates)| {
        let pairs = [(q.u1, near.u1), (q.u2, near.u2), (q.u3, near.u3), (q.w1, near.w1), (q.w4, near.w4)];
        other.psi_chi == branch.psi_chi && pairs.into_iter().all(|(one, other)| is_same_angle(one, other))
    };
    assert_eq!(found.iter().filter(is_planted).count(), 1);
    // The numbers of the last group change fastest.
    let numbers = |branch: &TwoTriadsBranch| match (branch.u1_u2_u3_u4, branch.w1_w2_w3_w4) {
        (AssemblyMode::Number(one), AssemblyMode::Number(other)) => (one, other),
        _ => panic!("{branch:?} has numbers"),
    };
    let mut most = 0;
    for step in 0..63 {
        let found = listed!(m, 0.1 * f64::from(step));
        for side in found.chunk_by(|(one, _), (other, _)| one.psi_chi == other.psi_chi) {
            let numbers: Vec<_> = side.iter().map(|(branch, _)| numbers(branch)).collect();
            assert!(numbers.is_sorted_by(|one, next| one < next), "{numbers:?}");
            most = most.max(numbers.chunk_by(|one, other| one.0 == other.0).count());
        }
    }
    assert!(most > 1, "the second group has positions for {most} of the first");
}

linkage::linkage! {
    /// Two links to one slider along an axis: its length is in two loops.
    mechanism OneSlider {
        param a = 2, b = 4, c = 3, d = 5, e = 4, x = 1, y = 2, h = 0.5;
        input v;
        unknown p, q, r, s;
        loop a@v + b@p + c@q = (s, h);
        loop (s, h) + d@q = (x, y) + e@r;
    }

    /// A slider on a link and one along an axis.
    mechanism TwoSliders {
        param a = 2, b = 3, c = 1, f = 4, x = 1, y = 2;
        input v;
        unknown p, q, s, t;
        loop a@v + b@p + (s, c)@q = (x, y);
        loop a@v - c@p + f@q = (x, t);
    }

    /// Three loops with a slider along an axis, and a joint by its coordinates.
    mechanism ThreeLoops {
        param a = 2, b = 5, c = 4, d = 6, e = 3, f = 7, g = 2;
        input v;
        unknown x, y, p, q, r, t, w, s;
        loop a@v + b@p = (x, y);
        loop (x, y) + c@q = d@0 + e@r;
        loop (x, y) + f@q = (1, 2) + c@t + g@w;
        loop d@0 + (g, 1)@r + e@w = (s, -1);
    }
}

/// Newton's method from random starts has no position that the list has not; each position found is in it.
macro_rules! is_whole {
    ($Mechanism:ident, $Coordinates:ident, $Branch:ident, [$($angle:ident)+], [$($length:ident)+]) => {{
        let m = $Mechanism::default();
        let mut random = SmallRng::seed_from_u64(3);
        let (mut counts, mut reached) = (vec![0; 21], 0);
        for step in 0..30 {
            let v = 0.21 * f64::from(step);
            let found = listed!(m, v);
            counts[found.len()] += 1;
            for _ in 0..40 {
                let angle = $Coordinates {
                    v,
                    $($angle: random.random_range(-3.1..3.1),)+
                    $($length: random.random_range(-6.0..6.0),)+
                };
                let Ok(near) = m.assemble_near(&angle, $Branch::default()) else { continue };
                let one = near.coordinates();
                let is_there = |(_, q): &($Branch, $Coordinates)| {
                    $(is_same_angle(one.$angle, q.$angle) &&)+ $((one.$length - q.$length).abs() < 1e-6 &&)+ true
                };
                assert_eq!(found.iter().filter(|found| is_there(found)).count(), 1, "{one:?} of {found:?}");
                reached += 1;
            }
        }
        println!("{}: {counts:?} by number of positions, reached {reached} times", stringify!($Mechanism));
        assert!(reached > 100);
    }};
}

#[test]
fn sliders_on_axes() {
    is_whole!(OneSlider, OneSliderCoordinates, OneSliderBranch, [p q r], [s]);
    is_whole!(TwoSliders, TwoSlidersCoordinates, TwoSlidersBranch, [p q], [s t]);
    is_whole!(ThreeLoops, ThreeLoopsCoordinates, ThreeLoopsBranch, [p q r t w], [x y s]);
}

/// `branches` of a mechanism whose positions cannot be listed says why: a warning at the call, and an error.
#[test]
fn branches_that_cannot_be_listed() {
    // A platform on three legs, by the squares of its distances.
    let m = Platform::default();
    #[expect(deprecated, reason = "the warning is what is tested")]
    let error = m.branches(PlatformInputs { l1: 3.0, l2: 3.0, l3: 3.0 }).err();
    assert_eq!(error, Some(PositionError::NoClosedForm { mechanism: "Platform", group: "x, y, phi" }));
    // 17 links with two positions each have 131072 branches.
    #[expect(deprecated, reason = "the warning is what is tested")]
    let error = Comb::default().branches(0.3).err().unwrap();
    assert_eq!(error, PositionError::TooManyBranches { mechanism: "Comb" });
    assert_eq!(error.to_string(), "Comb has too many branches to list its positions: use `assemble` with one of them");
    // Each of them can be assembled.
    assert_eq!(CombBranch::all().count(), 1 << 17);
    let last = CombBranch::all().last().unwrap();
    let pose = Comb::default().assemble(0.3, last).unwrap();
    assert_eq!(Comb::default().branch_of(&pose), last);
}
