//! The closed forms of the documents, computed formula by formula: they satisfy the constraint equations on both branches.

use std::collections::BTreeMap;

use linkage_compiler::derivation::{ClosedForm, Derivation};
use linkage_compiler::graph::{Function, Graph, Node, NodeId, SymbolId};
use linkage_compiler::{derive, read};

/// Unknowns, statements, and the roots of each group.
const MECHANISMS: [(&str, &str, &[bool]); 11] = [
    ("u, v", "loop a@w + b@u + c@v = d@0;", &[true]),
    ("u, v", "loop a@w + b@u = d@0 + c@v;", &[true]),
    ("u, v", "loop a@w + b@u + c@(v + u) = d@0;", &[true]),
    ("u, s", "loop a@w + b@u = s@delta + e@90deg;", &[true]),
    ("s, u", "loop a@w + s@u + e@(u + 90deg) = d@0;", &[true]),
    ("u, s", "loop a@w + s@(u + delta) = d@0 + e@u;", &[true]),
    ("s, p", "loop a@w = s@delta + p@eps;", &[false]),
    ("u", "equation b*sin(u) + e*cos(u) = a*sin(w);", &[true]),
    ("s", "equation c*s + a*w = d;", &[false]),
    // One group after the other.
    ("u, v, p, q", "loop a@w + b@u = d@0 + c@v; loop c@v + b@p = d@delta + b@q;", &[true, true]),
    ("s, u, v", "equation s = d + e*sin(w); loop s@w + b@u + c@v = d@0;", &[false, true]),
];

/// The values of a position, formula by formula.
struct Values<'a> {
    graph: &'a Graph,
    of: BTreeMap<SymbolId, f64>,
}

impl Values<'_> {
    fn value(&self, node: NodeId) -> f64 {
        self.graph.evaluate(&[node], |symbol| self.of.get(&symbol).copied().unwrap_or(f64::NAN))[0]
    }

    fn symbol(&self, node: NodeId) -> SymbolId {
        self.graph.as_symbol(node).expect("a symbol")
    }

    /// Solves all equations of a group; the root has this sign.
    fn solve(&mut self, form: &ClosedForm, sign: f64) {
        let mut cosine = f64::NAN;
        for &[left, right] in &form.equations {
            let value = self.value(right);
            let names = |node| {
                self.graph
                    .symbols_of(&[node])
                    .into_iter()
                    .map(|symbol| self.graph.symbol_name(symbol))
                    .collect::<Vec<_>>()
            };
            assert!(!value.is_nan(), "{:?} is in terms of those before it: {:?}", names(left), names(right));
            match self.graph.node(left) {
                Node::Symbol(symbol) => {
                    self.of.insert(*symbol, value);
                }
                Node::Call(Function::Cos, _) => cosine = value,
                Node::Call(Function::Sin, angle) => {
                    assert!((value.hypot(cosine) - 1.0).abs() < 1e-14, "a direction has the length 1");
                    self.of.insert(self.symbol(angle[0]), value.atan2(cosine));
                }
                Node::Product { factors, .. } => {
                    let &[(base, 2)] = factors.as_slice() else { panic!("{factors:?}") };
                    let is_root = form.root.is_some_and(|(root, _)| root == base);
                    self.of.insert(self.symbol(base), if is_root { sign } else { 1.0 } * value.sqrt());
                }
                node => panic!("{node:?}"),
            }
        }
    }
}

fn derivation(unknowns: &str, statements: &str) -> Derivation {
    let words: Vec<&str> = statements.split(|c: char| !c.is_alphanumeric()).collect();
    let parameters = ["a", "b", "c", "d", "e", "delta", "eps"].into_iter().filter(|name| words.contains(name));
    let parameters = parameters.collect::<Vec<_>>().join(", ");
    let source = format!("mechanism M {{ param {parameters}; input w; unknown {unknowns}; {statements} }}");
    derive(&read(source.parse().unwrap()).unwrap_or_else(|errors| panic!("{source}: {errors:?}"))[0]).remove(0)
}

/// A crank-rocker, and guides in two directions.
fn given(name: &str) -> f64 {
    match name {
        "a" => 1.0,
        "b" => 3.5,
        "c" => 3.0,
        "d" => 4.0,
        "e" => 0.25,
        "delta" => 0.3,
        "eps" => 1.4,
        "w" => 0.8,
        _ => f64::NAN,
    }
}

#[test]
fn closed_forms_solve_the_equations_on_both_branches() {
    for (unknowns, statements, roots) in MECHANISMS {
        let mut derivation = derivation(unknowns, statements);
        let assembly = derivation.assembly();
        let forms = derivation.closed_forms(&assembly);
        let found: Vec<bool> = forms.iter().map(|form| form.root.is_some()).collect();
        assert_eq!(found, roots, "{statements}");
        for sign in [1.0, -1.0] {
            let graph = &derivation.graph;
            let symbols = graph.symbols_of(&derivation.residual);
            let known = symbols.into_iter().map(|symbol| (symbol, given(graph.symbol_name(symbol))));
            let of = known.filter(|(_, value)| !value.is_nan()).collect();
            let mut values = Values { graph, of };
            for form in &forms {
                assert!(!form.equations.is_empty(), "{statements}");
                values.solve(form, sign);
            }
            for &row in &derivation.residual {
                let residual = values.value(row);
                assert!(residual.abs() < 1e-14, "{statements}: {residual}");
            }
            // The sign of the determinant is that of the branch.
            for chord in &assembly.chords {
                let determinant = values.value(derivation.groups[chord.group].determinant.unwrap().value);
                let expected = if chord.is_opposite { -sign } else { sign };
                assert_eq!(determinant.signum(), expected, "{statements}");
            }
        }
    }
}

/// Letters of the mechanism keep their meaning.
#[test]
fn letters_of_the_mechanism_are_left_alone() {
    let source =
        "mechanism M { param kappa1, b, c, Delta; input w; unknown u, v; loop kappa1@w + b@u + c@v = Delta@0; }";
    let mut derivation = derive(&read(source.parse().unwrap()).unwrap()[0]).remove(0);
    let assembly = derivation.assembly();
    let forms = derivation.closed_forms(&assembly);
    let left: Vec<NodeId> = forms.iter().flat_map(|form| &form.equations).map(|[left, _]| *left).collect();
    let names =
        |node| derivation.graph.symbols_of(&[node]).into_iter().map(|symbol| derivation.graph.symbol_name(symbol));
    let names: Vec<&str> = left.into_iter().flat_map(names).collect();
    let links = ["x_u", "y_u", "x_v", "y_v", "v", "v", "u", "u"];
    assert_eq!(names[..6], ["rho_x", "rho_y", "rho", "chi", "tau_x", "tau_y"]);
    assert_eq!(names[6..], links);
}

/// Newton's method has no formulas.
#[test]
fn groups_without_closed_form_have_no_equations() {
    let mut derivation = derivation("s", "equation s + e*sin(s) = a*w;");
    let assembly = derivation.assembly();
    let forms = derivation.closed_forms(&assembly);
    assert!(forms.iter().all(|form| form.equations.is_empty() && form.root.is_none()));
}
