//! Analysis of frictions and stops.

use super::along::Along;
use super::{Contact, ContactLaw};
use crate::graph::NodeId;
use crate::model::resolver::Resolver;
use crate::syntax::{EffectKind, ExpressionId};

impl Resolver<'_> {
    /// Evaluates a friction or a stop: all its expressions, also after a mistake in one.
    pub(super) fn contact(&mut self, kind: &EffectKind) -> Option<(Contact, Along)> {
        match kind {
            EffectKind::Friction { factors, reaction, on } => {
                let mut nodes = Vec::new();
                for &factor in factors {
                    let node = self.law(factor);
                    if node.and_then(|node| self.graph.constant_value(node)).is_some_and(|value| value < 0.0) {
                        let message = "the limit of a friction is negative: it would drive the mechanism";
                        self.diagnostics.error(self.expressions.region(factor), message);
                    }
                    nodes.push(node);
                }
                if let (&[factor], None) = (factors.as_slice(), reaction) {
                    self.lone_coefficient(factor);
                }
                if let Some(Some(pin)) = reaction {
                    self.vector(*pin);
                }
                let along = self.moving(*on);
                let label = format!("friction on {}", self.text(*on)?);
                let along = self.signed(along?);
                let law = ContactLaw::Friction(nodes.into_iter().collect::<Option<_>>()?);
                let written = Along::Contact { on: *on, is_signed: true };
                Some((Contact { label, along, law, bearing: None }, written))
            }
            EffectKind::Stop { on, range, restitution } => {
                let along = self.moving(*on);
                let mut still = |id: ExpressionId, what: &str| {
                    let node = self.scalar(id)?;
                    self.still(id, node, what);
                    Some(node)
                };
                let written = range.map(|range| range.map(|end| still(end, "the end of a stop")));
                let given = still(*restitution, "the restitution of a stop");
                let label = format!("stop on {}", self.text(*on)?);
                let ends = written.unwrap_or_else(|| self.declared_ends(*on, along));
                let (range, restitution_node) = ([ends[0]?, ends[1]?], given?);
                let value = |node: NodeId| self.graph.constant_value(node);
                // A length is not below zero.
                let least =
                    if along.is_some_and(|along| self.graph.is_length(along)) { 0.0 } else { f64::NEG_INFINITY };
                if let [Some(lower), Some(upper)] = range.map(value)
                    && lower.max(least) >= upper
                {
                    let region = self.expressions.region(*on);
                    self.diagnostics.error(region, format_args!("the range {lower}..{upper} of this stop is empty"));
                }
                if value(restitution_node).is_some_and(|value| !(0.0..=1.0).contains(&value)) {
                    let message = "a restitution must be between 0 and 1: s'+ = -e s'- at an impact";
                    self.diagnostics.error(self.expressions.region(*restitution), message);
                }
                let (along, range, is_signed) = self.above_zero(along?, range);
                let law = ContactLaw::Stop { range, restitution: restitution_node };
                Some((Contact { label, along, law, bearing: None }, Along::Contact { on: *on, is_signed }))
            }
            _ => None,
        }
    }

    /// Reports a friction whose only factor has the name of a coefficient: that would be its largest force.
    fn lone_coefficient(&mut self, factor: ExpressionId) {
        let name = self.expressions.as_name(factor).map(ToString::to_string);
        let Some(name) = name.filter(|name| is_coefficient(name)) else { return };
        let message = format!(
            "`{name}` alone is the largest force or torque of this friction\na coefficient is multiplied by the normal \
             force: `friction {name}, normal on s;`, or of an angle `friction {name}, radius, normal on phi;`; \
             `reaction` instead of `normal` is the force in the joint\na force has another name, such as `limit`"
        );
        self.diagnostics.error(self.expressions.region(factor), message);
    }

    /// The declared range of the scalar of a stop, which is written without one.
    fn declared_ends(&mut self, on: ExpressionId, along: Option<NodeId>) -> [Option<NodeId>; 2] {
        let Some(along) = along else { return [None; 2] };
        let ends = self.ranges.get(&along).copied().unwrap_or_default();
        if ends.contains(&None) {
            let name = self.text(on).unwrap_or_default();
            let what = if ends == [None; 2] { "no range that is declared before" } else { "a range with one end" };
            let message = format!("`{name}` has {what}: write `stop {name} in lower..upper, restitution e;`");
            self.diagnostics.error(self.expressions.region(on), message);
        }
        ends
    }

    /// The scalar and the range of a stop, and whether it is signed. A length never passes an end at zero or below: it stays in -c..c if it stays in 0..c, and so does x of |x|.
    fn above_zero(&mut self, scalar: NodeId, [lower, upper]: [NodeId; 2]) -> (NodeId, [NodeId; 2], bool) {
        if self.graph.is_length(scalar) && self.graph.constant_value(lower).is_some_and(|lower| lower <= 0.0) {
            (self.signed(scalar), [self.graph.negate(upper), upper], true)
        } else {
            (scalar, [lower, upper], false)
        }
    }
}

/// True for the names of a coefficient of friction: `mu`, `mu_1`, `mu2`.
pub(super) fn is_coefficient(name: &str) -> bool {
    let rest = name.strip_prefix("mu").or_else(|| name.strip_prefix('μ'));
    rest.is_some_and(|rest| rest.chars().all(|next| next == '_' || next.is_ascii_digit()) || rest.starts_with('_'))
}
