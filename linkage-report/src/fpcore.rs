//! Emitted formulas as FPCore, the notation of tools that bound or reduce rounding errors (<https://fpbench.org>).

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::RangeInclusive;

use linkage_runtime::__shared::{CANCELLATION, COINCIDENT_ULPS, ZERO_ULPS, smallest_product};
use linkage_runtime::derivation::Kernel;

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
pub struct FpCore {
    name: String,
    /// In the order of the lines.
    arguments: Vec<&'static str>,
    lines: Vec<Line>,
    value: &'static str,
    /// The conditions, and the lines that they need.
    checks: Vec<Check>,
    lines_of_checks: Vec<Line>,
    given: BTreeMap<&'static str, f64>,
    ranges: BTreeMap<&'static str, RangeInclusive<f64>>,
}

/// `name = value`
type Line = (&'static str, &'static str);

/// A condition by its word, and the numbers that it is on.
#[derive(Debug, Clone)]
struct Check {
    word: &'static str,
    of: Vec<&'static str>,
}

impl FpCore {
    /// The formulas of functions of a mechanism or scene.
    pub(crate) fn of(owner: &str, kernels: &[Kernel]) -> Vec<Self> {
        let owner = &ascii(owner);
        kernels.iter().flat_map(|kernel| Code::of(kernel).cores(owner, kernel.function)).collect()
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

    fn argument(&self, name: &str) -> Option<&'static str> {
        self.arguments.iter().copied().find(|argument| *argument == name)
    }

    /// The given numbers and lines as bindings of `let*`, for a body of these expressions.
    fn bindings(&self, lines: &[Line], body: impl Iterator<Item = &'static str>) -> Vec<String> {
        let used: BTreeSet<&str> = lines.iter().map(|(_, value)| *value).chain(body).flat_map(symbols).collect();
        let given = self.given.iter().filter(|(name, _)| used.contains(*name));
        let given = given.map(|(name, number)| format!("[{name} {}]", literal(*number)));
        given.chain(lines.iter().map(|(name, value)| format!("[{name} {value}]"))).collect()
    }

    /// The conditions: ranges first.
    fn conditions(&self) -> Vec<String> {
        let ranges = self.ranges.iter().filter(|(name, _)| !self.given.contains_key(*name));
        let ranges =
            ranges.map(|(name, range)| format!("(<= {} {name} {})", literal(*range.start()), literal(*range.end())));
        let mut conditions: Vec<String> = ranges.collect();
        let mut checks: Vec<String> = self.checks.iter().flat_map(Check::conditions).collect();
        let bindings =
            self.bindings(&self.lines_of_checks, self.checks.iter().flat_map(|check| check.of.iter().copied()));
        if !checks.is_empty() && !bindings.is_empty() {
            let all = joined(checks);
            checks = vec![format!("(let* ({}) {all})", bindings.join(" "))];
        }
        conditions.extend(checks);
        conditions
    }
}

