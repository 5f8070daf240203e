//! Scenes: the equations of motion against the principle of virtual work with dual numbers along positions alone,
//! against Lagrange's equations of the emitted mass matrix, against published numbers, and against energy.

use linkage::nalgebra::RealField;
use linkage::{Real, Scene, linkage};
use num_dual::{Dual2_64, Dual64};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

include!("mechanisms/andrews_scene.rs");
include!("mechanisms/five_bar_scenes.rs");
include!("mechanisms/four_bar_scenes.rs");
include!("mechanisms/slider_crank_scenes.rs");

/// Poses a scene.
const POSES: usize = 300;

/// The promise: relative error of one formula against another.
const TOLERANCE: f64 = 1e-11;

#[track_caller]
fn close(what: &str, found: f64, expected: f64, scale: f64) {
    let error = (found - expected).abs();
    let scale = scale.max(expected.abs());
    assert!(error <= TOLERANCE * scale, "{what}: {found:e} is not {expected:e}, off by {error:e} of {scale:e}");
}

/// A body at a position: mass, moment of inertia, centre and angle.
type Placed<T> = (f64, f64, [T; 2], T);

/// What position says of one scene: its bodies, and the scalars that its laws act along.
trait Positions<const V: usize> {
    fn bodies<T: Real>(&self, v: [T; V]) -> Vec<Placed<T>>;
    fn scalars<T: Real>(&self, v: [T; V]) -> Vec<T>;
}

/// M, the part of Q that is left of inertia and the field g, and of each scalar its derivatives and its rate.
struct Virtual<const V: usize> {
    mass: [[f64; V]; V],
    forces: [f64; V],
    /// The sum of the magnitudes of what the forces are made of.
    sizes: [f64; V],
    scalars: Vec<(f64, [f64; V], f64)>,
}

/// M_jk = sum m G_j . G_k + j w_j w_k and Q_j = -sum m G_j . (G'' - g) + j w_j phi'' at v'' = 0: first derivatives
/// by dual numbers along the inputs, second ones by those along v'.
fn virtual_work<const V: usize>(
    positions: &impl Positions<V>,
    v: [f64; V],
    rate: [f64; V],
    field: [f64; 2],
) -> Virtual<V> {
    let along = |input: usize| -> [Dual64; V] {
        std::array::from_fn(|place| Dual64::new(v[place], f64::from(u8::from(place == input))))
    };
    let path: [Dual2_64; V] = std::array::from_fn(|place| Dual2_64::new(v[place], rate[place], 0.0));
    let moved: Vec<Vec<Placed<Dual64>>> = (0..V).map(|input| positions.bodies(along(input))).collect();
    let (mut mass, mut forces, mut sizes) = ([[0.0; V]; V], [0.0; V], [0.0; V]);
    for (place, (m, j, center, angle)) in positions.bodies(path).into_iter().enumerate() {
        for row in 0..V {
            let (_, _, [x, y], phi) = &moved[row][place];
            for column in 0..V {
                let (_, _, [u, w], psi) = &moved[column][place];
                mass[row][column] += m * (x.eps * u.eps + y.eps * w.eps) + j * phi.eps * psi.eps;
            }
            for term in [
                m * x.eps * center[0].v2,
                m * y.eps * center[1].v2,
                j * phi.eps * angle.v2,
                -m * x.eps * field[0],
                -m * y.eps * field[1],
            ] {
                forces[row] -= term;
                sizes[row] += term.abs();
            }
        }
    }
    let derivatives: Vec<Vec<Dual64>> = (0..V).map(|input| positions.scalars(along(input))).collect();
    let of = |place: usize| std::array::from_fn(|input| derivatives[input][place].eps);
    let rates = positions.scalars(path).into_iter().enumerate();
    let scalars = rates.map(|(place, scalar)| (scalar.re, of(place), scalar.v1)).collect();
    Virtual { mass, forces, sizes, scalars }
}

impl<const V: usize> Virtual<V> {
    /// Adds a force along a scalar.
    fn add(&mut self, place: usize, law: impl Fn(f64, f64) -> f64) {
        let (value, by, rate) = self.scalars[place];
        let force = law(value, rate);
        for (input, by) in by.into_iter().enumerate() {
            self.forces[input] += force * by;
            self.sizes[input] += (force * by).abs();
        }
    }
}

/// Lagrange: Q_j = v' (dM/dv_j) v' / 2 - sum (dM/dv_k v'_k v')_j from a mass matrix at dual positions.
fn lagrange<const V: usize>(mass: impl Fn([Dual64; V]) -> [[Dual64; V]; V], v: [f64; V], rate: [f64; V]) -> [f64; V] {
    let by: Vec<[[Dual64; V]; V]> = (0..V)
        .map(|input| mass(std::array::from_fn(|place| Dual64::new(v[place], f64::from(u8::from(place == input))))))
        .collect();
    std::array::from_fn(|j| {
        let mut force = 0.0;
        for a in 0..V {
            for b in 0..V {
                force += by[j][a][b].eps * rate[a] * rate[b] / 2.0 - by[b][j][a].eps * rate[a] * rate[b];
            }
        }
        force
    })
}

