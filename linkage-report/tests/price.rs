//! Prices: errors against formulas of their own in 31 digits, inputs without a position, and references that are not what
//! they should be. No test compares times.

use linkage::DoubleDouble;
use linkage::chart::{Chart, Look};
use linkage::nalgebra::{ComplexField, RealField};
use linkage::price::{InOtherScalars, MotionPrice, PriceError, PriceOptions, QUANTITIES};
use linkage::range_of_motion::{MotionEnd, RangeOfMotion, RangeOptions};
use linkage::{InputError, linkage};

/// Few samples, each timed once.
fn quick() -> PriceOptions {
    PriceOptions { samples: 24, rounds: 1, span: 0.0, ..PriceOptions::default() }
}

mod lever {
    use super::linkage;

    linkage! {
        #[derive(Clone)]
        pub mechanism SlottedLever {
            param crank = 120, offset = 50;
            input theta;
            unknown psi, s;
            loop crank@theta = (0, -offset) + s@psi;
        }
    }
}

mod bars {
    use super::linkage;

    linkage! {
        #[derive(Clone)]
        pub mechanism Bars {
            param ground = 4, crank = 3, coupler = 2, rocker = 2.5;
            input theta;
            unknown phi, psi;
            loop crank@theta + coupler@phi = ground@0 + rocker@psi;
        }
    }
}

mod parallel {
    use super::linkage;

    linkage! {
        #[derive(Clone)]
        pub mechanism Parallelogram {
            param a = 2, b = 5;
            input theta;
            unknown phi, psi;
            loop a@theta + b@phi = b@0 + a@psi;
        }
    }
}

mod kepler {
    use super::linkage;

    linkage! {
        #[derive(Clone)]
        pub mechanism Kepler {
            param e = 0.25;
            input mean;
            unknown eccentric;
            equation eccentric - e * sin(eccentric) = mean;
        }
    }
}

mod bead {
    use super::linkage;
    use linkage::Real;

    /// A parabola in the scalar of its argument.
    fn exact<T: Real>(x: T) -> (T, T, T) {
        (x * x, x + x, linkage::real(2.0))
    }

    /// A parabola in `f64`.
    fn rounded<T: Real>(x: T) -> (T, T, T) {
        let x: f64 = linkage::nalgebra::try_convert(x).unwrap_or(f64::NAN);
        (linkage::real(x * x), linkage::real(x + x), linkage::real(2.0))
    }

    linkage! {
        #[derive(Clone)]
        pub mechanism Exact {
            input x;
            unknown height;
            extern fn exact(x) -> (wire, slope, bend);
            equation height = wire(x);
        }
    }

    linkage! {
        #[derive(Clone)]
        pub mechanism Rounded {
            input x;
            unknown height;
            extern fn rounded(x) -> (wire, slope, bend);
            equation height = wire(x);
        }
    }
}

/// A mechanism in the other scalars.
macro_rules! others {
    ($m:expr) => {
        InOtherScalars { single: $m.clone().map(|x| x as f32), double_double: $m.clone().map(DoubleDouble::from) }
    };
}

fn lever_price(options: &PriceOptions) -> Result<MotionPrice, PriceError> {
    let m = lever::SlottedLever::default();
    let start = lever::SlottedLeverCoordinates { theta: 0.0, psi: 0.4, s: 130.0 };
    let range = RangeOfMotion::of(&m, &start, RangeOptions::default())?;
    MotionPrice::of(&range, lever::SlottedLever::<f64>::DERIVATION, &others!(m), options)
}

/// psi and s of the lever with two derivatives, by trigonometry: s^2 = r^2 + o^2 + 2 r o sin theta. The lever turns: the
/// square of its velocity is in places larger than its acceleration, in others smaller.
fn by_trigonometry(theta: f64) -> [[DoubleDouble; 2]; 3] {
    let [r, o, theta, two] = [120.0, 50.0, theta, 2.0].map(DoubleDouble::from);
    let (sine, cosine) = (theta.sin(), theta.cos());
    let square = r * r + o * o + two * r * o * sine;
    let s = square.sqrt();
    let rate = r * o * cosine / s;
    [
        [(o + r * sine).atan2(r * cosine), s],
        [(r * r + r * o * sine) / square, rate],
        [r * o * cosine * (o * o - r * r) / (square * square), -(r * o * sine) / s - rate * rate / s],
    ]
}

