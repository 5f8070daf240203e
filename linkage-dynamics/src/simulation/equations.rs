//! The differential equations of a scene in the current independent coordinates.
//!
//! `q' = N z'` and `M_r z'' = Q_r` with `M_r = N' M N` and `Q_r = N' (F - M b)`, where the columns of N span the null space of
//! [J A] and b is `q''` at `z'' = 0`. With z = v these are the emitted equations.

use super::frame::Frame;
use super::independent::{Choice, LEAST_PIVOT_RATIO};
use super::motion::{Motion, Parametrisation, Polynomial, Reduced};
use super::sheet::Errors;
use super::watch::Watch;
use crate::contact::{ReducedContact, ReducedEquations, Reduction};
use crate::integrate::{Crossing, Guard, System};
use crate::{Mode, MotionErrorOf, NameOf, Rates, Scene, StateColumn};
use linkage_runtime::__shared::all_finite;
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::{Build, Column, Dim, Mechanism, Name, PerInput, real};

/// The largest distance of a motion from the crossing on its sheet, in half lengths of its line; it begins within 2.5 of
/// them.
const LONGEST_WAY: f64 = 3.0;

impl<S: Scene, W> Motion<'_, S, W> {
    /// y' in the current coordinates.
    #[inline]
    fn rate_at(&mut self, t: S::Scalar, y: &StateColumn<S>) -> Result<StateColumn<S>, MotionErrorOf<S>> {
        let (q, free_rates) = self.unpack(y);
        let (independent, frame) = match &self.parametrisation {
            Parametrisation::Inputs if self.contacts.modes.iter().all(|&mode| mode == Mode::Open) => {
                return self.scene.derivative(t, y);
            }
            Parametrisation::Inputs => {
                return self.rate_of(t, &ReducedEquations::with_rates(&*self.scene, t, y)?);
            }
            Parametrisation::Others(independent) => {
                let factors = self.factors(independent, &q);
                // An error near a singularity of the choice: the integrator then tries a shorter step.
                let least = independent.regularity() * real(LEAST_PIVOT_RATIO);
                let signed = |pivot: S::Scalar, start| if start < S::Scalar::zero() { -pivot } else { pivot };
                let pivots = factors.pivots().zip_map(&independent.pivots, signed);
                if !pivots.iter().all(|&pivot| pivot >= least) {
                    return Err(self.singular_error(&q));
                }
                (independent, self.exact_frame(&factors, &q, &free_rates))
            }
            Parametrisation::Over(sheet) => {
                // A longer step may end next to another change point.
                if sheet.x(&sheet.independent.of(&Self::column(&q))).abs() > real(LONGEST_WAY) {
                    return Err(self.singular_error(&q));
                }
                (&sheet.independent, self.frame_on(sheet, &q, &free_rates)?)
            }
        };
        let rate = self.rate_of(t, &self.equations_by(independent, &frame, (t, y))?)?;
        if let (true, Parametrisation::Over(sheet)) = (frame.is_interpolated, &self.parametrisation) {
            let errors = self.errors_of_rate(&sheet.errors, &frame, (&free_rates, &self.unpack(&rate).1));
            self.uncertainty = Some(self.uncertainty.map_or(errors, |known| known.zip_map(&errors, S::Scalar::max)));
        }
        Ok(rate)
    }

    /// y' from the equations and q'.
    fn rate_of(
        &self,
        t: S::Scalar,
        (equations, rates): &(Reduced<S>, Rates<S>),
    ) -> Result<StateColumn<S>, MotionErrorOf<S>> {
        let accelerations = self.contacts.acceleration(equations).map_err(|error| error.at(t))?;
        all_finite(self.scene.name(), Name::from_static("the acceleration"), accelerations.iter())?;
        // y' is packed in the layout of y.
        let (unknowns, inputs) = S::Mechanism::rate_parts(rates);
        Ok(self.pack(&S::Mechanism::coordinates(unknowns, inputs), &accelerations))
    }

    /// M, Q and the contacts reduced to a choice of independent coordinates z, and q'.
    pub(super) fn equations_by(
        &self,
        independent: &Choice<S>,
        frame: &Frame<S>,
        (t, y): (S::Scalar, &StateColumn<S>),
    ) -> Result<(Reduced<S>, Rates<S>), MotionErrorOf<S>> {
        let (mut equations, rates) = self.unprescribed_by(independent, frame, (t, y))?;
        // Prescribed coordinates follow their laws.
        for (input, law) in self.prescribed(t).iter().enumerate() {
            let Some(law) = law else { continue };
            if let Some(at) = independent.free.iter().position(|&free| free == self.dims().0.count() + input) {
                equations.prescribe(at, law.acceleration);
            }
        }
        Ok((equations, rates))
    }

    /// The equations of [`equations_by`](Self::equations_by) before the prescribed motions are applied.
    pub(super) fn unprescribed_by(
        &self,
        independent: &Choice<S>,
        frame: &Frame<S>,
        (t, y): (S::Scalar, &StateColumn<S>),
    ) -> Result<(Reduced<S>, Rates<S>), MotionErrorOf<S>> {
        let (_, free_rates) = self.unpack(y);
        let Frame { q, basis: (unknowns, inputs), bias, .. } = frame;
        let (unknowns, inputs) = (*unknowns, *inputs);
        let rates = S::Mechanism::rates(unknowns * free_rates, inputs * free_rates);
        let all = self.scene.unreduced(t, q, &rates)?;
        let moved = all.unknowns * unknowns + all.mixed * inputs;
        let of_inputs_alone = all.mixed.tr_mul_matrix(&unknowns) + all.inputs * inputs;
        let mass = unknowns.tr_mul_matrix(&moved) + inputs.tr_mul_matrix(&of_inputs_alone);
        let left_unknowns = all.unknown_forces - all.unknowns * bias.unknowns - all.mixed * bias.inputs;
        let left_inputs = all.input_forces - all.mixed.tr_mul(&bias.unknowns) - all.inputs * bias.inputs;
        let forces = unknowns.tr_mul(&left_unknowns) + inputs.tr_mul(&left_inputs);
        let (basis, bias) = ((&unknowns, &inputs), (&bias.unknowns, &bias.inputs));
        let found = self.scene.contacts(t, q, &rates)?;
        let mut bearings = self.scene.contact_count().repeat(None);
        if self.scene.has_bearings() {
            let reduction = Reduction { basis, bias, all: &all, contacts: &found };
            bearings = reduction.bearings(self.scene.name(), &self.scene.bearings(t, q, &rates)?, |rows| {
                let solution = self.factors(independent, q).solve(rows);
                Ok((solution.unknowns, solution.inputs))
            })?;
        }
        let contacts = found.map(|contact| ReducedContact::new(&contact, basis, bias));
        let coordinates = independent.free.map(|column| self.scene.mechanism().coordinate_name(column));
        let reduced = ReducedEquations {
            scene: self.scene.name(),
            coordinates,
            mass,
            forces,
            rates: free_rates,
            contacts,
            bearings,
        };
        Ok((reduced, rates))
    }
}

