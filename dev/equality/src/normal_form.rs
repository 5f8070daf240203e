//! Conversion of the graph to fractions of polynomials in symbols and exponentials.

use std::collections::BTreeMap;

use linkage_compiler::graph::{Function, Graph, Node, NodeId, Number, SymbolId};

use crate::constants::{Complex, Constant};
use crate::fraction::{Denominator, Fraction};
use crate::polynomial::{Index, Monomial, Polynomial, Powers, Ring};
use crate::ratio::Ratio;
use crate::{HIGHEST_ORDER, Outcome, Reason};

/// The meaning of a variable of the polynomials.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Meaning {
    Pi,
    Symbol(SymbolId),
    /// A number that is not exact, by its bits.
    Inexact(u64),
    /// The value of a function outside the class.
    Call(NodeId),
    /// exp(i * power product / denominator), where the power product is not pi alone.
    Exponential(Monomial, Denominator),
}

/// The properties of a variable.
pub(super) struct Variable {
    meaning: Meaning,
    /// The reason why a difference that contains it is undecided.
    pub(super) outside: Option<Reason>,
    /// Its constant, if it depends on no symbol.
    pub(super) constant: Option<Constant>,
}

/// The normal forms of the nodes of a graph.
pub(super) struct NormalForms<'g> {
    graph: &'g Graph,
    pub(super) ring: Ring,
    pub(super) variables: Vec<Variable>,
    indices: BTreeMap<Meaning, Index>,
    fractions: BTreeMap<NodeId, Fraction>,
}

impl<'g> NormalForms<'g> {
    /// Computes the forms of all nodes that the roots depend on, with roots of unity of this order.
    pub(super) fn new(graph: &'g Graph, roots: &[NodeId], order: u32) -> Outcome<Self> {
        let (variables, indices, fractions) = (Vec::new(), BTreeMap::new(), BTreeMap::new());
        let mut forms = Self { graph, ring: Ring::new(order, graph.budget()), variables, indices, fractions };
        for id in graph.reachable(roots) {
            let fraction = forms.node(id)?;
            forms.fractions.insert(id, fraction);
        }
        Ok(forms)
    }

    pub(super) fn of(&self, id: NodeId) -> Fraction {
        self.fractions.get(&id).cloned().unwrap_or_default()
    }

    fn node(&mut self, id: NodeId) -> Outcome<Fraction> {
        match self.graph.node(id) {
            Node::Constant(value) => Ok(self.number(*value)?.into()),
            Node::Pi => Ok(self.variable(Meaning::Pi)?.into()),
            Node::Symbol(symbol) => Ok(self.variable(Meaning::Symbol(*symbol))?.into()),
            Node::Sum { constant, terms } => {
                let mut coefficients = Vec::new();
                for (coefficient, term) in terms {
                    coefficients.push((self.number(*coefficient)?, *term));
                }
                let constant = (self.number(*constant)?, &Fraction::from(Polynomial::one()));
                let terms = coefficients.into_iter().map(|(coefficient, term)| (coefficient, &self.fractions[&term]));
                Fraction::sum(&self.ring, terms.chain([constant]))
            }
            Node::Product { coefficient, factors } => {
                let coefficient = self.number(*coefficient)?;
                let factors = factors.iter().map(|(base, exponent)| (&self.fractions[base], *exponent));
                Fraction::product(&self.ring, coefficient, factors)
            }
            Node::Call(Function::Sin, arguments) => self.circular(arguments[0]).map(|[sine, _]| sine.into()),
            Node::Call(Function::Cos, arguments) => self.circular(arguments[0]).map(|[_, cosine]| cosine.into()),
            Node::Call(Function::Tan, arguments) => {
                let [sine, cosine] = self.circular(arguments[0])?.map(Fraction::from);
                Fraction::product(&self.ring, Polynomial::one(), [(&sine, 1), (&cosine, -1)])
            }
            Node::Call(_, arguments) | Node::External(_, arguments) => self.opaque(id, arguments),
        }
    }

    fn number(&mut self, value: Number) -> Outcome<Polynomial> {
        match value {
            Number::Ratio(n, d) => Ok(Polynomial::constant(Ratio::new(n.into(), d.into())?)),
            Number::Float(value) if value.is_finite() => self.variable(Meaning::Inexact(value.to_bits())),
            // A number is not finite only after a division by zero or an overflow.
            Number::Float(_) => Err(Reason::Undefined.into()),
        }
    }

    /// A call of a function outside the class: the variable of an earlier call with equal arguments, or a new one.
    fn opaque(&mut self, id: NodeId, arguments: &[NodeId]) -> Outcome<Fraction> {
        for (index, variable) in (0..).zip(&self.variables) {
            if let Meaning::Call(earlier) = variable.meaning
                && let Some(theirs) = self.same_function(id, earlier)
            {
                let mut equal = true;
                for (argument, other) in arguments.iter().zip(theirs) {
                    let difference = self.fractions[argument].minus(&self.ring, &self.fractions[other])?;
                    equal &= difference.numerator.is_zero();
                }
                if equal {
                    return Ok(Polynomial::variable(index).into());
                }
            }
        }
        Ok(self.variable(Meaning::Call(id))?.into())
    }

