//! An independent search for all accelerations that satisfy the laws: a grid of the directions of the reactions, at each
//! of which the forces are linear, then Newton's method; forces of one redundant contact are scanned.

use std::f64::consts::TAU;

use super::Equations;
use linkage_dynamics::ContactLaw;
use linkage_runtime::Matrix;
use linkage_runtime::nalgebra::SMatrix;

/// r and a row of P.
type Row = (f64, Vec<f64>);

/// s'' = b + A f and R = r + P f of the contacts.
pub struct Laws {
    pub names: Vec<&'static str>,
    pub kinds: Vec<Kind>,
    pub bias: Vec<f64>,
    pub matrix: Vec<Vec<f64>>,
    /// r and P of both components.
    pub reactions: Vec<Option<[Row; 2]>>,
}

/// A contact and its state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// A given limit, and the sign of s'.
    Given(f64, f64),
    /// The limit divided by the reaction, and the sign of s'.
    Bearing(f64, f64),
    /// A closed stop, and the direction away from it.
    Closed(f64),
    /// An open stop.
    Open,
}

/// The choice for a contact at rest or moving.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Choice {
    Held,
    /// A friction that slips in this direction.
    Slips(f64),
    Free,
}

impl Laws {
    pub fn new<const V: usize, const C: usize>(equations: &Equations<V, C>) -> Option<Self> {
        let inverse = Matrix::from(SMatrix::from(equations.mass).try_inverse()?);
        let free = inverse * equations.forces;
        let columns: Vec<_> = equations.contacts.iter().map(|contact| inverse * contact.row).collect();
        let kinds = equations.contacts.iter().map(|contact| match contact.law {
            ContactLaw::Friction { limit } => Kind::Given(limit, contact.drift),
            ContactLaw::Bearing { factor } => Kind::Bearing(factor, contact.drift),
            ContactLaw::Stop { lower, .. } if contact.value == lower => Kind::Closed(1.0),
            ContactLaw::Stop { upper, .. } if contact.value == upper => Kind::Closed(-1.0),
            ContactLaw::Stop { .. } => Kind::Open,
        });
        Some(Self {
            names: equations.contacts.iter().map(|contact| contact.name).collect(),
            kinds: kinds.collect(),
            bias: equations.contacts.iter().map(|contact| contact.bias + contact.row.dot(&free)).collect(),
            matrix: equations
                .contacts
                .iter()
                .map(|one| columns.iter().map(|column| one.row.dot(column)).collect())
                .collect(),
            reactions: equations
                .bearings
                .iter()
                .map(|bearing| {
                    Some(bearing.as_ref()?.components.map(|row| {
                        let by =
                            columns.iter().zip(&row.contacts).map(|(column, by)| row.accelerations.dot(column) + by);
                        (row.constant + row.accelerations.dot(&free), by.collect())
                    }))
                })
                .collect(),
        })
    }

    fn count(&self) -> usize {
        self.kinds.len()
    }

    pub fn along(&self, place: usize, forces: &[f64]) -> f64 {
        self.bias[place] + dot(&self.matrix[place], forces)
    }

    pub fn along_all(&self, forces: &[f64]) -> Vec<f64> {
        (0..self.count()).map(|place| self.along(place, forces)).collect()
    }

    /// R.
    pub fn reaction(&self, place: usize, forces: &[f64]) -> [f64; 2] {
        self.reactions[place].as_ref().map_or([0.0; 2], |rows| [0, 1].map(|k| rows[k].0 + dot(&rows[k].1, forces)))
    }

    pub fn limit(&self, place: usize, forces: &[f64]) -> f64 {
        match self.kinds[place] {
            Kind::Given(limit, _) => limit,
            Kind::Bearing(factor, _) => {
                let [x, y] = self.reaction(place, forces);
                factor * x.hypot(y)
            }
            _ => 0.0,
        }
    }

    /// The scale of the accelerations of a contact at these forces.
    pub fn scale(&self, place: usize, forces: &[f64]) -> f64 {
        self.bias[place].abs() + self.matrix[place].iter().zip(forces).map(|(a, f)| (a * f).abs()).sum::<f64>() + 1e-300
    }

