//! The equations of contacts against those of the mechanism, and the contact law for any of them.

use linkage::contact::{Contacts, ReducedEquations};
use linkage::nalgebra::vector;
use linkage::{Column, D, Matrix, Mode};

use super::machines::*;
use linkage_oracle::close;

/// The scalar of a contact, its derivatives and its quadratic terms against the outputs of the mechanism; the equations
/// in one function against separate ones.
#[test]
fn contacts_and_equations_as_the_mechanism_says() {
    use linkage::Equations;
    let scene = Jointed::default();
    for (phi, rate, acceleration) in [(0.3, 2.0, -7.0), (1.9, -3.5, 11.0), (4.4, 0.6, 0.3)] {
        let guess = MachineCoordinates { phi, psi: 3.0, z: 0.4 };
        let q = scene.mechanism.solve(&guess).unwrap().coordinates;
        let motion = scene.mechanism.motion(&q, rate, acceleration).unwrap();
        let (rates, second) = (motion.rates, motion.accelerations);
        let contacts = scene.contacts(1.5, &q, &rates).unwrap();
        let joint = motion.outputs.joint;
        let expected = [
            ("friction on phi", phi, rate, acceleration, 0.2 * 0.01 * 90.0),
            ("friction on joint", joint.value, joint.rate, joint.acceleration, 0.2 * 0.012 * 90.0),
            ("friction on psi", q.psi, rates.psi, second.psi, 0.2 * 0.008 * 90.0),
            ("friction on z", q.z, rates.z, second.z, 0.2 * 40.0),
        ];
        for (contact, (name, value, rate, acceleration, limit)) in contacts.iter().zip(expected) {
            let along =
                |u: [f64; 2], v: f64| contact.along.unknowns.dot(&u.into()) + contact.along.inputs.dot(&[v].into());
            assert_eq!(contact.name, name);
            close("s", contact.along.value, value, 1e-15);
            close("s'", along([rates.psi, rates.z], rates.phi), rate, 1e-15);
            let found = along([second.psi, second.z], second.phi) + contact.along.bias;
            close("s''", found, acceleration, 1e-13);
            assert!(
                matches!(contact.law, linkage::ContactLaw::Friction { limit: found } if (found - limit).abs() < 1e-15)
            );
        }
        let together = scene.equations(1.5, &q, rate).unwrap();
        let (mass, forces) = (scene.mass_matrix(&q).unwrap(), scene.forces(1.5, &q, rate).unwrap());
        let apart = Equations::at(&scene.mechanism, &q, vector![rate], mass, forces).unwrap();
        close("M", together.mass[(0, 0)], apart.mass[(0, 0)], 1e-15);
        close("Q", together.forces[0], apart.forces[0], 1e-13);
        close("W", (together.ratios - apart.ratios).largest(), 0.0, 1e-14);
        close("u''", (together.bias - apart.bias).largest(), 0.0, 1e-13);
    }
    // The quadratic terms of an output that is curved in the coordinates.
    let pair = Curved::default();
    let q = pair.mechanism.solve(&self::pair(0.7, 1.1)).unwrap().coordinates;
    let motion =
        pair.mechanism.motion(&q, PairInputs { theta1: 2.0, theta4: -3.0 }, PairInputs { theta1: 5.0, theta4: 4.0 });
    let (rates, second) = motion.map(|motion| (motion.rates, motion.accelerations)).unwrap();
    let contact = pair.contacts(0.0, &q, &rates).unwrap()[0];
    close("s", contact.along.value, q.theta1 * q.theta2.sin(), 1e-15);
    let (sine, cosine) = q.theta2.sin_cos();
    let rate = rates.theta1 * sine + q.theta1 * cosine * rates.theta2;
    let along = |u: [f64; 2], v: [f64; 2]| contact.along.unknowns.dot(&u.into()) + contact.along.inputs.dot(&v.into());
    close("s'", along([rates.theta2, rates.theta3], [rates.theta1, rates.theta4]), rate, 1e-14);
    let bent = 2.0 * rates.theta1 * cosine * rates.theta2 - q.theta1 * sine * rates.theta2.powi(2);
    let expected = second.theta1 * sine + q.theta1 * cosine * second.theta2 + bent;
    let found = along([second.theta2, second.theta3], [second.theta1, second.theta4]) + contact.along.bias;
    close("s''", found, expected, 1e-12);
    // A limit that is a law.
    let linkage::ContactLaw::Friction { limit } = contact.law else { panic!("{contact:?}") };
    close("limit", limit, 9.0 * (1.0 + rates.theta3.powi(2)), 1e-13);
}