fn constant<T: RealField + Copy>(value: f64) -> T {
    linkage::nalgebra::convert(value)
}

/// Calls `check` with random inputs and rates.
fn at_random<const V: usize>(check: impl Fn([f64; V], [f64; V], f64)) {
    let mut random = SmallRng::seed_from_u64(19_260_321);
    for _ in 0..POSES {
        let mut draw = |size: f64| std::array::from_fn(|_| random.random_range(-size..size));
        check(draw(3.0), draw(8.0), draw(5.0)[0]);
    }
}

const FOUR_BAR: LoadedFourBarBranch = LoadedFourBarBranch { theta3_theta4: linkage::Elbow::Left };

fn four_bar_at<T: Real>(v: [T; 1]) -> Option<LoadedFourBarCoordinates<T>> {
    let four_bar = LoadedFourBar::default().map(constant);
    Some(four_bar.assemble(v[0], FOUR_BAR).ok()?.coordinates())
}

struct FourBarPositions;

impl Positions<1> for FourBarPositions {
    fn bodies<T: Real>(&self, v: [T; 1]) -> Vec<Placed<T>> {
        let (m, scene) = (LoadedFourBar::default().map(constant::<T>), Idle::default());
        let pose = m.assemble(v[0], FOUR_BAR).unwrap();
        let (points, q) = (m.points(&pose).unwrap(), pose.coordinates());
        vec![
            (scene.m2, scene.j2, points.g2.into(), q.theta2),
            (scene.m3, scene.j3, points.g3.into(), q.theta3),
            (scene.m4, scene.j4, points.g4.into(), q.theta4),
        ]
    }

    fn scalars<T: Real>(&self, v: [T; 1]) -> Vec<T> {
        let (m, scene) = (LoadedFourBar::default().map(constant::<T>), Loaded::default());
        let pose = m.assemble(v[0], FOUR_BAR).unwrap();
        let (c, q) = (m.points(&pose).unwrap().c, pose.coordinates());
        let (x, y) = (c.x - constant::<T>(scene.xp), c.y - constant::<T>(scene.yp));
        let length = (x * x + y * y).sqrt();
        let turn = q.theta3 - v[0];
        let v = constant::<T>(2.0) * q.theta4.sin() * turn * turn;
        vec![length, q.theta4, v, c.y]
    }
}

#[test]
fn four_bar_by_virtual_work() {
    let (idle, loaded, driven) = (Idle::default(), Loaded::default(), Driven::default());
    at_random(|v: [f64; 1], rate: [f64; 1], t| {
        let q = four_bar_at(v).unwrap();
        let mut expected = virtual_work(&FourBarPositions, v, rate, [0.0, -idle.g]);
        close("M", idle.mass_matrix(&q).unwrap()[0], expected.mass[0][0], 0.0);
        assert_eq!(loaded.mass_matrix(&q), idle.mass_matrix(&q));
        close("Q", idle.forces(t, &q, rate[0]).unwrap()[0], expected.forces[0], expected.sizes[0]);
        let by_lagrange =
            lagrange(|v| [[idle.clone().map(constant).mass_matrix(&four_bar_at(v).unwrap()).unwrap()[0]]], v, rate);
        let mut weightless = idle.clone();
        weightless.g = 0.0;
        close("Eksergian", weightless.forces(t, &q, rate[0]).unwrap()[0], by_lagrange[0], expected.sizes[0]);
        let acceleration = idle.acceleration(t, &q, rate[0]).unwrap().theta2;
        close("v''", acceleration * expected.mass[0][0], expected.forces[0], expected.sizes[0]);

        // The torque that drives is what is missing to the law.
        let mut resisted = virtual_work(&FourBarPositions, v, rate, [0.0, -idle.g]);
        resisted.add(1, |_, speed| -driven.ct * speed);
        let bent = -9.0 * (3.0 * t).sin();
        let torque = driven.drive_forces(t, &q, rate[0]).unwrap()[0];
        let scale = resisted.sizes[0] + (expected.mass[0][0] * bent).abs();
        close("drive", torque, expected.mass[0][0] * bent - resisted.forces[0], scale);
        close("v'' of the drive", driven.acceleration(t, &q, rate[0]).unwrap().theta2, bent, 1.0);
        let law = [12.0 * t + (3.0 * t).sin(), 12.0 + 3.0 * (3.0 * t).cos(), bent];
        for (found, expected) in driven.drives(t)[0].into_iter().zip(law) {
            close("law", found, expected, 1.0);
        }

        expected.add(0, |length, _| -loaded.k * (length - loaded.s0));
        expected.add(0, |_, speed| -loaded.c * speed);
        expected.add(1, |angle, _| -loaded.kt * (angle - loaded.phi0));
        expected.add(1, |_, speed| -loaded.ct * speed);
        expected.add(2, |_, _| -1.0);
        expected.add(3, |_, _| -loaded.f * t);
        let motor = loaded.t0 - loaded.kw * rate[0] + t.sin();
        close("loaded", loaded.forces(t, &q, rate[0]).unwrap()[0], expected.forces[0] + motor, expected.sizes[0]);
    });
}

