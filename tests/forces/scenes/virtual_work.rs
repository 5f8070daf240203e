//! The equations of motion by the principle of virtual work, with dual numbers along positions alone.

use linkage::Real;
use linkage::nalgebra::RealField;
use linkage_oracle::close;
use num_dual::{Dual2_64, Dual64};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

/// Poses a scene.
const POSES: usize = 300;

/// The promise: relative error of one formula against another.
const TOLERANCE: f64 = 1e-11;

#[track_caller]
pub(super) fn agrees(what: &str, found: f64, expected: f64, scale: f64) {
    close(what, found, expected, TOLERANCE * scale.max(expected.abs()));
}

/// A body at a position: mass, moment of inertia, centre and angle.
pub(super) type Placed<T> = (f64, f64, [T; 2], T);

/// The quantities of one scene that follow from the position: its bodies, and the scalars that its laws act along.
pub(super) trait Positions<const V: usize> {
    fn bodies<T: Real>(&self, v: [T; V]) -> Vec<Placed<T>>;
    fn scalars<T: Real>(&self, v: [T; V]) -> Vec<T>;
}

/// M, the part of Q from inertia and the field g, and of each scalar its derivatives and its rate.
pub(super) struct Virtual<const V: usize> {
    pub(super) mass: [[f64; V]; V],
    pub(super) forces: [f64; V],
    /// The sum of the magnitudes of the terms of the forces.
    pub(super) sizes: [f64; V],
    pub(super) scalars: Vec<(f64, [f64; V], f64)>,
}

/// M_jk = sum m G_j . G_k + j w_j w_k and Q_j = -sum m G_j . (G'' - g) + j w_j phi'' at v'' = 0: first derivatives
/// by dual numbers along the inputs, second ones by those along v'.
pub(super) fn virtual_work<const V: usize>(
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
    pub(super) fn add(&mut self, place: usize, law: impl Fn(f64, f64) -> f64) {
        let (value, by, rate) = self.scalars[place];
        let force = law(value, rate);
        for (input, by) in by.into_iter().enumerate() {
            self.forces[input] += force * by;
            self.sizes[input] += (force * by).abs();
        }
    }
}

/// Lagrange: Q_j = v' (dM/dv_j) v' / 2 - sum (dM/dv_k v'_k v')_j from a mass matrix at dual positions.
pub(super) fn lagrange<const V: usize>(
    mass: impl Fn([Dual64; V]) -> [[Dual64; V]; V],
    v: [f64; V],
    rate: [f64; V],
) -> [f64; V] {
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

pub(super) fn constant<T: RealField + Copy>(value: f64) -> T {
    linkage::nalgebra::convert(value)
}

/// Calls `check` with random inputs and rates.
pub(super) fn at_random<const V: usize>(check: impl Fn([f64; V], [f64; V], f64)) {
    let mut random = SmallRng::seed_from_u64(19_260_321);
    for _ in 0..POSES {
        let mut draw = |size: f64| std::array::from_fn(|_| random.random_range(-size..size));
        check(draw(3.0), draw(8.0), draw(5.0)[0]);
    }
}
