//! Accelerations and impacts: all combinations of modes are tried, and one that satisfies every law is taken.

use super::linear::{inverse, solve, times};
use super::model::{Law, Model, N, R, Rows, Square, Vector, dot};

/// The state of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    Open,
    Stick,
    Forward,
    Backward,
    Lower,
    Upper,
}

impl Mode {
    pub fn is_held(self) -> bool {
        matches!(self, Self::Stick | Self::Lower | Self::Upper)
    }

    /// The direction away from a stop.
    pub fn inward(self) -> f64 {
        if self == Self::Upper { -1.0 } else { 1.0 }
    }
}

/// The modes of all contacts.
pub type Modes = [Mode; R];

/// A force or an acceleration within this part of the sum of its terms is zero. Contacts are released at four times this
/// part, the documented 1024 ulps.
pub const FORCE: f64 = 256.0 * f64::EPSILON;

/// A stop that takes part in an impact.
#[derive(Debug, Clone, Copy)]
pub struct Struck {
    pub inward: f64,
    pub restitution: f64,
}

/// The laws of a model and its inverse masses.
pub struct Laws<'a, M> {
    pub model: &'a M,
    pub laws: Vec<Law>,
    pub inverse: Square,
}

/// Accelerations and the forces of links and contacts, by row.
pub struct Motion {
    pub acceleration: Vector,
    pub forces: [f64; R],
    /// The sum of the magnitudes of the terms of s'', and of the force that holds it, by row.
    pub size: [f64; R],
    pub force_size: [f64; R],
}

impl<'a, M: Model> Laws<'a, M> {
    pub fn new(model: &'a M) -> Self {
        Self { model, laws: model.laws(), inverse: inverse(&model.mass(), M::COUNT) }
    }

    pub fn count(&self) -> usize {
        M::LINKS + self.laws.len()
    }

    /// Returns M^-1 g of each row, and the rows of G M^-1 G' that are asked for.
    fn response(&self, rows: &Rows, held: &[usize]) -> ([Vector; R], [[f64; R]; R]) {
        let mut columns = [[0.0; N]; R];
        let mut a = [[0.0; R]; R];
        for (i, &row) in held.iter().enumerate() {
            columns[i] = times(&self.inverse, &rows[row].gradient);
            for (j, &other) in held[..=i].iter().enumerate() {
                let entry = dot(&rows[other].gradient, &columns[i]);
                (a[i][j], a[j][i]) = (entry, entry);
            }
        }
        (columns, a)
    }

    /// The rows of the links and of the held contacts.
    pub fn held(&self, modes: &Modes) -> ([usize; R], usize) {
        let (mut held, mut count) = ([0; R], 0);
        for row in 0..self.count() {
            if row < M::LINKS || modes[row - M::LINKS].is_held() {
                held[count] = row;
                count += 1;
            }
        }
        (held, count)
    }

    /// The change x of the coordinates, in the directions M^-1 G', that changes these rows by `wanted`.
    pub fn change(&self, rows: &Rows, held: &[usize], wanted: &[f64; R]) -> Option<Vector> {
        let (columns, a) = self.response(rows, held);
        let factors = solve(a, *wanted, held.len())?;
        let mut change = [0.0; N];
        for (column, factor) in columns.iter().zip(factors).take(held.len()) {
            for i in 0..N {
                change[i] += column[i] * factor;
            }
        }
        Some(change)
    }

    /// The motion in these modes; None if the held rows are dependent.
    pub fn motion(&self, (t, x, v): (f64, &Vector, &Vector), rows: &Rows, modes: &Modes) -> Option<Motion> {
        let mut forces = [0.0; R];
        let mut load = self.model.forces(t, x, v);
        let mut load_size = load.map(f64::abs);
        for (place, law) in self.laws.iter().enumerate() {
            let row = M::LINKS + place;
            if let (&Law::Friction { limit }, Mode::Forward | Mode::Backward) = (law, modes[place]) {
                forces[row] = if modes[place] == Mode::Forward { -limit } else { limit };
                for i in 0..N {
                    load[i] += rows[row].gradient[i] * forces[row];
                    load_size[i] += (rows[row].gradient[i] * forces[row]).abs();
                }
            }
        }
        let free = times(&self.inverse, &load);
        let free_size = times(&self.inverse.map(|row| row.map(f64::abs)), &load_size);
        let (held, count) = self.held(modes);
        let held = &held[..count];
        let (columns, a) = self.response(rows, held);
        let (mut wanted, mut size, mut force_size) = ([0.0; R], [0.0; R], [0.0; R]);
        for (row, size) in size.iter_mut().enumerate().take(self.count()) {
            *size = rows[row].bias.abs() + dot(&rows[row].gradient.map(f64::abs), &free_size);
        }
        for (i, &row) in held.iter().enumerate() {
            wanted[i] = -(rows[row].bias + dot(&rows[row].gradient, &free));
            force_size[row] = size[row] / a[i][i];
        }
        let found = solve(a, wanted, count)?;
        let mut acceleration = free;
        for (i, &row) in held.iter().enumerate() {
            forces[row] = found[i];
            for at in 0..N {
                acceleration[at] += columns[i][at] * found[i];
            }
        }
        Some(Motion { acceleration, forces, size, force_size })
    }

