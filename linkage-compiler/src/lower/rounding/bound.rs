//! The bound of a function: that of each result, in the names of the mechanism.

use super::Roundings;
use super::angle::{AngleId, Angles};
use super::count::{Amplifier, Count};
use super::follow::Following;
use super::monomial::{Factor, Monomial};
use super::tracked::Tracked;
use crate::graph::{Graph, SymbolId};
use crate::lower::schedule::{Line, Schedule};

/// The largest error that each rounded result of a function can have.
#[derive(Debug, Clone)]
pub struct Bound {
    pub(super) results: Vec<Of>,
}

/// The error of a result x is at most (relative |x| + scattered size) 2^-53.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Of {
    /// The place among the results.
    pub(super) index: usize,
    pub(super) name: String,
    pub(super) relative: Law,
    pub(super) scattered: Law,
    pub(super) size: Vec<Product>,
}

/// A number, and multiples of quantities of angles.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Law {
    pub(super) constant: f64,
    pub(super) amplified: Vec<(Amplifier, Angle, f64)>,
}

/// Coordinates with their factors.
pub(super) type Angle = Vec<(String, f64)>;

/// A product of magnitudes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Product {
    pub(super) coefficient: f64,
    pub(super) factors: Vec<(Base, i32)>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Base {
    Named(String),
    Sine(Angle),
    Cosine(Angle),
}

/// The names of the symbols.
struct Names<'a> {
    graph: &'a Graph,
    angles: &'a Angles,
}

impl Names<'_> {
    fn symbol(&self, symbol: SymbolId) -> String {
        self.graph.symbol_name(symbol).to_owned()
    }

    fn angle(&self, angle: AngleId) -> Angle {
        self.angles.terms(angle).iter().map(|(symbol, factor)| (self.symbol(*symbol), *factor)).collect()
    }

    fn law(&self, count: &Count) -> Law {
        let amplified = count.amplified.iter().map(|(kind, angle, factor)| (*kind, self.angle(*angle), *factor));
        Law { constant: count.constant, amplified: amplified.collect() }
    }

    fn product(&self, of: &Monomial) -> Product {
        let base = |factor: Factor| match factor {
            Factor::Symbol(symbol) => Base::Named(self.symbol(symbol)),
            Factor::Sine(angle) => Base::Sine(self.angle(angle)),
            Factor::Cosine(angle) => Base::Cosine(self.angle(angle)),
        };
        let factors = of.factors.iter().map(|(factor, exponent)| (base(*factor), *exponent)).collect();
        Product { coefficient: of.coefficient, factors }
    }

    fn of(&self, index: usize, name: String, tracked: &Tracked) -> Option<Of> {
        let size = tracked.size.simplified()?.0.iter().map(|one| self.product(one)).collect();
        let [relative, scattered] = [&tracked.relative, &tracked.scattered].map(|count| self.law(count));
        Some(Of { index, name, relative, scattered, size })
    }
}

impl Roundings {
    /// The bound of a kernel whose results have these names; `None` if the error of one of them is unknown.
    pub(in crate::lower) fn bound(&mut self, graph: &Graph, schedule: &Schedule, names: &[String]) -> Option<Bound> {
        let is_iterated = |line: &Line| matches!(line, Line::Newton { .. } | Line::Modes { .. } | Line::Chord { .. });
        if schedule.lines.iter().any(is_iterated) {
            return None;
        }
        let mut following = Following::new(graph, schedule, self);
        let tracked: Vec<Tracked> =
            schedule.results.iter().map(|result| following.signed(*result)).collect::<Option<_>>()?;
        let texts = Names { graph, angles: &self.angles };
        let rounded = tracked.iter().zip(names).enumerate();
        let rounded = rounded.filter(|(_, (of, _))| !of.relative.is_zero() || !of.scattered.is_zero());
        let results =
            rounded.map(|(index, (of, name))| texts.of(index, name.clone(), of)).collect::<Option<Vec<_>>>()?;
        (!results.is_empty()).then_some(Bound { results })
    }

    /// Keeps the errors of these results, which are fields of a pose.
    pub(in crate::lower) fn keep_pose(&mut self, graph: &Graph, schedule: &Schedule, fields: &[(usize, SymbolId)]) {
        for &(index, symbol) in fields {
            let mut following = Following::new(graph, schedule, self);
            let tracked = schedule.results.get(index).and_then(|result| following.signed(*result));
            if tracked.is_some() && !self.knows(symbol) {
                self.pose.insert(symbol, tracked);
            }
        }
    }
}

impl Bound {
    /// The places of the results that are rounded.
    pub fn indices(&self) -> impl Iterator<Item = usize> {
        self.results.iter().map(|of| of.index)
    }

    /// The bound of the error of a result with this value, where names have these values; `None` for a result that is
    /// exact.
    #[must_use]
    pub fn at(&self, index: usize, result: f64, value: &dyn Fn(&str) -> f64) -> Option<f64> {
        let of = self.results.iter().find(|of| of.index == index)?;
        let size: f64 = of.size.iter().map(|product| product.at(value)).sum();
        let scattered = of.scattered.at(value) * size;
        // 2^-53
        Some((of.relative.at(value) * result.abs() + scattered) * f64::EPSILON / 2.0)
    }
}

impl Law {
    fn at(&self, value: &dyn Fn(&str) -> f64) -> f64 {
        let amplified = self.amplified.iter().map(|(kind, angle, factor)| {
            let x = sum(angle, value);
            let amplifier = match kind {
                Amplifier::Cotangent => x / libm::tan(x),
                Amplifier::Tangent => x * libm::tan(x),
                Amplifier::Size => x,
                Amplifier::Cosecant => libm::sin(x).recip(),
                Amplifier::Secant => libm::cos(x).recip(),
            };
            factor * amplifier.abs()
        });
        self.constant + amplified.sum::<f64>()
    }
}

impl Product {
    fn at(&self, value: &dyn Fn(&str) -> f64) -> f64 {
        let factors = self.factors.iter().map(|(base, exponent)| {
            let base = match base {
                Base::Named(name) => value(name),
                Base::Sine(angle) => libm::sin(sum(angle, value)),
                Base::Cosine(angle) => libm::cos(sum(angle, value)),
            };
            base.abs().powi(*exponent)
        });
        self.coefficient * factors.product::<f64>()
    }
}

fn sum(angle: &Angle, value: &dyn Fn(&str) -> f64) -> f64 {
    angle.iter().map(|(name, factor)| factor * value(name)).sum()
}
