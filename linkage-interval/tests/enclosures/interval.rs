//! Intervals without rounding errors: exact results, infinite bounds, domains, sets.

use std::f64::consts::{FRAC_PI_2, PI};

use linkage_interval::Interval;
use linkage_runtime::Number;

const INFINITY: f64 = f64::INFINITY;
/// The least positive double.
const LEAST: f64 = f64::from_bits(1);

fn interval(least: f64, most: f64) -> Interval {
    Interval::new(least, most).unwrap()
}

fn point(value: f64) -> Interval {
    value.into()
}

#[test]
fn no_interval_is_empty() {
    for (least, most) in [(1.0, 0.0), (f64::NAN, 0.0), (0.0, f64::NAN), (INFINITY, INFINITY), (-INFINITY, -INFINITY)] {
        assert_eq!(Interval::new(least, most), None);
    }
    for value in [f64::NAN, INFINITY, -INFINITY] {
        assert_eq!([Interval::from(value), Number::near(value), Interval::exactly(value)], [Interval::ENTIRE; 3]);
    }
    for (middle, radius) in [(1.0, -1e-300), (f64::NAN, 1.0), (1.0, f64::NAN), (INFINITY, 1.0)] {
        assert_eq!(Interval::around(middle, radius), None, "{middle} {radius}");
    }
    assert_eq!(Interval::around(1.0, 0.25), Some(interval(0.75, 1.25)));
    assert_eq!(Interval::around(1.0, 1e-300), Some(interval(1.0_f64.next_down(), 1.0_f64.next_up())));
    assert_eq!(Interval::around(1.0, INFINITY), Some(Interval::ENTIRE));
}

/// Operations on numbers whose result is a double.
#[test]
fn exact_results_are_not_widened() {
    let tenth = point(0.1);
    assert_eq!([tenth + 0.0.into(), tenth * 1.0.into(), tenth / 1.0.into(), -(-tenth)], [tenth; 4]);
    assert_eq!([tenth * 0.0.into(), Interval::ENTIRE * 0.0.into(), point(0.0) / tenth], [point(0.0); 3]);
    assert_eq!([point(3.0) * point(7.0), point(21.0) / point(-7.0)], [point(21.0), point(-3.0)]);
    assert_eq!([point(9.0).sqrt(), point(-3.0).square(), point(0.0).sqrt()], [point(3.0), point(9.0), point(0.0)]);
    assert_eq!(
        [point(0.0).exponential(), point(1.0).logarithm(), point(0.0).sine(), point(0.0).arctangent()],
        [1.0, 0.0, 0.0, 0.0].map(point)
    );
    // A third is not a double.
    let third = Interval::ratio(1.0, 3.0);
    assert_eq!(third, interval(1.0 / 3.0, (1.0_f64 / 3.0).next_up()));
    assert_eq!(Interval::near(0.1), interval(0.1_f64.next_down(), 0.1_f64.next_up()));
}

#[test]
fn overflow_and_underflow() {
    let (huge, tiny) = (point(f64::MAX), point(LEAST));
    assert_eq!([huge + huge, huge * huge, huge / tiny, huge.square()], [interval(f64::MAX, INFINITY); 4]);
    assert_eq!([-huge - huge, -huge * huge], [interval(-INFINITY, -f64::MAX); 2]);
    assert_eq!([tiny * tiny, tiny / huge, tiny.square()], [interval(0.0, LEAST); 3]);
    assert_eq!(-tiny * tiny, interval(-LEAST, 0.0));
    assert_eq!(
        [point(1e4).exponential(), point(-1e4).exponential()],
        [interval(f64::MAX, INFINITY), interval(0.0, LEAST)]
    );
    let length = huge.hypotenuse(huge);
    assert!(length.least() >= 0.999_999_999_999_999 * f64::MAX && length.most() == INFINITY);
    assert_eq!(tiny.hypotenuse(point(0.0)), tiny);
}

#[test]
fn infinite_bounds() {
    let (above, below) = (interval(2.0, INFINITY), interval(-INFINITY, -2.0));
    assert_eq!([above + below, above * Interval::ENTIRE, above - above], [Interval::ENTIRE; 3]);
    assert_eq!([above * below, above + above], [interval(-INFINITY, -4.0), interval(4.0, INFINITY)]);
    assert_eq!([above * interval(0.0, 1.0), above / above], [interval(0.0, INFINITY); 2]);
    assert_eq!([point(1.0) / above, point(1.0) / below], [interval(0.0, 0.5), interval(-0.5, 0.0)]);
    assert_eq!(
        [Interval::ENTIRE.square(), Interval::ENTIRE.abs(), Interval::ENTIRE.exponential()],
        [interval(0.0, INFINITY); 3]
    );
    assert_eq!([Interval::ENTIRE.sine(), Interval::ENTIRE.cosine()], [interval(-1.0, 1.0); 2]);
    assert_eq!(interval(1.0, INFINITY).logarithm(), interval(0.0, INFINITY));
    assert_eq!(Interval::ENTIRE.arctangent(), interval(-FRAC_PI_2.next_up(), FRAC_PI_2.next_up()));
    assert_eq!(above.hypotenuse(below).most(), INFINITY);
    assert_eq!([above.middle(), below.middle(), Interval::ENTIRE.middle()], [f64::MAX, -f64::MAX, 0.0]);
    assert_eq!([above.width(), above.magnitude(), above.mignitude()], [INFINITY, INFINITY, 2.0]);
}

