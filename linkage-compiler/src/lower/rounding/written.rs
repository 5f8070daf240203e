//! A bound as a sentence for the doc comment.

use super::bound::{Angle, Base, Bound, Law, Of, Product};
use super::count::Amplifier;

/// The most different laws in a sentence; the largest of all stands for more.
const MOST_LAWS: usize = 3;

/// The longest sentence, in bytes, that a reader may be expected to read.
const LONGEST: usize = 400;

impl Bound {
    /// The bound in one sentence; `None` if it is too long to be of use.
    #[must_use]
    pub fn sentence(&self) -> Option<String> {
        let mut letters = Letters::new(&self.results);
        let laws = match grouped(&self.results).as_slice() {
            [(one, _)] => letters.law(one),
            several if several.len() <= MOST_LAWS => {
                let texts = several.iter().map(|(of, names)| format!("{} for {}", letters.law(of), names.join(", ")));
                texts.collect::<Vec<_>>().join("; ")
            }
            _ => letters.law(&self.worst()?),
        };
        let from = if self.is_on_pose { "at a pose of `pose_at`" } else { "from exact arguments" };
        let legend = letters.legend();
        let text = format!(
            "Rounding in `f64` {from}, for angles to 1e5 without overflow and underflow: {laws}{legend}."
        );
        (text.len() <= LONGEST).then_some(text)
    }

    /// A law for all results.
    fn worst(&self) -> Option<Of> {
        let (first, rest) = self.results.split_first()?;
        let worst = rest.iter().fold(first.clone(), |worst, of| Of {
            relative: worst.relative.most(&of.relative),
            scattered: worst.scattered.most(&of.scattered),
            size: most(worst.size, &of.size),
            ..worst
        });
        Some(worst)
    }
}

/// Different laws, each with the names of its results.
fn grouped(results: &[Of]) -> Vec<(&Of, Vec<&str>)> {
    let mut groups: Vec<(&Of, Vec<&str>)> = Vec::new();
    for of in results {
        let is_alike =
            |(other, _): &&mut (&Of, Vec<&str>)| (&other.relative, &other.scattered, &other.size) == (&of.relative, &of.scattered, &of.size);
        match groups.iter_mut().find(is_alike) {
            Some((_, names)) => names.push(&of.name),
            None => groups.push((of, vec![&of.name])),
        }
    }
    groups
}

/// The products of two sums, those of both with the larger coefficient.
fn most(mut one: Vec<Product>, other: &[Product]) -> Vec<Product> {
    for product in other {
        match one.iter_mut().find(|same| same.factors == product.factors) {
            Some(same) => same.coefficient = same.coefficient.max(product.coefficient),
            None => one.push(product.clone()),
        }
    }
    one
}

impl Law {
    fn most(mut self, other: &Self) -> Self {
        self.constant = self.constant.max(other.constant);
        for (kind, angle, factor) in &other.amplified {
            match self.amplified.iter_mut().find(|(same, of, _)| same == kind && of == angle) {
                Some((.., most)) => *most = most.max(*factor),
                None => self.amplified.push((*kind, angle.clone(), *factor)),
            }
        }
        self
    }
}

/// Letters for sums of angles.
struct Letters {
    free: Vec<char>,
    given: Vec<(Angle, char)>,
}

impl Letters {
    fn new(results: &[Of]) -> Self {
        let names = |of: &Of| {
            let of_angles = of.relative.amplified.iter().chain(&of.scattered.amplified).flat_map(|(_, angle, _)| angle);
            let of_factors = of.size.iter().flat_map(|product| &product.factors).filter_map(|(base, _)| match base {
                Base::Named(name) => Some(name),
                Base::Sine(_) | Base::Cosine(_) => None,
            });
            of_angles.map(|(name, _)| name).chain(of_factors).cloned().collect::<Vec<_>>()
        };
        let taken: Vec<String> = results.iter().flat_map(names).collect();
        // In alphabetical order from the end; `x` is the result.
        let free = ('d'..='w').rev().filter(|letter| taken.iter().all(|name| *name != letter.to_string())).collect();
        Self { free, given: Vec::new() }
    }

    /// A stored angle by its name, a sum of angles by a letter.
    fn angle(&mut self, angle: &Angle) -> String {
        if let [(name, 1.0)] = angle.as_slice() {
            return name.clone();
        }
        if let Some((_, letter)) = self.given.iter().find(|(other, _)| other == angle) {
            return letter.to_string();
        }
        let Some(letter) = self.free.pop() else { return written(angle) };
        self.given.push((angle.clone(), letter));
        letter.to_string()
    }

    fn legend(&self) -> String {
        self.given.iter().map(|(angle, letter)| format!(", {letter} = {}", written(angle))).collect()
    }

    /// `relative error <= ...`, or the error of a result x.
    fn law(&mut self, of: &Of) -> String {
        if of.size.is_empty() {
            return format!("relative error <= `{} 2^-53`", self.count(&of.relative));
        }
        // The last rounding of a sum is within its size.
        if of.relative.amplified.is_empty() && of.relative.constant <= 1.0 {
            let all = Law { constant: of.scattered.constant + of.relative.constant, ..of.scattered.clone() };
            let (count, size) = (self.count(&all), self.size(&of.size));
            return format!("error <= `{count} {size} 2^-53`");
        }
        let [relative, scattered] = [&of.relative, &of.scattered].map(|law| self.count(law));
        let size = self.size(&of.size);
        format!("error of x <= `({relative} |x| + {scattered} {size}) 2^-53`")
    }