impl<S: Scene, W> Motion<'_, S, W> {
    /// The errors of `y'` with an interpolated frame, from those of its values: of `q'` N's times `z'`, of `z''` that of the
    /// bias and those of the directions in which inertia and forces act, which are relative to `z''`.
    fn errors_of_rate(
        &self,
        errors: &Errors<S::Scalar>,
        frame: &Frame<S>,
        (rates, accelerations): (&PerInput<S::Mechanism>, &PerInput<S::Mechanism>),
    ) -> StateColumn<S> {
        let scales = &self.scales.coordinates;
        let speed = self.scaled_norm(&frame.rates(rates));
        let urge = self.scaled_norm(&frame.accelerations(accelerations));
        let of_rates = errors.basis * speed;
        let of_accelerations = errors.bias * speed * speed + (errors.basis + errors.position) * urge;
        let free = self.parametrisation.independent().map_or(scales.inputs, |independent| independent.of(scales));
        let q = S::Mechanism::coordinates(scales.unknowns * of_rates, scales.inputs * of_rates);
        self.pack(&q, &(free * of_accelerations))
    }
}

impl<S: Scene, W: Watch<S>> System for Motion<'_, S, W> {
    type Scalar = S::Scalar;
    type Name = NameOf<S>;
    type N = S::State;
    type Events = W::Events;
    type Guards = S::Contacts;

    #[inline]
    fn rate(&mut self, t: S::Scalar, y: &StateColumn<S>) -> Result<StateColumn<S>, MotionErrorOf<S>> {
        let t = self.beside(t);
        let rate = self.rate_at(t, y);
        match rate {
            Err(_) => self.off_kinks(t, y).map_or(rate, |near| self.rate_at(t, &near)),
            rate => rate,
        }
    }

    fn uncertainty(&mut self) -> Option<StateColumn<S>> {
        self.uncertainty.take()
    }

    fn events(&mut self, t: S::Scalar, y: &StateColumn<S>) -> Result<Column<S::Scalar, W::Events>, MotionErrorOf<S>> {
        let state = self.state(t, y)?;
        self.watch.values(&state)
    }

    #[inline]
    fn counts(&self) -> (W::Events, S::Contacts) {
        (self.watch.crossings().dim(), self.scene.contact_count())
    }

    fn crossings(&self) -> Column<Crossing, W::Events> {
        self.watch.crossings()
    }

    fn guards(
        &mut self,
        t: S::Scalar,
        y: &StateColumn<S>,
    ) -> Result<Column<Guard<S::Scalar>, S::Contacts>, MotionErrorOf<S>> {
        self.margins(t, y)
    }

    fn guard_changes(&mut self, y: &StateColumn<S>, moves: &StateColumn<S>) -> Column<Option<S::Scalar>, S::Contacts> {
        let ((q, _), (moves, _)) = (self.unpack(y), self.unpack(moves));
        let (unknowns, inputs) = S::Mechanism::parts(&moves);
        let changes = self.scene.gap_changes(&q, &S::Mechanism::rates(unknowns, inputs));
        changes.zip_map(&self.contacts.modes, |change, mode| change.filter(|_| mode == Mode::Open))
    }

    fn before_step(&mut self, t: S::Scalar, _: &StateColumn<S>) -> Result<Option<StateColumn<S>>, MotionErrorOf<S>> {
        self.begin_step(t);
        Ok(None)
    }

    #[inline]
    fn end_of_step(&mut self, t: S::Scalar, end: S::Scalar) -> S::Scalar {
        self.end_before_kink(t, end)
    }

    #[inline]
    fn went_over_change(&self) -> bool {
        self.corners.passed.is_some()
    }

    #[inline]
    fn change_of_law(&mut self, step: &Polynomial<S>) -> Result<Option<f64>, MotionErrorOf<S>> {
        self.kink_within(step)
    }
}