const PAIR: PairBranch = PairBranch { theta2_theta3: linkage::Elbow::Right };

struct PairPositions;

impl Positions<2> for PairPositions {
    fn bodies<T: Real>(&self, v: [T; 2]) -> Vec<Placed<T>> {
        let (m, scene) = (Pair::default().map(constant::<T>), Free::default());
        let pose = m.assemble(PairInputs { theta1: v[0], theta4: v[1] }, PAIR).unwrap();
        let (points, q) = (m.points(&pose).unwrap(), pose.coordinates());
        vec![
            (scene.m1, scene.j1, points.g1.into(), q.theta1),
            (scene.m2, scene.j2, points.g2.into(), q.theta2),
            (scene.m3, scene.j3, points.g3.into(), q.theta3),
            (scene.m4, scene.j4, points.g4.into(), q.theta4),
        ]
    }

    fn scalars<T: Real>(&self, v: [T; 2]) -> Vec<T> {
        let m = Pair::default().map(constant::<T>);
        let pose = m.assemble(PairInputs { theta1: v[0], theta4: v[1] }, PAIR).unwrap();
        vec![m.outputs(&pose).unwrap().opening]
    }
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
                close("M", mass[(row, column)], expected.mass[row][column], scale);
            }
        }
        let mut inert = free.clone();
        (inert.g, inert.kt, inert.ct) = (0.0, 0.0, 0.0);
        let quadratic = lagrange(|v| inert.clone().map(constant).mass_matrix(&at(v)).unwrap().into(), v, rate);
        let found = inert.forces(t, &q, rates).unwrap();
        close("Lagrange", found[0] - 2.0 * t.sin() + q.theta4, quadratic[0], size);
        close("Lagrange", found[1], quadratic[1], size);
        close("virtual work", bare.forces[1], quadratic[1], size);

        let mut held = virtual_work(&PairPositions, v, rate, [0.0, -free.g]);
        expected.add(0, |opening, _| -free.kt * (opening - 0.4));
        expected.add(0, |_, speed| -free.ct * speed);
        expected.forces[0] += 2.0 * t.sin() - q.theta4;
        let found = free.forces(t, &q, rates).unwrap();
        let acceleration = free.acceleration(t, &q, rates).unwrap();
        let size = size.max(expected.sizes[0]).max(expected.sizes[1]);
        for row in 0..2 {
            close("Q", found[row], expected.forces[row], size);
            let left = mass[(row, 0)] * acceleration.theta1 + mass[(row, 1)] * acceleration.theta4;
            let scale = (mass[(row, 0)] * acceleration.theta1).abs() + size;
            close("M v''", left, expected.forces[row], scale);
        }

        // theta4 is driven: the torque there, and theta1 as it falls.
        held.add(0, |_, speed| -half.ct * speed);
        let acceleration = half.acceleration(t, &q, rates).unwrap();
        assert_eq!(acceleration.theta4, 1.0);
        let torque = half.drive_forces(t, &q, rates).unwrap()[0];
        for (row, force) in [(0, 0.0), (1, torque)] {
            let left = mass[(row, 0)] * acceleration.theta1 + mass[(row, 1)];
            let scale = (mass[(row, 0)] * acceleration.theta1).abs() + size;
            close("half driven", left, held.forces[row] + force, scale);
        }
    });
}