/// The errors of the closed form in `f64` are those of its own results against trigonometry in 31 digits.
#[test]
fn errors_of_the_closed_form() {
    let price = lever_price(&quick()).unwrap();
    let m = lever::SlottedLever::default();
    let start = lever::SlottedLeverCoordinates { theta: 0.0, psi: 0.4, s: 130.0 };
    let branch = m.branch_of(&m.pose_at(&start));
    assert_eq!(price.inputs.len(), 24);
    for (place, &theta) in price.inputs.iter().enumerate() {
        let pose = m.assemble(theta, branch).unwrap();
        let velocity = m.velocity(&pose, 1.0).unwrap();
        let acceleration = m.acceleration(&pose, &velocity, 0.0).unwrap();
        let q = pose.coordinates();
        let expected = by_trigonometry(theta);
        // The longest length of the loop.
        let scale = expected[0][1].high().max(120.0);
        let apart = |order: usize, [psi, s]: [f64; 2]| {
            let [exact_psi, exact_s] = expected[order];
            let turns = ((psi - exact_psi.high()) / std::f64::consts::TAU).round();
            let psi = DoubleDouble::from(psi) - exact_psi - DoubleDouble::two_pi() * DoubleDouble::from(turns);
            psi.high().abs().max((DoubleDouble::from(s) - exact_s).high().abs() / scale)
        };
        let size = |order: usize| {
            let [psi, s] = expected[order].map(|value| value.high().abs());
            psi.max(s / scale)
        };
        let own = [
            apart(0, [q.psi, q.s]),
            apart(1, [velocity.psi, velocity.s]) / size(1),
            apart(2, [acceleration.psi, acceleration.s]) / size(2).max(size(1) * size(1)),
        ];
        for (order, own) in own.into_iter().enumerate() {
            let error = price.method("f64").unwrap().quantities[order].errors[place].unwrap();
            assert!((error - own).abs() <= 1e-9 * own + 1e-28, "{} at {theta}: {error:e}, {own:e}", QUANTITIES[order]);
        }
        assert!(own[0] < 5e-16, "{own:?}");
    }
}

/// The methods in other scalars have as many digits as these.
#[test]
fn digits_of_each_method() {
    let price = lever_price(&quick()).unwrap();
    let names: Vec<&str> = price.methods.iter().map(|method| &*method.name).collect();
    let all = [
        "f64",
        "f32",
        "double-double",
        "Newton, 1 step",
        "Newton, 2 steps",
        "Newton, 3 steps",
        "Newton to tolerance",
        "table of 64",
        "table of 1024",
    ];
    assert_eq!(names, all);
    for (order, quantity) in QUANTITIES.iter().enumerate() {
        let largest = |name: &str| price.method(name).unwrap().quantities[order].largest().unwrap();
        for (name, [least, most]) in [
            ("f64", [1e-17, 2e-15]),
            ("f32", [1e-9, 2e-6]),
            ("double-double", [1e-34, 1e-30]),
            ("Newton, 3 steps", [1e-17, 2e-15]),
            ("table of 64", [1e-9, 1e-5]),
        ] {
            let error = largest(name);
            assert!(least < error && error < most, "{name}, {quantity}: {error:e}");
        }
        // Sixteen times the entries, in a table of cubics, are four powers of that in the error.
        let ratio = largest("table of 64") / largest("table of 1024");
        assert!((0.25..4.0).contains(&(ratio / 65_536.0)), "{ratio}");
        let costs = price.costs(order);
        let front = price.front(order);
        assert!(front.windows(2).all(|two| costs[two[1]].unwrap().error < costs[two[0]].unwrap().error));
        assert!(price.fastest(order, 1e-40).is_none());
        let (fastest, _) = price.fastest(order, 1e-20).unwrap();
        assert_eq!(fastest.name, "double-double");
    }
    // The last step of Newton's method to the reference is within its digits.
    assert!(price.reference < 1e-30, "{:e}", price.reference);
}

fn points(chart: &Chart, look: Look) -> usize {
    chart.curves.iter().filter(|curve| curve.look == look).flat_map(|curve| &curve.points).flatten().count()
}

#[test]
fn charts_and_pages() {
    let price = lever_price(&quick()).unwrap();
    for order in 0..3 {
        assert_eq!(points(&price.error_and_time(order), Look::Discs), 9);
        assert_eq!(points(&price.errors_along(order), Look::Line), 9 * 24);
        // The number of steps to a tolerance is not known beforehand.
        assert_eq!(points(&price.predicted_and_measured(order), Look::Rings), 8);
        assert_eq!(points(&price.predicted_and_measured(order), Look::Dots), 9);
    }
    let html = price.to_html();
    assert_eq!(html.matches("<svg").count(), 9);
    assert_eq!(html.matches("<table").count(), 3);
    assert!(!html.contains("NaN") && !html.contains("<script") && !html.contains("inf"), "{html}");
    let text = price.to_string();
    assert!(text.contains("24 inputs, theta from 0° to 360°."), "{text}");
    assert!(text.contains("Fastest velocity with an error of 1.0e−12: "), "{text}");
}

