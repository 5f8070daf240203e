//! Prices of scenes: errors against exact motions, the operations of effects by hand, and scenes without a price.

use linkage::DoubleDouble;
use linkage::chart::Look;
use linkage::nalgebra::ComplexField;
use linkage::price::{Order, PriceError, ScenePrice, ScenePriceOptions};
use linkage::simulation::{Start, simulate};
use linkage::{InputError, MotionError, linkage};

fn quick() -> ScenePriceOptions {
    let tolerances = vec![1e-4, 1e-6, 1e-8, 1e-10];
    ScenePriceOptions { tolerances, samples: 8, rounds: 1, span: 0.0, ..ScenePriceOptions::default() }
}

mod wheel {
    use super::linkage;
    use linkage::Real;

    /// A torque by an angle, in `f64`.
    fn rounded<T: Real>(angle: T) -> (T, T, T) {
        let angle: f64 = linkage::nalgebra::try_convert(angle).unwrap_or(f64::NAN);
        (linkage::real(-4.0 * angle), linkage::real(-4.0), linkage::real(0.0))
    }

    linkage! {
        #[derive(Clone)]
        pub mechanism Wheel {
            param j = 0.5, k = 2, radius = 0.1;
            input theta;
            point Rim = radius@theta;
            extern fn rounded(theta) -> (torque, slope, bend);
            body wheel { inertia j; angle theta; }
            /// theta'' = -4 theta.
            scene Sprung { inertia; spring k, 0 on theta; }
            scene Free { inertia; }
            scene ByTable { inertia; torque torque(theta) on theta; }
        }
    }
}

mod bars {
    use super::linkage;

    linkage! {
        #[derive(Clone)]
        pub mechanism Bars {
            param ground = 4, crank = 3, coupler = 2, rocker = 2.5, m = 1, w = 1;
            input theta;
            unknown phi, psi;
            loop crank@theta + coupler@phi = ground@0 + rocker@psi;
            body crank { mass m; center (crank/2)@theta; inertia m*crank^2/12; angle theta; }
            scene Driven { inertia; drive theta = 0.5 + w*t; }
        }
    }
}

const START: Start<f64, wheel::WheelCoordinates<f64>, wheel::WheelInputs<f64>> =
    Start { t: 0.0, q: wheel::WheelCoordinates { theta: 1.0 }, input_rates: wheel::WheelInputs { theta: 0.0 } };

const END: f64 = 7.0;

fn sprung() -> ScenePrice {
    let scene = wheel::Sprung::default();
    let twice = scene.clone().map(DoubleDouble::from);
    ScenePrice::of(&scene, &twice, wheel::Sprung::<f64>::DERIVATION, START, END, &quick()).unwrap()
}

/// theta = cos(2 t): the errors at the end are those of runs against it, with as many right-hand sides.
#[test]
fn errors_of_a_motion_that_is_known() {
    let price = sprung();
    let scene = wheel::Sprung::default();
    let exact = (DoubleDouble::from(2.0) * DoubleDouble::from(END)).cos();
    assert!(price.reference_error < 1e-14, "{:e}", price.reference_error);
    assert_eq!(price.runs.len(), 8);
    for run in &price.runs {
        let outcome = run.outcome.unwrap();
        if run.order == Order::Eight {
            let mut motion = simulate(&scene, START, END, run.tolerance).unwrap();
            motion.finish(|_, _| true).unwrap();
            let own = (DoubleDouble::from(motion.state().q.theta) - exact).high().abs();
            // The reference differs from the cosine by its own error.
            assert!((outcome.error_at_end - own).abs() <= 2e-14, "{:e} {own:e}", outcome.error_at_end);
            assert_eq!(outcome.counts, motion.counts());
        }
        assert!(outcome.error >= outcome.error_at_end);
        assert!(outcome.error < 300.0 * run.tolerance, "{run:?}");
        assert!(outcome.error > 1e-3 * run.tolerance, "{run:?}");
    }
    for order in [Order::Eight, Order::Five] {
        let of: Vec<_> = price.runs.iter().filter(|run| run.order == order).map(|run| run.outcome.unwrap()).collect();
        assert!(of.windows(2).all(|two| two[1].error < two[0].error));
        assert!(of.windows(2).all(|two| two[1].counts.evaluations > two[0].counts.evaluations));
    }
}

