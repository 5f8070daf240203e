//! The forces of held contacts: frictions that stick and stops on which s rests.
//!
//! The forces f with A f = -b keep `s'' = 0` of the held contacts, where `A = S M^-1 S'` and b is `s''` without their forces.
//! With redundant contacts, as where every joint of a linkage with one input sticks, A is singular. The factorisation
//! L D L' with diagonal pivoting takes the row with the largest pivot divided by its diagonal entry of A, until the
//! pivots are rounding errors. The contacts of these rows are independent and carry the forces; every other row is a
//! linear combination of them.

use super::reduced::ReducedEquations;
use super::tolerance::held_tolerance;
use super::{ContactLaw, Mode};
use crate::MotionError;
use crate::inertia::Inertia;
use linkage_runtime::__shared::{Ranked, reduce_rows};
use linkage_runtime::{BorrowedName, Build, Column, Dim, Matrix, Real};

/// The accelerations due to forces along some of the contacts.
pub(super) struct Response<T: Real, V: Dim, C: Dim> {
    /// M^-1 Q, the forces of slipping contacts included.
    pub acceleration: Column<T, V>,
    /// M^-1 S', one column for each requested contact.
    pub columns: Matrix<T, V, C>,
    /// S M^-1 S'.
    pub matrix: Matrix<T, C, C>,
    /// `s''` without the forces of the requested contacts, and the magnitude of its terms. In coordinates of one body
    /// relative to another the terms within M^-1 cancel: by Cauchy and Schwarz, |S M^-1 Q|^2 <= (S M^-1 S') (Q M^-1 Q).
    pub bias: Column<(T, T), C>,
}

impl<T: Real, V: Dim, C: Dim> Response<T, V, C> {
    /// Computes the response with these forces along the contacts. Only the columns and rows of the contacts for which
    /// `is_requested` is true are computed; the others are zero.
    ///
    /// # Errors
    /// Those of [`Inertia::new`].
    pub(super) fn new<N: BorrowedName>(
        equations: &ReducedEquations<T, V, C, N>,
        forces: &Column<T, C>,
        is_requested: impl Fn(usize) -> bool,
    ) -> Result<Self, MotionError<N>> {
        let ReducedEquations { scene, coordinates, mass, contacts, .. } = equations;
        let (v, c) = equations.dims();
        let inertia = Inertia::new(*scene, coordinates, mass)?;
        let (mut side, mut size) = (equations.forces, equations.forces.abs());
        for (contact, &force) in contacts.iter().zip(forces) {
            side += contact.row * force;
            size += contact.row.abs() * force.abs();
        }
        let acceleration = inertia.solve(&side);
        // Without the coordinates that affect no contact, such as prescribed ones.
        let affects = |at: usize| {
            contacts.iter().any(|contact| !contact.row[at].is_zero())
                || (0..v.count()).any(|other| other != at && !mass[(at, other)].is_zero())
        };
        let terms = (0..v.count()).filter(|&at| affects(at)).map(|at| side[at] * acceleration[at]);
        let squared = terms.fold(T::zero(), |sum, term| sum + term).max(T::zero());
        let mut columns = v.zero_matrix(c);
        let mut matrix = c.zero_matrix(c);
        let mut bias = c.repeat((T::zero(), T::zero()));
        for (place, contact) in contacts.iter().enumerate().filter(|(place, _)| is_requested(*place)) {
            columns.set_column(place, inertia.solve(&contact.row));
            let terms = contact.row.component_mul(&acceleration);
            let own = contact.row.dot(&columns.column(place)).max(T::zero());
            let size = terms.abs().sum().max(columns.column(place).abs().dot(&size)).max((own * squared).sqrt());
            bias[place] = (contact.bias + terms.sum(), contact.bias.abs() + size);
            for (other, before) in contacts.iter().enumerate().take(place + 1).filter(|(other, _)| is_requested(*other))
            {
                let entry = before.row.dot(&columns.column(place));
                (matrix[(place, other)], matrix[(other, place)]) = (entry, entry);
            }
        }
        Ok(Self { acceleration, columns, matrix, bias })
    }
}

/// The held contacts and their forces.
pub(super) struct Held<T: Real, V: Dim, C: Dim> {
    pub response: Response<T, V, C>,
    pub factors: Ranked<T, C>,
    /// The forces along s of the independent contacts, in pivot order.
    pub forces: Column<T, C>,
}