/// A double rocker: coupler and rocker are in line at cos theta = (g^2 + c^2 - (a + b)^2) / (2 g c), on both sides.
#[test]
fn a_range_beyond_dead_points() {
    let m = bars::Bars::default();
    let start = m.assemble(0.5, bars::BarsBranch::new(linkage::Elbow::Left)).unwrap().coordinates();
    let range = RangeOfMotion::of(&m, &start, RangeOptions::default()).unwrap();
    let asked = [-2.0, 3.0];
    let options = PriceOptions { inputs: Some(asked), ..quick() };
    let price = MotionPrice::of(&range, bars::Bars::<f64>::DERIVATION, &others!(m), &options).unwrap();
    let dead = ((16.0 + 9.0 - 4.5_f64 * 4.5) / 24.0).acos();
    assert_eq!(price.gaps.len(), 2);
    for (gap, (from, to)) in price.gaps.iter().zip([(-dead, asked[0]), (dead, asked[1])]) {
        assert!((gap.from - from).abs() < 1e-12 && gap.to == to, "{gap:?}");
        assert!(matches!(gap.reason, MotionEnd::DeadPoint { group: "phi, psi" }), "{gap:?}");
    }
    assert!(price.inputs.iter().all(|input| input.abs() < dead));
    let chart = price.errors_along(1);
    let [lower, upper] = &chart.spans[..] else { panic!("two parts without a position") };
    assert_eq!((lower.ends, upper.ends), ([price.gaps[0].from, -2.0], [price.gaps[1].from, 3.0]));
    assert_eq!(chart.lines.len(), 2);
    assert!(chart.to_svg().contains("no position: a dead point of phi, psi"));
    assert_eq!(chart.x.range, Some(asked));
    let text = price.to_string();
    assert!(text.contains("is a dead point of phi, psi."), "{text}");
    // Velocities lose digits towards a dead point: the sine of the transmission angle falls by the root of the distance.
    let errors = &price.method("double-double").unwrap().quantities[1].errors;
    let [first, middle] = [0, 11].map(|place| errors[place].unwrap());
    assert!(first.is_finite() && middle.is_finite());
    // Of a turn there is no table here.
    let table = &price.method("table of 64").unwrap().quantities[0];
    assert!(table.largest().unwrap() > 1e-12);
}

/// The bars are in line at 0, where the third of five inputs is: it has no reference and is left out.
#[test]
fn a_change_point_among_the_inputs() {
    let m = parallel::Parallelogram::default();
    let start = parallel::ParallelogramCoordinates { theta: 0.5, phi: 0.0, psi: 0.5 };
    let range = RangeOfMotion::of(&m, &start, RangeOptions::through_change_points()).unwrap();
    let options = PriceOptions { inputs: Some([-1.0, 1.0]), samples: 5, ..quick() };
    let price = MotionPrice::of(&range, parallel::Parallelogram::<f64>::DERIVATION, &others!(m), &options).unwrap();
    let [out] = &price.left_out[..] else { panic!("{:?}", price.left_out) };
    assert_eq!(out.input, 0.0);
    assert!(matches!(out.error, PriceError::Reference { .. } | PriceError::Path(_)), "{out:?}");
    assert_eq!(price.inputs.len(), 4);
    // The motion was followed from 0.5 on: this is its change point at a full turn, a turn before.
    let [point] = &price.change_points[..] else { panic!("{:?}", price.change_points) };
    assert!(point.input.abs() < 1e-12, "{point:?}");
    // The cranks stay parallel, phi is 0.
    let chart = price.errors_along(0);
    assert!(chart.lines.iter().any(|line| line.name.contains("change point of phi, psi")), "{:?}", chart.lines);
    let text = price.to_string();
    assert!(text.contains("other motions cross: a change point of phi, psi.") && text.contains("Left out: "), "{text}");
    let errors = &price.method("double-double").unwrap().quantities[0].errors;
    assert!(errors.iter().all(|error| error.is_ok_and(|error| error < 1e-28)), "{errors:?}");
}

