//! The equations of motion of linkages of one and of two inputs, by virtual work and by Lagrange.

use linkage::Real;
use num_dual::{Dual2_64, Dual64};

use super::machines::*;
use super::virtual_work::{Placed, Positions, agrees, at_random, constant, lagrange, virtual_work};

#[test]
fn four_bar_by_virtual_work() {
    let (idle, loaded, driven) = (Idle::default(), Loaded::default(), Driven::default());
    at_random(|v: [f64; 1], rate: [f64; 1], t| {
        let q = four_bar_at(v).unwrap();
        let mut expected = virtual_work(&FourBarPositions, v, rate, [0.0, -idle.g]);
        agrees("M", idle.mass_matrix(&q).unwrap()[0], expected.mass[0][0], 0.0);
        assert_eq!(loaded.mass_matrix(&q), idle.mass_matrix(&q));
        agrees("Q", idle.forces(t, &q, rate[0]).unwrap()[0], expected.forces[0], expected.sizes[0]);
        let by_lagrange =
            lagrange(|v| [[idle.clone().map(constant).mass_matrix(&four_bar_at(v).unwrap()).unwrap()[0]]], v, rate);
        let mut weightless = idle.clone();
        weightless.g = 0.0;
        agrees("Eksergian", weightless.forces(t, &q, rate[0]).unwrap()[0], by_lagrange[0], expected.sizes[0]);
        let acceleration = idle.acceleration(t, &q, rate[0]).unwrap().theta2;
        agrees("v''", acceleration * expected.mass[0][0], expected.forces[0], expected.sizes[0]);

        // The driving torque is the residual of the law.
        let mut resisted = virtual_work(&FourBarPositions, v, rate, [0.0, -idle.g]);
        resisted.add(1, |_, speed| -driven.ct * speed);
        let bent = -9.0 * (3.0 * t).sin();
        let torque = driven.drive_forces(t, &q, rate[0]).unwrap().theta2;
        let scale = resisted.sizes[0] + (expected.mass[0][0] * bent).abs();
        agrees("drive", torque, expected.mass[0][0] * bent - resisted.forces[0], scale);
        agrees("v'' of the drive", driven.acceleration(t, &q, rate[0]).unwrap().theta2, bent, 1.0);
        let law = driven.drives(t).theta2;
        agrees("law", law.value, 12.0 * t + (3.0 * t).sin(), 1.0);
        agrees("law", law.rate, 12.0 + 3.0 * (3.0 * t).cos(), 1.0);
        agrees("law", law.acceleration, bent, 1.0);

        expected.add(0, |length, _| -loaded.k * (length - loaded.s0));
        expected.add(0, |_, speed| -loaded.c * speed);
        expected.add(1, |angle, _| -loaded.kt * (angle - loaded.phi0));
        expected.add(1, |_, speed| -loaded.ct * speed);
        expected.add(2, |_, _| -1.0);
        expected.add(3, |_, _| -loaded.f * t);
        let motor = loaded.t0 - loaded.kw * rate[0] + t.sin();
        agrees("loaded", loaded.forces(t, &q, rate[0]).unwrap()[0], expected.forces[0] + motor, expected.sizes[0]);
    });
}

#[test]
fn five_bar_by_virtual_work() {
    let (free, half) = (Free::default(), Half::default());
    at_random(|v: [f64; 2], rate: [f64; 2], t| {
        let at = |v: [Dual64; 2]| {
            let pair = Pair::default().map(constant::<Dual64>);
            pair.assemble(PairInputs { theta1: v[0], theta4: v[1] }, PAIR).unwrap().coordinates()
        };
        let Ok(pose) = free.mechanism.assemble(PairInputs { theta1: v[0], theta4: v[1] }, PAIR) else { return };
        let q = pose.coordinates();
        let rates = PairInputs { theta1: rate[0], theta4: rate[1] };
        let bare = virtual_work(&PairPositions, v, rate, [0.0, 0.0]);
        let mut expected = virtual_work(&PairPositions, v, rate, [0.0, -free.g]);
        let size = expected.sizes[0].max(expected.sizes[1]);
        let mass = free.mass_matrix(&q).unwrap();
        for row in 0..2 {
            for column in 0..2 {
                let scale = (expected.mass[row][row] * expected.mass[column][column]).sqrt();
                agrees("M", mass[(row, column)], expected.mass[row][column], scale);
            }
        }
        let mut inert = free.clone();
        (inert.g, inert.kt, inert.ct) = (0.0, 0.0, 0.0);
        let quadratic = lagrange(|v| inert.clone().map(constant).mass_matrix(&at(v)).unwrap().into(), v, rate);
        let found = inert.forces(t, &q, rates).unwrap();
        agrees("Lagrange", found[0] - 2.0 * t.sin() + q.theta4, quadratic[0], size);
        agrees("Lagrange", found[1], quadratic[1], size);
        agrees("virtual work", bare.forces[1], quadratic[1], size);

        let mut held = virtual_work(&PairPositions, v, rate, [0.0, -free.g]);
        expected.add(0, |opening, _| -free.kt * (opening - 0.4));
        expected.add(0, |_, speed| -free.ct * speed);
        expected.forces[0] += 2.0 * t.sin() - q.theta4;
        let found = free.forces(t, &q, rates).unwrap();
        let acceleration = free.acceleration(t, &q, rates).unwrap();
        let size = size.max(expected.sizes[0]).max(expected.sizes[1]);
        for row in 0..2 {
            agrees("Q", found[row], expected.forces[row], size);
            let left = mass[(row, 0)] * acceleration.theta1 + mass[(row, 1)] * acceleration.theta4;
            let scale = (mass[(row, 0)] * acceleration.theta1).abs() + size;
            agrees("M v''", left, expected.forces[row], scale);
        }

        // theta4 is driven: the torque there, and theta1 as it falls.
        held.add(0, |_, speed| -half.ct * speed);
        let acceleration = half.acceleration(t, &q, rates).unwrap();
        assert_eq!(acceleration.theta4, 1.0);
        let torque = half.drive_forces(t, &q, rates).unwrap().theta4;
        for (row, force) in [(0, 0.0), (1, torque)] {
            let left = mass[(row, 0)] * acceleration.theta1 + mass[(row, 1)];
            let scale = (mass[(row, 0)] * acceleration.theta1).abs() + size;
            agrees("half driven", left, held.forces[row] + force, scale);
        }
    });
}

