//! Axes: ranges, grid lines and their labels.

/// An axis of a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The name.
    pub name: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// The way in which values are written.
    pub unit: Unit,
    /// The ends; by default those of the curves.
    pub range: Option<[f64; 2]>,
    /// The distance of grid lines on a linear axis, by default a round number.
    pub step: Option<f64>,
}

/// The spacing of values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Evenly.
    Linear,
    /// By their logarithms. Values must be positive.
    Logarithmic,
}

/// The way in which values are written.
#[derive(Debug, Clone, PartialEq)]
pub enum Unit {
    /// Numbers.
    Number,
    /// Angles in radians, written in degrees.
    Degrees,
    /// Seconds, written with a prefix.
    Seconds,
    /// Names, the first at 0, the next at 1.
    Names(Vec<String>),
}

/// A grid line with its label.
pub(super) struct Tick {
    pub(super) at: f64,
    pub(super) label: String,
}

/// More decades than the first of a pair have a grid line every so many.
const MANY_DECADES: [(f64, i32); 3] = [(16.0, 8), (9.0, 4), (5.0, 2)];

/// A smaller part of an axis than this is no distance of grid lines.
const LEAST_STEP: f64 = 1e-3;

/// The most letters of a number next to an axis.
const MOST_LETTERS: usize = 5;

impl Axis {
    /// A linear axis of numbers.
    #[must_use]
    pub fn linear(name: impl Into<String>) -> Self {
        Self { name: name.into(), scale: Scale::Linear, unit: Unit::Number, range: None, step: None }
    }

    /// A logarithmic axis of numbers.
    #[must_use]
    pub fn logarithmic(name: impl Into<String>) -> Self {
        Self { scale: Scale::Logarithmic, ..Self::linear(name) }
    }

    /// Writes values in this unit.
    #[must_use]
    pub fn unit(self, unit: Unit) -> Self {
        Self { unit, ..self }
    }

    /// Shows this range.
    #[must_use]
    pub fn range(self, range: [f64; 2]) -> Self {
        Self { range: Some(range), ..self }
    }

    /// Draws grid lines at this distance.
    #[must_use]
    pub fn every(self, step: f64) -> Self {
        Self { step: Some(step), ..self }
    }

    /// The distance along the axis, in its own measure.
    pub(super) fn measure(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => value,
            Scale::Logarithmic => value.log10(),
        }
    }

    /// True for a value that has a place on the axis.
    pub(super) fn has(&self, value: f64) -> bool {
        value.is_finite() && (self.scale == Scale::Linear || value > 0.0)
    }

    /// The ends in the measure of the axis, around these values.
    pub(super) fn ends(&self, values: impl Iterator<Item = f64>, is_padded: bool) -> [f64; 2] {
        if let Unit::Names(names) = &self.unit {
            return [names.len() as f64 - 0.5, -0.5];
        }
        let values = values.chain(self.range.into_iter().flatten()).filter(|value| self.has(*value));
        let wide = |[low, high]: [f64; 2], value: f64| [low.min(value), high.max(value)];
        let [low, high] = values.map(|value| self.measure(value)).fold([f64::INFINITY, f64::NEG_INFINITY], wide);
        if low > high {
            return [0.0, 1.0];
        }
        match self.scale {
            Scale::Logarithmic => [low.floor(), high.ceil().max(low.floor() + 1.0)],
            Scale::Linear if low == high => [low - 0.5, high + 0.5],
            Scale::Linear if is_padded => {
                // A rounding error beyond a grid line does not extend the range.
                let step = self.step([low, high]);
                [(low / step + 1e-6).floor() * step, (high / step - 1e-6).ceil() * step]
            }
            Scale::Linear => [low, high],
        }
    }

    /// The distance of grid lines.
    fn step(&self, [low, high]: [f64; 2]) -> f64 {
        if let Some(step) = self.step.filter(|step| *step > (high - low) * LEAST_STEP) {
            return step;
        }
        if self.unit == Unit::Degrees {
            let steps = [1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0, 360.0, 720.0];
            let span = (high - low).to_degrees();
            if let Some(step) = steps.into_iter().find(|step| (5.0..).contains(&span) && span / step <= 6.0) {
                return step.to_radians();
            }
            return nice(span / 5.0).to_radians();
        }
        nice((high - low) / 5.0)
    }

    /// The grid lines between these ends, in the measure of the axis.
    pub(super) fn ticks(&self, ends: [f64; 2]) -> Vec<Tick> {
        let [low, high] = ends;
        if let Unit::Names(names) = &self.unit {
            return names.iter().enumerate().map(|(at, name)| Tick { at: at as f64, label: name.clone() }).collect();
        }
        if self.scale == Scale::Logarithmic {
            let every = MANY_DECADES.into_iter().find(|(many, _)| high - low > *many).map_or(1, |(_, every)| every);
            let decades = (low as i32..=high as i32).filter(|decade| decade % every == 0);
            return decades.map(|decade| Tick { at: f64::from(decade), label: self.decade(decade) }).collect();
        }
        let step = self.step(ends);
        let [first, last] = [(low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64];
        let at = |count: i64| count as f64 * step;
        let ticks = (first..=last).map(|count| Tick { at: at(count), label: self.label(at(count), step) });
        let ticks: Vec<Tick> = ticks.collect();
        let is_wide = |tick: &Tick| tick.label.trim_start_matches('−').chars().count() > MOST_LETTERS;
        match self.unit {
            Unit::Number if ticks.iter().any(is_wide) => by_power(ticks, step),
            _ => ticks,
        }
    }

    /// The text of a number, with the digits of the step.
    fn label(&self, at: f64, step: f64) -> String {
        let (at, step, unit) = match self.unit {
            Unit::Degrees => (at.to_degrees(), step.to_degrees(), "°"),
            _ => (at, step, ""),
        };
        let digits = (-(step * (1.0 + 1e-9)).log10().floor()).clamp(0.0, 9.0) as usize;
        format!("{at:.digits$}{unit}").replace('-', "−")
    }

    /// The text of a power of ten.
    fn decade(&self, decade: i32) -> String {
        const PREFIXES: [&str; 5] = ["ps", "ns", "µs", "ms", "s"];
        let place = (decade + 12).div_euclid(3);
        match usize::try_from(place).ok().and_then(|place| PREFIXES.get(place)).filter(|_| self.unit == Unit::Seconds) {
            Some(prefix) => format!("{} {prefix}", 10_i32.pow((decade + 12).rem_euclid(3).unsigned_abs())),
            None => format!("1e{decade}").replace('-', "−"),
        }
    }
}

