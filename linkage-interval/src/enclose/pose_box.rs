//! A box of positions and parameters, and what is enclosed over it.

use std::fmt;

use linkage_runtime::jacobian::ScalesOf;
use linkage_runtime::{Build, Certifiable, Column, Dim, Mechanism, Number};

use super::linear::{Linear, Sizes, column};
use super::mean_value::{Order, Solver};
use super::{EncloseError, EncloseErrorOf};
use crate::Interval;
use crate::series::{Series, lines};

/// For each input or parameter a column of an interval for each unknown.
pub type IntervalColumns<M, C> = Column<Column<Interval, <M as Mechanism>::U>, C>;

/// A box of unknowns, inputs and parameters in which J is regular.
///
/// ```
/// # use linkage_interval::Interval;
/// # use linkage_interval::enclose::{EncloseErrorOf, PoseBox};
/// # use linkage_runtime::{Certifiable, Column, D};
/// /// The angular velocity of a rocker, for all angles of a box.
/// fn rocker<M: Certifiable<U = D<2>, V = D<1>>>(bar: &M, angles: [Interval; 3]) -> Result<Interval, EncloseErrorOf<M>> {
///     let [crank, coupler, rocker] = angles;
///     let all = PoseBox::new(bar, [coupler, rocker].into(), [crank].into())?;
///     Ok(all.velocity(&[Interval::from(1.0)].into())?[1])
/// }
/// ```
pub struct PoseBox<M: Certifiable> {
    /// The unknowns, the inputs, the parameters.
    numbers: Vec<Interval>,
    linear: Linear,
    /// J in the middle, unless the box is a point.
    middle: Option<Linear>,
    mechanism: M,
}

impl<M: Certifiable> PoseBox<M> {
    /// The box of these unknowns and inputs, with the parameters of the mechanism.
    ///
    /// # Errors
    /// Those of [`with_parameters`](Self::with_parameters).
    pub fn new(
        mechanism: &M,
        unknowns: Column<Interval, M::U>,
        inputs: Column<Interval, M::V>,
    ) -> Result<Self, EncloseErrorOf<M>> {
        Self::with_parameters(mechanism, mechanism.parameters().map(Interval::from), unknowns, inputs)
    }

    /// The box of one position, for which the results are as narrow as rounding errors allow.
    ///
    /// # Errors
    /// Those of [`with_parameters`](Self::with_parameters).
    pub fn at(mechanism: &M, q: &M::Coordinates) -> Result<Self, EncloseErrorOf<M>> {
        let (unknowns, inputs) = M::parts(q);
        Self::new(mechanism, unknowns.map(Interval::from), inputs.map(Interval::from))
    }

    /// The box of these unknowns, inputs and parameters.
    ///
    /// # Errors
    /// - [`EncloseError::Invalid`] if an interval is infinite; [`Interval::from`] makes such ones of NaN and infinity;
    /// - [`EncloseError::UserFunction`] if a loop or an equation calls one;
    /// - [`EncloseError::NoBounds`] if J has none;
    /// - [`EncloseError::NotRegular`] if J is not proved regular at every point.
    pub fn with_parameters(
        mechanism: &M,
        parameters: Column<Interval, <M as Certifiable>::P>,
        unknowns: Column<Interval, M::U>,
        inputs: Column<Interval, M::V>,
    ) -> Result<Self, EncloseErrorOf<M>> {
        all_finite(mechanism, "unknown", M::unknown_name, unknowns.as_slice())?;
        all_finite(mechanism, "input", M::input_name, inputs.as_slice())?;
        all_finite(mechanism, "parameter", M::parameter_name, parameters.as_slice())?;
        let middle = M::coordinates(unknowns.map(Interval::middle), inputs.map(Interval::middle));
        let scales = ScalesOf::<M>::of(mechanism, &mechanism.pose_at(&middle));
        let sizes = Sizes {
            rows: scales.residuals.iter().map(|&scale| scale_or_one(scale)).collect(),
            unknowns: scales.coordinates.unknowns.iter().map(|&scale| scale_or_one(scale)).collect(),
        };
        Self::of_numbers(mechanism, unknowns.iter().chain(&inputs).chain(&parameters).copied().collect(), &sizes)
    }

