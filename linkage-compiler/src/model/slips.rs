//! Slips that are valid formulas: degrees without a unit, a unit where none may stand, an angle that is a length.

use super::kind::{Kind, bare_symbols, bare_terms};
use super::mechanism::Mechanism;
use super::name::Name;
use super::resolve::lacks_equations;
use super::resolver::Resolver;
use super::scope::Value;
use crate::diagnostics::Region;
use crate::graph::{NodeId, Number, SymbolId};
use crate::syntax::{Expression, ExpressionId, Operator, Statement, StatementKind, Unit};

/// A number above it is more than a turn in radians.
const TURN: f64 = std::f64::consts::TAU;

impl Resolver<'_> {
    /// The text of a plain number, and its value, if the expression is one.
    fn plain(&self, id: ExpressionId) -> Option<(String, f64, Unit)> {
        match self.expressions.get(id) {
            Expression::Number { digits, unit } if self.expressions.suffix(id.index()).is_none() => {
                Some((digits.clone(), digits.parse().ok()?, *unit))
            }
            Expression::Negate(inner) => {
                let (digits, value, unit) = self.plain(*inner)?;
                Some((format!("-{digits}"), -value, unit))
            }
            _ => None,
        }
    }

    /// The text of a constant for readers: a plain number as written, another one as a decimal number if it has no division.
    pub(super) fn written(&self, id: ExpressionId, node: NodeId) -> String {
        if let Some((digits, _, unit)) = self.plain(id) {
            return digits + if unit == Unit::Degrees { "deg" } else { "" };
        }
        match self.graph.as_number(node) {
            Some(Number::Ratio(numerator, denominator)) if !self.divides(id) => {
                (numerator as f64 / denominator as f64).to_string()
            }
            _ => self.graph.text(node),
        }
    }

    /// The unit of a default: that of a plain number, or the only one of a number times a plain number or of a sum.
    pub(super) fn unit_of(&self, id: ExpressionId) -> Unit {
        match self.expressions.get(id) {
            Expression::Number { unit, .. } => *unit,
            Expression::Negate(inner) => self.unit_of(*inner),
            Expression::Sum(operands) => {
                let mut units = operands.iter().map(|(_, operand)| self.unit_of(*operand));
                units.next().filter(|first| units.all(|unit| unit == *first)).unwrap_or(Unit::None)
            }
            Expression::Product(operands) => {
                let units = operands.iter().map(|(operator, operand)| (*operator, self.unit_of(*operand)));
                let units: Vec<_> = units.filter(|(_, unit)| *unit != Unit::None).collect();
                if let [(Operator::Direct, only)] = units.as_slice() { *only } else { Unit::None }
            }
            _ => Unit::None,
        }
    }

    /// True if a division is written in an expression.
    fn divides(&self, id: ExpressionId) -> bool {
        let expression = self.expressions.get(id);
        let is_quotient = matches!(expression, Expression::Product(factors)
            if factors.iter().any(|(operator, _)| *operator == Operator::Inverse));
        is_quotient || expression.operands().into_iter().any(|operand| self.divides(operand))
    }

    /// Reports a plain number of more than a turn as an angle or as a term of one; returns true if there is one.
    pub(super) fn degrees_without_unit(&mut self, angle: ExpressionId) -> bool {
        if let Some((digits, value, unit)) = self.plain(angle) {
            let is_slip = unit == Unit::None && value.abs() > TURN;
            if is_slip {
                let message =
                    format!("{digits} radians are more than a turn: write `{digits}deg`, or `{digits}rad` to mean it");
                self.diagnostics.error(self.expressions.region(angle), message);
            }
            return is_slip;
        }
        let Expression::Sum(operands) = self.expressions.get(angle) else { return false };
        operands.iter().any(|&(_, operand)| self.degrees_without_unit(operand))
    }

    /// Reports an angle unit where none may stand; returns true if there is one.
    pub(super) fn has_unit(&mut self, id: ExpressionId, what: &str) -> bool {
        let Some((digits, _, unit)) = self.plain(id).filter(|(_, _, unit)| *unit != Unit::None) else { return false };
        let message = format!("{what} has no unit of {}: write `{digits}`", unit.of());
        self.diagnostics.error(self.expressions.region(id), message);
        true
    }

    /// Records the angle of a body, to be checked when the kinds of all names are known.
    pub(super) fn angle_of_body(&mut self, node: NodeId, region: Region, body: &str) {
        self.kinds.angles_of_bodies.push((node, region, body.to_owned()));
    }

    /// Reports defaults and angles of bodies of the wrong kind.
    pub(super) fn kinds_of_numbers(&mut self, statements: &[Statement]) {
        let parameters = statements.iter().filter_map(|statement| match &statement.kind {
            StatementKind::Parameters(parameters) => Some(parameters),
            _ => None,
        });
        for (name, default) in parameters.flatten() {
            let (Some(default), Some(symbol)) = (*default, self.scope.symbol(name)) else { continue };
            let Some((digits, value, unit)) = self.plain(default) else { continue };
            let message = match (self.kinds.of(symbol), unit) {
                (Kind::Angle, Unit::None) if value.abs() > TURN => {
                    format!(
                        "the angle `{name}` is {digits} radians, more than a turn: write `{digits}deg`, or `{digits}rad` to mean it"
                    )
                }
                (Kind::Angle, Unit::TurnsPerMinute) => {
                    format!("the angle `{name}` has no unit of speeds: write `{digits}deg`")
                }
                (Kind::Length, Unit::Degrees | Unit::Radians | Unit::TurnsPerMinute) => {
                    format!("the length `{name}` has no unit of {}: write `{digits}`", unit.of())
                }
                _ => continue,
            };
            self.diagnostics.error(self.expressions.region(default), message);
        }
        for (node, region, body) in std::mem::take(&mut self.kinds.angles_of_bodies) {
            let length = bare_symbols(&self.graph, node).into_iter().find(|&symbol| {
                self.kinds.of(symbol) == Kind::Length
                    && (self.kinds.lengths_of_loops.contains(&symbol) || self.kinds.known.contains_key(&symbol))
            });
            if let Some(length) = length {
                let name = self.graph.symbol_name(length);
                let message =
                    format!("the angle of `{body}` is the length `{name}`: write the angle that the body turns by");
                self.diagnostics.error(region, message);
            }
        }
    }

    /// Reports sums of an angle and a length that are coordinates: an arc has a radius, which may be a number.
    pub(super) fn kinds_of_sums(&mut self, result: &Mechanism) {
        let name_of = |symbol: SymbolId| {
            let coordinate = result.coordinates.iter().find(|coordinate| coordinate.symbol == symbol);
            coordinate.map(|coordinate| coordinate.name.text.as_str())
        };
        for operands in std::mem::take(&mut self.kinds.sums) {
            let mut found: [Vec<(ExpressionId, Number, &str)>; 2] = Default::default();
            for operand in operands {
                let Some(Value::Scalar(node)) = self.values.get(operand.index()) else { continue };
                let terms = bare_terms(&self.graph, *node);
                let kinds = terms.iter().map(|(_, symbol)| self.length_or_angle(*symbol));
                let kinds: Vec<Option<Kind>> = kinds.collect();
                // An operand with both has its own message.
                if kinds.contains(&Some(Kind::Length)) && kinds.contains(&Some(Kind::Angle)) {
                    continue;
                }
                for ((number, symbol), kind) in terms.into_iter().zip(kinds) {
                    let (Some(kind), Some(name)) = (kind, name_of(symbol)) else { continue };
                    found[usize::from(kind == Kind::Length)].push((operand, number.absolute(), name));
                }
            }
            let [angles, lengths] = found;
            let pair = angles.iter().find_map(|&(operand, number, angle)| {
                let (_, _, length) = lengths.iter().find(|(_, other, _)| *other == number)?;
                Some((operand, angle, *length))
            });
            if let Some((operand, angle, length)) = pair {
                let message = format!(
                    "the angle `{angle}` and the length `{length}` have different units: write `r*{angle}` with a radius `r`"
                );
                self.diagnostics.error(self.expressions.region(operand), message);
            }
        }
    }

    /// The kind of a name that is used as a length or as an angle.
    pub(super) fn length_or_angle(&self, symbol: SymbolId) -> Option<Kind> {
        let has = |kind| self.kinds.known.get(&symbol) == Some(&kind);
        match () {
            () if has(Kind::Angle) => Some(Kind::Angle),
            () if has(Kind::Length) || self.kinds.lengths_of_loops.contains(&symbol) => Some(Kind::Length),
            () => None,
        }
    }

    /// Reports each `let` that is not used.
    pub(super) fn unused_lets(&mut self, statements: &[Statement], result: &Mechanism) {
        if lacks_equations(result) {
            return;
        }
        for statement in statements {
            let StatementKind::Let { name, .. } = &statement.kind else { continue };
            let text = Name::new(name).text;
            if !self.scope.is_value_used(&text) && !text.starts_with('_') {
                let message = format!("`let {text}` is never used: remove it, or call it `_{text}`");
                self.diagnostics.error(name.span(), message);
            }
        }
    }

    /// True for the name of an angle.
    fn is_angle(&self, name: &str) -> bool {
        self.scope.symbol_of(name).is_some_and(|symbol| self.kinds.known.get(&symbol) == Some(&Kind::Angle))
    }

    /// The names of values in a name, or in a product of names.
    pub(super) fn values_in(&self, id: ExpressionId) -> Vec<String> {
        let names = match self.expressions.get(id) {
            Expression::Product(operands) => {
                operands.iter().filter_map(|(_, operand)| self.expressions.as_name(*operand)).collect()
            }
            _ => self.expressions.as_name(id).into_iter().collect::<Vec<_>>(),
        };
        names.into_iter().filter(|name| self.scope.is_value(name)).map(ToString::to_string).collect()
    }

    /// A scalar among vectors: the advice is `r@phi` for a product of a length and an angle.
    pub(super) fn as_vector(&self, id: ExpressionId) -> String {
        let names: Vec<String> = match self.expressions.get(id) {
            Expression::Product(operands) => operands
                .iter()
                .filter_map(|(_, operand)| self.expressions.as_name(*operand))
                .map(ToString::to_string)
                .collect(),
            _ => self.expressions.as_name(id).map(ToString::to_string).into_iter().collect(),
        };
        match names.as_slice() {
            [name, ..] if self.values_in(id).contains(name) => {
                format!("define `{name}` as a vector, as in `let {name} = r@phi;`")
            }
            [length, angle] => format!("write `{length}@{angle}`"),
            [angle] if self.is_angle(angle) => "write `r@phi` or `(x, y)`".to_owned(),
            [length] => format!("write `{length}@phi` with its angle, or `({length}, 0)`"),
            _ => "write `r@phi` or `(x, y)`".to_owned(),
        }
    }
}