    /// `(7.8 + |d cot d| + 4.6/|sin e|)`, without brackets if it is a number.
    fn count(&mut self, law: &Law) -> String {
        let mut text = up(law.constant);
        for (kind, angle, factor) in &law.amplified {
            let x = self.angle(angle);
            let times = if *factor == 1.0 { String::new() } else { format!("{} ", up(*factor)) };
            text += &match kind {
                Amplifier::Cotangent => format!(" + {times}|{x} cot {x}|"),
                Amplifier::Tangent => format!(" + {times}|{x} tan {x}|"),
                Amplifier::Size => format!(" + {times}|{x}|"),
                Amplifier::Cosecant => format!(" + {}/|sin {x}|", up(*factor)),
                Amplifier::Secant => format!(" + {}/|cos {x}|", up(*factor)),
            };
        }
        if law.amplified.is_empty() { text } else { format!("({text})") }
    }

    /// `(|a b| + |c|)/|d sin e|`
    fn size(&mut self, size: &[Product]) -> String {
        let below = common_below(size);
        let terms: Vec<String> = size.iter().map(|product| self.product(product, &below)).collect();
        let above = if terms.len() == 1 { terms.concat() } else { format!("({})", terms.join(" + ")) };
        if below.is_empty() {
            return above;
        }
        let inverse: Vec<(Base, i32)> = below.into_iter().map(|(base, exponent)| (base, -exponent)).collect();
        format!("{above}/{}", self.factors(&inverse))
    }

    /// A product without what is common below the fraction.
    fn product(&mut self, product: &Product, common: &[(Base, i32)]) -> String {
        let rest = |(base, exponent): &(Base, i32)| {
            let shared = common.iter().find(|(other, _)| other == base).map_or(0, |(_, exponent)| *exponent);
            (exponent != &shared).then(|| (base.clone(), exponent - shared))
        };
        let factors: Vec<(Base, i32)> = product.factors.iter().filter_map(rest).collect();
        let (above, below): (Vec<_>, Vec<_>) = factors.into_iter().partition(|(_, exponent)| *exponent > 0);
        let coefficient = (product.coefficient != 1.0 || above.is_empty()).then(|| up(product.coefficient));
        let mut text: Vec<String> = coefficient.into_iter().collect();
        if !above.is_empty() {
            text.push(self.factors(&above));
        }
        let mut text = text.join(" ");
        if !below.is_empty() {
            let inverse: Vec<(Base, i32)> = below.into_iter().map(|(base, exponent)| (base, -exponent)).collect();
            text = format!("{text}/{}", self.factors(&inverse));
        }
        text
    }

    /// `|a b| c^2`: factors with odd powers between bars.
    fn factors(&mut self, factors: &[(Base, i32)]) -> String {
        let (even, odd): (Vec<_>, Vec<_>) = factors.iter().partition(|(_, exponent)| exponent % 2 == 0);
        let mut text = |all: Vec<&(Base, i32)>| all.into_iter().map(|(base, exponent)| self.power(base, *exponent)).collect::<Vec<_>>().join(" ");
        let (odd, even) = (text(odd), text(even));
        let odd = if odd.is_empty() { odd } else { format!("|{odd}|") };
        [odd, even].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" ")
    }

    fn power(&mut self, base: &Base, exponent: i32) -> String {
        let base = match base {
            Base::Named(name) => name.clone(),
            Base::Sine(angle) => format!("sin {}", self.angle(angle)),
            Base::Cosine(angle) => format!("cos {}", self.angle(angle)),
        };
        match exponent {
            1 => base,
            _ if base.contains(' ') => format!("({base})^{exponent}"),
            _ => format!("{base}^{exponent}"),
        }
    }
}

/// The divisors that all products have.
fn common_below(size: &[Product]) -> Vec<(Base, i32)> {
    let Some((first, rest)) = size.split_first() else { return Vec::new() };
    let below = first.factors.iter().filter(|(_, exponent)| *exponent < 0);
    let shared = below.filter_map(|(base, exponent)| {
        let of = |product: &Product| product.factors.iter().find(|(other, _)| other == base).map_or(0, |(_, of)| *of);
        let largest = rest.iter().map(of).fold(*exponent, i32::max);
        (largest < 0).then(|| (base.clone(), largest))
    });
    shared.collect()
}

/// A positive number, rounded up to tenths.
fn up(number: f64) -> String {
    let tenths = (number * 10.0 - 1e-6).ceil() / 10.0;
    if number < 10.0 && number.fract() != 0.0 && (number * 10.0).fract().abs() > 1e-6 && number < 1.0 {
        return format!("{number}");
    }
    format!("{tenths}")
}

fn written(angle: &Angle) -> String {
    let mut text = String::new();
    for (name, factor) in angle {
        let sign = match (text.is_empty(), *factor < 0.0) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => " - ",
            (false, false) => " + ",
        };
        let magnitude = factor.abs();
        let number = if magnitude == 1.0 { String::new() } else { format!("{magnitude} ") };
        text += &format!("{sign}{number}{name}");
    }
    text
}
