//! Values and derivatives of quantities over a part of a tube.

use linkage_runtime::{Certifiable, Number};

use super::system::{Dimensions, System};
use super::tube::{Part, Tube};
use crate::Interval;
use crate::series::Series;

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

/// A measure over an interval of the parameter, for all dimensions.
#[derive(Debug, Clone, Copy)]
pub(super) struct Jet {
    /// Its values.
    pub(super) value: Interval,
    /// Its derivative by the parameter of the tube.
    pub(super) first: Interval,
    /// Its second derivative; all real numbers if it is not computed.
    pub(super) second: Interval,
    /// The values in the middle of the interval.
    pub(super) middle: Interval,
    /// The derivative there.
    pub(super) slope: Interval,
}

/// A measure over a box, and the differences of its values from those of the nominal dimensions.
struct Bounds {
    series: Series<Interval>,
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
    ) -> Option<Bounds> {
        let part = tube.part(system, dimensions, c)?;
        let rates = part.expansion.rates(system, &part.linear)?;
        let accelerations = part.expansion.accelerations(system, dimensions, &part.linear, &part.q, &rates)?;
        let mut by_tolerances = Interval::zero();
        let series = match self {
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
        Some(Bounds { series, by_tolerances })
    }

    /// The measure in the middle of an interval for the nominal dimensions and for all. A rate has no derivatives by the
    /// parameters here, so that its nominal values are those for all.
    fn in_middle<M: Certifiable>(self, system: &System<M>, tube: &Tube, c: f64) -> Option<[Series<Interval>; 2]> {
        let all = self.over(system, tube, Dimensions::All, c.into())?;
        if !system.has_tolerances() || !matches!(self, Self::Quantity(_)) {
            return Some([all.series; 2]);
        }
        let nominal = self.over(system, tube, Dimensions::Nominal, c.into())?.series;
        let value = all.series.value.intersection(nominal.value + all.by_tolerances)?;
        Some([nominal, Series { value, ..all.series }])
    }

    /// The jet over an interval c with middle m, its values by the mean-value form f(m) + f'(C) (C - m), by Taylor's
    /// `f(m) + f'(m) (C - m) + f''(C) (C - m)^2 / 2`, and by the mean-value form in the parameters.
    pub(super) fn jet<M: Certifiable>(self, system: &System<M>, tube: &Tube, c: Interval) -> Option<Jet> {
        let m = c.middle();
        let [nominal, all] = self.in_middle(system, tube, m)?;
        let (middle, slope) = (all.value, all.first);
        if c.width() == 0.0 {
            return Some(Jet { value: middle, first: slope, second: all.second, middle, slope });
        }
        let Bounds { series: Series { value, first, second }, by_tolerances } =
            self.over(system, tube, Dimensions::All, c)?;
        let s = c - Interval::from(m);
        let mean = nominal.value + first * s;
        let taylor = nominal.value + nominal.first * s + second * s.square() * Interval::from(0.5);
        let value = value.intersection(mean.intersection(taylor)? + by_tolerances)?;
        Some(Jet { value, first, second, middle, slope })
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
