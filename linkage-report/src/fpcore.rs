//! Emitted formulas as FPCore, the notation of tools that bound or reduce rounding errors (<https://fpbench.org>).

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::RangeInclusive;

use linkage_runtime::__shared::{CANCELLATION, COINCIDENT_ULPS, ZERO_ULPS, smallest_product};
use linkage_runtime::derivation::notation::Name;
use linkage_runtime::derivation::{Equation, Formula, FormulaView, Kernel, KernelCheck, KernelCode};

use crate::Notation;
use crate::notation::literal;

/// One number that an emitted function computes, as a formula of FPCore 2.0. Its [`Display`](fmt::Display) is the text.
///
/// The operations are those of the code, in its order, with the names of the mechanism. The arguments are the
/// parameters, coordinates and rates that the number depends on; see the [manual](https://docs.rs/linkage) for the
/// choice of a branch.
///
/// ```
/// use linkage::{Document, linkage};
///
/// linkage! {
///     mechanism Crank {
///         param r;
///         input phi;
///         point Pin = r@phi;
///         derive fpcore;
///     }
/// }
/// let all = Crank::<f64>::DERIVATION.fpcore();
/// let pin = all.iter().find(|core| core.name() == "Crank::points.pin.x").ok_or("no formula")?;
/// let expected = r#"(FPCore (phi r)
///   :name "Crank::points.pin.x"
///   :precision binary64
///   (let* ([cos_phi (cos phi)])
///     (* r cos_phi)))"#;
/// assert_eq!(pin.to_string(), expected);
/// # Ok::<(), &str>(())
/// ```
#[derive(Debug, Clone)]
pub struct FpCore<'a> {
    name: String,
    /// In the order of the steps.
    arguments: Vec<&'a str>,
    steps: Vec<Equation<'a>>,
    value: Formula<'a>,
    /// The conditions, and the steps that they need.
    checks: Vec<KernelCheck<'a>>,
    steps_of_checks: Vec<Equation<'a>>,
    given: BTreeMap<&'a str, f64>,
    ranges: BTreeMap<&'a str, RangeInclusive<f64>>,
}

impl<'a> FpCore<'a> {
    /// The formulas of functions of a mechanism or scene.
    pub(crate) fn of(owner: &str, kernels: &[Kernel<'a>]) -> Vec<Self> {
        let owner = &ascii(owner);
        kernels.iter().flat_map(|kernel| cores(owner, kernel)).collect()
    }

    /// The type, function and place in its result: `FourBar::velocity.theta3`.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The arguments, without those with a given number.
    pub fn arguments(&self) -> impl Iterator<Item = &str> {
        self.arguments.iter().copied().filter(|name| !self.given.contains_key(name))
    }

    /// Replaces an argument by a number, such as a length by that of a design. Without such an argument it does
    /// nothing.
    #[must_use]
    pub fn with(mut self, argument: &str, number: f64) -> Self {
        if let Some(name) = self.argument(argument) {
            self.given.insert(name, number);
        }
        self
    }

    /// Limits an argument to a range, which some tools ask for. Without such an argument it does nothing.
    #[must_use]
    pub fn within(mut self, argument: &str, range: RangeInclusive<f64>) -> Self {
        if let Some(name) = self.argument(argument) {
            self.ranges.insert(name, range);
        }
        self
    }

    fn argument(&self, name: &str) -> Option<&'a str> {
        self.arguments.iter().copied().find(|argument| *argument == name)
    }

    /// The given numbers and steps as bindings of `let*`, for a body of these formulas.
    fn bindings(&self, steps: &[Equation<'a>], body: &[Formula<'a>]) -> Vec<String> {
        let mut used = BTreeSet::new();
        let formulas = steps.iter().map(|step| step.right).chain(body.iter().copied());
        formulas.for_each(|formula| each_symbol(formula, &mut |_, name| _ = used.insert(name)));
        let given = self.given.iter().filter(|(name, _)| used.contains(*name));
        let given = given.map(|(name, number)| format!("[{name} {}]", literal(*number)));
        let steps = steps.iter().map(|step| format!("[{} {}]", step.left.to_fpcore(), step.right.to_fpcore()));
        given.chain(steps).collect()
    }

    /// The conditions: ranges first.
    fn conditions(&self) -> Vec<String> {
        let ranges = self.ranges.iter().filter(|(name, _)| !self.given.contains_key(*name));
        let ranges =
            ranges.map(|(name, range)| format!("(<= {} {name} {})", literal(*range.start()), literal(*range.end())));
        let mut conditions: Vec<String> = ranges.collect();
        let mut checks: Vec<String> = self.checks.iter().flat_map(conditions_of).collect();
        let of_checks: Vec<Formula<'_>> = self.checks.iter().flat_map(KernelCheck::of).copied().collect();
        let bindings = self.bindings(&self.steps_of_checks, &of_checks);
        if !checks.is_empty() && !bindings.is_empty() {
            let all = joined(checks);
            checks = vec![format!("(let* ({}) {all})", bindings.join(" "))];
        }
        conditions.extend(checks);
        conditions
    }
}

impl fmt::Display for FpCore<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let arguments: Vec<&str> = self.arguments().collect();
        writeln!(f, "(FPCore ({})", arguments.join(" "))?;
        writeln!(f, "  :name \"{}\"", self.name)?;
        writeln!(f, "  :precision binary64")?;
        let conditions = self.conditions();
        if !conditions.is_empty() {
            writeln!(f, "  :pre {}", joined(conditions))?;
        }
        let (bindings, value) = (self.bindings(&self.steps, &[self.value]), self.value.to_fpcore());
        if bindings.is_empty() {
            return write!(f, "  {value})");
        }
        write!(f, "  (let* ({})\n    {value}))", bindings.join("\n         "))
    }
}