/// Of the two drivers of one mechanism: `crank` and `piston` are the same bodies.
#[test]
fn slider_crank_by_either_driver() {
    struct OfCrank;
    impl Positions<1> for OfCrank {
        fn bodies<T: Real>(&self, v: [T; 1]) -> Vec<Placed<T>> {
            let (m, scene) = (Crank::from(Machine::default()).map(constant::<T>), Turning::default());
            let pose = m.assemble(v[0], CrankBranch { psi: linkage::Slope::Rising }).unwrap();
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
            vec![m.assemble(v[0], CrankBranch { psi: linkage::Slope::Rising }).unwrap().coordinates().z]
        }
    }
    let (turning, steady, pushed) = (Turning::default(), Steady::default(), Pushed::default());
    at_random(|v: [f64; 1], rate: [f64; 1], t| {
        let q = turning.mechanism.assemble(v[0], CrankBranch { psi: linkage::Slope::Rising }).unwrap().coordinates();
        let mut expected = virtual_work(&OfCrank, v, rate, [0.0, -turning.g]);
        let light = virtual_work(&OfCrank, v, rate, [0.0, 0.0]);
        let mass = turning.mass_matrix(&q).unwrap()[0];
        close("M", mass, expected.mass[0][0], 0.0);
        close("inverse dynamics", steady.drive_forces(t, &q, rate[0]).unwrap()[0], -light.forces[0], light.sizes[0]);
        expected.add(0, |z, speed| -turning.k * (z - turning.z0) - turning.c * speed);
        close("Q", turning.forces(t, &q, rate[0]).unwrap()[0], expected.forces[0], expected.sizes[0]);

        // The same motion seen from the piston: the crank has no inertia there.
        let slope = expected.scalars[0].1[0];
        let crank = turning.m2 * (turning.mechanism.r / 4.0).powi(2) + turning.j2;
        let reduced = pushed.mass_matrix(&q).unwrap()[0];
        close("M of the piston", reduced * slope * slope, mass - crank, mass);
        let force = pushed.forces(t, &q, rate[0] * slope).unwrap()[0];
        // M_phi = M_z z_phi^2, so that Q of the crank is Q_z z_phi - M_z z_phi z_phiphi phi'^2.
        let along = Dual2_64::new(v[0], rate[0], 0.0);
        let bent = OfCrank.scalars([along])[0].v2;
        let by_crank = light.forces[0] - pushed.c * rate[0] + 30.0 * (9.0 * t).cos() * slope;
        let scale = light.sizes[0] + (pushed.c * rate[0]).abs() + (reduced * slope * bent).abs();
        close("Q of the piston", force * slope - reduced * slope * bent, by_crank, scale);
    });
}

/// dE/dt along the motion that a scene gives, by dual numbers, against the power of what drives and brakes.
macro_rules! balance {
    ($scene:expr, $v:expr, $rate:expr, $t:expr, $Inputs:ident { $($input:ident),* }, $Coordinates:ident { $($coordinate:ident),* }) => {{
        let (scene, rates) = ($scene, $rate);
        let (velocity, acceleration) = scene.rates($t, &$v, rates).unwrap();
        let dual = scene.clone().map(constant::<Dual64>);
        let q = $Coordinates { $($coordinate: Dual64::new($v.$coordinate, velocity.$coordinate)),* };
        let moved = $Inputs { $($input: Dual64::new(rates.$input, acceleration.$input)),* };
        let energy = dual.energy(&q, moved).unwrap();
        let (power, now) = (scene.power($t, &$v, rates).unwrap(), scene.energy(&$v, rates).unwrap());
        close("kinetic energy", energy.kinetic.re, now.kinetic, 0.0);
        close("potential energy", energy.potential.re, now.potential, 0.0);
        let scale = energy.kinetic.eps.abs() + energy.potential.eps.abs() + power.applied.abs() + power.dissipated.abs();
        close("power", power.applied - power.dissipated, energy.kinetic.eps + energy.potential.eps, scale);
    }};
}

#[test]
fn energy_balances() {
    let (loaded, driven, free, half) = (Loaded::default(), Driven::default(), Free::default(), Half::default());
    let (turning, pushed) = (Turning::default(), Pushed::default());
    at_random(|v: [f64; 2], rate: [f64; 2], t| {
        let q = four_bar_at([v[0]]).unwrap();
        let rates = LoadedFourBarInputs { theta2: rate[0] };
        balance!(
            &loaded,
            q,
            rates,
            t,
            LoadedFourBarInputs { theta2 },
            LoadedFourBarCoordinates { theta2, theta3, theta4 }
        );
        balance!(
            &driven,
            q,
            rates,
            t,
            LoadedFourBarInputs { theta2 },
            LoadedFourBarCoordinates { theta2, theta3, theta4 }
        );
        let q = turning.mechanism.assemble(v[0], CrankBranch { psi: linkage::Slope::Rising }).unwrap().coordinates();
        let rates = CrankInputs { phi: rate[0] };
        balance!(&turning, q, rates, t, CrankInputs { phi }, MachineCoordinates { phi, psi, z });
        let rates = PistonInputs { z: rate[0] };
        balance!(&pushed, q, rates, t, PistonInputs { z }, MachineCoordinates { phi, psi, z });
        let Ok(pose) = free.mechanism.assemble(PairInputs { theta1: v[0], theta4: v[1] }, PAIR) else { return };
        let (q, rates) = (pose.coordinates(), PairInputs { theta1: rate[0], theta4: rate[1] });
        balance!(&free, q, rates, t, PairInputs { theta1, theta4 }, PairCoordinates { theta1, theta2, theta3, theta4 });
        balance!(&half, q, rates, t, PairInputs { theta1, theta4 }, PairCoordinates { theta1, theta2, theta3, theta4 });
    });
}

