//! The equations of contacts against those of the mechanism, and their law for any of them.

use linkage::Mode;
use linkage::contact::{Contacts, ReducedEquations};
use linkage::nalgebra::{SVector, vector};

use super::machines::*;
use super::moving::close;

/// The scalar of a contact, its derivatives and its quadratic terms, beside the outputs of the mechanism; the
/// equations in one kernel beside those put together.
#[test]
fn contacts_and_equations_as_the_mechanism_says() {
    use linkage::Equations;
    let scene = Jointed::default();
    for (phi, rate, acceleration) in [(0.3, 2.0, -7.0), (1.9, -3.5, 11.0), (4.4, 0.6, 0.3)] {
        let guess = MachineCoordinates { phi, psi: 3.0, z: 0.4 };
        let q = scene.mechanism.solve(&guess).unwrap().coordinates;
        let motion = scene.mechanism.motion(&q, rate, acceleration).unwrap();
        let (velocity, second) = (motion.velocity, motion.acceleration);
        let contacts = scene.contacts(1.5, &q, &velocity).unwrap();
        let joint = motion.outputs.joint;
        let expected = [
            ("friction on phi", phi, rate, acceleration, 0.2 * 0.01 * 90.0),
            ("friction on joint", joint.value, joint.velocity, joint.acceleration, 0.2 * 0.012 * 90.0),
            ("friction on psi", q.psi, velocity.psi, second.psi, 0.2 * 0.008 * 90.0),
            ("friction on z", q.z, velocity.z, second.z, 0.2 * 40.0),
        ];
        for (contact, (name, value, rate, acceleration, limit)) in contacts.iter().zip(expected) {
            let along =
                |u: SVector<f64, 2>, v: SVector<f64, 1>| contact.along.unknowns.dot(&u) + contact.along.inputs.dot(&v);
            assert_eq!(contact.name, name);
            close("s", contact.along.value, value, 1e-15);
            close("s'", along(vector![velocity.psi, velocity.z], vector![velocity.phi]), rate, 1e-15);
            let found = along(vector![second.psi, second.z], vector![second.phi]) + contact.along.bias;
            close("s''", found, acceleration, 1e-13);
            assert!(
                matches!(contact.law, linkage::ContactLaw::Friction { limit: found } if (found - limit).abs() < 1e-15)
            );
        }
        let together = scene.equations(1.5, &q, rate).unwrap();
        let (mass, forces) = (scene.mass_matrix(&q).unwrap(), scene.forces(1.5, &q, rate).unwrap());
        let apart = Equations::at(&scene.mechanism, &q, &vector![rate], mass, forces).unwrap();
        close("M", together.mass[0], apart.mass[0], 1e-15);
        close("Q", together.forces[0], apart.forces[0], 1e-13);
        close("W", (together.ratios - apart.ratios).amax(), 0.0, 1e-14);
        close("u''", (together.bias - apart.bias).amax(), 0.0, 1e-13);
    }
    // The quadratic terms of an output that is curved in the coordinates.
    let pair = Curved::default();
    let q = pair.mechanism.solve(&self::pair(0.7, 1.1)).unwrap().coordinates;
    let motion =
        pair.mechanism.motion(&q, PairInputs { theta1: 2.0, theta4: -3.0 }, PairInputs { theta1: 5.0, theta4: 4.0 });
    let (velocity, second) = motion.map(|motion| (motion.velocity, motion.acceleration)).unwrap();
    let contact = pair.contacts(0.0, &q, &velocity).unwrap()[0];
    close("s", contact.along.value, q.theta1 * q.theta2.sin(), 1e-15);
    let (sine, cosine) = q.theta2.sin_cos();
    let rate = velocity.theta1 * sine + q.theta1 * cosine * velocity.theta2;
    let u = |q: &PairCoordinates| vector![q.theta2, q.theta3];
    let v = |q: &PairCoordinates| vector![q.theta1, q.theta4];
    let along = |q: &PairCoordinates| contact.along.unknowns.dot(&u(q)) + contact.along.inputs.dot(&v(q));
    close("s'", along(&velocity), rate, 1e-14);
    let bent = 2.0 * velocity.theta1 * cosine * velocity.theta2 - q.theta1 * sine * velocity.theta2.powi(2);
    let expected = second.theta1 * sine + q.theta1 * cosine * second.theta2 + bent;
    close("s''", along(&second) + contact.along.bias, expected, 1e-12);
    // A limit that is a law.
    let linkage::ContactLaw::Friction { limit } = contact.law else { panic!("{contact:?}") };
    close("limit", limit, 9.0 * (1.0 + velocity.theta3.powi(2)), 1e-13);
}

/// Any masses, forces and contacts: what is found satisfies the law, and it alone does.
#[test]
fn the_law_holds_for_random_contacts() {
    use linkage::ContactLaw;
    use linkage::contact::ReducedContact;
    use linkage::nalgebra::SMatrix;
    let mut seed = 0x2545_f491_4f6c_dd1d_u64;
    let mut random = move || {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    fn one<const V: usize>(random: &mut impl FnMut() -> f64, seen: &mut [usize; 6]) {
        let root = SMatrix::<f64, V, V>::from_fn(|_, _| random());
        let mass = root * root.transpose() + SMatrix::<f64, V, V>::identity() * 0.2;
        let forces = SVector::<f64, V>::from_fn(|_, _| 2.0 * random());
        let contacts: [ReducedContact<f64, V>; 5] = std::array::from_fn(|place| {
            let row = SVector::<f64, V>::from_fn(|_, _| random());
            let law = match place {
                0..3 => ContactLaw::Friction { limit: 0.8 * (1.0 + random()) },
                _ => ContactLaw::Stop { lower: 0.0, upper: 1.0, restitution: 0.5 },
            };
            let value = if place == 4 { 1.0 } else { 0.0 };
            ReducedContact { name: "a contact", value, row, drift: 0.0, bias: 0.0, law }
        });
        let coordinates = [""; V];
        let equations =
            ReducedEquations { scene: "random", coordinates, mass, forces, rates: SVector::zeros(), contacts };
        let (state, rates) = Contacts::begin(0.0, &SVector::zeros(), |_| Ok(equations)).unwrap();
        assert_eq!(rates, SVector::<f64, V>::zeros());
        let motion = state.motion(&equations).unwrap();
        // M v'' = Q + S' f.
        let mut left = mass * motion.acceleration - forces;
        for (contact, &force) in contacts.iter().zip(motion.forces.iter()) {
            left -= contact.row * force;
        }
        close("M v'' - Q - S' f", left.amax(), 0.0, 1e-11);
        for ((contact, &force), mode) in contacts.iter().zip(motion.forces.iter()).zip(state.modes) {
            let second = contact.row.dot(&motion.acceleration);
            let limit = match contact.law {
                ContactLaw::Friction { limit } => limit,
                ContactLaw::Stop { .. } => f64::INFINITY,
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
        // The event functions of these modes see nothing; those of everything held see it unless nothing moves.
        assert!(state.events(&equations).unwrap().iter().all(|&value| value >= 0.0));
        let mut all = state;
        all.modes = [Mode::Stick, Mode::Stick, Mode::Stick, Mode::AtLower, Mode::AtUpper];
        let stands = all.events(&equations).unwrap().iter().all(|&left| left >= 0.0);
        assert_eq!(stands, motion.acceleration.amax() < 1e-11, "{V} {:?}", state.modes);
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
