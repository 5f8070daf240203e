//! A lane is accepted if its position, its rates and its accelerations exist, with any columns asked for. A quantity
//! that does not exist is missing in its own column, and nowhere else.

use linkage::lanes::{Batch, Given, Lanes, Values};
use linkage::nalgebra::ComplexField;
use linkage::{Dim, Elbow, PositionError, Real, linkage, real};

use crate::by_name::{Bits, same_bits};

linkage! {
    /// A crank-rocker whose outputs have limited domains, all computed in lanes.
    pub mechanism Rocker {
        param a = 2, b = 6, c = 5, d = 7;
        input th;
        unknown p, q;
        loop a@th + b@p = c@q + d@0;
        point P = a@th + (b/2, sqrt(sin(th)))@p;
        output root = sqrt(cos(th));
        output mu = q - p;
        output steep = 1 / th;
        output z = abs(mu)^3;
        derive lanes;
    }

    /// Two outputs whose formulas share a difference.
    pub mechanism Bar {
        param a = 2, b = 6, c = 5, d = 7;
        input th;
        unknown p, q;
        loop a@th + b@p = c@q + d@0;
        output mu = q - p;
        output z = abs(mu)^3;
        derive lanes;
    }

    /// A slider-crank that is not accepted everywhere, with functions of a library.
    pub mechanism Slider {
        param r = 2, l = 1;
        input th;
        unknown phi, s;
        loop r@th + l@phi = (s, 0);
        output angle = acos(2 * cos(th));
        output level = ln(s);
        derive lanes;
    }

    /// Kepler's equation, which has no closed form.
    pub mechanism Kepler {
        param e = 0.5;
        input th;
        unknown psi;
        equation psi - e * sin(psi) = th;
        output root = sqrt(th);
        derive lanes;
    }

    /// A pendulum, an open chain.
    pub mechanism Pendulum {
        param l = 1;
        input th;
        point P = (sqrt(cos(th)), l * sin(th));
        derive lanes;
    }

    /// A slider and a function of the user that only an output reads.
    pub mechanism Cam {
        param h = 1;
        input th;
        unknown s;
        extern fn bell(th) -> (value, slope, bend);
        equation s = h * th;
        output lift = h * value(th);
        derive lanes;
    }

    /// A four-bar with the turns of an angle, and a function of the user that only an output reads.
    pub mechanism Lifter {
        param l1 = 6, l2 = 2, l3 = 5, l4 = 7;
        input th;
        unknown a, b, psi;
        extern fn bell(th) -> (value, slope, bend);
        loop l2@th + l3@a + l4@b = l1@0;
        equation psi = 2 * a;
        output lift = value(th) + psi;
        derive lanes;
    }
}

/// A bell whose value exists up to 2, its slope up to 1 and its second derivative up to 0.
fn bell<T: Real>(th: T) -> (T, T, T) {
    let up_to = |end: f64, value: T| if th <= real(end) { value } else { real(f64::NAN) };
    (up_to(2.0, th * th), up_to(1.0, th + th), up_to(0.0, real(2.0)))
}

/// Angles with zeros and limits of domains among them: more than one block, and not a multiple of one.
fn angles<T: Real>() -> Vec<T> {
    let steps = (-30..=30).map(|step| real::<T>(0.1 * f64::from(step)));
    steps.chain([-0.0, 4.0, -4.5, 1e-300].map(real)).collect()
}

/// The given columns of a turn at the rate and acceleration 1.
fn given<'a, M: Lanes>(design: &M, angles: &'a [M::Scalar]) -> Given<M, Values<'a, M::Scalar>> {
    let mut parameters = M::Given::default().array(|_| real::<M::Scalar>(1.0));
    design.write_parameters(&mut parameters);
    M::Given::default().array(|place| match M::GIVEN[place] == "th" {
        true => Values::Each(angles),
        false => Values::Same(parameters.as_ref()[place]),
    })
}

/// The columns asked for, and the mask.
fn run<M: Lanes>(batch: &Batch<'_, M>, asked: &[usize]) -> (Vec<Vec<M::Scalar>>, Vec<bool>) {
    let mut found = vec![vec![real::<M::Scalar>(7.0); batch.count()]; M::FOUND.len()];
    let mut accepted = vec![false; batch.count()];
    let mut list: Vec<_> =
        found.iter_mut().enumerate().map(|(place, column)| asked.contains(&place).then_some(&mut **column)).collect();
    let rejected = batch.run(&mut list, &mut accepted).unwrap();
    assert_eq!(rejected, accepted.iter().filter(|accepted| !**accepted).count());
    (found, accepted)
}