/// Two drivers of one mechanism: `crank` and `piston` have the same bodies.
#[test]
fn slider_crank_by_either_driver() {
    struct OfCrank;
    impl Positions<1> for OfCrank {
        fn bodies<T: Real>(&self, v: [T; 1]) -> Vec<Placed<T>> {
            let (m, scene) = (Crank::from(Machine::default()).map(constant::<T>), Turning::default());
            let pose = m.assemble(v[0], CrankBranch { psi_z: linkage::Slider::Far }).unwrap();
            let (points, q) = (m.points(&pose).unwrap(), pose.coordinates());
            let quarter = constant::<T>(0.25);
            vec![
                (scene.m2, scene.j2, [points.pin.x * quarter, points.pin.y * quarter], q.phi),
                (scene.m3, scene.j3, points.g3.into(), q.psi),
                (scene.m4, 0.0, [q.z, T::zero()], T::zero()),
            ]
        }

        fn scalars<T: Real>(&self, v: [T; 1]) -> Vec<T> {
            let m = Crank::from(Machine::default()).map(constant::<T>);
            vec![m.assemble(v[0], CrankBranch { psi_z: linkage::Slider::Far }).unwrap().coordinates().z]
        }
    }
    let (turning, steady, pushed) = (Turning::default(), Steady::default(), Pushed::default());
    at_random(|v: [f64; 1], rate: [f64; 1], t| {
        let q = turning.mechanism.assemble(v[0], CrankBranch { psi_z: linkage::Slider::Far }).unwrap().coordinates();
        let mut expected = virtual_work(&OfCrank, v, rate, [0.0, -turning.g]);
        let light = virtual_work(&OfCrank, v, rate, [0.0, 0.0]);
        let mass = turning.mass_matrix(&q).unwrap()[0];
        agrees("M", mass, expected.mass[0][0], 0.0);
        agrees("inverse dynamics", steady.drive_forces(t, &q, rate[0]).unwrap().phi, -light.forces[0], light.sizes[0]);
        expected.add(0, |z, speed| -turning.k * (z - turning.z0) - turning.c * speed);
        agrees("Q", turning.forces(t, &q, rate[0]).unwrap()[0], expected.forces[0], expected.sizes[0]);

        // The same motion seen from the piston: the crank has no inertia there.
        let slope = expected.scalars[0].1[0];
        let crank = turning.m2 * (turning.mechanism.r / 4.0).powi(2) + turning.j2;
        let reduced = pushed.mass_matrix(&q).unwrap()[0];
        agrees("M of the piston", reduced * slope * slope, mass - crank, mass);
        let force = pushed.forces(t, &q, rate[0] * slope).unwrap()[0];
        // M_phi = M_z z_phi^2, so that Q of the crank is Q_z z_phi - M_z z_phi z_phiphi phi'^2.
        let along = Dual2_64::new(v[0], rate[0], 0.0);
        let bent = OfCrank.scalars([along])[0].v2;
        let by_crank = light.forces[0] - pushed.c * rate[0] + 30.0 * (9.0 * t).cos() * slope;
        let scale = light.sizes[0] + (pushed.c * rate[0]).abs() + (reduced * slope * bent).abs();
        agrees("Q of the piston", force * slope - reduced * slope * bent, by_crank, scale);
    });
}