    /// The largest relative violation of the laws.
    pub fn violation(&self, forces: &[f64]) -> f64 {
        let most = forces.iter().fold(1e-300_f64, |most, force| most.max(force.abs()));
        let of = |place: usize| {
            let (force, goes) = (forces[place], self.along(place, forces) / self.scale(place, forces));
            let limit = self.limit(place, forces);
            let size = most.max(limit);
            match self.kinds[place] {
                Kind::Given(_, rate) | Kind::Bearing(_, rate) if rate != 0.0 => {
                    (force + rate.signum() * limit).abs() / size
                }
                Kind::Given(..) | Kind::Bearing(..) => {
                    let sticks = goes.abs().max((force.abs() - limit) / size);
                    let slips = |sign: f64| ((force + sign * limit).abs() / size).max(-sign * goes);
                    sticks.min(slips(1.0)).min(slips(-1.0))
                }
                Kind::Closed(sign) => {
                    let holds = goes.abs().max(-sign * force / size);
                    holds.min((force.abs() / size).max(-sign * goes))
                }
                Kind::Open => force.abs() / size,
            }
        };
        (0..self.count()).map(of).fold(0.0, f64::max)
    }

    /// All s'' of motions that the search finds, up to `tolerance`; `angles` is the number of directions of a pin.
    pub fn motions(&self, angles: usize, tolerance: f64) -> Vec<Vec<f64>> {
        let mut found: Vec<Vec<f64>> = vec![];
        let mut choices = vec![Choice::Free; self.count()];
        self.choose(0, &mut choices, &mut |choices| {
            for forces in self.forces(choices, angles) {
                if self.violation(&forces) > tolerance {
                    continue;
                }
                let motion = self.along_all(&forces);
                let equals = |other: &Vec<f64>| {
                    (0..self.count())
                        .all(|place| (other[place] - motion[place]).abs() <= 1e-6 * self.scale(place, &forces))
                };
                if !found.iter().any(equals) {
                    found.push(motion);
                }
            }
        });
        found
    }

    fn choose(&self, place: usize, choices: &mut Vec<Choice>, visit: &mut impl FnMut(&[Choice])) {
        if place == self.count() {
            return visit(choices);
        }
        let options: &[Choice] = match self.kinds[place] {
            Kind::Given(_, rate) | Kind::Bearing(_, rate) if rate > 0.0 => &[Choice::Slips(1.0)],
            Kind::Given(_, rate) | Kind::Bearing(_, rate) if rate < 0.0 => &[Choice::Slips(-1.0)],
            Kind::Given(..) | Kind::Bearing(..) => &[Choice::Held, Choice::Slips(1.0), Choice::Slips(-1.0)],
            Kind::Closed(_) => &[Choice::Held, Choice::Free],
            Kind::Open => &[Choice::Free],
        };
        for &choice in options {
            choices[place] = choice;
            self.choose(place + 1, choices, visit);
        }
    }

    /// The forces in these modes.
    fn forces(&self, choices: &[Choice], angles: usize) -> Vec<Vec<f64>> {
        let slipping: Vec<usize> = (0..self.count())
            .filter(|&place| matches!((self.kinds[place], choices[place]), (Kind::Bearing(..), Choice::Slips(_))))
            .collect();
        let is_guide = |place: usize| {
            self.reactions[place].as_ref().is_some_and(|rows| rows[1].0 == 0.0 && rows[1].1.iter().all(|by| *by == 0.0))
        };
        let grids: Vec<usize> = slipping.iter().map(|&place| if is_guide(place) { 2 } else { angles }).collect();
        let mut results = vec![];
        for index in 0..grids.iter().product() {
            let mut left = index;
            let mut directions = vec![[0.0; 2]; self.count()];
            for (&place, &grid) in slipping.iter().zip(&grids) {
                let (sine, cosine) = (TAU * (left % grid) as f64 / grid as f64).sin_cos();
                directions[place] = [cosine, sine];
                left /= grid;
            }
            let (matrix, side) = self.linear(choices, &directions);
            match solve(matrix.clone(), side.clone()) {
                Some(start) => results.extend(self.polished(choices, &slipping, start)),
                None if slipping.is_empty() => results.extend(self.scanned(choices, &matrix, &side)),
                None => {}
            }
        }
        results
    }