impl fmt::Display for FpCore {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let arguments: Vec<&str> = self.arguments().collect();
        writeln!(f, "(FPCore ({})", arguments.join(" "))?;
        writeln!(f, "  :name \"{}\"", self.name)?;
        writeln!(f, "  :precision binary64")?;
        let conditions = self.conditions();
        if !conditions.is_empty() {
            writeln!(f, "  :pre {}", joined(conditions))?;
        }
        let bindings = self.bindings(&self.lines, std::iter::once(self.value));
        if bindings.is_empty() {
            return write!(f, "  {})", self.value);
        }
        write!(f, "  (let* ({})\n    {}))", bindings.join("\n         "), self.value)
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

impl Check {
    /// The conditions under which the code computes these formulas and no others.
    fn conditions(&self) -> Vec<String> {
        match (self.word, self.of.as_slice()) {
            ("regular", [determinant, scale]) => {
                vec![format!("(> (fabs {determinant}) (* {} (fabs {scale})))", ulps(ZERO_ULPS))]
            }
            ("nonzero", [number]) => vec![format!("(!= {number} 0)")],
            ("positive", [length]) => vec![format!("(>= {length} 0)")],
            ("apart", [radius, scale]) => vec![format!("(> {radius} (* {} {scale}))", ulps(COINCIDENT_ULPS))],
            ("moderate", [product]) => {
                let least = smallest_product::<f64>();
                vec![format!("(< {} {product} {})", literal(least), literal(1.0 / least))]
            }
            ("open", [low, high, reach_squared, distance_squared]) => vec![
                format!("(> {low} (* {CANCELLATION} {reach_squared}))"),
                format!("(> {high} (* {CANCELLATION} {distance_squared}))"),
                format!("(> {distance_squared} (* {} {reach_squared}))", ulps(1.0)),
            ],
            _ => Vec::new(),
        }
    }
}

fn ulps(number: f64) -> String {
    literal(number * f64::EPSILON)
}

/// A number of FPCore.
fn literal(number: f64) -> String {
    match number {
        _ if number.is_nan() => "NAN".to_owned(),
        _ if number.is_infinite() => if number > 0.0 { "INFINITY" } else { "(- INFINITY)" }.to_owned(),
        _ => format!("{number:?}").trim_end_matches(".0").to_owned(),
    }
}

/// The lines of a function.
struct Code {
    lines: Vec<Line>,
    checks: Vec<Check>,
    /// The places in the result and their values.
    results: Vec<Line>,
}

impl Code {
    fn of(kernel: &Kernel) -> Self {
        let mut code = Self { lines: Vec::new(), checks: Vec::new(), results: Vec::new() };
        for line in kernel.lines.lines() {
            let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
            let pair = rest.split_once(' ').unwrap_or((rest, ""));
            match word {
                "let" => code.lines.push(pair),
                "return" => code.results.push(pair),
                _ => code.checks.push(Check { word: pair.0, of: expressions(pair.1) }),
            }
        }
        code
    }

    fn cores(&self, owner: &str, function: &str) -> Vec<FpCore> {
        let core = |&(place, value): &Line| {
            let lines = self.needed(symbols(value));
            let mut known: BTreeSet<&str> = lines.iter().map(|(name, _)| *name).collect();
            known.extend(lines.iter().flat_map(|(_, value)| symbols(value)).chain(symbols(value)));
            let is_of_it = |check: &&Check| check.of.first().is_some_and(|first| known.contains(first));
            let checks: Vec<Check> = self.checks.iter().filter(is_of_it).cloned().collect();
            let lines_of_checks =
                self.needed(checks.iter().flat_map(|check| check.of.iter().flat_map(|of| symbols(of))));
            let mut arguments = Vec::new();
            let of_checks = checks.iter().flat_map(|check| check.of.iter().copied());
            let all = lines.iter().chain(&lines_of_checks).map(|(_, value)| *value).chain([value]).chain(of_checks);
            for symbol in all.flat_map(symbols) {
                if !arguments.contains(&symbol) && self.lines.iter().all(|(name, _)| *name != symbol) {
                    arguments.push(symbol);
                }
            }
            FpCore {
                name: format!("{owner}::{function}{place}"),
                arguments,
                lines,
                value,
                checks,
                lines_of_checks,
                given: BTreeMap::new(),
                ranges: BTreeMap::new(),
            }
        };
        self.results.iter().map(core).collect()
    }

    /// The lines that symbols need, in order.
    fn needed(&self, symbols_of: impl Iterator<Item = &'static str>) -> Vec<Line> {
        let mut needed: BTreeSet<&str> = symbols_of.collect();
        let mut lines: Vec<Line> = Vec::new();
        for &(name, value) in self.lines.iter().rev() {
            if needed.contains(name) {
                needed.extend(symbols(value));
                lines.push((name, value));
            }
        }
        lines.reverse();
        lines
    }
}

/// The symbols of an expression that are neither operators nor constants.
fn symbols(expression: &'static str) -> impl Iterator<Item = &'static str> {
    let is_symbol = |word: &&str| {
        let is_number = word.starts_with(|first: char| first.is_ascii_digit() || first == '-');
        !word.is_empty() && !word.starts_with('(') && !is_number && !["PI", "NAN", "INFINITY"].contains(word)
    };
    expression.split(' ').map(|word| word.trim_end_matches(')')).filter(is_symbol)
}

/// The expressions of a list, divided at spaces outside parentheses.
fn expressions(list: &'static str) -> Vec<&'static str> {
    let (mut depth, mut start, mut all) = (0_usize, 0, Vec::new());
    for (place, letter) in list.char_indices() {
        match letter {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            ' ' if depth == 0 => {
                all.push(&list[start..place]);
                start = place + 1;
            }
            _ => {}
        }
    }
    all.push(&list[start..]);
    all
}