/// Labels with one power of ten: 0, 1e6, 2e6.
fn by_power(ticks: Vec<Tick>, step: f64) -> Vec<Tick> {
    let largest = ticks.iter().fold(0.0_f64, |most, tick| most.max(tick.at.abs()));
    let power = (largest * (1.0 + 1e-9)).log10().floor();
    let unit = 10_f64.powf(power);
    let digits = (-(step / unit * (1.0 + 1e-9)).log10().floor()).clamp(0.0, 9.0) as usize;
    let label = |at: f64| match at == 0.0 {
        true => "0".to_owned(),
        false => format!("{:.digits$}e{power}", at / unit).replace('-', "−"),
    };
    ticks.into_iter().map(|Tick { at, .. }| Tick { at, label: label(at) }).collect()
}

/// The first of 1, 2, 5 times a power of ten that is not smaller.
pub(super) fn nice(rough: f64) -> f64 {
    let power = 10_f64.powf(rough.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
    steps.into_iter().find(|step| *step >= rough).unwrap_or(steps[3])
}

#[cfg(test)]
mod tests {
    use super::{Axis, Unit};

    fn labels(axis: &Axis, values: [f64; 2]) -> Vec<String> {
        let ends = axis.ends(values.into_iter(), true);
        axis.ticks(ends).into_iter().map(|tick| tick.label).collect()
    }

    #[test]
    fn grid_lines_of_each_unit() {
        assert_eq!(labels(&Axis::linear(""), [-0.19, 0.39]), ["−0.2", "0.0", "0.2", "0.4"]);
        let turn = [0.0, std::f64::consts::TAU];
        assert_eq!(labels(&Axis::linear("").unit(Unit::Degrees), turn), ["0°", "90°", "180°", "270°", "360°"]);
        assert_eq!(labels(&Axis::logarithmic(""), [2e-9, 3e-8]), ["1e−9", "1e−8", "1e−7"]);
        let seconds = Axis::logarithmic("").unit(Unit::Seconds);
        assert_eq!(labels(&seconds, [2e-8, 3e-6]), ["10 ns", "100 ns", "1 µs", "10 µs"]);
        let names = Axis::linear("").unit(Unit::Names(vec!["a".to_owned(), "b".to_owned()]));
        assert_eq!(labels(&names, [0.0, 1.0]), ["a", "b"]);
    }

    #[test]
    fn wide_numbers_have_a_power_of_ten() {
        assert_eq!(labels(&Axis::linear(""), [0.0, 3.6e6]), ["0", "1e6", "2e6", "3e6", "4e6"]);
        assert_eq!(labels(&Axis::linear(""), [-1.2e6, 1.2e6]), ["−1e6", "0", "1e6"]);
        assert_eq!(labels(&Axis::linear(""), [0.0, 1.2e5]), ["0", "0.5e5", "1.0e5", "1.5e5"]);
        assert_eq!(labels(&Axis::linear(""), [0.0, 3e-7]), ["0", "1e−7", "2e−7", "3e−7"]);
        assert_eq!(labels(&Axis::linear(""), [0.0, 8e4]), ["0", "20000", "40000", "60000", "80000"]);
    }

    /// A number that is not positive has no place on a logarithmic axis, and one that is not finite on none.
    #[test]
    fn numbers_without_a_place() {
        assert_eq!(Axis::logarithmic("").ends([0.0, -1.0, f64::NAN, 5.0, 50.0].into_iter(), true), [0.0, 2.0]);
        assert_eq!(Axis::linear("").ends([f64::INFINITY, f64::NAN].into_iter(), true), [0.0, 1.0]);
    }
}
