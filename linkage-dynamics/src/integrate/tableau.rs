//! Embedded Runge-Kutta pairs as tables, and the stages of a step.

use linkage_runtime::{Build, Column, Dim, Real, real};

/// A linear combination of slopes: the index of each slope and its coefficient.
pub type Weights = &'static [(usize, f64)];

/// A slope k = f(t + c h, y + h sum a_j k_j).
#[derive(Debug, Clone, Copy)]
pub struct Stage {
    /// The node c.
    pub node: f64,
    /// The coefficients a_j.
    pub weights: Weights,
}

/// The parameters of the step-size controller.
#[derive(Debug, Clone, Copy)]
pub struct Control {
    /// The exponent of the error, beta included.
    pub exponent: f64,
    /// The exponent of the previous error (PI controller, Lund's stabilisation); 0 switches it off.
    pub beta: f64,
    /// The least ratio of a step to the previous one.
    pub shrink: f64,
    /// The largest ratio of a step to the previous one.
    pub grow: f64,
    /// h |lambda| at the boundary of the stability region: above it stability limits the step.
    pub stability: f64,
}

/// The Butcher tableau of an embedded explicit Runge-Kutta pair with dense output; the last slope is reused as the
/// first of the next step (FSAL). Slope 0 is f(t, y), slope `end` is f(t + h, y1).
#[derive(Debug, Clone, Copy)]
pub struct Tableau {
    /// The order p of the solution: its local error is O(h^(p + 1)).
    pub order: u32,
    /// Slopes 1, 2, ...
    pub stages: &'static [Stage],
    /// y1 = y + h sum b_j k_j.
    pub solution: Weights,
    /// The index of the slope at the end of the step.
    pub end: usize,
    /// (y1 - solution of lower order) / h. With two estimates, of orders 5 and 3, E = E5^2 / sqrt(E5^2 + E3^2 / 100).
    pub errors: [Weights; 2],
    /// Slopes `end` + 1 and following, which only dense output uses.
    pub dense_stages: &'static [Stage],
    /// The coefficients of dense output, divided by h, that do not follow from y, y1 and their slopes.
    pub dense: &'static [Weights],
    /// The parameters of the step-size controller.
    pub control: Control,
}

/// The number of slopes of the largest method.
pub(super) const SLOPES: usize = 16;

/// The slopes of a step.
pub(super) type Slopes<T, N> = [Column<T, N>; SLOPES];

/// An adaptive method.
pub trait Method {
    /// Its coefficients.
    const TABLEAU: Tableau;
}

/// sum w_j k_j.
#[inline(always)]
pub(super) fn combination<T: Real, N: Dim>(slopes: &Slopes<T, N>, weights: Weights) -> Column<T, N> {
    // Entry by entry: with operators of columns or in place the loop over the weights is not unrolled, and each slope is
    // stored and read again, a fifth of the time of a pendulum.
    weights.iter().fold(slopes[0].dim().zeros(), |sum, &(j, weight)| {
        let (slope, weight) = (&slopes[j], real::<T>(weight));
        sum.dim().column(|place| sum[place] + slope[place] * weight)
    })
}

/// Computes the slopes of these stages, numbered upwards from `from`.
#[inline(always)]
pub(super) fn evaluate<T: Real, N: Dim, E>(
    mut rate: impl FnMut(T, &Column<T, N>) -> Result<Column<T, N>, E>,
    stages: &[Stage],
    from: usize,
    (t, y): (T, &Column<T, N>),
    h: T,
    slopes: &mut Slopes<T, N>,
) -> Result<(), E> {
    for (number, stage) in (from..).zip(stages) {
        let inner = *y + combination(slopes, stage.weights) * h;
        slopes[number] = rate(t + real::<T>(stage.node) * h, &inner)?;
    }
    Ok(())
}