    /// The box of finite numbers.
    pub(crate) fn of_numbers(mechanism: &M, numbers: Vec<Interval>, sizes: &Sizes) -> Result<Self, EncloseErrorOf<M>> {
        let linear = Linear::of(mechanism, &numbers, sizes)?;
        let middles: Vec<Interval> = numbers.iter().map(|x| x.middle().into()).collect();
        let is_point = middles == numbers;
        let middle = if is_point { None } else { Some(Linear::of(mechanism, &middles, sizes)?) };
        Ok(Self { numbers, linear, middle, mechanism: mechanism.with(mechanism.parameters()) })
    }

    /// The unknowns.
    #[must_use]
    pub fn unknowns(&self) -> Column<Interval, M::U> {
        column(self.mechanism.dims().0, &self.numbers, 0)
    }

    /// The inputs.
    #[must_use]
    pub fn inputs(&self) -> Column<Interval, M::V> {
        column(self.mechanism.dims().1, &self.numbers, self.unknown_count())
    }

    /// The parameters.
    #[must_use]
    pub fn parameters(&self) -> Column<Interval, <M as Certifiable>::P> {
        column(self.mechanism.parameters().dim(), &self.numbers, self.parameters_from())
    }

    /// For each group an upper bound of the norm of I - Y J over the box, below 1, where Y is about the inverse of its
    /// block of J in the middle: the proof that the block is regular, and how near it is to failing.
    #[must_use]
    pub fn norms(&self) -> Column<f64, M::G> {
        self.mechanism.dims().2.column(|place| self.linear.norms.get(place).copied().unwrap_or_default())
    }

    /// W = -J^-1 A: for each input the column of the rates of the unknowns while it has the rate 1 and the others 0.
    ///
    /// # Errors
    /// [`EncloseError::NoBounds`] if A has none.
    pub fn velocity_ratios(&self) -> Result<IntervalColumns<M, M::V>, EncloseErrorOf<M>> {
        self.by_each(self.mechanism.dims().1, self.unknown_count(), "A")
    }

    /// u' = W v': the rates of the unknowns for all rates of the inputs in these intervals.
    ///
    /// # Errors
    /// [`EncloseError::Invalid`] if a rate is infinite, [`EncloseError::NoBounds`] if A has no bounds.
    pub fn velocity(&self, input_rates: &Column<Interval, M::V>) -> Result<Column<Interval, M::U>, EncloseErrorOf<M>> {
        all_finite(&self.mechanism, "rate", M::input_name, input_rates.as_slice())?;
        let curve = lines(&self.numbers, &self.direction(self.unknown_count(), input_rates.as_slice()));
        Ok(column(self.mechanism.dims().0, &self.solver(Order::First, "A v'").solve(&curve)?, 0))
    }

    /// `u''` from `J u'' = -(A v'' + gamma)`: the accelerations of the unknowns for all rates and all accelerations of the
    /// inputs in these intervals. With the rates of [`velocity`](Self::velocity) they contain those of every motion
    /// through a point of the box.
    ///
    /// # Errors
    /// [`EncloseError::Invalid`] if a rate or an acceleration is infinite, [`EncloseError::NoBounds`] if A or gamma has
    /// no bounds.
    pub fn acceleration(
        &self,
        unknown_rates: &Column<Interval, M::U>,
        input_rates: &Column<Interval, M::V>,
        input_accelerations: &Column<Interval, M::V>,
    ) -> Result<Column<Interval, M::U>, EncloseErrorOf<M>> {
        all_finite(&self.mechanism, "rate", M::unknown_name, unknown_rates.as_slice())?;
        all_finite(&self.mechanism, "rate", M::input_name, input_rates.as_slice())?;
        all_finite(&self.mechanism, "acceleration", M::input_name, input_accelerations.as_slice())?;
        let mut first = self.direction(self.unknown_count(), input_rates.as_slice());
        first.iter_mut().zip(unknown_rates).for_each(|(own, &rate)| *own = rate);
        let second = self.direction(self.unknown_count(), input_accelerations.as_slice());
        let parts = self.numbers.iter().zip(first).zip(second);
        let curve: Vec<_> = parts.map(|((&value, first), second)| Series { value, first, second }).collect();
        Ok(column(self.mechanism.dims().0, &self.solver(Order::Second, "A v'' + gamma").solve(&curve)?, 0))
    }

