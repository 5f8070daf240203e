//! Lagrange's equations d/dt dL/dv = dL/dq + F with L = T - V, differentiated by dual numbers.

use std::cell::RefCell;

use linkage::nalgebra::{SMatrix, SVector};
use linkage_oracle::close;
use num_dual::{Dual64, HyperDual64};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use linkage_gallery::{cart_pendulum, double_pendulum, three_link_arm};

use super::energies::{Arm, Cart, Double, Energies};

/// Random states of each scene.
const STATES: usize = 1000;

/// 13 digits of the largest term.
const TOLERANCE: f64 = 1e-13;

/// M a = F + `given` at v'' = a: the mass matrix, the force without `given`, and the sum of the magnitudes of its terms.
struct Motion<const V: usize> {
    mass: SMatrix<f64, V, V>,
    force: SVector<f64, V>,
    size: SVector<f64, V>,
}

/// M_jk = d2T/dv_j dv_k, and F_j = dL/dq_j - sum d2T/dv_j dq_k v_k.
fn lagrange<const V: usize>(system: &impl Energies<V>, q: [f64; V], v: [f64; V]) -> Motion<V> {
    let unit = |place: usize, at: usize| f64::from(u8::from(place == at));
    let constant = |value: f64| HyperDual64::new(value, 0.0, 0.0, 0.0);
    let mass = SMatrix::from_fn(|row, column| {
        let rates = std::array::from_fn(|at| HyperDual64::new(v[at], unit(row, at), unit(column, at), 0.0));
        system.kinetic(q.map(constant), rates).eps1eps2
    });
    let along = |row: usize| {
        let moving = std::array::from_fn(|at| HyperDual64::new(q[at], 0.0, v[at], 0.0));
        let rates = std::array::from_fn(|at| HyperDual64::new(v[at], unit(row, at), 0.0, 0.0));
        system.kinetic(moving, rates).eps1eps2
    };
    let by_position = |row: usize| {
        let moved: [Dual64; V] = std::array::from_fn(|at| Dual64::new(q[at], unit(row, at)));
        [system.kinetic(moved, v.map(Dual64::from_re)).eps, -system.potential(moved).eps]
    };
    let terms = |row: usize| {
        let [kinetic, potential] = by_position(row);
        [kinetic, potential, -along(row)]
    };
    Motion {
        mass,
        force: SVector::from_fn(|row, _| terms(row).iter().sum()),
        size: SVector::from_fn(|row, _| terms(row).iter().map(|term| term.abs()).sum()),
    }
}

impl<const V: usize> Motion<V> {
    /// Adds a force F along a scalar with these derivatives by q.
    fn add(&mut self, force: f64, by: [f64; V]) {
        let by = SVector::from(by) * force;
        (self.force, self.size) = (self.force + by, self.size + by.abs());
    }

    /// Compares an emitted mass matrix and emitted forces.
    #[track_caller]
    fn agrees(&self, mass: SMatrix<f64, V, V>, force: SVector<f64, V>) {
        for (row, column) in (0..V).flat_map(|row| (0..V).map(move |column| (row, column))) {
            let scale = (self.mass[(row, row)] * self.mass[(column, column)]).sqrt();
            close("M", mass[(row, column)], self.mass[(row, column)], TOLERANCE * scale);
        }
        for row in 0..V {
            close("Q", force[row], self.force[row], TOLERANCE * self.size[row]);
        }
    }

    /// M a = F + `given` holds for emitted accelerations and for the forces of drives.
    #[track_caller]
    fn holds(&self, acceleration: SVector<f64, V>, given: [f64; V]) {
        for (row, given) in given.into_iter().enumerate() {
            let inert = (self.mass * acceleration)[row];
            let size = self.size[row] + (self.mass.abs() * acceleration.abs())[row] + given.abs();
            close("M v''", inert, self.force[row] + given, TOLERANCE * size);
        }
    }
}

