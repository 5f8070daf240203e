//! Invalid numbers: each gives a typed error, and nothing runs for ever.

use linkage::continuation::{Direction, Event, Options, Path};
use linkage::{Elbow, InputError, Mechanism, PathError, PositionError, Slider};

use linkage_gallery::four_bar::*;
use linkage_gallery::offset_slider_crank::*;

const BAD: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

fn start(m: &FourBar) -> FourBarCoordinates {
    m.assemble(0.35, FourBarBranch::new(Elbow::Left)).unwrap().coordinates()
}

#[test]
fn infinite_and_nan_numbers() {
    let m = FourBar::default();
    let q = start(&m);
    for bad in BAD {
        for broken in [
            FourBarCoordinates { theta2: bad, ..q },
            FourBarCoordinates { theta3: bad, ..q },
            FourBarCoordinates { theta4: bad, ..q },
        ] {
            let error = Path::new(&m, &broken, Direction::Increasing).err();
            assert!(matches!(error, Some(PathError::Position(PositionError::NotFinite { .. }))), "{error:?}");
        }
        let rates = FourBarRates { theta2: 1.0, theta3: 0.0, theta4: 0.0 };
        for broken in [
            FourBarRates { theta2: bad, ..rates },
            FourBarRates { theta3: bad, ..rates },
            FourBarRates { theta4: bad, ..rates },
        ] {
            let error = Path::new(&m, &q, Direction::Along(broken)).err();
            assert!(matches!(error, Some(PathError::Position(PositionError::NotFinite { .. }))), "{error:?}");
        }
        for broken in [FourBar::new(bad, 20.0, 50.0, 70.0), FourBar::new(80.0, 20.0, bad, 70.0)] {
            let error = Path::new(&broken, &q, Direction::Increasing).err();
            assert!(matches!(error, Some(PathError::Position(PositionError::NotFinite { .. }))), "{error:?}");
        }
        let mut path = Path::new(&m, &q, Direction::Increasing).unwrap();
        assert!(matches!(path.advance_to(bad), Err(PathError::Position(PositionError::NotFinite { .. }))));
        assert!(matches!(path.advance_watching(|_, _| bad), Err(PathError::Position(PositionError::NotFinite { .. }))));
    }
}

/// No rate depends on the slider.
#[test]
fn motion_at_a_slider_that_is_not_finite() {
    let m = OffsetSliderCrank::default();
    let q = m.assemble(0.35, OffsetSliderCrankBranch::new(Slider::Far)).unwrap().coordinates();
    assert!(m.motion(&q, 1.0, 0.0).is_ok());
    for bad in BAD {
        let error = PositionError::NotFinite { mechanism: "OffsetSliderCrank", quantity: "the position" };
        assert_eq!(m.motion(&OffsetSliderCrankCoordinates { d: bad, ..q }, 1.0, 0.0).err(), Some(error));
    }
}

#[test]
fn invalid_options() {
    let m = FourBar::default();
    let q = start(&m);
    let good = Options::default();
    let mut all = Vec::new();
    for bad in [0.0, -0.1, 1e-16, 1e-300, 2.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        all.push(Options { longest_step: bad, ..good });
        all.push(Options { largest_turn: bad, ..good });
    }
    all.push(Options { most_steps: 0, ..good });
    for range in [[1.0, 0.0], [0.35, 0.35], [1.0, 2.0], [f64::NAN, 1.0], [0.0, f64::NAN]] {
        all.push(Options { range: Some(range), ..good });
    }
    for options in all {
        let error = Path::with(&m, &q, Direction::Increasing, options).err();
        assert!(
            matches!(error, Some(PathError::Input(InputError::OutOfRange { of: Some("FourBar"), .. }))),
            "{options:?}: {error:?}"
        );
    }
    let options = Options { range: Some([0.0, 1.0]), ..good };
    let mut path = Path::with(&m, &q, Direction::Increasing, options).unwrap();
    assert!(matches!(path.advance_to(1.5), Err(PathError::Input(InputError::OutOfRange { .. }))));
    assert_eq!(path.by_ref().last().unwrap().unwrap().event, Some(Event::Limit));
    assert_eq!(path.position().theta2, 1.0);
    path.turn_back();
    assert_eq!(path.by_ref().last().unwrap().unwrap().position.theta2, 0.0);
}

#[test]
fn too_far() {
    let m = FourBar::default();
    let options = Options { most_steps: 100, ..Options::default() };
    let mut path = Path::with(&m, &start(&m), Direction::Increasing, options).unwrap();
    assert_eq!(path.advance_to(1e9), Err(PathError::TooManySteps { mechanism: "FourBar", steps: 100 }));
    // The smallest allowed steps only take long.
    let options = Options { longest_step: 1e-12, most_steps: 100, ..Options::default() };
    let mut path = Path::with(&m, &start(&m), Direction::Increasing, options).unwrap();
    assert!(path.advance().is_ok());
    assert!(matches!(path.advance_to(1.0), Err(PathError::TooManySteps { .. })));
}

#[test]
fn zero_lengths() {
    let q = start(&FourBar::default());
    let along = FourBarRates { theta2: 1.0, theta3: -0.5, theta4: 0.5 };
    for lengths in [[0.0; 4], [1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0], [1.0, 1.0, 0.0, 0.0], [0.0, 1.0, 1.0, 0.0]] {
        let m = FourBar::from(lengths);
        for direction in [Direction::Increasing, Direction::Along(along)] {
            let Ok(mut path) = Path::new(&m, &q, direction) else { continue };
            // Every step that succeeds is at a position.
            for step in path.by_ref().take(50) {
                let Ok(step) = step else { break };
                let pose = m.pose_at(&step.position);
                assert!(m.residual(&pose).largest() <= 8.0 * f64::EPSILON * m.residual_scales(&pose).largest());
            }
        }
    }
    let error = Path::new(&FourBar::from([0.0; 4]), &q, Direction::Increasing).err();
    assert!(matches!(error, Some(PathError::Lost { mechanism: "FourBar", group: "theta3, theta4", .. })), "{error:?}");
}