/// E - e sin E = M has no closed form; its solution by bisection in 31 digits.
#[test]
fn a_mechanism_without_a_closed_form() {
    let m = kepler::Kepler::default();
    let start = kepler::KeplerCoordinates { mean: 1.0, eccentric: 1.2 };
    let start = m.solve(&start).unwrap().coordinates;
    let path = linkage::continuation::Options { range: Some([0.25, 3.0]), ..RangeOptions::default().path };
    let range = RangeOfMotion::of(&m, &start, RangeOptions { path, ..RangeOptions::default() }).unwrap();
    let price = MotionPrice::by_newton(&range, kepler::Kepler::<f64>::DERIVATION, &others!(m), &quick()).unwrap();
    assert_eq!(price.methods[0].name, "Newton to tolerance");
    for (place, &mean) in price.inputs.iter().enumerate() {
        let near = kepler::KeplerCoordinates { mean, eccentric: mean };
        let found = m.solve(&near).unwrap().coordinates.eccentric;
        let e = DoubleDouble::from(0.25);
        let (mut low, mut high) = (DoubleDouble::from(mean), DoubleDouble::from(mean + 0.25));
        for _ in 0..110 {
            let middle = (low + high) * DoubleDouble::from(0.5);
            if middle - e * middle.sin() < DoubleDouble::from(mean) {
                low = middle;
            } else {
                high = middle;
            }
        }
        let own = (DoubleDouble::from(found) - low).high().abs();
        let error = price.methods[0].quantities[0].errors[place].unwrap();
        // Both end within an ulp of the solution, from other guesses.
        assert!((error - own).abs() < 4.5e-16 && error < 5e-16, "{mean}: {error:e} {own:e}");
        let twice = price.method("double-double, 4 steps").unwrap().quantities[0].errors[place].unwrap();
        assert!(twice < 1e-30, "{twice:e}");
    }
}

/// A reference with other lengths is noticed before anything is compared with it.
#[test]
fn a_reference_with_other_parameters() {
    let m = bars::Bars::default();
    let start = m.assemble(0.5, bars::BarsBranch::new(linkage::Elbow::Left)).unwrap().coordinates();
    let range = RangeOfMotion::of(&m, &start, RangeOptions::default()).unwrap();
    let mut others = others!(m);
    others.double_double.rocker += DoubleDouble::from(1e-8);
    let error = MotionPrice::of(&range, bars::Bars::<f64>::DERIVATION, &others, &quick()).unwrap_err();
    assert!(matches!(error, PriceError::OtherParameters { mechanism: "Bars", equation: 1 | 2, .. }), "{error:?}");
    assert!(error.to_string().contains("map(DoubleDouble::from)"), "{error}");
}

/// A user function that computes in `f64` has no 31 digits to compare with.
#[test]
fn a_user_function_without_a_double_double_form() {
    macro_rules! price {
        ($Bead:ident, $Coordinates:ident) => {{
            let m = bead::$Bead::default();
            let start = bead::$Coordinates { x: 1.0, height: 1.0 };
            let path = linkage::continuation::Options { range: Some([0.5, 2.0]), ..RangeOptions::default().path };
            let range = RangeOfMotion::of(&m, &start, RangeOptions { path, ..RangeOptions::default() }).unwrap();
            MotionPrice::of(&range, bead::$Bead::<f64>::DERIVATION, &others!(m), &quick())
        }};
    }
    let exact = price!(Exact, ExactCoordinates).unwrap();
    assert!(exact.method("f64").unwrap().quantities[0].largest().unwrap() < 1e-15);
    let error = price!(Rounded, RoundedCoordinates).unwrap_err();
    assert!(matches!(error, PriceError::FewDigits { mechanism: "Rounded", equation: 1, function: Some("wire"), .. }));
    assert!(error.to_string().contains("the user function `wire`"), "{error}");
}

#[test]
fn options_that_are_invalid() {
    let invalid = |options: PriceOptions| lever_price(&options).unwrap_err();
    for (options, name) in [
        (PriceOptions { samples: 0, ..quick() }, "the number of samples"),
        (PriceOptions { rounds: 0, ..quick() }, "the number of rounds"),
        (PriceOptions { inputs: Some([1.0, 1.0]), ..quick() }, "the largest input of a price"),
        (PriceOptions { inputs: Some([f64::NAN, 1.0]), ..quick() }, "the largest input of a price"),
        (PriceOptions { span: f64::NAN, ..quick() }, "the span of a price"),
        (PriceOptions { step: Some(0.0), ..quick() }, "the step of a price"),
    ] {
        let error = invalid(options);
        let is_it = matches!(error, PriceError::Input(InputError::OutOfRange { quantity, .. }) if quantity == name);
        assert!(is_it, "{name}: {error:?}");
    }
    let m = bars::Bars::default();
    let start = m.assemble(0.5, bars::BarsBranch::new(linkage::Elbow::Left)).unwrap().coordinates();
    let range = RangeOfMotion::of(&m, &start, RangeOptions::default()).unwrap();
    let options = PriceOptions { inputs: Some([2.0, 3.0]), ..quick() };
    let error = MotionPrice::of(&range, bars::Bars::<f64>::DERIVATION, &others!(m), &options).unwrap_err();
    let is_it = matches!(error, PriceError::Input(InputError::OutOfRange { quantity: "the inputs of a price", .. }));
    assert!(is_it, "{error:?}");
}