/// Andrews' mechanism: at the start as the Test Set for IVP Solvers (F. Mazzia, C. Magherini) gives it, in motion
/// W' M W with the mass matrix of the seven coordinates that the Test Set prints.
#[test]
fn andrews_as_published() {
    let scene = Squeezing::default();
    let start = SqueezerCoordinates {
        beta: -0.061_713_890_014_276_5,
        theta: 0.0,
        gamma: 0.455_279_819_163_070_4,
        phi: 0.222_668_390_165_885_88,
        delta: 0.487_364_979_543_842_54,
        omega: -0.222_668_390_165_885_88,
        epsilon: 1.230_547_444_549_821_3,
    };
    let (_, acceleration) = scene.rates(0.0, &start, 0.0).unwrap();
    close("beta''", acceleration.beta, 14_222.443_919_954_114, 0.0);
    let published = [98.566_870_396_241_09, -6.122_688_344_255_663, 0.0, 0.0, 0.0, 0.0];
    for (found, expected) in scene.reactions(0.0, &start, 0.0).unwrap().iter().zip(published) {
        close("lambda", *found, expected, 1e2);
    }

    let squeezer = &scene.mechanism;
    let SqueezerCoordinates { theta, phi, omega, .. } = start;
    let Squeezer { rr, e, zt, zf, u, .. } = *squeezer;
    let Squeezing { ra, da, ea, sa, sb, ta, tb, ua, ub, fa, .. } = scene;
    let Squeezing { m1, m2, m3, m4, m5, m6, m7, i1, i2, i3, i4, i5, i6, i7, .. } = scene;
    let mut m = linkage::nalgebra::SMatrix::<f64, 7, 7>::zeros();
    m[(0, 0)] = m1 * ra * ra + m2 * (rr * rr - 2.0 * da * rr * theta.cos() + da * da) + i1 + i2;
    m[(1, 0)] = m2 * (da * da - da * rr * theta.cos()) + i2;
    m[(1, 1)] = m2 * da * da + i2;
    m[(2, 2)] = m3 * (sa * sa + sb * sb) + i3;
    m[(3, 3)] = m4 * (e - ea) * (e - ea) + i4;
    m[(4, 3)] = m4 * ((e - ea) * (e - ea) + zt * (e - ea) * phi.sin()) + i4;
    m[(4, 4)] =
        m4 * (zt * zt + 2.0 * zt * (e - ea) * phi.sin() + (e - ea) * (e - ea)) + m5 * (ta * ta + tb * tb) + i4 + i5;
    m[(5, 5)] = m6 * (zf - fa) * (zf - fa) + i6;
    m[(6, 5)] = m6 * ((zf - fa) * (zf - fa) - u * (zf - fa) * omega.sin()) + i6;
    m[(6, 6)] =
        m6 * ((zf - fa) * (zf - fa) - 2.0 * u * (zf - fa) * omega.sin() + u * u) + m7 * (ua * ua + ub * ub) + i6 + i7;
    m.fill_upper_triangle_with_lower_triangle();
    let ratios = squeezer.velocity_ratios(&squeezer.pose_at(&start)).unwrap();
    let all = linkage::nalgebra::SVector::<f64, 7>::from_fn(|row, _| if row == 0 { 1.0 } else { ratios[row - 1] });
    close("W' M W", scene.mass_matrix(&start).unwrap()[0], (all.transpose() * m * all)[0], 0.0);
    close("spring", scene.energy(&start, 0.0).unwrap().potential, 1.435_796_399_161_670_2, 0.0);

    // After 0.03 s, integrated with 42 digits and given to 20: PSIDE's published values agree to 6.
    let later = SqueezerCoordinates {
        beta: 15.810_771_195_153_707,
        theta: -15.756_371_058_411_84,
        gamma: 0.040_822_240_119_645_8,
        phi: -0.534_730_116_342_079_6,
        delta: 0.524_409_965_879_954_1,
        omega: 0.534_730_116_342_079_6,
        epsilon: 1.048_080_741_041_938,
    };
    let (velocity, acceleration) = scene.rates(0.03, &later, 1_139.920_302_259_106).unwrap();
    close("theta'", velocity.theta, -1_424.379_295_177_540_1, 0.0);
    close("epsilon'", velocity.epsilon, 0.323_179_149_249_130_9, 0.0);
    close("beta''", acceleration.beta, -24_631.763_122_874_634, 0.0);
    let reactions = scene.reactions(0.03, &later, 1_139.920_302_259_106).unwrap();
    let integrated = [
        199.175_348_104_538_63,
        -29.755_309_974_971_763,
        23.066_543_611_622_15,
        31.452_725_275_771_137,
        22.642_494_786_394_38,
        11.617_392_352_611_256,
    ];
    for (found, expected) in reactions.iter().zip(integrated) {
        close("lambda", *found, expected, 0.0);
    }
    let energy = scene.energy(&later, 1_139.920_302_259_106).unwrap();
    let work = scene.mom * (later.beta - start.beta);
    close("energy", energy.kinetic + energy.potential, 1.435_796_399_161_670_2 + work, 0.0);
}

