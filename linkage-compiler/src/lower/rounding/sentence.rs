//! A bound as a sentence for the doc comment.

use super::bound::{Angle, Base, Bound, Law, Of, Product};
use super::count::Amplifier;
use crate::lower::rounding::DIRECTION;

/// The most different laws in a sentence; the largest of all stands for more.
const MOST_LAWS: usize = 3;

/// The most results with one law for different angles.
const MOST_ALIKE: usize = 6;

/// The longest sentence, in bytes, that a reader may be expected to read.
const LONGEST: usize = 400;

/// The most angles of a readable law.
const MOST_ANGLES: usize = 4;

impl Bound {
    /// The bound in one sentence; `None` if it is too long to be of use.
    #[must_use]
    pub fn sentence(&self) -> Option<String> {
        // The directions of a pose have the error of a sine, which needs no mention where determinants have theirs.
        let (mut directions, mut results): (Vec<Of>, Vec<Of>) =
            self.results.iter().cloned().partition(|of| of.name == DIRECTION);
        if results.is_empty() {
            std::mem::swap(&mut directions, &mut results);
        }
        let groups = grouped(&results);
        let has_names = results.iter().all(|of| !of.name.is_empty());
        let mut letters = Letters::new(&results);
        let laws = match groups.as_slice() {
            [(one, _)] => letters.law(one),
            several if has_names => match letters.alike(several) {
                Some(law) => law,
                None if several.len() <= MOST_LAWS => letters.several(several),
                None => letters.law(&worst(&results)?),
            },
            _ => letters.law(&worst(&results)?),
        };
        let legend = letters.legend();
        let text = format!("Rounding (`f64`, angles to 1e5, no overflow or underflow): {laws}{legend}.");
        (text.len() <= LONGEST).then_some(text)
    }
}

/// A law for all results.
fn worst(results: &[Of]) -> Option<Of> {
    let is_relative = results.iter().all(|of| of.scattered.is_zero());
    let absolute = |of: &Of| match is_relative {
        true => of.clone(),
        false => of.absolute(),
    };
    let (first, rest) = results.split_first()?;
    let worst = rest.iter().map(absolute).fold(absolute(first), |worst, of| Of {
        relative: worst.relative.most(&of.relative),
        scattered: worst.scattered.most(&of.scattered),
        size: most(worst.size, &of.size),
        ..worst
    });
    let is_readable = |law: &Law| law.amplified.len() <= MOST_ANGLES;
    (is_readable(&worst.relative) && is_readable(&worst.scattered)).then_some(worst)
}

impl Of {
    /// The bound by the size only, which is at least |x|, where the relative one is a number.
    fn absolute(&self) -> Self {
        if !self.relative.amplified.is_empty() {
            return self.clone();
        }
        let constant = self.scattered.constant + self.relative.constant;
        let scattered = Law { constant, ..self.scattered.clone() };
        Self { relative: Law::default(), scattered, ..self.clone() }
    }
}

