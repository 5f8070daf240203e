//! The formulas of a mechanism with one moving input, over all kinds of numbers that a certificate needs.
//!
//! The coordinates are q = (u, v): the unknowns, then the moving input. All derivatives come from Psi alone, by
//! [`Series`]; the emitted J, A and gamma are only compared with them.

use linkage_runtime::__shared::Shown;
use linkage_runtime::jacobian::ScalesOf;
use linkage_runtime::{Build, Certifiable, Column, Dim, Formulas, Number, Ranged};

use super::error::{CertifyError, CertifyErrorOf};
use super::on_turns::OnTurns;
use super::turned::repeats;
use crate::Interval;
use crate::series::{Series, lines, unit_line};

/// A parameter with a tolerance: the formulas with its derivative, and the difference of its values from the middle.
struct Tolerance<M: Certifiable> {
    by: M::Over<Series<Interval>>,
    quantities_by: M::Over<OnTurns>,
    difference: Interval,
}

/// The mechanism with its parameters exact, or with all values of their tolerances.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Dimensions {
    /// The middle of each tolerance.
    Nominal,
    /// All of them.
    All,
}

/// The formulas of a mechanism, its fixed inputs and its scales.
pub(super) struct System<M: Certifiable> {
    pub(super) mechanism: M,
    floats: M::Over<Series<f64>>,
    nominal: M::Over<Series<Interval>>,
    all: M::Over<Series<Interval>>,
    nominal_quantities: M::Over<OnTurns>,
    all_quantities: M::Over<OnTurns>,
    emitted: M::Over<Interval>,
    parameters: Column<Interval, <M as Certifiable>::P>,
    tolerances: Vec<Tolerance<M>>,
    inputs: Vec<f64>,
    moving: usize,
    /// The scales of the residuals.
    pub(super) rows: Vec<f64>,
    /// The scales of the coordinates: 1 for an angle.
    pub(super) scales: Vec<f64>,
}

impl<M: Certifiable> System<M> {
    /// The system of a mechanism whose other inputs stay at those of `start`.
    pub(super) fn new(
        mechanism: &M,
        start: &M::Coordinates,
        moving: usize,
        parameters: Column<Interval, <M as Certifiable>::P>,
    ) -> Result<Self, CertifyErrorOf<M>> {
        let invalid = |what| CertifyError::Invalid { mechanism: mechanism.name(), what };
        let (unknowns, inputs) = M::parts(start);
        if moving >= inputs.iter().count() {
            return Err(invalid("the index of the input"));
        }
        if !unknowns.iter().chain(inputs.iter()).all(|number| number.is_finite()) {
            return Err(invalid("the start"));
        }
        let middles = mechanism.parameters();
        if middles.iter().any(|value| !value.is_finite()) || parameters.dim() != middles.dim() {
            return Err(invalid("the parameters"));
        }
        if middles.iter().zip(&parameters).any(|(&middle, all)| !all.contains(middle) || !all.width().is_finite()) {
            return Err(invalid("a tolerance"));
        }
        let tolerances = parameters.iter().zip(middles.iter()).enumerate().filter(|(_, (all, _))| all.width() > 0.0);
        let tolerances = tolerances.map(|(place, (&all, &middle))| {
            let mut by = parameters.map(Series::constant);
            by[place] = Series::line(all, Interval::one());
            Tolerance {
                by: mechanism.over(by),
                quantities_by: mechanism.over(by.map(OnTurns::plain)),
                difference: all - Interval::from(middle),
            }
        });
        let scales = ScalesOf::<M>::of(mechanism, &mechanism.pose_at(start));
        let scale_or_one = |scale: f64| if scale.is_finite() && scale > 0.0 { scale } else { 1.0 };
        let coordinates =
            scales.coordinates.unknowns.iter().chain(scales.coordinates.inputs.iter().skip(moving).take(1));
        Ok(Self {
            tolerances: tolerances.collect(),
            floats: mechanism.over(middles.map(Series::constant)),
            nominal: mechanism.over(middles.map(|value| Series::constant(value.into()))),
            all: mechanism.over(parameters.map(Series::constant)),
            nominal_quantities: mechanism.over(middles.map(|value| OnTurns::plain(Series::constant(value.into())))),
            all_quantities: mechanism.over(parameters.map(|value| OnTurns::plain(Series::constant(value)))),
            emitted: mechanism.over(parameters),
            parameters,
            inputs: inputs.iter().copied().collect(),
            moving,
            rows: scales.residuals.iter().map(|&scale| scale_or_one(scale)).collect(),
            scales: coordinates.map(|&scale| scale_or_one(scale)).collect(),
            mechanism: mechanism.with(middles),
        })
    }

    /// The number of unknowns.
    pub(super) fn count(&self) -> usize {
        self.mechanism.dims().0.count()
    }