    /// The linear equations of the forces at given directions of the reactions.
    fn linear(&self, choices: &[Choice], directions: &[[f64; 2]]) -> (Vec<Vec<f64>>, Vec<f64>) {
        let (mut matrix, mut side) = (vec![vec![0.0; self.count()]; self.count()], vec![0.0; self.count()]);
        for (place, choice) in choices.iter().enumerate() {
            match (choice, self.kinds[place], &self.reactions[place]) {
                (Choice::Held, ..) => {
                    matrix[place].clone_from(&self.matrix[place]);
                    side[place] = -self.bias[place];
                    continue;
                }
                (Choice::Slips(sign), Kind::Given(limit, _), _) => side[place] = -sign * limit,
                (Choice::Slips(sign), Kind::Bearing(factor, _), Some(rows)) => {
                    for (direction, (base, by)) in directions[place].iter().zip(rows) {
                        let share = sign * factor * direction;
                        side[place] -= share * base;
                        matrix[place].iter_mut().zip(by).for_each(|(entry, by)| *entry += share * by);
                    }
                }
                _ => {}
            }
            matrix[place][place] += 1.0;
        }
        (matrix, side)
    }

    /// Newton's method: the directions are those of the reactions at the last forces.
    fn polished(&self, choices: &[Choice], slipping: &[usize], mut forces: Vec<f64>) -> Option<Vec<f64>> {
        for _ in 0..60 {
            let mut directions = vec![[0.0; 2]; self.count()];
            for &place in slipping {
                let [x, y] = self.reaction(place, &forces);
                let size = x.hypot(y);
                directions[place] = if size > 0.0 { [x / size, y / size] } else { [0.0; 2] };
            }
            let (matrix, side) = self.linear(choices, &directions);
            let next = solve(matrix, side)?;
            let change = next.iter().zip(&forces).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
            forces = next;
            if change <= 1e-14 * forces.iter().fold(0.0_f64, |most, force| most.max(force.abs())) {
                return Some(forces);
            }
        }
        None
    }

    /// Forces with one redundant contact: a scan of its force.
    fn scanned(&self, choices: &[Choice], matrix: &[Vec<f64>], side: &[f64]) -> Vec<Vec<f64>> {
        let held = (0..self.count()).filter(|&place| choices[place] == Choice::Held);
        for place in held {
            // The force of this contact is given, its equation follows from the others.
            let with = |force: f64| {
                let (mut matrix, mut side) = (matrix.to_vec(), side.to_vec());
                matrix[place] = vec![0.0; self.count()];
                (matrix[place][place], side[place]) = (1.0, force);
                solve(matrix, side)
            };
            let Some(base) = with(0.0) else { continue };
            let unit = base.iter().fold(1e-3_f64, |most, force| most.max(force.abs()));
            let steps = (-400..=400).map(|k| f64::from(k) / 40.0);
            return steps.filter_map(|k| with(unit * k.signum() * (k.abs().exp() - 1.0) * 0.1)).collect();
        }
        vec![]
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Gaussian elimination with partial pivoting.
fn solve(mut matrix: Vec<Vec<f64>>, mut side: Vec<f64>) -> Option<Vec<f64>> {
    let count = side.len();
    let scale = matrix.iter().flatten().fold(0.0_f64, |most, entry| most.max(entry.abs()));
    for step in 0..count {
        let pivot = (step..count).max_by(|&a, &b| matrix[a][step].abs().total_cmp(&matrix[b][step].abs()))?;
        if matrix[pivot][step].abs() <= 1e-11 * scale {
            return None;
        }
        matrix.swap(step, pivot);
        side.swap(step, pivot);
        for row in step + 1..count {
            let factor = matrix[row][step] / matrix[step][step];
            let above = matrix[step].clone();
            matrix[row].iter_mut().zip(&above).for_each(|(entry, above)| *entry -= factor * above);
            side[row] -= factor * side[step];
        }
    }
    for step in (0..count).rev() {
        let known = dot(&matrix[step][step + 1..], &side[step + 1..]);
        side[step] = (side[step] - known) / matrix[step][step];
    }
    Some(side)
}
