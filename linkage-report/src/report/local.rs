//! A mechanism at one position, by numbers: what the directions of its links need.

use linkage_runtime::derivation::{Derivation, GroupForm};
use linkage_runtime::{Build, Dim, Kinematic, Mechanism};

/// A vector of the plane.
pub(super) type Vector = [f64; 2];

/// A function of the rates of unknowns, then of inputs.
type OfRates<'a> = Box<dyn Fn(&[f64]) -> Vec<f64> + 'a>;

/// The numbers of a mechanism at a position, for [`Report::of_data`](super::Report::of_data).
pub struct Local<'a, 'd> {
    pub(super) derivation: &'a Derivation<'d>,
    are_angles: Vec<bool>,
    /// J, row by row.
    jacobian: Vec<f64>,
    gamma: OfRates<'a>,
    /// The equations and the unknowns of each group.
    groups: Vec<[Vec<usize>; 2]>,
}

impl<'a, 'd> Local<'a, 'd> {
    /// The mechanism of a derivation at a position: true for each unknown that is an angle, J row by row, and gamma at the rates
    /// of all unknowns, then of all inputs.
    pub fn new(
        derivation: &'a Derivation<'d>,
        are_angles: Vec<bool>,
        jacobian: Vec<f64>,
        gamma: impl Fn(&[f64]) -> Vec<f64> + 'a,
    ) -> Self {
        let names: Vec<String> = derivation.unknowns.iter().map(|symbol| symbol.formula.to_string()).collect();
        let places = |group: &linkage_runtime::derivation::Group<'_>| {
            let place = |text: String| names.iter().position(|name| *name == text);
            let unknowns = group.unknowns.iter().filter_map(|unknown| place(unknown.to_string()));
            [group.equations.to_vec(), unknowns.collect()]
        };
        let groups = derivation.groups.iter().map(places).collect();
        Self { derivation, are_angles, jacobian, gamma: Box::new(gamma), groups }
    }

    /// An emitted mechanism at a position.
    pub(super) fn of<M: Kinematic<Scalar = f64>>(
        mechanism: &'a M,
        derivation: &'a Derivation<'d>,
        q: &M::Coordinates,
    ) -> Self {
        let pose = mechanism.pose_at(q);
        let of_unknowns = mechanism.jacobian_unknowns(&pose);
        let count = of_unknowns.dims().0.count();
        let all = (0..count).flat_map(|row| (0..count).map(move |column| (row, column)));
        let jacobian = all.map(|(row, column)| of_unknowns.part(row, column)).collect();
        let gamma = move |rates: &[f64]| mechanism.gamma(&pose, &rates_of(mechanism, rates)).iter().copied().collect();
        Self::new(derivation, mechanism.unknown_angles().to_vec(), jacobian, gamma)
    }

    pub(super) fn form(&self, group: usize) -> Option<GroupForm> {
        self.derivation.groups.get(group).map(|group| group.form)
    }

    pub(super) fn equations(&self, group: usize) -> &[usize] {
        self.groups.get(group).map_or(&[], |[equations, _]| equations)
    }

    pub(super) fn unknowns(&self, group: usize) -> &[usize] {
        self.groups.get(group).map_or(&[], |[_, unknowns]| unknowns)
    }

    pub(super) fn is_angle(&self, unknown: usize) -> bool {
        self.are_angles.get(unknown) == Some(&true)
    }

    /// Two entries of a column of J.
    pub(super) fn column(&self, unknown: usize, rows: [usize; 2]) -> Vector {
        let count = self.derivation.unknowns.len();
        rows.map(|row| self.jacobian.get(row * count + unknown).copied().unwrap_or(f64::NAN))
    }

    /// Unknowns, of which a length is 0 where it is zero up to rounding errors of the lengths in its equations.
    pub(super) fn rounded(&self, unknowns: &[f64]) -> Vec<f64> {
        let (count, all) = (self.derivation.unknowns.len(), unknowns.iter().copied());
        let round = |(place, value): (usize, f64)| {
            let group = self.groups.iter().find(|[_, unknowns]| unknowns.contains(&place));
            let rows = group.into_iter().flat_map(|[equations, _]| equations);
            // The column of the angle of a link is as long as the link.
            let entries = rows.flat_map(|row| self.jacobian.iter().skip(row * count).take(count).enumerate());
            let lengths = entries.filter(|(column, _)| self.is_angle(*column)).map(|(_, entry)| entry.abs());
            let scale = lengths.fold(0.0, f64::max);
            if !self.is_angle(place) && value.abs() <= 16.0 * f64::EPSILON * scale { 0.0 } else { value }
        };
        all.enumerate().map(round).collect()
    }

    /// The rates at which one coordinate moves with rate 1; unknowns come before inputs.
    pub(super) fn unit(&self, coordinate: usize) -> Vec<f64> {
        let count = self.derivation.unknowns.len() + self.derivation.inputs.len();
        (0..count).map(|other| f64::from(u8::from(other == coordinate))).collect()
    }

    /// Psi_qq a b in two rows, by polarisation of the quadratic velocity term: 4 Psi_qq a b = gamma(a + b) - gamma(a - b).
    pub(super) fn mixed(&self, a: &[f64], b: &[f64], rows: [usize; 2]) -> Vector {
        let with = |sign: f64| (self.gamma)(&a.iter().zip(b).map(|(a, b)| a + sign * b).collect::<Vec<f64>>());
        let [plus, minus] = [with(1.0), with(-1.0)];
        rows.map(|row| match (plus.get(row), minus.get(row)) {
            (Some(plus), Some(minus)) => (plus - minus) / 4.0,
            _ => f64::NAN,
        })
    }
}

/// Rates of unknowns and inputs in the type of a mechanism.
fn rates_of<M: Mechanism<Scalar = f64>>(mechanism: &M, rates: &[f64]) -> M::Rates {
    let (u, v, _) = mechanism.dims();
    M::rates(u.padded(rates.iter().copied()), v.padded(rates.iter().copied().skip(u.count())))
}

/// The rates of unknowns, then of inputs.
pub(super) fn listed<M: Mechanism<Scalar = f64>>(rates: &M::Rates) -> Vec<f64> {
    let (unknowns, inputs) = M::rate_parts(rates);
    unknowns.iter().chain(inputs.iter()).copied().collect()
}