/// Each column alone, each pair of columns and all columns give the same mask and the same numbers; a number of an accepted
/// lane is missing where `exists` is false. Returns the number of accepted lanes.
fn check<M: Lanes>(design: &M, branch: M::Branch, exists: impl Fn(&str, M::Scalar) -> bool) -> usize
where
    M::Scalar: Bits,
{
    let angles = angles::<M::Scalar>();
    let batch = Batch::<M>::new(given(design, &angles), branch).unwrap();
    let every: Vec<usize> = (0..M::FOUND.len()).collect();
    let (all, mask) = run(&batch, &every);
    for (lane, (&angle, &accepted)) in angles.iter().zip(&mask).enumerate() {
        let alone = batch.lane(lane);
        assert_eq!(alone.is_ok(), accepted, "{} at {angle}", M::NAME);
        assert_eq!(batch.lane_of_coordinates(lane).err(), alone.as_ref().err().copied(), "{} at {angle}", M::NAME);
        let numbers: Vec<M::Scalar> = all.iter().map(|column| column[lane]).collect();
        assert!(alone.is_err() || same_bits(alone.unwrap().as_ref(), &numbers), "{} at {angle}", M::NAME);
        for (name, value) in M::FOUND.iter().zip(numbers) {
            let is_there = accepted && exists(name, angle);
            assert!(
                if is_there { value.is_finite() } else { value.is_nan() },
                "{name} of {} at {angle}: {value}",
                M::NAME
            );
        }
    }
    for first in every.clone() {
        for second in every.clone() {
            let (found, accepted) = run(&batch, &[first, second]);
            assert_eq!(accepted, mask, "{} with {} and {}", M::NAME, M::FOUND[first], M::FOUND[second]);
            let is_same = [first, second].iter().all(|&place| same_bits(&found[place], &all[place]));
            assert!(is_same, "{} with {} and {}", M::NAME, M::FOUND[first], M::FOUND[second]);
        }
    }
    assert_eq!(run(&batch, &[]).1, mask, "{} without columns", M::NAME);
    mask.iter().filter(|accepted| **accepted).count()
}

fn to_f64<T: Real>(value: T) -> f64 {
    linkage::nalgebra::try_convert(value).unwrap()
}

#[test]
fn outputs_of_limited_domain_reject_no_lane() {
    let exists = |name: &str, th: f64| match name {
        "root" => th.cos() >= 0.0,
        "root_rate" | "root_acceleration" => th.cos() > 0.0,
        "p_x" | "p_y" => th.sin() >= 0.0,
        "p_velocity_x" | "p_velocity_y" => th.sin() > 0.0,
        // sin(th)^(-3/2) is finite down to 1e-205.
        "p_acceleration_x" | "p_acceleration_y" => th.sin() > 1e-200,
        "steep" => (1.0 / th).is_finite(),
        "steep_rate" => (1.0 / (th * th)).is_finite(),
        "steep_acceleration" => (1.0 / (th * th * th)).is_finite(),
        _ => true,
    };
    let branch = RockerBranch::new(Elbow::Left);
    // The crank turns fully.
    assert_eq!(check(&Rocker::default(), branch, exists), angles::<f64>().len());
    let single = |name: &str, th: f32| match name {
        // The smallest angle, 1e-300, is zero in single precision.
        "steep" | "steep_rate" | "steep_acceleration" => th != 0.0,
        _ => exists(name, to_f64(th)),
    };
    assert_eq!(check(&Rocker::default().map(|value| value as f32), branch, single), angles::<f32>().len());
}

#[test]
fn functions_of_a_library_reject_no_lane() {
    let slider = Slider::default();
    let exists = |name: &str, th: f64| match name {
        "angle" | "angle_rate" | "angle_acceleration" => th.cos().abs() < 0.5,
        // Its derivatives s' / s and so on exist where s is negative.
        "level" => 2.0 * th.cos() + (1.0 - 4.0 * th.sin().powi(2)).sqrt() > 0.0,
        _ => true,
    };
    let accepted = check(&slider, SliderBranch::all().next().unwrap(), exists);
    // Those angles whose sine is less than a half, of which those about pi have no logarithm.
    assert_eq!(accepted, angles::<f64>().iter().filter(|th| th.sin().abs() < 0.5).count());
}