    /// The unknowns and the moving input of a position; `None` if its other inputs are not those of the system.
    pub(super) fn position(&self, q: &M::Coordinates) -> Option<Vec<f64>> {
        let (unknowns, inputs) = M::parts(q);
        let mut fixed = inputs.iter().zip(&self.inputs).enumerate().filter(|&(place, _)| place != self.moving);
        let moving = *inputs.iter().nth(self.moving)?;
        fixed.all(|(_, (one, other))| one == other).then(|| unknowns.iter().copied().chain([moving]).collect())
    }

    /// True if an unknown, or the moving input after them, is an angle.
    pub(super) fn is_angle(&self, coordinate: usize) -> bool {
        let input = self.mechanism.input_angles().get(self.moving);
        let own = self.mechanism.unknown_angles().get(coordinate);
        own.or(if coordinate == self.count() { input } else { None }).copied().unwrap_or_default()
    }

    /// The name of the moving input.
    pub(super) fn input_name(&self) -> M::Name {
        self.mechanism.input_name(self.moving)
    }

    /// A value of the moving input for readers.
    pub(super) fn shown_input(&self, value: f64) -> Shown {
        Shown { value, is_angle: self.is_angle(self.count()) }
    }

    /// A place of the moving input: a number where its interval is narrow, else both ends, rounded outward.
    pub(super) fn shown_place(&self, of: Interval) -> String {
        /// The width of an interval that is one number for readers, as a part of it.
        const ONE_NUMBER: f64 = 1e-7;

        if of.width() <= ONE_NUMBER * of.magnitude() || !of.magnitude().is_finite() {
            return self.shown_input(of.middle()).to_string();
        }
        let is_angle = self.is_angle(self.count());
        let in_degrees = || of * Interval::from(180.0) / Interval::pi();
        let (of, unit) = if is_angle { (in_degrees(), "°") } else { (of, "") };
        format!("{} to {}{unit}", of.rounded_least(), of.rounded_most())
    }