/// The name of a type in ASCII, as strings of FPCore are: other letters by their numbers.
fn ascii(name: &str) -> String {
    let ascii = |letter: char| if letter.is_ascii() { letter.into() } else { format!("u{:x}", u32::from(letter)) };
    name.chars().map(ascii).collect()
}

/// All conditions as one.
fn joined(conditions: Vec<String>) -> String {
    match conditions.as_slice() {
        [only] => only.clone(),
        several => format!("(and {})", several.join(" ")),
    }
}

/// The conditions under which the code computes these formulas and no others.
fn conditions_of(check: &KernelCheck<'_>) -> Vec<String> {
    let text = |of: &Formula<'_>| of.to_fpcore();
    match check {
        KernelCheck::Regular(of) => {
            let [determinant, scale] = of.each_ref().map(text);
            vec![format!("(> (fabs {determinant}) (* {} (fabs {scale})))", ulps(ZERO_ULPS))]
        }
        KernelCheck::Nonzero([number]) => vec![format!("(!= {} 0)", text(number))],
        KernelCheck::Positive([length]) => vec![format!("(>= {} 0)", text(length))],
        KernelCheck::Apart(of) => {
            let [radius, scale] = of.each_ref().map(text);
            vec![format!("(> {radius} (* {} {scale}))", ulps(COINCIDENT_ULPS))]
        }
        KernelCheck::Moderate([product]) => {
            let least = smallest_product::<f64>();
            vec![format!("(< {} {} {})", literal(least), text(product), literal(1.0 / least))]
        }
        KernelCheck::Open(of) => {
            let [low, high, reach_squared, distance_squared] = of.each_ref().map(text);
            vec![
                format!("(> {low} (* {CANCELLATION} {reach_squared}))"),
                format!("(> {high} (* {CANCELLATION} {distance_squared}))"),
                format!("(> {distance_squared} (* {} {reach_squared}))", ulps(1.0)),
            ]
        }
    }
}

fn ulps(number: f64) -> String {
    literal(number * f64::EPSILON)
}

/// The formulas of the numbers that a function returns.
fn cores<'a>(owner: &str, kernel: &Kernel<'a>) -> Vec<FpCore<'a>> {
    let KernelCode { steps, checks, results } = kernel.code;
    let defined: BTreeSet<u32> = steps.iter().map(|step| step.left.number()).collect();
    let core = |place: &str, value: Formula<'a>| {
        let of_it = needed(steps, &[value]);
        let mut known: BTreeSet<u32> = of_it.iter().map(|step| step.left.number()).collect();
        let formulas = of_it.iter().map(|step| step.right).chain([value]);
        formulas.for_each(|formula| each_symbol(formula, &mut |number, _| _ = known.insert(number)));
        let is_of_it =
            |check: &&KernelCheck<'a>| check.of().first().is_some_and(|first| known.contains(&first.number()));
        let checks: Vec<KernelCheck<'a>> = checks.iter().filter(is_of_it).copied().collect();
        let of_checks: Vec<Formula<'a>> = checks.iter().flat_map(KernelCheck::of).copied().collect();
        let steps_of_checks = needed(steps, &of_checks);
        let mut arguments = Vec::new();
        let formulas = of_it.iter().chain(&steps_of_checks).map(|step| step.right).chain([value]).chain(of_checks);
        formulas.for_each(|formula| {
            each_symbol(formula, &mut |number, name| {
                if !arguments.contains(&name) && !defined.contains(&number) {
                    arguments.push(name);
                }
            });
        });
        FpCore {
            name: format!("{owner}::{}{place}", kernel.function),
            arguments,
            steps: of_it,
            value,
            checks,
            steps_of_checks,
            given: BTreeMap::new(),
            ranges: BTreeMap::new(),
        }
    };
    results.iter().map(|result| core(result.place, result.value)).collect()
}

/// The steps that formulas need, in order.
fn needed<'a>(steps: &[Equation<'a>], formulas: &[Formula<'a>]) -> Vec<Equation<'a>> {
    let mut needed = BTreeSet::new();
    formulas.iter().for_each(|&formula| each_symbol(formula, &mut |number, _| _ = needed.insert(number)));
    let mut found: Vec<Equation<'a>> = Vec::new();
    for step in steps.iter().rev() {
        if needed.contains(&step.left.number()) {
            each_symbol(step.right, &mut |number, _| _ = needed.insert(number));
            found.push(*step);
        }
    }
    found.reverse();
    found
}

/// Visits the names in a formula of code, with their numbers, in the order of the text.
fn each_symbol<'a>(formula: Formula<'a>, visit: &mut dyn FnMut(u32, &'a str)) {
    match formula.view() {
        FormulaView::Name(Name::Plain(name)) => visit(formula.number(), name),
        FormulaView::Sum(terms) => terms.iter().for_each(|(_, term)| each_symbol(term, visit)),
        FormulaView::Product(parts)
        | FormulaView::Call(_, parts)
        | FormulaView::External(_, _, parts)
        | FormulaView::AtMost(parts) => parts.iter().for_each(|part| each_symbol(part, visit)),
        FormulaView::Quotient(one, other) | FormulaView::Multiple(one, other) => {
            each_symbol(one, visit);
            each_symbol(other, visit);
        }
        FormulaView::Power(inside, _) | FormulaView::NonZero(inside) | FormulaView::Exists(inside) => {
            each_symbol(inside, visit);
        }
        _ => {}
    }
}
