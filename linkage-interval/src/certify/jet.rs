//! Values and derivatives of quantities over a part of a tube.

use linkage_runtime::{Certifiable, Number};

use super::series::Series;
use super::system::{Dimensions, System};
use super::tube::{Part, Tube};
use crate::Interval;

/// A function of the position along a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Measure {
    /// A coordinate of a point or an output, by its number.
    Quantity(usize),
    /// The derivative of an unknown by the parameter of the tube, by the number of the unknown.
    Rate(usize),
    /// The derivative of a quantity by the parameter of the tube.
    QuantityRate(usize),
}

/// A measure over an interval of the parameter.
pub(super) struct Jet {
    /// Its values for all dimensions.
    pub(super) value: Interval,
    /// Its derivative by the parameter of the tube.
    pub(super) first: Interval,
    /// Its second derivative; all real numbers if it is not computed.
    pub(super) second: Interval,
    /// The differences of its values from those of the nominal dimensions, bounded by the mean-value theorem.
    by_tolerances: Interval,
}

impl Measure {
    /// The jet over a part of a tube; `None` if the rates have no bounds there.
    fn over<M: Certifiable>(
        self,
        system: &System<M>,
        tube: &Tube,
        dimensions: Dimensions,
        c: Interval,
    ) -> Option<Jet> {
        let part = tube.part(system, dimensions, c)?;
        let rates = part.expansion.rates(system, &part.linear)?;
        let accelerations = part.expansion.accelerations(system, dimensions, &part.linear, &part.q, &rates)?;
        let mut by_tolerances = Interval::zero();
        let jet = match self {
            Self::Rate(place) => {
                let (value, first) = (*rates.get(place)?, *accelerations.get(place)?);
                Series { value, first, second: Interval::ENTIRE }
            }
            Self::Quantity(place) | Self::QuantityRate(place) => {
                let parts = part.q.iter().zip(&rates).zip(&accelerations);
                let q: Vec<_> = parts.map(|((&value, &first), &second)| Series { value, first, second }).collect();
                let quantity = *system.quantities(dimensions, &q).get(place)?;
                if self == Self::Quantity(place) {
                    by_tolerances = spread(system, &part, place)?;
                    quantity
                } else {
                    Series { value: quantity.first, first: quantity.second, second: Interval::ENTIRE }
                }
            }
        };
        Some(Jet { value: jet.value, first: jet.first, second: jet.second, by_tolerances })
    }

    /// The jet over an interval c, its value by the mean-value form in c and in the parameters:
    /// f(m) + f'(C) (C - m) + the sum of f_p (p - p0), where m is the middle of c.
    pub(super) fn jet<M: Certifiable>(self, system: &System<M>, tube: &Tube, c: Interval) -> Option<Jet> {
        let mut jet = self.over(system, tube, Dimensions::All, c)?;
        if c.width() > 0.0 || system.has_tolerances() {
            let middle = Interval::from(c.middle());
            // A rate has no derivatives by the parameters here.
            let dimensions =
                if matches!(self, Self::Quantity(_)) { Dimensions::Nominal } else { Dimensions::All };
            let at = self.over(system, tube, dimensions, middle)?;
            let form = at.value + jet.first * (c - middle) + jet.by_tolerances;
            jet.value = jet.value.intersection(form)?;
        }
        Some(jet)
    }
}

/// The sum over the tolerances of the derivative of a quantity by the parameter times its difference from the middle,
/// where the unknowns follow by du/dp = -J^-1 Psi_p.
fn spread<M: Certifiable>(system: &System<M>, part: &Part, place: usize) -> Option<Interval> {
    if !system.has_tolerances() {
        return Some(Interval::zero());
    }
    let by_parameters = system.by_parameters(&part.q);
    let rates = by_parameters.iter().map(|(by, _)| {
        let right: Vec<Interval> = by.iter().map(|&x| -x).collect();
        part.expansion.solve(system, &part.linear, &right, Interval::zero())
    });
    let rates: Vec<Vec<Interval>> = rates.collect::<Option<_>>()?;
    let quantities = system.quantities_by_parameters(&part.q, &rates);
    let terms = quantities.iter().zip(&by_parameters).map(|(by, (_, difference))| Some(*by.get(place)? * *difference));
    terms.reduce(|sum, term| Some(sum? + term?)).unwrap_or(Some(Interval::zero()))
}