    /// The words about parameters that have tolerances.
    pub(super) fn shown_tolerances(&self) -> &'static str {
        if self.has_tolerances() { ", for all parameters within their tolerances" } else { "" }
    }

    /// True if Psi is the same after these full turns of the unknowns and of the moving input.
    pub(super) fn repeats(&self, turns: &[i64]) -> bool {
        let (u, v, _) = self.mechanism.dims();
        let at = |place: usize| turns.get(place).copied().unwrap_or_default();
        let moving = at(u.count());
        let inputs = v.column(|place| if place == self.moving { moving } else { 0 });
        repeats(&self.mechanism, &self.parameters, &u.column(at), &inputs)
    }

    /// True if a parameter has a tolerance.
    pub(super) fn has_tolerances(&self) -> bool {
        !self.tolerances.is_empty()
    }

    /// Splits q into u and all inputs.
    fn split<N: Number>(&self, q: &[N]) -> (Column<N, M::U>, Column<N, M::V>) {
        let at = |place: usize| q.get(place).copied().unwrap_or_else(N::unknown);
        let fixed = |place: usize| self.inputs.get(place).map_or_else(N::unknown, |&value| N::exactly(value));
        let input = |place| if place == self.moving { at(self.count()) } else { fixed(place) };
        let (u, v, _) = self.mechanism.dims();
        (u.column(at), v.column(input))
    }

    fn formulas(&self, dimensions: Dimensions) -> &M::Over<Series<Interval>> {
        match dimensions {
            Dimensions::Nominal => &self.nominal,
            Dimensions::All => &self.all,
        }
    }

    /// Psi and its two derivatives along a curve.
    pub(super) fn psi(&self, dimensions: Dimensions, q: &[Series<Interval>]) -> Vec<Series<Interval>> {
        let (unknowns, inputs) = self.split(q);
        self.formulas(dimensions).residual(&unknowns, &inputs).iter().copied().collect()
    }

    /// Psi and its two derivatives along a curve, without enclosure.
    pub(super) fn float_psi(&self, q: &[Series<f64>]) -> Vec<Series<f64>> {
        let (unknowns, inputs) = self.split(q);
        self.floats.residual(&unknowns, &inputs).iter().copied().collect()
    }

    /// The quantities and their two derivatives along a curve.
    pub(super) fn quantities(&self, dimensions: Dimensions, q: &[Series<Interval>]) -> Vec<OnTurns> {
        let (unknowns, inputs) = self.split(q);
        let formulas = match dimensions {
            Dimensions::Nominal => &self.nominal_quantities,
            Dimensions::All => &self.all_quantities,
        };
        formulas.quantities(&unknowns.map(OnTurns::plain), &inputs.map(OnTurns::plain)).iter().copied().collect()
    }

    /// The value with a range at this place, with its ends, over a box.
    pub(super) fn ranged(&self, place: usize, q: &[Interval]) -> Option<Ranged<Interval>> {
        let (unknowns, inputs) = self.split(q);
        self.emitted.ranged(place, &unknowns, &inputs)
    }

    /// For each tolerance the derivative of Psi by the parameter, and the difference of its values from the middle.
    pub(super) fn by_parameters(&self, q: &[Interval]) -> Vec<(Vec<Interval>, Interval)> {
        let q: Vec<_> = q.iter().map(|&x| Series::constant(x)).collect();
        let (unknowns, inputs) = self.split(&q);
        let by = |tolerance: &Tolerance<M>| {
            let psi = tolerance.by.residual(&unknowns, &inputs);
            (psi.iter().map(|psi| psi.first).collect(), tolerance.difference)
        };
        self.tolerances.iter().map(by).collect()
    }

    /// For each tolerance the derivative of the quantities by the parameter while the unknowns have these rates.
    pub(super) fn quantities_by_parameters(&self, q: &[Interval], rates: &[Vec<Interval>]) -> Vec<Vec<OnTurns>> {
        let by = |(tolerance, rates): (&Tolerance<M>, &Vec<Interval>)| {
            let (unknowns, inputs) = self.split(&lines(q, rates));
            let (unknowns, inputs) = (unknowns.map(OnTurns::plain), inputs.map(OnTurns::plain));
            tolerance.quantities_by.quantities(&unknowns, &inputs).iter().copied().collect()
        };
        self.tolerances.iter().zip(rates).map(by).collect()
    }

    /// The unknowns, all inputs and the parameters, from the unknowns and the moving input.
    pub(super) fn numbers(&self, q: &[Interval]) -> Vec<Interval> {
        let (unknowns, inputs) = self.split(q);
        unknowns.iter().chain(&inputs).chain(&self.parameters).copied().collect()
    }

    /// The columns of [J A], the derivatives of Psi by each coordinate.
    pub(super) fn jacobian(&self, dimensions: Dimensions, q: &[Interval]) -> Vec<Vec<Interval>> {
        let column = |column| self.psi(dimensions, &unit_line(q, column)).iter().map(|psi| psi.first).collect();
        (0..q.len()).map(column).collect()
    }

    /// The columns of [J A] at a point, without enclosure.
    pub(super) fn float_jacobian(&self, q: &[f64]) -> Vec<Vec<f64>> {
        let column = |column| self.float_psi(&unit_line(q, column)).iter().map(|psi| psi.first).collect();
        (0..q.len()).map(column).collect()
    }

    /// Compares the emitted J, A and gamma with the derivatives of Psi over a box. Both contain the true values, so
    /// that they intersect if the emitted formulas are right.
    ///
    /// The rates of gamma are the scales of the coordinates, each times another factor, so that terms of opposite sign
    /// do not cancel.
    pub(super) fn check_emitted(&self, q: &[Interval]) -> Result<(), CertifyErrorOf<M>> {
        let factors = (0_u32..).map(|place| 1.0 + f64::from(place) / 3.0);
        let rates: Vec<Interval> =
            self.scales.iter().zip(factors).map(|(scale, factor)| (scale * factor).into()).collect();
        let contradiction = |what| CertifyError::Contradiction { mechanism: self.mechanism.name(), what };
        let (unknowns, inputs) = self.split(q);
        let own = self.jacobian(Dimensions::All, q);
        let j = self.emitted.jacobian_unknowns(&unknowns, &inputs);
        let a = self.emitted.jacobian_inputs(&unknowns, &inputs);
        let (of_unknowns, of_input) = own.split_at(self.count());
        if !of_unknowns.iter().zip(j.iter()).all(|(own, emitted)| intersect(own, emitted.as_slice())) {
            return Err(contradiction("J"));
        }
        if !of_input.iter().zip(a.iter().skip(self.moving)).all(|(own, emitted)| intersect(own, emitted.as_slice())) {
            return Err(contradiction("A"));
        }
        let own: Vec<_> = self.psi(Dimensions::All, &lines(q, &rates)).iter().map(|psi| psi.second).collect();
        let (unknown_rates, _) = self.split(&rates);
        let input_rate = rates.last().copied().unwrap_or(Interval::zero());
        let input_rates = inputs.dim().column(|place| if place == self.moving { input_rate } else { Interval::zero() });
        let gamma = self.emitted.gamma(&unknowns, &inputs, &unknown_rates, &input_rates);
        if intersect(&own, gamma.as_slice()) { Ok(()) } else { Err(contradiction("gamma")) }
    }
}

fn intersect(these: &[Interval], those: &[Interval]) -> bool {
    these.iter().zip(those).all(|(&this, &that)| this.intersection(that).is_some())
}