/// Nothing is known of a function or quotient that is defined for some of the numbers only.
#[test]
fn outside_the_domain() {
    let mixed = interval(-0.5, 2.0);
    let unknown = [mixed.sqrt(), mixed.logarithm(), interval(0.0, 1.0).logarithm(), mixed.arcsine(), mixed.arccosine()];
    assert_eq!(unknown, [Interval::ENTIRE; 5]);
    assert_eq!([mixed / mixed, mixed / interval(0.0, 1.0), point(0.0) / point(0.0)], [Interval::ENTIRE; 3]);
    assert_eq!(
        [interval(1.5, 1.6).tangent(), interval(-4.0, 4.0).tangent(), interval(1.0, 4.5).tangent()],
        [Interval::ENTIRE; 3]
    );
    assert_ne!(interval(-1.57, 1.57).tangent(), Interval::ENTIRE);
    // Beyond 1e5 the sine has no proved bound but its range.
    assert_eq!([point(1e5_f64.next_up()).sine(), point(-1e6).cosine()], [interval(-1.0, 1.0); 2]);
    assert_eq!(point(1e6).tangent(), Interval::ENTIRE);
}

#[test]
fn extrema_of_the_sine() {
    assert_eq!([interval(1.0, 2.0).sine().most(), interval(4.0, 5.0).sine().least()], [1.0, -1.0]);
    assert_eq!([interval(-0.1, 0.1).cosine().most(), interval(3.0, 3.2).cosine().least()], [1.0, -1.0]);
    assert!(interval(1.0, 1.5).sine().most() < 1.0 && interval(0.1, 0.2).cosine().most() < 1.0);
    let wide = interval(1.0, 2.0).sine();
    assert!((wide.least() - 1.0_f64.sin()).abs() < 1e-15);
    assert_eq!([interval(0.0, 7.0).sine(), interval(-9e4, 9e4).cosine()], [interval(-1.0, 1.0); 2]);
}

/// A box with the origin, or with points on both sides of the negative x axis, has all angles.
#[test]
fn angles_of_boxes() {
    let all = interval(-PI.next_up(), PI.next_up());
    let around = interval(-1.0, 1.0);
    assert_eq!([around.arctangent2(around), around.arctangent2(interval(-2.0, -1.0))], [all; 2]);
    assert_eq!([point(0.0).arctangent2(point(0.0)), interval(-1.0, 0.0).arctangent2(point(-1.0))], [all; 2]);
    let straight = interval(PI, PI.next_up());
    assert_eq!([point(0.0).arctangent2(point(-1.0)), point(-0.0).arctangent2(point(-1.0))], [straight; 2]);
    assert_eq!(point(0.0).arctangent2(interval(0.5, INFINITY)), point(0.0));
    let close = |found: Interval, least: f64, most: f64| {
        let (below, above) = (least - found.least(), found.most() - most);
        assert!((0.0..1e-15).contains(&below) && (0.0..1e-15).contains(&above), "{found:?}");
    };
    use std::f64::consts::FRAC_PI_4;
    close(interval(1.0, 2.0).arctangent2(interval(-2.0, 1.0)), FRAC_PI_4, 2.677_945_044_588_987);
    close(interval(-2.0, -1.0).arctangent2(interval(1.0, 2.0)), -1.107_148_717_794_090_4, -0.463_647_609_000_806_1);
    close(around.arctangent2(interval(1.0, 2.0)), -FRAC_PI_4, FRAC_PI_4);
    close(interval(0.0, 1.0).arctangent2(interval(-2.0, -1.0)), 3.0 * FRAC_PI_4, PI);
    close(interval(1.0, INFINITY).arctangent2(interval(-1.0, INFINITY)), 0.0, 3.0 * FRAC_PI_4);
}

#[test]
fn sets() {
    let (a, b) = (interval(0.0, 2.0), interval(1.0, 3.0));
    assert_eq!([a.intersection(b), a.intersection(interval(2.5, 3.0))], [Some(interval(1.0, 2.0)), None]);
    assert_eq!(a.hull(interval(5.0, 6.0)), interval(0.0, 6.0));
    assert!(a.contains(2.0) && !a.contains(2.1) && !a.contains(f64::NAN) && !Interval::ENTIRE.contains(INFINITY));
    assert!(interval(0.5, 1.0).is_interior(a) && a.is_within(a) && !a.is_interior(a) && !b.is_within(a));
    assert!(a.is_interior(Interval::ENTIRE) && !Interval::ENTIRE.is_interior(Interval::ENTIRE));
    assert_eq!(
        [a.middle(), a.width(), interval(-3.0, 2.0).magnitude(), interval(-3.0, -2.0).mignitude()],
        [1.0, 2.0, 3.0, 2.0]
    );
}
