//! Types of the runtime crates that can be written and read.

use linkage::contact::{Contacts, ReducedEquations};
use linkage::continuation::{AlongCoordinates, AlongRates, AtChangePoint, Direction, Options};
use linkage::drawing::DrawingError;
use linkage::extremes::{Extreme, Extremes};
use linkage::integrate::{Crossing, Tolerance, dop853};
use linkage::simulation::{AtSingularity, Start, simulate};
use linkage::{
    Column, ContactLaw, D, DoubleDouble, Elbow, Matrix, Mode, Prescribed, Rounded, Scene, Slider, Slope, StateParts,
    linkage,
};

use crate::{comes_back, four_bar};

linkage! {
    #[derive(Debug, Clone)]
    pub mechanism Press {
        param r = 0.1, l = 0.35, j = 0.02, m = 0.8, mu = 0.2, normal = 40, load = 5, e = 0.3;
        input phi;
        unknown psi, z;
        loop r@phi - l@psi = (z, 0);
        body crank { inertia j; angle phi; }
        body ram { mass m; center (z, 0); }
        scene Working {
            inertia;
            torque load on phi;
            friction mu, normal on z;
            stop z in 0.26..0.6, restitution e;
            energy;
            power;
        }
        scene Resting {
            torque load * cos(phi) on phi;
            equilibrium;
        }
        derive serde;
    }
}

const START: PressCoordinates = PressCoordinates { phi: 1.2, psi: 2.9, z: 0.4 };

#[test]
fn columns_and_matrices() {
    comes_back(Column::from([0.1, -0.0, 1.0 / 3.0]));
    comes_back(Column::<f64, D<0>>::zeros());
    comes_back(Column::from([Mode::Stick, Mode::Open]));
    comes_back(Matrix::<f64, D<2>, D<3>>::from_fn(|row, column| 0.1 * (1 + row + 2 * column) as f64));
    comes_back(Matrix::<f64, D<0>, D<2>>::zeros());
    comes_back(Matrix::<f64, D<2>, D<0>>::zeros());
    comes_back(DoubleDouble::from(1.0) / DoubleDouble::from(3.0));
    comes_back(Rounded::from(1.0) / Rounded::from(3.0));
}

#[test]
fn choices_and_options() {
    comes_back((Elbow::Right, Slider::Near, Slope::Falling));
    comes_back(Options {
        range: Some([0.1, 0.7]),
        at_change_point: AtChangePoint::Switch,
        ..Options::<f64>::default()
    });
    comes_back([Direction::Increasing, Direction::Along(four_bar().0.l2)]);
    comes_back(Tolerance::<f64, D<2>>::new(1e-9, [0.1, 20.0]).unwrap());
    comes_back([Crossing::Rising, Crossing::Falling, Crossing::Either]);
    comes_back(AtSingularity::Stop);
    comes_back(ContactLaw::Stop { lower: 0.1, upper: 0.7, restitution: 0.3 });
    comes_back(Prescribed { value: 0.1, rate: 0.2, acceleration: 0.3 });
    comes_back(DrawingError::UnknownPoint("A".to_owned()));
}

#[test]
fn results() {
    let least = Extreme { input: 0.1, value: -0.7 };
    comes_back(Extremes { least, largest: Extreme { input: 0.3, value: 0.1 } });
    comes_back(AlongCoordinates { q: START, parameter: 0.1 });
    comes_back(AlongRates { rates: 0.7, parameter: 0.1 });
    let mut integration =
        dop853(|_t: f64, y: &Column<f64, D<1>>| Ok(-*y), (0.0, [1.0]), 1.0, Tolerance::new(1e-9, [1.0]).unwrap())
            .unwrap();
    comes_back(integration.advance().unwrap().unwrap());
    comes_back(integration.counts());
}

#[test]
fn equations_of_motion() {
    let scene = Working::default();
    let q = scene.mechanism.solve(&START).unwrap().coordinates;
    let rates = scene.mechanism.motion(&q, 3.0, 0.0).unwrap().rates;
    let state = Working::state(&q, &3.0.into());
    comes_back(state);
    comes_back(Scene::equations(&scene, 0.0, &state).unwrap());
    comes_back(Scene::unreduced(&scene, 0.0, &q, &rates).unwrap());
    comes_back(Scene::contacts(&scene, 0.0, &q, &rates).unwrap()[0].along);
    comes_back(scene.energy(&q, 3.0).unwrap());
    comes_back(scene.power(0.0, &q, 3.0).unwrap());
    comes_back(Resting::default().balance(0.0, &q).unwrap());
}

#[test]
fn contacts_and_simulations() {
    let scene = Working::default();
    let state = scene.start(0.0, &START, &0.0.into()).unwrap();
    let StateParts { q, input_rates } = Working::parts(&state);
    let at = |v: &Column<f64, D<1>>| ReducedEquations::of(&scene, 0.0, &Working::state(&q, &(*v).into()));
    let (contacts, rates) = Contacts::begin(0.0, &input_rates.into(), at).unwrap();
    comes_back(contacts);
    comes_back(contacts.motion(&at(&rates).unwrap()).unwrap());

    let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates: 0.0 }, 0.3, 1e-9).unwrap();
    motion.finish(|_, _| true).unwrap();
    comes_back(motion.loads().unwrap());
    comes_back(motion.counts());
    comes_back(motion.passages());
}
