//! Accelerations and reactions as functions of the contact forces: `s'' = b + A f`, R = r + P f.

use crate::MotionError;
use crate::contact::held::{Response, slipping};
use crate::contact::tolerance::{held_tolerance, sum_tolerance};
use crate::contact::{ContactLaw, Mode, ReducedEquations};
use linkage_runtime::__shared::contraction;
use linkage_runtime::{BorrowedName, Build, Column, Dim, PositionError, Real, real};

/// A reaction as a function of the contact forces.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reaction<T: Real, C: Dim> {
    /// The limit divided by |R|.
    pub factor: T,
    /// r.
    pub base: [T; 2],
    /// The sum of the magnitudes of the terms of r.
    size: T,
    /// The rows of P.
    pub by: [Column<T, C>; 2],
}

/// The contacts at one state. No contact force is contained in the response.
pub(super) struct Problem<'a, T: Real, V: Dim, C: Dim, N: BorrowedName> {
    pub equations: &'a ReducedEquations<T, V, C, N>,
    pub response: Response<T, V, C>,
    pub reactions: Column<Option<Reaction<T, C>>, C>,
}

impl<T: Real, C: Dim> Reaction<T, C> {
    /// R.
    pub(super) fn at(&self, forces: &Column<T, C>) -> [T; 2] {
        [0, 1].map(|k| self.base[k] + self.by[k].dot(forces))
    }

    /// The reaction R. It is set to zero if it is no larger than its rounding error: the joint then carries no load.
    pub(super) fn load(&self, forces: &Column<T, C>) -> [T; 2] {
        let reaction = self.at(forces);
        let is_unloaded = self.factor * length(reaction) <= self.rounding(forces);
        if is_unloaded { [T::zero(); 2] } else { reaction }
    }

    /// The change of R with these changes of the forces.
    pub(super) fn along(&self, direction: &Column<T, C>) -> [T; 2] {
        [0, 1].map(|k| self.by[k].dot(direction))
    }

    /// The rounding error of the limit.
    fn rounding(&self, forces: &Column<T, C>) -> T {
        let terms = self.by.iter().fold(self.size, |size, by| size + by.component_mul(forces).abs().sum());
        self.factor * sum_tolerance(terms)
    }
}

impl<'a, T: Real, V: Dim, C: Dim, N: BorrowedName> Problem<'a, T, V, C, N> {
    /// # Errors
    /// Those of [`Response::new`]; [`PositionError::NotFinite`] with the name of a contact without a reaction.
    pub(super) fn new(equations: &'a ReducedEquations<T, V, C, N>) -> Result<Self, MotionError<N>> {
        let (_, c) = equations.dims();
        let response = Response::new(equations, &c.zeros(), |_| true)?;
        let mut reactions = c.repeat(None);
        for (place, contact) in equations.contacts.iter().enumerate() {
            let ContactLaw::Bearing { factor } = contact.law else { continue };
            let not_finite = PositionError::NotFinite { mechanism: equations.scene, quantity: contact.name };
            let Some(bearing) = equations.bearings[place] else { return Err(not_finite.into()) };
            let (mut base, mut size, mut by) = ([T::zero(); 2], T::zero(), [c.zeros(); 2]);
            for (k, row) in bearing.components.iter().enumerate() {
                let terms = row.accelerations.component_mul(&response.acceleration);
                base[k] = row.constant + terms.sum();
                size += row.constant.abs() + terms.abs().sum();
                by[k] = response.columns.tr_mul(&row.accelerations) + row.contacts;
            }
            if !(factor.is_finite() && size.is_finite() && by.iter().all(Column::is_finite)) {
                return Err(not_finite.into());
            }
            reactions[place] = Some(Reaction { factor, base, size, by });
        }
        Ok(Self { equations, response, reactions })
    }

    /// `s''`, and the sum of the magnitudes of its terms.
    pub(super) fn along(&self, place: usize, forces: &Column<T, C>) -> (T, T) {
        let terms = forces.iter().enumerate().map(|(other, &force)| self.response.matrix[(place, other)] * force);
        terms.fold(self.response.bias[place], |(sum, size), term| (sum + term, size + term.abs()))
    }

    /// True if `s''` is zero within rounding error.
    pub(super) fn stands(&self, place: usize, forces: &Column<T, C>) -> bool {
        let (sum, size) = self.along(place, forces);
        sum.abs() <= held_tolerance::<T>() * size
    }

    /// `z''`, and the sums of the magnitudes of its terms.
    pub(super) fn acceleration(&self, forces: &Column<T, C>) -> (Column<T, V>, Column<T, V>) {
        let start = self.response.acceleration;
        let columns = self.response.columns.columns().iter().zip(forces);
        columns.fold((start, start.abs()), |(sum, size), (&column, &force)| {
            let term = column * force;
            (sum + term, size + term.abs())
        })
    }

    /// The greatest force of a friction.
    pub(super) fn limit(&self, place: usize, forces: &Column<T, C>) -> T {
        match (self.equations.contacts[place].law, &self.reactions[place]) {
            (ContactLaw::Friction { limit }, _) => limit,
            (ContactLaw::Bearing { factor }, Some(reaction)) => factor * length(reaction.at(forces)),
            _ => T::zero(),
        }
    }