/// Different laws, each with the names of its results.
fn grouped(results: &[Of]) -> Vec<(&Of, Vec<&str>)> {
    let mut groups: Vec<(&Of, Vec<&str>)> = Vec::new();
    for of in results {
        let is_alike = |(other, _): &&mut (&Of, Vec<&str>)| {
            (&other.relative, &other.scattered, &other.size) == (&of.relative, &of.scattered, &of.size)
        };
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
    fn is_zero(&self) -> bool {
        self.constant == 0.0 && self.amplified.is_empty()
    }

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

/// Names as code.
fn listed(names: &[&str]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// Letters for sums of angles.
struct Letters {
    free: Vec<char>,
    given: Vec<(Angle, char)>,
    /// Letters for the angles of several results, each with its meaning.
    varying: Vec<(char, String)>,
}

/// The letters of a sum of sizes that several laws have, and of its divisors.
const SUM: &str = "m";
const DIVISOR: &str = "s";

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
        // Those after d; `m` is a sum, `x` is the result.
        let free = ('d'..'m').rev().filter(|&letter| !taken.iter().any(|name| name.chars().eq([letter]))).collect();
        Self { free, given: Vec::new(), varying: Vec::new() }
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
        let angles = self.given.iter().map(|(angle, letter)| format!(", {letter} = `{}`", written(angle)));
        let varying = self.varying.iter().map(|(letter, meaning)| format!(", {letter} = {meaning}"));
        angles.chain(varying).collect()
    }

    /// One law for results that differ only in angles.
    fn alike(&mut self, groups: &[(&Of, Vec<&str>)]) -> Option<String> {
        let (first, _) = groups.first()?;
        let shape = |law: &Law| law.amplified.iter().map(|(kind, _, factor)| (*kind, *factor)).collect::<Vec<_>>();
        let is_alike = |(of, _): &(&Of, Vec<&str>)| {
            of.scattered.is_zero()
                && of.relative.constant == first.relative.constant
                && shape(&of.relative) == shape(&first.relative)
        };
        if groups.len() > MOST_ALIKE || !groups.iter().all(is_alike) {
            return None;
        }
        let mut law = first.relative.clone();
        for (index, (_, angle, _)) in law.amplified.iter_mut().enumerate() {
            let of = groups.iter().map(|(of, names)| (&of.relative.amplified[index].1, names));
            if of.clone().all(|(other, _)| other == angle) {
                continue;
            }
            let letter = self.free.pop()?;
            let meanings = of.map(|(angle, names)| format!("`{}` for {}", written(angle), listed(names)));
            self.varying.push((letter, meanings.collect::<Vec<_>>().join(", ")));
            *angle = vec![(letter.to_string(), 1.0)];
        }
        Some(self.law(&Of { relative: law, ..(*first).clone() }))
    }

    /// Several laws. If they differ only in the divisor of one sum of sizes, both get a letter.
    fn several(&mut self, groups: &[(&Of, Vec<&str>)]) -> String {
        let sizes: Vec<(String, String)> = groups.iter().map(|(of, _)| self.size(&of.size)).collect();
        let is_alike = |(of, _): &(&Of, Vec<&str>)| {
            !of.scattered.is_zero() && (&of.relative, &of.scattered) == (&groups[0].0.relative, &groups[0].0.scattered)
        };
        if groups.iter().all(is_alike) && sizes.iter().all(|(sum, divisor)| *sum == sizes[0].0 && !divisor.is_empty()) {
            let divisors = sizes.iter().zip(groups);
            let divisors =
                divisors.map(|((_, divisor), (_, names))| format!("`{}` for {}", &divisor[1..], listed(names)));
            let divisors = divisors.collect::<Vec<_>>().join(", ");
            let law = self.law_of(groups[0].0, &format!("{SUM}/{DIVISOR}"));
            return format!("{law}, {SUM} = `{}`, {DIVISOR} = {divisors}", sizes[0].0);
        }
        let texts = groups.iter().map(|(of, names)| format!("{} for {}", self.law(of), listed(names)));
        texts.collect::<Vec<_>>().join("; ")
    }

    fn law(&mut self, of: &Of) -> String {
        let (sum, divisor) = self.size(&of.size);
        self.law_of(of, &format!("{sum}{divisor}"))
    }

    /// `relative error <= ...`, or the error of a result x.
    fn law_of(&mut self, of: &Of, size: &str) -> String {
        if of.scattered.is_zero() {
            return format!("relative error <= `{}`", self.units(&of.relative, ""));
        }
        // The last rounding of a sum is within its size.
        let of = if of.relative.constant <= 1.0 { &of.absolute() } else { of };
        if of.relative.is_zero() {
            return format!("error <= `{}`", self.units(&of.scattered, &format!(" {size}")));
        }
        let [relative, scattered] = [&of.relative, &of.scattered].map(|law| self.count(law));
        format!("error of x <= `({relative} |x| + {scattered} {size}) 2^-53`")
    }

    /// A law times a size in units of 2^-53.
    fn units(&mut self, law: &Law, size: &str) -> String {
        match self.count(law) {
            one if one == "1" && size.is_empty() => "2^-53".to_owned(),
            one if one == "1" => format!("{} 2^-53", size.trim_start()),
            count => format!("{count}{size} 2^-53"),
        }
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

    /// `(|a b| + |c|)` and `/|d sin e|`.
    fn size(&mut self, size: &[Product]) -> (String, String) {
        let below = common_below(size);
        let terms: Vec<String> = size.iter().map(|product| self.product(product, &below)).collect();
        let above = if terms.len() == 1 { terms.concat() } else { format!("({})", terms.join(" + ")) };
        if below.is_empty() {
            return (above, String::new());
        }
        let inverse: Vec<(Base, i32)> = below.into_iter().map(|(base, exponent)| (base, -exponent)).collect();
        (above, format!("/{}", self.divisor(&inverse)))
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
            text = format!("{text}/{}", self.divisor(&inverse));
        }
        text
    }

    /// `|a b|`, or `(|a b| c^2)`.
    fn divisor(&mut self, factors: &[(Base, i32)]) -> String {
        let text = self.factors(factors);
        let is_one = factors.len() == 1 || factors.iter().all(|(_, exponent)| exponent % 2 != 0);
        if is_one { text } else { format!("({text})") }
    }

    /// `|a b| c^2`: factors with odd powers between bars.
    fn factors(&mut self, factors: &[(Base, i32)]) -> String {
        let (even, odd): (Vec<_>, Vec<_>) = factors.iter().partition(|(_, exponent)| exponent % 2 == 0);
        let mut text = |all: Vec<&(Base, i32)>| {
            all.into_iter().map(|(base, exponent)| self.power(base, *exponent)).collect::<Vec<_>>().join(" ")
        };
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

/// A positive number, rounded up to tenths, or to two digits if it is small.
fn up(number: f64) -> String {
    if !number.is_normal() {
        return number.to_string();
    }
    let digit = libm::pow(10.0, libm::log10(number).floor() - 1.0).min(0.1);
    // A number with fewer digits may be a bit above itself in binary.
    let rounded = (number / digit - 1e-9).ceil() * digit;
    let digits = (-libm::log10(digit)).round().max(1.0) as usize;
    let text = format!("{rounded:.digits$}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
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
