//! Random identities: an expression against a rewritten form, and against a form with one mistake.

use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use linkage_compiler::graph::{Function, NodeId, Number};
use linkage_equality::{Answer, compare};

use crate::algebra::formula::Formulas;

const CASES: usize = 100;

const LENGTHS: [&str; 3] = ["l1", "l2", "l3"];
const ANGLES: [&str; 3] = ["a", "b", "c"];

/// Multiples of a/4, b/4, c/4 and pi/24.
type Angle = [i64; 4];

#[derive(Clone, Debug)]
enum Expression {
    Integer(i64),
    Length(usize),
    Circular(Function, Angle),
    Sum(Vec<Self>),
    Product(Vec<Self>),
    Quotient(Box<Self>, Box<Self>),
    Power(Box<Self>, i32),
}

use Expression::{Circular, Integer, Length, Power, Product, Quotient, Sum};

fn sin(angle: Angle) -> Expression {
    Circular(Function::Sin, angle)
}

fn cos(angle: Angle) -> Expression {
    Circular(Function::Cos, angle)
}

fn quotient(above: Expression, below: Expression) -> Expression {
    Quotient(Box::new(above), Box::new(below))
}

fn times(factor: i64, expression: Expression) -> Expression {
    Product(vec![Integer(factor), expression])
}

fn plus(left: Angle, right: Angle) -> Angle {
    std::array::from_fn(|i| left[i] + right[i])
}

fn minus(left: Angle, right: Angle) -> Angle {
    std::array::from_fn(|i| left[i] - right[i])
}

/// Half of an angle, if it is representable.
fn half(angle: Angle) -> Option<Angle> {
    angle.iter().all(|part| part % 2 == 0).then(|| angle.map(|part| part / 2))
}

struct Source(SmallRng);

impl Source {
    fn below(&mut self, bound: usize) -> usize {
        self.0.random_range(0..bound)
    }

    fn chance(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }

    /// An integer combination of a, b and c, sometimes plus a multiple of pi/6.
    fn angle(&mut self) -> Angle {
        let mut angle = [0; 4];
        angle[self.below(3)] = 4 * self.0.random_range(1..=2);
        if self.chance(40) {
            angle[self.below(3)] += 4 * self.0.random_range(-1..=1);
        }
        if self.chance(30) {
            angle[3] = 4 * self.0.random_range(1..=11);
        }
        angle
    }

    fn circular(&mut self) -> Expression {
        let function = [Function::Sin, Function::Cos, Function::Sin, Function::Cos, Function::Tan][self.below(5)];
        Circular(function, self.angle())
    }

    fn leaf(&mut self) -> Expression {
        match self.below(6) {
            0 => Integer([-3, -2, 2, 3, 5][self.below(5)]),
            1 | 2 => Length(self.below(3)),
            _ => self.circular(),
        }
    }

    fn expression(&mut self, depth: usize) -> Expression {
        if depth == 0 {
            return self.leaf();
        }
        match self.below(8) {
            0..=2 => Sum((0..2 + self.below(2)).map(|_| self.expression(depth - 1)).collect()),
            3..=5 => Product(vec![self.expression(depth - 1), self.expression(depth - 1)]),
            6 => quotient(self.expression(depth - 1), Sum(vec![Length(self.below(3)), self.leaf()])),
            _ => Power(Box::new(Sum(vec![self.leaf(), self.leaf()])), [2, 3, -1, -2][self.below(4)]),
        }
    }

    /// Rewrites an expression by random identities.
    fn rewrite(&mut self, expression: &Expression) -> Expression {
        let inner = match expression {
            Integer(_) | Length(_) | Circular(..) => expression.clone(),
            Sum(terms) => Sum(terms.iter().map(|term| self.rewrite(term)).collect()),
            Product(factors) => Product(factors.iter().map(|factor| self.rewrite(factor)).collect()),
            Quotient(above, below) => quotient(self.rewrite(above), self.rewrite(below)),
            Power(base, exponent) => Power(Box::new(self.rewrite(base)), *exponent),
        };
        let stepped = if self.chance(70) { self.step(inner) } else { inner };
        if self.chance(8) { self.insert(stepped) } else { stepped }
    }