/// The state of a scene as plain numbers, integrated by the classical method of Runge and Kutta.
#[test]
fn a_state_for_integrators() {
    fn run<S: Scene<f64, U, V, N, 0>, const U: usize, const V: usize, const N: usize>(
        scene: &S,
        mut y: linkage::nalgebra::SVector<f64, N>,
        step: f64,
        steps: usize,
    ) -> linkage::nalgebra::SVector<f64, N> {
        let mut t = 0.0;
        for _ in 0..steps {
            let a = scene.derivative(t, &y).unwrap();
            let b = scene.derivative(t + step / 2.0, &(y + a * (step / 2.0))).unwrap();
            let c = scene.derivative(t + step / 2.0, &(y + b * (step / 2.0))).unwrap();
            let d = scene.derivative(t + step, &(y + c * step)).unwrap();
            y = scene.project(&(y + (a + (b + c) * 2.0 + d) * (step / 6.0))).unwrap();
            t += step;
        }
        y
    }
    let idle = Idle::default();
    let guess = LoadedFourBarCoordinates { theta2: 0.3, theta3: 1.2, theta4: -1.0 };
    let start = idle.start(0.0, &guess, &LoadedFourBarInputs { theta2: 10.0 }).unwrap();
    let energy = |y: &linkage::nalgebra::SVector<f64, 4>| {
        let (q, rates) = Idle::parts(y);
        let energy = idle.energy(&q, rates).unwrap();
        energy.kinetic + energy.potential
    };
    let total = energy(&start);
    let errors =
        [200, 400].map(|steps| (energy(&run(&idle, start, 1.0 / f64::from(steps), steps as usize)) - total) / total);
    println!("{total} {errors:?}");
    assert!(errors[1].abs() < 1e-6 && errors[0].abs() > 10.0 * errors[1].abs(), "{errors:?}");
    // The parts of the derivative agree with it.
    let derivative = idle.derivative(0.0, &start).unwrap();
    let equations = idle.equations(0.0, &start).unwrap();
    let acceleration = equations.forces / equations.mass[0];
    close("v''", acceleration[0], derivative[3], 0.0);
    let (q, rates) = Idle::parts(&start);
    let moving = equations.ratios * rates.theta2;
    (0..2).for_each(|at| close("u'", moving[at], derivative[at], 0.0));
    let four_bar = &idle.mechanism;
    let pose = four_bar.pose_at(&q);
    let velocity = four_bar.velocity(&pose, rates).unwrap();
    let all = four_bar.acceleration(&pose, &velocity, acceleration[0]).unwrap();
    let of_unknowns = equations.ratios * acceleration + equations.bias;
    close("theta3''", of_unknowns[0], all.theta3, 0.0);
    close("theta4''", of_unknowns[1], all.theta4, 0.0);
    assert_eq!(idle.contacts(0.0, &q, &velocity).unwrap(), []);
    // The crank has made more than a turn, and the angles say so.
    let end = run(&idle, start, 0.005, 200);
    let (q, _) = Idle::parts(&end);
    assert!(q.theta2 > 7.0, "{q:?}");
    let four_bar = &idle.mechanism;
    assert!(four_bar.residual(&four_bar.pose_at(&q)).amax() < 1e-15, "{q:?}");
}

/// The reaction where the rocker meets the ground, and then each body by Newton's and Euler's laws: forces from
/// joint to joint, moments about each centre, and what is left at the crank is the torque of the drive.
#[test]
fn reactions_hold_every_body() {
    use linkage::nalgebra::Vector2;
    let scene = Driven::default();
    let four_bar = &scene.mechanism;
    at_random(|v: [f64; 1], rate: [f64; 1], t| {
        let pose = four_bar.assemble(v[0], FOUR_BAR).unwrap();
        let q = pose.coordinates();
        let (velocity, acceleration) = scene.rates(t, &q, rate[0]).unwrap();
        let motion = four_bar.motion(&q, rate[0], acceleration).unwrap();
        let (points, turning) = (motion.points, motion.acceleration);
        let lambda: Vector2<f64> = scene.reactions(t, &q, rate[0]).unwrap();
        let weight = Vector2::new(0.0, -scene.g);
        let end = points.c.position + Vector2::new(q.theta4.cos(), q.theta4.sin()) * four_bar.l4;
        // What holds a body where it is driven from, and the moment that is left about its centre.
        let held =
            |m: f64, center: linkage::PointMotion<f64>, from: Vector2<f64>, to: Vector2<f64>, load: Vector2<f64>| {
                let force = (center.acceleration - weight) * m - load;
                let moment = (from - center.position).perp(&force) + (to - center.position).perp(&load);
                (force, moment)
            };
        let (at_c, rocker) = held(scene.m4, points.g4, points.c.position, end, -lambda);
        let (at_b, coupler) = held(scene.m3, points.g3, points.b.position, points.c.position, -at_c);
        let (at_a, crank) = held(scene.m2, points.g2, Vector2::zeros(), points.b.position, -at_b);
        let size = lambda.norm() + at_c.norm() + at_b.norm() + at_a.norm();
        close("rocker", rocker - scene.ct * velocity.theta4, scene.j4 * turning.theta4, size);
        close("coupler", coupler, scene.j3 * turning.theta3, size);
        let torque = scene.drive_forces(t, &q, rate[0]).unwrap()[0];
        close("crank", crank + torque, scene.j2 * turning.theta2, size);
    });
}