    /// du/dp = -J^-1 Psi_p: for each parameter the column of the rates of the unknowns while it grows with rate 1, at
    /// fixed inputs.
    ///
    /// # Errors
    /// [`EncloseError::NoBounds`] if Psi_p has none.
    pub fn sensitivity(&self) -> Result<IntervalColumns<M, <M as Certifiable>::P>, EncloseErrorOf<M>> {
        self.by_each(self.mechanism.parameters().dim(), self.parameters_from(), "Psi_p")
    }

    /// The rates of the unknowns while one number grows with rate 1, for each of those from this index on.
    fn by_each<C: Dim>(
        &self,
        columns: C,
        from: usize,
        derivative: &'static str,
    ) -> Result<IntervalColumns<M, C>, EncloseErrorOf<M>> {
        let solver = self.solver(Order::First, derivative);
        let by = |place| solver.solve(&lines(&self.numbers, &self.direction(from + place, &[Interval::one()])));
        let all: Vec<Vec<Interval>> = (0..columns.count()).map(by).collect::<Result<_, _>>()?;
        let u = self.mechanism.dims().0;
        Ok(columns.column(|place| column(u, all.get(place).map_or(&[], Vec::as_slice), 0)))
    }

    fn unknown_count(&self) -> usize {
        self.mechanism.dims().0.count()
    }

    /// The place of the first parameter among the numbers.
    fn parameters_from(&self) -> usize {
        let (u, v, _) = self.mechanism.dims();
        u.count() + v.count()
    }

    /// The rates of all numbers that are zero but for these from an index on.
    fn direction(&self, from: usize, rates: &[Interval]) -> Vec<Interval> {
        let mut all = vec![Interval::zero(); self.numbers.len()];
        all.iter_mut().skip(from).zip(rates).for_each(|(own, &rate)| *own = rate);
        all
    }

    fn solver(&self, order: Order, derivative: &'static str) -> Solver<'_, M> {
        let middle = self.middle.as_ref().unwrap_or(&self.linear);
        Solver { mechanism: &self.mechanism, linear: &self.linear, middle, order, derivative }
    }
}

impl<M: Certifiable> fmt::Debug for PoseBox<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("PoseBox")
            .field("unknowns", &self.unknowns())
            .field("inputs", &self.inputs())
            .field("parameters", &self.parameters())
            .field("norms", &self.norms())
            .finish()
    }
}

/// An error if an interval is infinite.
fn all_finite<M: Certifiable>(
    mechanism: &M,
    kind: &'static str,
    name: impl Fn(&M, usize) -> M::Name,
    intervals: &[Interval],
) -> Result<(), EncloseErrorOf<M>> {
    match intervals.iter().position(|x| !x.magnitude().is_finite()) {
        Some(place) => Err(EncloseError::Invalid { mechanism: mechanism.name(), kind, name: name(mechanism, place) }),
        None => Ok(()),
    }
}

/// A scale as a divisor: 1 if it is zero or not finite.
fn scale_or_one(scale: f64) -> f64 {
    if scale.is_finite() && scale > 0.0 { scale } else { 1.0 }
}