    /// Chooses the modes of the contacts at rest, each given by the mode in which it would be held; those that move keep
    /// their modes. Of several combinations that satisfy the laws the one with the most contacts held is taken.
    ///
    /// # Panics
    /// If no combination satisfies the laws, or if two give different accelerations.
    pub fn choose(
        &self,
        (t, x, v): (f64, &Vector, &Vector),
        modes: &Modes,
        at_rest: &[Option<Mode>; R],
    ) -> Result<Modes, &'static str> {
        let rows = self.model.rows(t, x, v);
        let resting: Vec<usize> = (0..self.laws.len()).filter(|&place| at_rest[place].is_some()).collect();
        let options = |place: usize| match at_rest[place] {
            Some(Mode::Stick) => [Mode::Stick, Mode::Forward, Mode::Backward],
            Some(side) => [side, Mode::Open, Mode::Open],
            None => [modes[place]; 3],
        };
        let mut best: Option<(i32, Modes, Vector, f64)> = None;
        for number in 0..3_usize.pow(resting.len() as u32) {
            let (mut trial, mut rest, mut is_new) = (*modes, number, true);
            for &place in &resting {
                trial[place] = options(place)[rest % 3];
                is_new &= rest % 3 < 2 || at_rest[place] == Some(Mode::Stick);
                rest /= 3;
            }
            if !is_new {
                continue;
            }
            let Some(motion) = self.motion((t, x, v), &rows, &trial) else { continue };
            if !resting.iter().all(|&place| self.is_valid(&rows, &motion, place, trial[place], at_rest[place])) {
                continue;
            }
            // A stop at rest counts more than a friction: of two redundant ones the stop is held.
            let held = resting.iter().map(|&place| match trial[place] {
                Mode::Lower | Mode::Upper => 16,
                Mode::Stick => 15,
                _ => 0,
            });
            let held: i32 = held.sum();
            let size = motion.size.iter().fold(0.0, |most: f64, size| most.max(*size));
            if let Some((_, _, other, other_size)) = &best {
                let size = size.max(*other_size);
                if resting.iter().any(|&place| {
                    let row = &rows[M::LINKS + place];
                    (dot(&row.gradient, &motion.acceleration) - dot(&row.gradient, other)).abs() > 1e-9 * size
                }) {
                    return Err("two accelerations satisfy the laws");
                }
            }
            if best.is_none_or(|(most, ..)| held > most) {
                best = Some((held, trial, motion.acceleration, size));
            }
        }
        best.map(|(_, modes, ..)| modes).ok_or("no acceleration satisfies the laws")
    }

    fn is_valid(&self, rows: &Rows, motion: &Motion, place: usize, mode: Mode, at_rest: Option<Mode>) -> bool {
        let row = M::LINKS + place;
        let (force, force_error) = (motion.forces[row], FORCE * motion.force_size[row]);
        let (bias, gradient) = (rows[row].bias, &rows[row].gradient);
        let (acceleration, error) = (bias + dot(gradient, &motion.acceleration), FORCE * motion.size[row]);
        match (mode, self.laws[place]) {
            (Mode::Stick, Law::Friction { limit }) => force.abs() <= limit + force_error,
            (Mode::Forward, _) => acceleration >= -error,
            (Mode::Backward, _) => acceleration <= error,
            (Mode::Open, _) => acceleration * at_rest.map_or(0.0, Mode::inward) >= -error,
            (Mode::Lower | Mode::Upper, _) => force * mode.inward() >= -force_error,
            _ => false,
        }
    }

    /// The rates after an impact, and the impulse of each stop along its direction inward.
    pub fn impact(
        &self,
        rows: &Rows,
        v: &Vector,
        struck: &[Option<Struck>; R],
    ) -> Result<(Vector, [f64; R]), &'static str> {
        let stops: Vec<usize> = (0..self.laws.len()).filter(|&place| struck[place].is_some()).collect();
        let size = v.iter().zip(&self.inverse).fold(0.0, |sum: f64, (v, _)| sum + v.abs());
        for number in 0..1_usize << stops.len() {
            // All of them first, then fewer.
            let active: Vec<usize> =
                stops.iter().enumerate().filter(|(i, _)| number >> i & 1 == 0).map(|(_, &place)| place).collect();
            let held: Vec<usize> = (0..M::LINKS).chain(active.iter().map(|place| M::LINKS + place)).collect();
            let (columns, a) = self.response(rows, &held);
            let mut wanted = [0.0; R];
            for (i, &row) in held.iter().enumerate() {
                let restitution =
                    if row < M::LINKS { 0.0 } else { struck[row - M::LINKS].map_or(0.0, |of| of.restitution) };
                wanted[i] = -(1.0 + restitution) * rows[row].rate(v);
            }
            let Some(found) = solve(a, wanted, held.len()) else { continue };
            let (mut after, mut impulses) = (*v, [0.0; R]);
            for (i, &row) in held.iter().enumerate() {
                for at in 0..N {
                    after[at] += columns[i][at] * found[i];
                }
                if row >= M::LINKS {
                    impulses[row - M::LINKS] = found[i] * struck[row - M::LINKS].map_or(0.0, |of| of.inward);
                }
            }
            let is_valid = stops.iter().all(|&place| {
                let (row, of) = (&rows[M::LINKS + place], struck[place].expect("it is struck"));
                let rate = (row.rate(&after) + of.restitution * row.rate(v)) * of.inward;
                let mass = dot(&row.gradient, &times(&self.inverse, &row.gradient));
                impulses[place] * mass >= -1e-13 * size && rate >= -1e-13 * (size + row.drift.abs())
            });
            if is_valid {
                return Ok((after, impulses));
            }
        }
        Err("no impulses satisfy the laws")
    }
}
