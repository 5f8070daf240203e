//! Facts about a mechanism in the trait `Certifiable`.

use std::f64::consts::{PI, TAU};

use linkage::certify::Certify;
use linkage::{Certifiable, Column, Formulas, Interval, Mechanism, Number, linkage};
use linkage_gallery::Fixture;
use linkage_gallery::cam_rocker::CamRocker;
use linkage_gallery::listed::{self, same_as};
use linkage_oracle::{Oracle, all_close};

use crate::intervals::formulas::{At, Enclosable};

/// Psi is the same after the turns of one coordinate or of two together for which `repeats` says so.
pub fn turns_leave_the_residual(of: &Enclosable) {
    let oracle = Oracle::of(of);
    let (unknowns, count) = (oracle.derivation.unknowns.len(), oracle.derivation.coordinates.len());
    let parameters = same_as(listed::all(), of).defaults();
    // Psi where no user function makes it NaN.
    let residual =
        |at: &At<f64>| -> Vec<f64> { of.values(at)[..unknowns].iter().copied().filter(|psi| !psi.is_nan()).collect() };
    oracle.at_samples(2, |_, sample| {
        let at = At { parameters: parameters.clone(), ..At::of(sample, &oracle.derivation) };
        let before = residual(&at);
        let scale = at.parameters.iter().fold(1.0, |most: f64, value| most.max(value.abs()));
        for (one, other) in (0..count).flat_map(|one| (one..count).map(move |other| (one, other))) {
            for (by_one, by_other) in [(1, 1), (1, -1), (2, 1), (2, -1), (1, 2), (1, -2), (2, 2)] {
                let mut turns = vec![0; count];
                turns[other] = by_other;
                turns[one] = by_one;
                if !of.repeats(&turns) {
                    continue;
                }
                let mut turned = at.map(|value| value);
                let coordinates = turned.unknowns.iter_mut().chain(&mut turned.inputs);
                coordinates.zip(&turns).for_each(|(coordinate, &turns)| *coordinate += TAU * f64::from(turns as i32));
                all_close(&format!("after the turns {turns:?}"), &residual(&turned), &before, scale, 1e-12);
            }
        }
    });
}

linkage! {
    /// Angles that enter by halves and thirds, by a parameter, and not at all.
    #[derive(Debug, Clone, Copy, PartialEq)]
    mechanism Geared {
        param a = 3, b = 2, c = 1, n = 2;
        input phi, idle;
        unknown x, y, psi, chi, delta;
        loop a@(phi/2) + b@(psi - phi/3) = (x, y);
        equation c * cos(3 * psi) = 0.1 * y;
        equation c * sin(2/5 * chi) + sin(chi/2) = 0.3 * x;
        equation sin(n * delta) + c * sin(delta) = 0.2 * x;
        output turned = phi;
        point P = a@idle;
        derive intervals;
    }
}

#[test]
fn angles_repeat_by_their_multiples() {
    let m = Geared::default();
    assert_eq!(Geared::<f64>::INPUTS, ["phi", "idle"]);
    assert_eq!(Geared::<f64>::UNKNOWNS, ["x", "y", "psi", "chi", "delta"]);
    // An output that is the angle itself is no part of Psi.
    let least = |m: &Geared, place: usize| {
        let repeats = |turns: i64| {
            let mut all = [0; 7];
            all[place] = turns;
            let [x, y, psi, chi, delta, phi, idle] = all;
            Certify::new(m).repeats(&Column::from([x, y, psi, chi, delta]), &Column::from([phi, idle]))
        };
        (1..=20).find(|&turns| repeats(turns) && repeats(-turns) && repeats(2 * turns))
    };
    let all: Vec<_> = (0..7).map(|place| least(&m, place)).collect();
    assert_eq!(all, [None, None, Some(1), Some(10), Some(1), Some(6), Some(1)]);
    assert_eq!(least(&Geared { n: 0.375, ..m }, 4), Some(8));
    assert_eq!(least(&Geared { n: 0.1, ..m }, 4), None);
    assert_eq!(Geared::<f64>::PARAMETERS, ["a", "b", "c", "n"]);
    assert_eq!(<Geared as Certifiable>::QUANTITIES, ["p_x", "p_y", "turned"]);
}

#[test]
fn a_user_function_is_named_in_its_group() {
    let named: Vec<_> = CamRocker::USER_FUNCTIONS.iter().flatten().collect();
    assert_eq!(named, [&"turn"]);
    let parameters: Column<f64, _> = Certifiable::parameters(&CamRocker::default());
    assert_eq!(parameters.as_slice(), Fixture::parameters(&CamRocker::default()));
}

linkage! {
    /// Constants that no double holds.
    mechanism Constants {
        param r = 1;
        input phi;
        output third = r / 3;
        output root = sqrt(7) * r;
        output half_turn = 180deg * r;
        output large = 3002399751580331 * 3 * r;
        output turned = phi;
        derive intervals;
    }
}

#[test]
fn constants_are_not_rounded() {
    let over = Constants::default().over::<Interval>(Column::from([Interval::from(1.0)]));
    let inputs = Column::from([Interval::from(1.0)]);
    let [third, root, half_turn, large, turned] = over.quantities(&Column::from([]), &inputs).into();
    for (value, what) in [(third, "third"), (root, "root"), (half_turn, "half turn"), (large, "large")] {
        assert!(value.least() < value.most(), "{what}: {value:?}");
        assert!(value.width() <= 8.0 * f64::EPSILON * value.magnitude(), "{what}: {value:?}");
    }
    assert!((third + third + third).contains(1.0) && root.square().contains(7.0));
    // pi is above its double by 1.2e-16.
    assert!(half_turn.contains(PI) && half_turn.contains(PI.next_up()));
    // 2^53 + 1.
    assert!(large.contains(9_007_199_254_740_992.0) && large.contains(9_007_199_254_740_994.0));
    assert_eq!((turned.least(), turned.most()), (1.0, 1.0));
}