    /// The arguments of `earlier`, if both are calls of one function.
    fn same_function(&self, id: NodeId, earlier: NodeId) -> Option<&'g [NodeId]> {
        match (self.graph.node(id), self.graph.node(earlier)) {
            (Node::Call(one, _), Node::Call(other, theirs)) if one == other => Some(theirs),
            (Node::External(one, _), Node::External(other, theirs)) if one == other => Some(theirs),
            _ => None,
        }
    }

    /// The sine and cosine of an angle.
    fn circular(&mut self, angle: NodeId) -> Outcome<[Polynomial; 2]> {
        let Fraction { numerator, denominator } = self.fractions[&angle].clone();
        let pi = self.index(Meaning::Pi)?;
        let half_turn = Monomial { powers: Powers::one(pi, Ratio::ONE), root: 0 };
        let (mut root, mut powers) = (0, Powers::default());
        for (monomial, coefficient) in numerator.terms() {
            if *monomial == half_turn && denominator.is_empty() {
                root = self.half_turns(coefficient)?;
            } else {
                let atom = self.index(Meaning::Exponential(monomial.clone(), denominator.clone()))?;
                powers = powers.times(&Powers::one(atom, coefficient))?;
            }
        }
        // With e = e^(i t): cos t = (e + 1/e) / 2, sin t = (e - 1/e) / 2i, and -i = zeta^(3 N / 4).
        let ring = &self.ring;
        let (order, half) = (ring.roots.order(), Ratio::new(1, 2)?);
        let inverse = powers.inverse()?;
        let mut cosine = ring.monomial(&powers, root, half)?;
        ring.accumulate(&mut cosine, &ring.monomial(&inverse, order - root, half)?)?;
        let mut sine = ring.monomial(&powers, root + order / 4 * 3, half)?;
        ring.accumulate(&mut sine, &ring.monomial(&inverse, order - root + order / 4, half)?)?;
        Ok([sine, cosine])
    }

    /// The exponent k with zeta^k = e^(i pi turns).
    fn half_turns(&self, turns: Ratio) -> Outcome<u32> {
        let order = i128::from(self.ring.roots.order());
        let needed = turns.denominator.checked_mul(2).ok_or(Reason::TooLarge)?;
        if order % needed == 0 {
            let root = (turns.numerator % needed * (order / needed)).rem_euclid(order);
            return u32::try_from(root).map_err(|_| Reason::TooLarge.into());
        }
        let mut multiple = order;
        while multiple % needed != 0 {
            multiple += order;
            if multiple > i128::from(HIGHEST_ORDER) {
                return Err(Reason::TooLarge.into());
            }
        }
        Err(crate::Halt::Order(u32::try_from(multiple).unwrap_or(u32::MAX)))
    }

    fn variable(&mut self, meaning: Meaning) -> Outcome<Polynomial> {
        self.index(meaning).map(Polynomial::variable)
    }

    fn index(&mut self, meaning: Meaning) -> Outcome<Index> {
        if let Some(&index) = self.indices.get(&meaning) {
            return Ok(index);
        }
        let (outside, constant) = self.nature(&meaning);
        let index = Index::try_from(self.variables.len()).map_err(|_| Reason::TooManyTerms)?;
        self.indices.insert(meaning.clone(), index);
        self.variables.push(Variable { meaning, outside, constant });
        Ok(index)
    }

    fn nature(&self, meaning: &Meaning) -> (Option<Reason>, Option<Constant>) {
        match meaning {
            Meaning::Pi => (None, Some(Constant::Pi)),
            Meaning::Symbol(_) => (None, None),
            Meaning::Inexact(bits) => (Some(Reason::Inexact(Number::Float(f64::from_bits(*bits)))), None),
            Meaning::Call(id) => match self.graph.node(*id) {
                Node::Call(function, _) => (Some(Reason::OutsideClass(function.name())), None),
                Node::External(external, _) => {
                    let value = self.graph.external_names(external.function).first();
                    (Some(Reason::External(value.cloned().unwrap_or_default())), None)
                }
                _ => (None, None),
            },
            Meaning::Exponential(monomial, denominator) if denominator.is_empty() => {
                let exponent = self.constant_value(&monomial.powers);
                // x cos(1) and pi x are independent angles only if cos(1) and pi are.
                let mixed = exponent.is_none()
                    && monomial.powers.iter().any(|(variable, _)| {
                        matches!(self.variables[variable as usize].constant, Some(Constant::Exponential { .. }))
                    });
                let root = Complex::root(monomial.root, self.ring.roots.order());
                let constant = exponent.map(|value| Constant::Exponential {
                    exponent: Complex::I.times(root).times(value),
                    algebraic: monomial.powers.is_one(),
                });
                (self.outside(&monomial.powers).or(mixed.then_some(Reason::Constants)), constant)
            }
            // Such angles may be dependent: 1 / (x + 1) + x / (x + 1) = 1.
            Meaning::Exponential(monomial, denominator) => {
                let inner = denominator.keys().flat_map(|factor| factor.terms().map(|(monomial, _)| monomial));
                let reason = inner.chain([monomial]).find_map(|monomial| self.outside(&monomial.powers));
                (reason.or(Some(Reason::AngleIsQuotient)), None)
            }
        }
    }

    /// The reason why a product of powers is undecided, if it is.
    pub(super) fn outside(&self, powers: &Powers) -> Option<Reason> {
        powers.iter().find_map(|(variable, _)| self.variables[variable as usize].outside.clone())
    }

    /// The value, if no symbol is among the variables.
    pub(super) fn constant_value(&self, powers: &Powers) -> Option<Complex> {
        powers.iter().try_fold(Complex::ONE, |product, (variable, exponent)| {
            let constant = self.variables[variable as usize].constant.as_ref()?;
            Some(product.times(constant.power(exponent.to_f64())))
        })
    }
}