/// For any masses, forces and contacts the solution satisfies the contact law, and no other mode does.
#[test]
fn the_law_holds_for_random_contacts() {
    use linkage::ContactLaw;
    use linkage::contact::ReducedContact;
    let mut seed = 0x2545_f491_4f6c_dd1d_u64;
    let mut random = move || {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    fn one<const V: usize>(random: &mut impl FnMut() -> f64, seen: &mut [usize; 6]) {
        let root = Matrix::<f64, D<V>, D<V>>::from_fn(|_, _| random());
        let mass = root * root.transpose() + Matrix::identity() * 0.2;
        let forces = Column::from_fn(|_| 2.0 * random());
        let contacts = Column::<_, D<5>>::from_fn(|place| {
            let row = Column::<f64, D<V>>::from_fn(|_| random());
            let law = match place {
                0..3 => ContactLaw::Friction { limit: 0.8 * (1.0 + random()) },
                _ => ContactLaw::Stop { lower: 0.0, upper: 1.0, restitution: 0.5 },
            };
            let value = if place == 4 { 1.0 } else { 0.0 };
            ReducedContact { name: "a contact", value, row, drift: 0.0, bias: 0.0, law }
        });
        let (coordinates, rates) = (Column::repeat(""), Column::zeros());
        let bearings = Column::repeat(None);
        let equations = ReducedEquations { scene: "random", coordinates, mass, forces, rates, contacts, bearings };
        let (state, rates) = Contacts::begin(0.0, &rates, |_| Ok(equations)).unwrap();
        assert_eq!(rates, Column::zeros());
        let motion = state.motion(&equations).unwrap();
        // M v'' = Q + S' f.
        let mut left = mass * motion.acceleration - forces;
        for (contact, &force) in contacts.iter().zip(motion.forces.iter()) {
            left -= contact.row * force;
        }
        close("M v'' - Q - S' f", left.largest(), 0.0, 1e-11);
        for ((contact, &force), mode) in contacts.iter().zip(motion.forces.iter()).zip(state.modes) {
            let second = contact.row.dot(&motion.acceleration);
            let limit = match contact.law {
                ContactLaw::Friction { limit } => limit,
                ContactLaw::Bearing { .. } | ContactLaw::Stop { .. } => f64::INFINITY,
            };
            let fits = match mode {
                Mode::Stick => second.abs() < 1e-11 && force.abs() <= limit * (1.0 + 1e-12),
                Mode::SlipForward => second > 0.0 && force == -limit,
                Mode::SlipBackward => second < 0.0 && force == limit,
                Mode::AtLower => second.abs() < 1e-11 && force >= 0.0,
                Mode::AtUpper => second.abs() < 1e-11 && force <= 0.0,
                Mode::Open if contact.value == 0.0 => second >= 0.0 && force == 0.0,
                Mode::Open => second <= 0.0 && force == 0.0,
            };
            assert!(fits, "{V} {mode:?} {second} {force} {limit}");
            seen[mode as usize] += 1;
        }
        // The event functions of these modes are silent; those of the mode that holds everything are not, unless
        // nothing moves.
        assert!(state.events(&equations).unwrap().iter().all(|&value| value >= 0.0));
        let mut all = state;
        all.modes = [Mode::Stick, Mode::Stick, Mode::Stick, Mode::AtLower, Mode::AtUpper].into();
        let stands = all.events(&equations).unwrap().iter().all(|&left| left >= 0.0);
        assert_eq!(stands, motion.acceleration.largest() < 1e-11, "{V} {:?}", state.modes);
    }
    let mut seen = [0; 6];
    for _ in 0..3000 {
        one::<1>(&mut random, &mut seen);
        one::<2>(&mut random, &mut seen);
        one::<3>(&mut random, &mut seen);
        one::<4>(&mut random, &mut seen);
    }
    assert!(seen.iter().all(|&often| often > 1000), "{seen:?}");
}