#[test]
fn a_mechanism_without_closed_form() {
    let exists = |name: &str, th: f64| match name {
        "root" => th >= 0.0,
        "root_rate" => th > 0.0,
        // th^(-3/2) is finite down to 1e-205.
        "root_acceleration" => th > 1e-200,
        _ => true,
    };
    check(&Kepler::default(), KeplerBranch::new(), exists);
}

#[test]
fn an_open_chain_has_all_lanes() {
    let exists = |name: &str, th: f64| match name {
        "p_x" => th.cos() >= 0.0,
        "p_velocity_x" | "p_acceleration_x" => th.cos() > 0.0,
        _ => true,
    };
    assert_eq!(check(&Pendulum::default(), PendulumBranch::new(), exists), angles::<f64>().len());
}

#[test]
fn a_function_of_the_user_rejects_no_lane_if_only_an_output_reads_it() {
    let exists = |name: &str, th: f64| match name {
        "lift" => th <= 2.0,
        "lift_rate" => th <= 1.0,
        "lift_acceleration" => th <= 0.0,
        _ => true,
    };
    assert_eq!(check(&Cam::default(), CamBranch {}, exists), angles::<f64>().len());
    // The squares of small lengths underflow: the separate calls find these positions.
    for scale in [1.0, 1e150, 1e-150, 1e-152] {
        let lifter = Lifter::default().map(|length| scale * length);
        assert_eq!(check(&lifter, LifterBranch::all().next().unwrap(), exists), angles::<f64>().len(), "{scale}");
    }
}

/// A lane without a position has no number in any column, and its error is that of `kinematics`.
#[test]
fn a_rejected_lane_is_missing_in_all_columns() {
    let angles = [0.0, 1.5, 0.2];
    let (slider, branch) = (Slider::default(), SliderBranch::all().next().unwrap());
    let batch = Batch::<Slider>::new(given(&slider, &angles), branch).unwrap();
    let every: Vec<usize> = (0..Slider::<f64>::FOUND.len()).collect();
    let (all, mask) = run(&batch, &every);
    assert_eq!(mask, [true, false, true]);
    assert!(all.iter().all(|column| column[1].is_nan()));
    assert_eq!(batch.lane(1).err(), slider.kinematics(1.5, branch, 1.0, 1.0).err());
    assert!(matches!(batch.lane(1), Err(PositionError::Unbuildable { .. })));
}

/// At th = 0 the second derivative of mu is the difference of two equal numbers.
#[test]
fn a_difference_that_vanishes_has_the_sign_of_the_scalar_function() {
    let (bar, branch) = (Bar::default(), BarBranch::new(Elbow::Left));
    let angles = [0.0, -0.0, std::f64::consts::PI, 0.3];
    let mut zeros = 0;
    for (rate, acceleration) in [(0.0, 1.0), (-0.0, 1.0), (0.0, -1.0), (0.0, 0.0), (1.0, 0.0), (1.0, 1.0)] {
        let start = BarInputs { th: angles.as_slice() };
        let batch = Bar::batch(Bar::default(), start, branch, rate.into(), acceleration.into()).unwrap();
        let mut found = [[0.0; 4]; 6];
        let [mu, mu_rate, mu_acceleration, z, z_rate, z_acceleration] =
            found.each_mut().map(|column| Some(&mut column[..]));
        let mut columns =
            BarColumns { mu, mu_rate, mu_acceleration, z, z_rate, z_acceleration, ..Default::default() }.list();
        assert_eq!(batch.run(&mut columns, &mut [false; 4]), Ok(0));
        for (lane, th) in angles.into_iter().enumerate() {
            let BarOutputs { mu, z } = bar.full_kinematics(th, branch, rate, acceleration).unwrap().outputs;
            let numbers = [mu, z].into_iter().flat_map(|of| [of.value, of.rate, of.acceleration]);
            let expected: Vec<f64> = numbers.collect();
            let in_lane: Vec<f64> = found.iter().map(|column| column[lane]).collect();
            assert!(same_bits(&in_lane, &expected), "at {th}, {rate}, {acceleration}: {in_lane:?}, {expected:?}");
            zeros += expected.iter().filter(|value| **value == 0.0).count();
        }
    }
    assert!(zeros > 20, "{zeros}");
}