/// Calls `check` with random factors for the parameters, positions, rates and times.
fn at_random<const V: usize>(check: impl Fn(&dyn Fn(f64) -> f64, [f64; V], [f64; V], f64)) {
    let random = RefCell::new(SmallRng::seed_from_u64(17_881_204));
    let draw = |least: f64, most: f64| random.borrow_mut().random_range(least..most);
    for _ in 0..STATES {
        let (q, v) = (std::array::from_fn(|_| draw(-3.2, 3.2)), std::array::from_fn(|_| draw(-9.0, 9.0)));
        check(&|value| value * draw(0.4, 2.5), q, v, draw(-4.0, 4.0));
    }
}

#[test]
fn double_pendulum() {
    use double_pendulum::*;
    at_random(|vary, q: [f64; 2], v: [f64; 2], t| {
        let of = DoublePendulum::default().map(vary);
        let [m1, m2, j1, j2, g] = [1.5, 0.9, 0.13, 0.06, 9.81].map(vary);
        let system = Double { of: of.clone(), m: [m1, m2], j: [j1, j2], g };
        let position = DoublePendulumCoordinates { theta1: q[0], theta2: q[1] };
        let rates = DoublePendulumInputs { theta1: v[0], theta2: v[1] };

        let swinging = Swinging { mechanism: of.clone(), m1, j1, m2, j2, g };
        let free = lagrange(&system, q, v);
        let mass = swinging.mass_matrix(&position).unwrap();
        free.agrees(mass, swinging.forces(t, &position, rates).unwrap());
        free.holds(swinging.acceleration(t, &position, rates).unwrap().into(), [0.0; 2]);
        let energy = swinging.energy(&position, rates).unwrap();
        let (kinetic, potential) = (system.kinetic(q, v), system.potential(q));
        close("T", energy.kinetic, kinetic, TOLERANCE * kinetic.abs());
        let scale = g * (m1 * of.s1 + m2 * (of.l1 + of.s2 + of.h2));
        close("V", energy.potential, potential, TOLERANCE * scale);

        let [k, c] = [3.0, 0.4].map(vary);
        let damped = Damped { mechanism: of.clone(), m1, j1, m2, j2, g, k, c, ..Damped::default() };
        let mut held = lagrange(&system, q, v);
        held.add(-k * (q[1] - q[0] - 0.3), [-1.0, 1.0]);
        held.add(-c * (v[1] - v[0]), [-1.0, 1.0]);
        held.add(2.0 * (3.0 * t).sin(), [1.0, 0.0]);
        held.agrees(mass, damped.forces(t, &position, rates).unwrap());
        held.holds(damped.acceleration(t, &position, rates).unwrap().into(), [0.0; 2]);
        let power = damped.power(t, &position, rates).unwrap();
        close("applied", power.applied, 2.0 * (3.0 * t).sin() * v[0], TOLERANCE * 2.0 * v[0].abs());
        let dissipated = c * (v[1] - v[0]).powi(2);
        close("dissipated", power.dissipated, dissipated, TOLERANCE * c * (v[1].abs() + v[0].abs()).powi(2));

        let half = Half { mechanism: of, m1, j1, m2, j2, g };
        let acceleration = half.acceleration(t, &position, rates).unwrap();
        assert_eq!(acceleration.theta2, 0.0);
        let torque = half.drive_forces(t, &position, rates).unwrap().theta2;
        free.holds(acceleration.into(), [0.0, torque]);
    });
}