/// The spring on an angle has the force -k theta: a product, and a difference from the free angle 0, which vanishes.
#[test]
fn effects_and_parts() {
    let mut price = sprung();
    let spring = price.effects.iter().find(|effect| effect.name.contains("spring")).unwrap();
    assert_eq!(spring.operations.multiplications, 1, "{spring:?}");
    assert_eq!((spring.operations.functions, spring.operations.divisions, spring.operations.additions), (0, 0, 0));
    assert_eq!(spring.alone, spring.operations);
    assert!(price.parts.iter().any(|part| part.name.starts_with("derivative")));
    assert!(!price.parts.iter().any(|part| part.name.starts_with("contacts")));
    let (with, without) = (wheel::Sprung::default(), wheel::Free::default());
    price.without("the spring", (&with, START), (&without, START)).unwrap();
    let [with, without] = price.without[0].evaluations;
    assert!(without < with, "{with} {without}");
    assert!(price.to_string().contains("Without the spring: "));
    let html = price.to_html();
    assert_eq!(html.matches("<svg").count(), 4);
    assert!(!html.contains("NaN") && !html.contains("<script"), "{html}");
    let chart = price.error_by_tolerance();
    let dots = chart.curves.iter().filter(|curve| curve.look == Look::Dots).flat_map(|curve| &curve.points).count();
    assert_eq!(dots, 8);
}

/// The driven crank comes to a dead point at cos theta = (16 + 9 - 4.5^2) / 24.
#[test]
fn a_scene_that_ends_early() {
    let scene = bars::Driven::default();
    let m = &scene.mechanism;
    let q = m.assemble(0.5, bars::BarsBranch::new(linkage::Elbow::Left)).unwrap().coordinates();
    let twice = scene.clone().map(DoubleDouble::from);
    let start = Start { t: 0.0, q, input_rates: bars::BarsInputs { theta: 1.0 } };
    let price = |end: f64| ScenePrice::of(&scene, &twice, bars::Driven::<f64>::DERIVATION, start, end, &quick());
    assert!(price(0.5).is_ok());
    let error = price(3.0).unwrap_err();
    let dead = ((16.0 + 9.0 - 4.5_f64 * 4.5) / 24.0).acos() - 0.5;
    let PriceError::EndsEarly { scene: "Driven", t, end: 3.0, .. } = error else { panic!("{error:?}") };
    assert!(t <= dead && t > dead - 0.1, "{t} {dead}");
    assert!(error.to_string().starts_with("`Driven` ends at the time "), "{error}");
    // A motion that does not even start has an error of its own.
    let start = Start { input_rates: bars::BarsInputs { theta: 2.0 }, ..start };
    let error = ScenePrice::of(&scene, &twice, bars::Driven::<f64>::DERIVATION, start, 0.5, &quick()).unwrap_err();
    let PriceError::Start(error) = error else { panic!("{error:?}") };
    assert!(matches!(*error, MotionError::Input(InputError::Inconsistent { .. })), "{error:?}");
}

#[test]
fn a_scene_with_a_user_function_in_f64() {
    let scene = wheel::ByTable::default();
    let twice = scene.clone().map(DoubleDouble::from);
    let error = ScenePrice::of(&scene, &twice, wheel::ByTable::<f64>::DERIVATION, START, END, &quick()).unwrap_err();
    assert!(matches!(error, PriceError::FewDigitsOfScene { scene: "ByTable" }), "{error:?}");
}

#[test]
fn options_that_are_invalid() {
    let scene = wheel::Sprung::default();
    let twice = scene.clone().map(DoubleDouble::from);
    let price = |end: f64, options: &ScenePriceOptions| {
        ScenePrice::of(&scene, &twice, wheel::Sprung::<f64>::DERIVATION, START, end, options).unwrap_err()
    };
    for (end, options, name) in [
        (END, ScenePriceOptions { samples: 0, ..quick() }, "the number of samples"),
        (END, ScenePriceOptions { rounds: 0, ..quick() }, "the number of rounds"),
        (END, ScenePriceOptions { span: -1.0, ..quick() }, "the span of a price"),
        (END, ScenePriceOptions { reference: 1e-9, ..quick() }, "the tolerance of the reference"),
        (-1.0, quick(), "the end of a price"),
        (f64::NAN, quick(), "the end of a price"),
    ] {
        let error = price(end, &options);
        let is_it = matches!(error, PriceError::Input(InputError::OutOfRange { quantity, .. }) if quantity == name);
        assert!(is_it, "{name}: {error:?}");
    }
    // A tolerance that no run can have is one of its row.
    let options = ScenePriceOptions { tolerances: vec![1e-6, 1e-20], ..quick() };
    let price = ScenePrice::of(&scene, &twice, wheel::Sprung::<f64>::DERIVATION, START, END, &options).unwrap();
    assert_eq!(price.runs.iter().filter(|run| run.outcome.is_err()).count(), 2);
}