/// Without inertia: the weight of two bodies and a spring, held by the crank's torque.
#[test]
fn statics_by_virtual_work() {
    struct Heavy;
    impl Positions<1> for Heavy {
        fn bodies<T: Real>(&self, v: [T; 1]) -> Vec<Placed<T>> {
            FourBarPositions.bodies(v).split_off(1)
        }

        fn scalars<T: Real>(&self, v: [T; 1]) -> Vec<T> {
            FourBarPositions.scalars(v)
        }
    }
    let scene = Balanced::default();
    at_random(|v: [f64; 1], _, t| {
        let q = four_bar_at(v).unwrap();
        let mut expected = virtual_work(&Heavy, v, [0.0], [0.0, -scene.g]);
        expected.add(1, |angle, _| -scene.kt * (angle - scene.phi0));
        close("Q", scene.forces(t, &q, 3.0).unwrap()[0], expected.forces[0], expected.sizes[0]);
    });
}

/// The name of what is wrong, as the error gives it.
#[test]
fn errors_name_the_body_or_the_effect() {
    use linkage::Error;
    let q = four_bar_at([0.4]).unwrap();
    let inputs = LoadedFourBarInputs { theta2: 2.0 };
    let mut scene = Loaded { m3: -0.1, ..Loaded::default() };
    let error = scene.start(0.0, &q, &inputs).unwrap_err();
    assert_eq!(error, Error::Negative { scene: "Loaded", quantity: "the mass of coupler", value: -0.1 });
    assert_eq!(error.to_string(), "the mass of coupler in Loaded is negative: -1.0e-1");
    scene.m3 = f64::NAN;
    let named = |quantity| Err(Error::NotFinite { mechanism: "Loaded", quantity });
    assert_eq!(scene.check(), named("the mass of coupler"));

    let named = |quantity| Err(Error::NotFinite { mechanism: "Loaded", quantity });
    let broken = |change: fn(&mut Loaded)| {
        let mut scene = Loaded::default();
        change(&mut scene);
        scene.forces(0.0, &q, inputs).map(|_| ())
    };
    assert_eq!(broken(|scene| scene.t0 = f64::NAN), named("torque on theta2"));
    assert_eq!(broken(|scene| scene.kt = f64::INFINITY), named("spring on theta4"));
    assert_eq!(broken(|scene| scene.c = f64::NAN), named("damper between C and P"));
    assert_eq!(broken(|scene| scene.m4 = f64::NAN), named("body rocker"));
    assert_eq!(broken(|_| ()), Ok(()));
    let laws = Loaded::default().acceleration(f64::NAN, &q, inputs);
    assert_eq!(laws, Err(Error::NotFinite { mechanism: "Loaded", quantity: "torque on theta2" }));

    // Without masses nothing resists; without one of two only that input.
    let mut light = Idle::default();
    (light.m2, light.j2, light.m3, light.j3, light.m4, light.j4) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    let error = light.acceleration(0.0, &q, inputs).unwrap_err();
    assert_eq!(error, Error::NoInertia { scene: "Idle", coordinate: "theta2", share: 0.0 });

    // A motion that does not begin where its drive does.
    let driven = Driven::default();
    let start = |theta2: f64, rate: f64| {
        driven.start(0.0, &four_bar_at([theta2]).unwrap(), &LoadedFourBarInputs { theta2: rate })
    };
    assert!(start(0.0, 15.0).is_ok());
    let wrong = |quantity, gap| Err(Error::Inconsistent { scene: "Driven", coordinate: "theta2", quantity, gap });
    assert_eq!(start(0.25, 15.0), wrong("position", 0.25));
    assert_eq!(start(0.0, 16.0), wrong("rate", 1.0));
    assert!(matches!(start(0.0, f64::NAN), Err(Error::Inconsistent { quantity: "rate", .. })));
    // Nor where the mechanism is torn apart.
    let open = LoadedFourBarCoordinates { theta2: 0.4, theta3: f64::NAN, theta4: 0.0 };
    assert!(matches!(Idle::default().start(0.0, &open, &inputs), Err(Error::NotFinite { .. })));
}

