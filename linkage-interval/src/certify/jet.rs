//! Values and derivatives of quantities over a part of a tube.

use linkage_runtime::{Certifiable, Number};

use super::on_turns::OnTurns;
use super::system::{Dimensions, System};
use super::tube::{Part, Tube};
use crate::Interval;
use crate::series::Series;

/// A function of the position along a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Measure {
    /// A coordinate of a point or an output, by its number.
    Quantity(usize),
    /// Such a quantity without the jumps of its formula, which are multiples of one. A value is known up to these, until it is
    /// [turned](Measure::turned).
    OnTurns {
        /// The number of the quantity.
        place: usize,
        /// The jump.
        jump: Interval,
    },
    /// The derivative of an unknown by the parameter of the tube, by the number of the unknown.
    Rate(usize),
    /// The derivative of a quantity by the parameter of the tube, which does not jump.
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
pub(super) struct Bounds {
    pub(super) series: Series<Interval>,
    by_tolerances: Interval,
}

impl Measure {
    /// The series of a quantity that is measured.
    fn of(self, quantity: OnTurns) -> Series<Interval> {
        if let Self::Quantity(_) = self { quantity.own } else { quantity.series() }
    }

    /// The value with the one number of jumps by which it has numbers in common with `within`; `None` if there are others.
    pub(super) fn turned(self, value: Interval, within: Interval) -> Option<Interval> {
        let Self::OnTurns { jump, .. } = self else { return Some(value) };
        let nearest = ((within.middle() - value.middle()) / jump.middle()).round();
        let [below, found, above] = [nearest - 1.0, nearest, nearest + 1.0].map(|jumps| value + jump * jumps.into());
        let is_one = below.intersection(within).is_none() && above.intersection(within).is_none();
        if is_one && found.intersection(within).is_some() { Some(found) } else { None }
    }

    /// The jet over a part of a tube; `None` if the rates have no bounds there.
    pub(super) fn over<M: Certifiable>(
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
            Self::Quantity(place) | Self::OnTurns { place, .. } | Self::QuantityRate(place) => {
                let parts = part.q.iter().zip(&rates).zip(&accelerations);
                let q: Vec<_> = parts.map(|((&value, &first), &second)| Series { value, first, second }).collect();
                let quantity = self.of(*system.quantities(dimensions, &q).get(place)?);
                if let Self::QuantityRate(_) = self {
                    Series { value: quantity.first, first: quantity.second, second: Interval::ENTIRE }
                } else {
                    by_tolerances = self.spread(system, &part, place)?;
                    quantity
                }
            }
        };
        Some(Bounds { series, by_tolerances })
    }

    /// The measure in the middle of an interval for the nominal dimensions and for all. A rate has no derivatives by the
    /// parameters here, so that its nominal values are those for all.
    pub(super) fn in_middle<M: Certifiable>(
        self,
        system: &System<M>,
        tube: &Tube,
        c: f64,
        within: Interval,
    ) -> Option<[Series<Interval>; 2]> {
        let turned = |series: Series<Interval>| Some(Series { value: self.turned(series.value, within)?, ..series });
        let Bounds { series, by_tolerances } = self.over(system, tube, Dimensions::All, c.into())?;
        let all = turned(series)?;
        if !system.has_tolerances() || matches!(self, Self::Rate(_) | Self::QuantityRate(_)) {
            return Some([all; 2]);
        }
        let nominal = turned(self.over(system, tube, Dimensions::Nominal, c.into())?.series)?;
        let value = all.value.intersection(nominal.value + by_tolerances)?;
        Some([nominal, Series { value, ..all }])
    }

    /// The jet over an interval c with middle m, its values by the mean-value form f(m) + f'(C) (C - m), by Taylor's
    /// `f(m) + f'(m) (C - m) + f''(C) (C - m)^2 / 2`, and by the mean-value form in the parameters. All values are `within` an
    /// interval that is known.
    pub(super) fn jet<M: Certifiable>(
        self,
        system: &System<M>,
        tube: &Tube,
        c: Interval,
        within: Interval,
    ) -> Option<Jet> {
        let m = c.middle();
        let [nominal, all] = self.in_middle(system, tube, m, within)?;
        let (middle, slope) = (all.value, all.first);
        if c.width() == 0.0 {
            return Some(Jet { value: middle, first: slope, second: all.second, middle, slope });
        }
        let Bounds { series: Series { value, first, second }, by_tolerances } =
            self.over(system, tube, Dimensions::All, c)?;
        let s = c - Interval::from(m);
        let mean = nominal.value + first * s;
        let taylor = nominal.value + nominal.first * s + second * s.square() * Interval::from(0.5);
        let value = self.turned(value, within).unwrap_or(within).intersection(within)?;
        let value = value.intersection(mean.intersection(taylor)? + by_tolerances)?;
        Some(Jet { value, first, second, middle, slope })
    }

    /// The sum over the tolerances of the derivative of a quantity by the parameter times its difference from the middle,
    /// where the unknowns follow by du/dp = -J^-1 Psi_p.
    fn spread<M: Certifiable>(self, system: &System<M>, part: &Part, place: usize) -> Option<Interval> {
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
        let terms = quantities
            .iter()
            .zip(&by_parameters)
            .map(|(by, (_, difference))| Some(self.of(*by.get(place)?).first * *difference));
        terms.reduce(|sum, term| Some(sum? + term?)).unwrap_or(Some(Interval::zero()))
    }
}
