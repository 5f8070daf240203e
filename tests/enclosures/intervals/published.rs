//! Published numbers are enclosed, from the digits of the published positions; a divisor that may be zero is an error.

use linkage::enclose::{EncloseError, PoseBox};
use linkage::{Column, Interval, Number, linkage};
use linkage_gallery::four_bar::FourBar;
use linkage_gallery::norton_four_bar::NortonFourBar;

/// All numbers that are printed with these digits.
fn printed(value: f64, decimals: i32) -> Interval {
    Interval::around(value, 0.5 * 10.0_f64.powi(-decimals)).unwrap()
}

fn radians(degrees: Interval) -> Interval {
    degrees * Interval::pi() / 180.0.into()
}

/// Each interval has a number in common with the printed one, and is no wider than this part of it.
#[track_caller]
fn enclose(found: &[Interval], expected: [Interval; 2], part: f64) {
    for (found, expected) in found.iter().zip(expected) {
        assert!(found.intersection(expected).is_some(), "{found:?} {expected:?}");
        assert!(found.width() <= part * found.magnitude(), "{found:?}");
    }
}

/// R. L. Norton, "Design of Machinery", chapters 4, 6 and 7: a 40, b 120, c 80, d 100 at theta2 = 40 deg, 25 rad/s,
/// 15 rad/s^2, open; the digits are those of `classic_numbers`.
#[test]
fn four_bar_of_norton() {
    let unknowns = [printed(20.297_882_788_196_5, 13), printed(57.324_880_070_360_8, 13)].map(radians);
    let inputs = [radians(40.0.into())];
    let pose = PoseBox::new(&NortonFourBar::default(), unknowns.into(), inputs.into()).unwrap();
    let rates = pose.velocity(&[25.0.into()].into()).unwrap();
    enclose(rates.as_slice(), [printed(-4.120_914_415_347_70, 14), printed(6.997_985_242_176_77, 14)], 1e-13);
    let accelerations = pose.acceleration(&rates, &[25.0.into()].into(), &[15.0.into()].into()).unwrap();
    enclose(accelerations.as_slice(), [printed(296.089_193_174_310, 12), printed(470.133_530_261_023, 12)], 1e-13);
    // With the sign of the crank's acceleration wrong the numbers are others.
    let other = pose.acceleration(&rates, &[25.0.into()].into(), &[(-15.0).into()].into()).unwrap();
    assert!(other[0].intersection(printed(296.089_193_174_310, 12)).is_none());
}

/// The four-bar 80-20-50-70 of the sheet at 20 deg and 400 rpm; the source is in `maple_sheet`. The sheet's arithmetic has
/// ten digits, so that it differs in the ninth.
#[test]
fn four_bar_of_the_sheet() {
    let unknowns = [printed(1.231_343_147_254_347, 15), printed(-0.880_796_908_593_408, 15)];
    let pose = PoseBox::new(&FourBar::default(), unknowns.into(), [radians(20.0.into())].into()).unwrap();
    let ratios = pose.velocity_ratios().unwrap()[0];
    enclose(ratios.as_slice(), [printed(-0.439_871_260_155_996, 15), printed(-0.257_433_739_305_082, 15)], 1e-13);
    let omega = Column::from([Interval::pi() * 40.0.into() / 3.0.into()]);
    let rates = pose.velocity(&omega).unwrap();
    enclose(rates.as_slice(), [printed(-18.425_284_259_084_822, 15), printed(-10.783_359_255_826_607, 15)], 1e-13);
    enclose(rates.as_slice(), [printed(-18.425_284_25, 7), printed(-10.783_359_24, 7)], 1e-13);
    let accelerations = pose.acceleration(&rates, &omega, &[Interval::zero()].into()).unwrap();
    let exact = [printed(-259.655_463_740_965, 12), printed(584.710_757_984_326_3, 13)];
    enclose(accelerations.as_slice(), exact, 1e-12);
    enclose(accelerations.as_slice(), [printed(-259.655_463_7, 5), printed(584.710_757_2, 5)], 1e-12);
}

linkage! {
    /// Wheels: one divides by the ratio in its equation, one by the factor of its unknown.
    mechanism Wheels {
        param ratio = 2, factor = 3;
        input phi;
        unknown psi, chi;
        equation psi = phi / ratio;
        equation sin(chi / factor) = abs(phi) / 10;
        point P = ratio@psi + factor@chi;
        derive intervals;
    }
}

fn narrow(value: f64) -> Interval {
    Interval::around(value, 0.1).unwrap()
}

fn wheels([ratio, factor, input]: [Interval; 3]) -> Result<PoseBox<Wheels>, EncloseError> {
    let unknowns = [narrow(0.5), narrow(0.3)];
    PoseBox::with_parameters(&Wheels::default(), [ratio, factor].into(), unknowns.into(), [input].into())
}

/// The group and the derivative of an error.
fn without_bounds(error: Option<EncloseError>) -> [&'static str; 2] {
    match error {
        Some(EncloseError::NoBounds { group, derivative, .. }) => [group, derivative],
        error => panic!("{error:?}"),
    }
}

#[test]
fn a_divisor_that_may_be_zero() {
    let rate = Column::from([narrow(1.0)]);
    // The rates do not depend on the input.
    let all = wheels([narrow(2.0), narrow(3.0), narrow(10.0)]).unwrap();
    // psi' = phi' / ratio, chi' = factor phi' / (10 cos(chi / factor)).
    let cosine = (narrow(0.3) / narrow(3.0)).cosine();
    let expected = [narrow(1.0) / narrow(2.0), narrow(3.0) * narrow(1.0) / cosine / 10.0.into()];
    for (found, expected) in all.velocity(&rate).unwrap().iter().zip(expected) {
        let inner = Interval::around(expected.middle(), 0.4 * expected.width()).unwrap();
        assert!(inner.is_within(*found) && found.width() < 1.4 * expected.width(), "{found:?} {expected:?}");
    }
    let through_zero = Interval::new(-0.5, 2.0).unwrap();
    assert_eq!(without_bounds(wheels([through_zero, narrow(3.0), narrow(1.0)]).err()), ["psi", "J"]);
    assert_eq!(without_bounds(wheels([narrow(2.0), through_zero, narrow(1.0)]).err()), ["chi", "J"]);
}

/// The magnitude of the input has no derivative at zero.
#[test]
fn a_kink() {
    let at_zero = wheels([narrow(2.0), narrow(3.0), narrow(0.0)]).unwrap();
    let (one, both) = (Column::from([narrow(1.0)]), Column::from([narrow(1.0); 2]));
    assert_eq!(without_bounds(at_zero.velocity(&one).err()), ["chi", "A v'"]);
    assert_eq!(without_bounds(at_zero.velocity_ratios().err()), ["chi", "A"]);
    assert_eq!(without_bounds(at_zero.acceleration(&both, &one, &one).err()), ["chi", "A v'' + gamma"]);
    assert!(at_zero.sensitivity().is_ok());
}