/// The force along s of a slipping contact with a given limit.
pub(super) fn slipping<T: Real>(mode: Mode, law: &ContactLaw<T>) -> T {
    match (mode, law) {
        (Mode::SlipForward, ContactLaw::Friction { limit }) => -*limit,
        (Mode::SlipBackward, ContactLaw::Friction { limit }) => *limit,
        _ => T::zero(),
    }
}

impl<T: Real, V: Dim, C: Dim> Held<T, V, C> {
    /// # Errors
    /// Those of [`Response::new`].
    #[inline(always)]
    pub(super) fn new<N: BorrowedName>(
        equations: &ReducedEquations<T, V, C, N>,
        modes: &Column<Mode, C>,
    ) -> Result<Self, MotionError<N>> {
        let forces = modes.dim().column(|place| slipping(modes[place], &equations.contacts[place].law));
        Self::with_forces(equations, modes, &forces)
    }

    /// Solves for the held contacts at these forces of the others.
    ///
    /// # Errors
    /// Those of [`Response::new`].
    // Inlined always: a result of 200 bytes that was just written is slow to move.
    #[inline(always)]
    pub(super) fn with_forces<N: BorrowedName>(
        equations: &ReducedEquations<T, V, C, N>,
        modes: &Column<Mode, C>,
        forces: &Column<T, C>,
    ) -> Result<Self, MotionError<N>> {
        let response = Response::new(equations, forces, |place| modes[place].is_held())?;
        let (mut order, mut count) = (modes.dim().repeat(0), 0);
        for place in (0..modes.dim().count()).filter(|&place| modes[place].is_held()) {
            order[count] = place;
            count += 1;
        }
        let factors = Ranked::pivoted(&response.matrix, &order, count, held_tolerance());
        let forces = factors.solve(|row| -response.bias[row].0);
        Ok(Self { response, factors, forces })
    }

    /// `v''`.
    pub(super) fn acceleration<N: BorrowedName>(&self, equations: &ReducedEquations<T, V, C, N>) -> Column<T, V> {
        let mut acceleration = self.response.acceleration;
        for (&row, &force) in self.factors.order.iter().zip(&self.forces).take(self.factors.rank) {
            acceleration += self.response.columns.column(row) * force;
        }
        self.enforce(equations, &mut acceleration, |row| equations.contacts[row].bias);
        acceleration
    }

    /// Returns v' projected so that s' = 0 of the held contacts: removes rounding error and the error of the event
    /// time.
    pub(super) fn rates<N: BorrowedName>(&self, equations: &ReducedEquations<T, V, C, N>) -> Column<T, V> {
        let impulses = self.factors.solve(|row| -equations.contacts[row].rate(&equations.rates).0);
        let mut rates = equations.rates;
        for (&row, &impulse) in self.factors.order.iter().zip(&impulses).take(self.factors.rank) {
            rates += self.response.columns.column(row) * impulse;
        }
        self.enforce(equations, &mut rates, |row| equations.contacts[row].drift);
        rates
    }

    /// Corrects x so that S x + `rest` = 0 holds exactly for the held contacts, not only to rounding error: it solves
    /// for one coordinate of each. The rate of a resting block is then exactly 0.
    fn enforce<N: BorrowedName>(
        &self,
        equations: &ReducedEquations<T, V, C, N>,
        x: &mut Column<T, V>,
        rest: impl Fn(usize) -> T,
    ) {
        let (rank, (v, c)) = (self.factors.rank, equations.dims());
        let mut rows = c.repeat(v.zeros());
        let mut pivots = c.repeat(0);
        let mut sides = c.zeros();
        for (place, &contact) in self.factors.order.iter().enumerate().take(rank) {
            rows[place] = equations.contacts[contact].row;
            sides[place] = -rest(contact);
        }
        // Dividing by the diagonal inertia makes the pivot choice independent of units.
        let weight = |row: &Column<T, V>, at: usize| row[at] * row[at] / equations.mass[(at, at)];
        let heaviest = |row: &Column<T, V>| {
            (1..v.count()).fold(0, |best, at| if weight(row, at) > weight(row, best) { at } else { best })
        };
        reduce_rows(
            &mut rows.as_mut_slice()[..rank],
            |place, row| {
                pivots[place] = heaviest(row);
                Some(pivots[place])
            },
            |place, other, factor| {
                let side = sides[place];
                sides[other] -= side * factor;
            },
        );
        for place in 0..rank {
            let pivot = pivots[place];
            let mut sum = sides[place];
            for at in (0..v.count()).filter(|at| !pivots.as_slice()[..rank].contains(at)) {
                sum -= rows[place][at] * x[at];
            }
            x[pivot] = sum / rows[place][pivot];
        }
    }
}