    /// The scale of a contact's force.
    pub(super) fn force_scale(&self, place: usize, forces: &Column<T, C>) -> T {
        let inverse = self.response.matrix[(place, place)];
        let (_, size) = self.along(place, forces);
        let own = inverse * forces[place].abs();
        let load = if inverse > T::zero() { (size - own) / inverse } else { T::zero() };
        load.max(self.limit(place, forces))
    }

    /// The rounding error by which a held force may exceed its limit.
    pub(super) fn force_tolerance(&self, place: usize, forces: &Column<T, C>) -> T {
        let rounding = self.reactions[place].map_or(T::zero(), |reaction| reaction.rounding(forces));
        held_tolerance::<T>() * self.force_scale(place, forces) + rounding
    }

    /// The distance of a contact's force from its bounds: of a friction that slips, from 0 and its limit.
    pub(super) fn margin(&self, place: usize, mode: Mode, forces: &Column<T, C>) -> T {
        let force = forces[place];
        let limit = || self.limit(place, forces);
        match mode {
            Mode::Stick => limit() - force.abs(),
            Mode::SlipForward => (limit() + force).min(-force),
            Mode::SlipBackward => (limit() - force).min(force),
            Mode::AtLower => force,
            Mode::AtUpper => -force,
            Mode::Open => T::zero(),
        }
    }

    /// True if the force of a held contact is within its bounds.
    pub(super) fn is_within(&self, place: usize, mode: Mode, forces: &Column<T, C>) -> bool {
        self.margin(place, mode, forces) >= -self.force_tolerance(place, forces)
    }

    /// True if a contact at rest that is not held accelerates in the direction of its mode, or stands still.
    pub(super) fn departs(&self, place: usize, (mode, side): (Mode, Mode), forces: &Column<T, C>) -> bool {
        let (sum, size) = self.along(place, forces);
        let sign = match mode {
            Mode::SlipForward => T::one(),
            Mode::SlipBackward => -T::one(),
            _ => side.inward(),
        };
        sum * sign >= -held_tolerance::<T>() * size
    }

    /// The greatest magnitudes of the forces in these modes: u <= c |r| + G u where the spectral radius of G is below 1;
    /// None if a force has no bound.
    fn most(&self, modes: &Column<Mode, C>) -> Option<Column<T, C>> {
        let c = modes.dim();
        let mut gain = c.zero_matrix(c);
        let mut side = c.zeros();
        for place in 0..c.count() {
            match (self.equations.contacts[place].law, &self.reactions[place]) {
                (ContactLaw::Friction { limit }, _) => side[place] = limit,
                (ContactLaw::Bearing { .. }, Some(Reaction { factor, base, by, .. })) => {
                    side[place] = *factor * length(*base);
                    for (other, (&x, &y)) in by[0].iter().zip(&by[1]).enumerate() {
                        *gain.get_mut(place, other)? = *factor * length([x, y]);
                    }
                }
                _ if modes[place].is_held() => return None,
                _ => {}
            }
        }
        contraction(&gain, side, c.count())
    }

    /// True if a friction that is held would need more than twice the force that all forces can give: at a dead centre of
    /// s it cannot hold s, whose acceleration no force changes. Closer to the limit the forces themselves are compared.
    pub(super) fn is_beyond_reach(&self, modes: &Column<Mode, C>) -> bool {
        let c = modes.dim();
        let Some(most) = self.most(modes) else { return false };
        (0..c.count()).filter(|&place| modes[place].is_held()).any(|place| {
            let (bias, size) = self.response.bias[place];
            let reach = (0..c.count()).map(|other| self.response.matrix[(place, other)].abs() * most[other]);
            let reach = reach.fold(T::zero(), |sum, term| sum + term);
            bias.abs() > reach * real(2.0) + held_tolerance::<T>() * size
        })
    }

    /// The forces of the contacts that do not depend on any reaction: those that slip with a given limit.
    pub(super) fn given(&self, modes: &Column<Mode, C>) -> Column<T, C> {
        modes.dim().column(|place| slipping(modes[place], &self.equations.contacts[place].law))
    }

    /// The contact to name in an error: the bearing whose limit depends most on its own force.
    pub(super) fn strongest(&self) -> N {
        let gain = |place: usize| {
            let reaction = self.reactions[place].as_ref()?;
            Some(reaction.factor * length([0, 1].map(|k| reaction.by[k][place])))
        };
        let bearings = (0..self.reactions.dim().count()).filter_map(|place| Some((place, gain(place)?)));
        let strongest = bearings.reduce(|best, other| if other.1 > best.1 { other } else { best });
        strongest.map_or_else(|| N::from_static(""), |(place, _)| self.equations.contacts[place].name)
    }
}

/// |R|; 0 for a joint without load.
pub(super) fn length<T: Real>([x, y]: [T; 2]) -> T {
    if y.is_zero() { x.abs() } else { x.hypotenuse(y) }
}