    /// Applies one identity.
    fn step(&mut self, expression: Expression) -> Expression {
        match expression {
            Circular(function, angle) => self.circular_law(function, angle),
            // f g: a product of two sines or cosines as a sum.
            Product(factors) => match factors.as_slice() {
                [
                    Circular(f @ (Function::Sin | Function::Cos), u),
                    Circular(g @ (Function::Sin | Function::Cos), v),
                ] => product_as_sum((*f, *u), (*g, *v)),
                // a (b + c) = a b + a c
                [a, Sum(terms)] | [Sum(terms), a] => {
                    Sum(terms.iter().map(|term| Product(vec![term.clone(), a.clone()])).collect())
                }
                // (a/b) c = a c / b
                [Quotient(a, b), c] | [c, Quotient(a, b)] => {
                    quotient(Product(vec![(**a).clone(), c.clone()]), (**b).clone())
                }
                _ => Product(factors),
            },
            Sum(terms) => match terms.as_slice() {
                // a/b + c = (a + b c)/b
                [Quotient(a, b), c] | [c, Quotient(a, b)] => {
                    let above = Sum(vec![(**a).clone(), Product(vec![(**b).clone(), c.clone()])]);
                    quotient(above, (**b).clone())
                }
                // sin u + sin v = 2 sin((u + v)/2) cos((u - v)/2)
                &[Circular(Function::Sin, u), Circular(Function::Sin, v)] => {
                    match (half(plus(u, v)), half(minus(u, v))) {
                        (Some(mean), Some(apart)) => times(2, Product(vec![sin(mean), cos(apart)])),
                        _ => Sum(terms),
                    }
                }
                _ => Sum(terms),
            },
            // (a + b)/c = a/c + b/c
            Quotient(above, below) => match *above {
                Sum(terms) => Sum(terms.into_iter().map(|term| quotient(term, (*below).clone())).collect()),
                above => quotient(above, *below),
            },
            Power(base, exponent @ (2 | -2)) => match base.as_ref() {
                // (a + b)^2 = a^2 + 2 a b + b^2
                Sum(terms) if terms.len() == 2 => {
                    let square = |term: &Expression| Power(Box::new(term.clone()), 2);
                    let mixed = Product(vec![Integer(2), terms[0].clone(), terms[1].clone()]);
                    let expanded = Sum(vec![square(&terms[0]), mixed, square(&terms[1])]);
                    if exponent > 0 { expanded } else { quotient(Integer(1), expanded) }
                }
                _ => Power(base, exponent),
            },
            other => other,
        }
    }

    fn circular_law(&mut self, function: Function, angle: Angle) -> Expression {
        let (choice, halved) = (self.below(3), half(angle));
        match (function, choice, halved) {
            (Function::Tan, 0, Some(h)) => {
                let tan = Circular(Function::Tan, h);
                let below = Sum(vec![Integer(1), times(-1, Power(Box::new(tan.clone()), 2))]);
                quotient(times(2, tan), below)
            }
            (Function::Tan, ..) => quotient(sin(angle), cos(angle)),
            (Function::Sin, 0, Some(h)) => times(2, Product(vec![sin(h), cos(h)])),
            (Function::Cos, 0, Some(h)) => Sum(vec![times(2, Power(Box::new(cos(h)), 2)), Integer(-1)]),
            (Function::Cos, 1, Some(h)) => Sum(vec![Integer(1), times(-2, Power(Box::new(sin(h)), 2))]),
            // The addition theorems, with a random part of the angle.
            _ => {
                let first = self.angle();
                let second = minus(angle, first);
                let (s, c) = ((sin(first), sin(second)), (cos(first), cos(second)));
                if function == Function::Sin {
                    Sum(vec![Product(vec![s.0, c.1]), Product(vec![c.0, s.1])])
                } else {
                    Sum(vec![Product(vec![c.0, c.1]), Product(vec![Integer(-1), s.0, s.1])])
                }
            }
        }
    }

    /// Inserts a disguised factor 1 or summand 0.
    fn insert(&mut self, expression: Expression) -> Expression {
        match self.below(3) {
            // sin^2 + cos^2 = 1
            0 => {
                let angle = self.angle();
                let squares = [sin(angle), cos(angle)].map(|f| Power(Box::new(f), 2));
                Product(vec![expression, Sum(squares.to_vec())])
            }
            // (a x + a y)/(x + y) = a
            1 => {
                let (x, y) = (Length(self.below(3)), self.leaf());
                let above = [&x, &y].map(|part| Product(vec![expression.clone(), part.clone()]));
                quotient(Sum(above.to_vec()), Sum(vec![x, y]))
            }
            // a + x - x, where one x is rewritten
            _ => {
                let extra = self.expression(1);
                let other = self.rewrite(&extra);
                Sum(vec![expression, extra, times(-1, other)])
            }
        }
    }

    /// Returns the expression with one mistake.
    fn spoil(&mut self, expression: &Expression) -> Expression {
        let descend = self.chance(75);
        match expression.clone() {
            Sum(mut terms) if descend => {
                let index = self.below(terms.len());
                terms[index] = self.spoil(&terms[index]);
                Sum(terms)
            }
            Product(mut factors) if descend => {
                let index = self.below(factors.len());
                factors[index] = self.spoil(&factors[index]);
                Product(factors)
            }
            Quotient(above, below) if descend && self.chance(50) => quotient(self.spoil(&above), *below),
            Quotient(above, below) if descend => quotient(*above, self.spoil(&below)),
            Power(base, exponent) if descend => Power(Box::new(self.spoil(&base)), exponent),
            Integer(value) => Integer(value + 1),
            Length(index) => times(if self.chance(50) { -1 } else { 2 }, Length(index)),
            Circular(function, mut angle) => match self.below(3) {
                0 => Circular(if function == Function::Sin { Function::Cos } else { Function::Sin }, angle),
                1 => {
                    angle[3] += 1;
                    Circular(function, angle)
                }
                _ => {
                    angle[self.below(3)] += 4;
                    Circular(function, angle)
                }
            },
            Sum(mut terms) => {
                let last = terms.pop().unwrap_or(Integer(1));
                terms.push(times(-1, last));
                Sum(terms)
            }
            Product(mut factors) => {
                factors.push(quotient(Integer(1001), Integer(1000)));
                Product(factors)
            }
            Quotient(above, below) => Quotient(below, above),
            Power(base, exponent) => Power(base, exponent + if exponent == -1 { 2 } else { 1 }),
        }
    }
}