/// A dead point: the coupler and the rocker in line.
#[test]
fn a_dead_point_is_refused() {
    let mut idle = Idle::default();
    (idle.mechanism.l1, idle.mechanism.l2) = (1.0, 0.5);
    // -0.5 + 0.8 + 0.7 = 1, all on one line.
    idle.mechanism.l3 = 0.8;
    let q = LoadedFourBarCoordinates { theta2: std::f64::consts::PI, theta3: 0.0, theta4: 0.0 };
    let error = idle.rates(0.0, &q, 1.0).unwrap_err();
    assert!(matches!(error, linkage::Error::Singular { mechanism: "Idle", group: "theta3, theta4", .. }), "{error}");
}

/// Where the forces vanish; the stiffness in the search is exact, or it would not be found in a few steps.
#[test]
fn equilibria() {
    let scene = Balanced::default();
    let guess = four_bar_at([0.4]).unwrap();
    let q = scene.equilibrium(0.0, &guess).unwrap();
    let scale = scene.m3 * scene.g;
    let left = scene.forces(0.0, &q, 0.0).unwrap()[0];
    assert!(left.abs() < 1e-12 * scale && (q.theta2 - guess.theta2).abs() > 0.01, "{left:e} {q:?}");
    let four_bar = &scene.mechanism;
    assert!(four_bar.residual(&four_bar.pose_at(&q)).amax() < 1e-15);
    // A spring without weight is at rest where it is not stretched.
    let spring = Balanced { g: 0.0, phi0: four_bar_at([0.5]).unwrap().theta4, ..Balanced::default() };
    assert!((spring.equilibrium(0.0, &guess).unwrap().theta2 - 0.5).abs() < 1e-13);

    let free = Free::default();
    let pose = free.mechanism.assemble(PairInputs { theta1: -1.8, theta4: -1.3 }, PAIR).unwrap();
    let q = free.equilibrium(0.5, &pose.coordinates()).unwrap();
    let left = free.forces(0.5, &q, PairInputs { theta1: 0.0, theta4: 0.0 }).unwrap();
    assert!(left.amax() < 1e-12 * free.m2 * free.g, "{left} {q:?}");
    // One input is driven, and stays where it is put.
    let half = Half::default();
    let q = half.equilibrium(0.5, &pose.coordinates()).unwrap();
    assert_eq!(q.theta4, 0.7 * 0.5 + 0.125);
    let left = half.forces(0.5, &q, PairInputs { theta1: 0.0, theta4: 0.0 }).unwrap();
    assert!(left[0].abs() < 1e-12 * half.m2 * half.g, "{left} {q:?}");
    // Without forces every position is one.
    let mut empty = Balanced::default();
    (empty.m3, empty.m4, empty.kt) = (0.0, 0.0, 0.0);
    assert_eq!(empty.equilibrium(0.0, &guess).unwrap().theta2, 0.4);
}

/// dQ/dv at rest against the forces at dual positions.
#[test]
fn stiffness_by_dual_numbers() {
    let (scene, free) = (Balanced::default(), Free::default());
    at_random(|v: [f64; 2], _, t| {
        let q = four_bar_at([v[0]]).unwrap();
        let moved = four_bar_at([Dual64::new(v[0], 1.0)]).unwrap();
        let force = scene.clone().map(constant::<Dual64>).forces(constant(t), &moved, Dual64::from(0.0)).unwrap()[0];
        let balance = scene.balance(t, &q).unwrap();
        close("Q", balance.forces[0], force.re, balance.sizes[0]);
        close("dQ/dv", balance.slopes[0][0], force.eps, balance.sizes[0]);

        let pair = Pair::default().map(constant::<Dual64>);
        let Ok(pose) = free.mechanism.assemble(PairInputs { theta1: v[0], theta4: v[1] }, PAIR) else { return };
        let balance = free.balance(t, &pose.coordinates()).unwrap();
        for (column, slopes) in balance.slopes.into_iter().enumerate() {
            let [theta1, theta4] = [0, 1].map(|at| Dual64::new(v[at], f64::from(u8::from(at == column))));
            let q = pair.assemble(PairInputs { theta1, theta4 }, PAIR).unwrap().coordinates();
            let rest = PairInputs { theta1: Dual64::from(0.0), theta4: Dual64::from(0.0) };
            let forces = free.clone().map(constant::<Dual64>).forces(constant(t), &q, rest).unwrap();
            for (row, slope) in slopes.into_iter().enumerate() {
                let scale = balance.sizes[row] + slopes[0].abs() + slopes[1].abs();
                close("Q", balance.forces[row], forces[row].re, balance.sizes[row]);
                close("dQ/dv", slope, forces[row].eps, scale);
            }
        }
    });
}