#[test]
fn three_link_arm() {
    use three_link_arm::*;
    at_random(|vary, q: [f64; 3], v: [f64; 3], t| {
        let of = ThreeLinkArm::default().map(vary);
        let [m1, m2, m3, load] = [4.0, 3.0, 1.5, 2.0].map(vary);
        let [j1, j2, j3, g] = [0.12, 0.08, 0.02, 9.81].map(vary);
        let system = Arm { of: of.clone(), m: [m1, m2, m3], j: [j1, j2, j3], load, g };
        let position = ThreeLinkArmCoordinates { phi1: q[0], phi2: q[1], phi3: q[2] };
        let rates = ThreeLinkArmInputs { phi1: v[0], phi2: v[1], phi3: v[2] };

        let falling = Falling { mechanism: of.clone(), m1, j1, m2, j2, m3, j3, load, g };
        let free = lagrange(&system, q, v);
        let mass = falling.mass_matrix(&position).unwrap();
        free.agrees(mass, falling.forces(t, &position, rates).unwrap());
        free.holds(falling.acceleration(t, &position, rates).unwrap().into(), [0.0; 3]);
        let kinetic = system.kinetic(q, v);
        close("T", falling.energy(&position, rates).unwrap().kinetic, kinetic, TOLERANCE * kinetic);

        // The force on the tool by the velocity ratios of the tool; frictions are not part of the forces.
        let pushed = Pushed { mechanism: of.clone(), m1, j1, m2, j2, m3, j3, load, g, ..Pushed::default() };
        let angles = [q[0], q[0] + q[1], q[0] + q[1] + q[2]];
        let links = [of.a, of.b, of.c];
        let from = |link: usize, part: fn(f64) -> f64| -> f64 {
            (link..3).map(|place| links[place] * part(angles[place])).sum()
        };
        let mut forced = lagrange(&system, q, v);
        forced.add(8.0 * (2.0 * t).cos(), [0, 1, 2].map(|link| -from(link, f64::sin)));
        forced.add(3.0, [0, 1, 2].map(|link| from(link, f64::cos)));
        forced.add(-(0.5 + 0.1 * v[1] * v[1]) * v[1], [0.0, 1.0, 0.0]);
        forced.agrees(mass, pushed.forces(t, &position, rates).unwrap());

        let bent = [-1.6 * (2.0 * t).sin(), 0.0, 2.0 / 3.0];
        let moved = Moved { mechanism: of.clone(), m1, j1, m2, j2, m3, j3, load, g };
        let acceleration = moved.acceleration(t, &position, rates).unwrap();
        close("the law", acceleration.phi1, bent[0], 1e-15);
        let MovedDrives { phi1: shoulder, phi2: elbow } = moved.drive_forces(t, &position, rates).unwrap();
        free.holds(acceleration.into(), [shoulder, elbow, 0.0]);
        let led = Led { mechanism: of, m1, j1, m2, j2, m3, j3, load, g };
        let LedDrives { phi1, phi2, phi3 } = led.drive_forces(t, &position, rates).unwrap();
        free.holds(bent.into(), [phi1, phi2, phi3]);
    });
}

#[test]
fn cart_with_a_pendulum() {
    use cart_pendulum::*;
    at_random(|vary, q: [f64; 2], v: [f64; 2], t| {
        let of = CartPendulum::default().map(vary);
        let [mc, m, j, g, k] = [3.0, 1.0, 0.02, 9.81, 40.0].map(vary);
        let system = Cart { of: of.clone(), mc, m, j, g };
        let position = CartPendulumCoordinates { x: q[0], phi: q[1] };
        let rates = CartPendulumInputs { x: v[0], phi: v[1] };

        let rolling = Rolling { mechanism: of.clone(), mc, m, j, g };
        let free = lagrange(&system, q, v);
        let mass = rolling.mass_matrix(&position).unwrap();
        free.agrees(mass, rolling.forces(t, &position, rates).unwrap());
        free.holds(rolling.acceleration(t, &position, rates).unwrap().into(), [0.0; 2]);

        let sprung = Sprung { mechanism: of.clone(), mc, m, j, g, k };
        let mut held = lagrange(&system, q, v);
        held.add(-k * q[0], [1.0, 0.0]);
        held.add(-2.0 * v[0], [1.0, 0.0]);
        held.agrees(mass, sprung.forces(t, &position, rates).unwrap());

        let shaken = Shaken { mechanism: of, mc, m, j, g };
        let acceleration = shaken.acceleration(t, &position, rates).unwrap();
        close("the law", acceleration.x, -8.1 * (9.0 * t).sin(), 1e-14);
        let force = shaken.drive_forces(t, &position, rates).unwrap().x;
        free.holds(acceleration.into(), [force, 0.0]);
    });
}