/// Converts a product of two sines or cosines to half a sum.
fn product_as_sum((f, u): (Function, Angle), (g, v): (Function, Angle)) -> Expression {
    let (sum, difference) = (plus(u, v), minus(u, v));
    let terms = match (f, g) {
        (Function::Sin, Function::Sin) => [cos(difference), times(-1, cos(sum))],
        (Function::Cos, Function::Cos) => [cos(difference), cos(sum)],
        (Function::Sin, _) => [sin(sum), sin(difference)],
        _ => [sin(sum), times(-1, sin(difference))],
    };
    quotient(Sum(terms.to_vec()), Integer(2))
}

impl Formulas {
    fn build(&mut self, expression: &Expression) -> NodeId {
        match expression {
            Integer(value) => self.graph.number(Number::integer(*value)),
            Length(index) => self.node(LENGTHS[*index]),
            Circular(function, [parts @ .., turn]) => {
                let mut terms = Vec::new();
                for (name, part) in ANGLES.iter().zip(parts) {
                    terms.push((Number::ratio((*part).into(), 4), self.node(name)));
                }
                terms.push((Number::ratio((*turn).into(), 24), self.graph.pi()));
                let angle = self.graph.sum(&terms);
                self.graph.call(*function, &[angle])
            }
            Sum(terms) => {
                let terms: Vec<_> = terms.iter().map(|term| (Number::ONE, self.build(term))).collect();
                self.graph.sum(&terms)
            }
            Product(factors) => {
                let factors: Vec<_> = factors.iter().map(|factor| (self.build(factor), 1)).collect();
                self.graph.product(&factors)
            }
            Quotient(above, below) => {
                let (above, below) = (self.build(above), self.build(below));
                self.graph.divide(above, below)
            }
            Power(base, exponent) => {
                let base = self.build(base);
                self.graph.power(base, *exponent)
            }
        }
    }

    /// The largest relative difference of two expressions at some points, if they have values there.
    fn apart(&mut self, left: NodeId, right: NodeId) -> Option<f64> {
        let mut largest: f64 = 0.0;
        for point in 0..6 {
            let mut values = Vec::new();
            for (index, name) in (0_i32..).zip(LENGTHS.iter().chain(&ANGLES)) {
                let value = 0.4 + 0.73 * f64::from((index + 1) * (point + 2)).sin().abs() + 0.1 * f64::from(index);
                values.push((self.symbol(name), value));
            }
            let bind = |symbol| values.iter().find(|(name, _)| *name == symbol).map_or(f64::NAN, |(_, value)| *value);
            let [x, y] = self.graph.evaluate(&[left, right], bind)[..] else { return None };
            if !x.is_finite() || !y.is_finite() || x.abs().max(y.abs()) > 1e6 {
                return None;
            }
            largest = largest.max((x - y).abs() / (1.0 + x.abs().max(y.abs())));
        }
        Some(largest)
    }
}

#[test]
fn true_identities() {
    let mut source = Source(SmallRng::seed_from_u64(linkage_trials::seed(1729)));
    let (mut proved, mut alike) = (0, 0);
    while proved < CASES {
        let mut formulas = Formulas::default();
        let expression = source.expression(2);
        let rewritten = source.rewrite(&expression);
        let (left, right) = (formulas.build(&expression), formulas.build(&rewritten));
        // Skip zero divisors, and pairs that are the same node.
        if formulas.graph.take_fault().is_some() {
            continue;
        }
        if left == right {
            alike += 1;
            continue;
        }
        let Some(apart) = formulas.apart(left, right) else { continue };
        assert!(
            apart < 1e-6,
            "the rewriting is wrong: {} and {}",
            formulas.graph.text(left),
            formulas.graph.text(right)
        );
        let answer = compare(&formulas.graph, left, right);
        assert_eq!(answer, Answer::Equal, "{expression:?} = {rewritten:?}");
        proved += 1;
    }
    assert!(alike < CASES / 2, "{alike} pairs were one node");
}

#[test]
fn false_identities() {
    let mut source = Source(SmallRng::seed_from_u64(linkage_trials::seed(1089)));
    let mut refuted = 0;
    while refuted < CASES {
        let mut formulas = Formulas::default();
        let expression = source.expression(2);
        let spoiled = source.spoil(&expression);
        let rewritten = source.rewrite(&spoiled);
        let (left, right) = (formulas.build(&expression), formulas.build(&rewritten));
        if formulas.graph.take_fault().is_some() || formulas.apart(left, right).is_none_or(|apart| apart < 1e-6) {
            continue;
        }
        let answer = compare(&formulas.graph, left, right);
        assert_eq!(answer, Answer::Different, "{expression:?} = {rewritten:?}");
        refuted += 1;
    }
}
