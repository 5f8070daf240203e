//! The work of the emitted functions as counts of operations, which are the same on every machine.

use linkage_compiler::derivation::{Derivation, Form, Step};
use linkage_compiler::ids::Table;
use linkage_compiler::lower::schedule;
use linkage_compiler::program::{Given, Operations};
use linkage_gallery::{families, source};

use linkage_gallery::five_bar::*;
use linkage_gallery::norton_four_bar::*;

fn derivation(file: &str) -> Derivation {
    let mechanism = linkage_compiler::read(source::tokens_of(file)).expect(file).remove(0);
    linkage_compiler::derive(&mechanism).remove(0)
}

/// u' and u'' at given angles, every determinant as a product of stored sines and cosines, as other
/// generators write it.
fn velocity_and_acceleration_in_products(file: &str) -> Operations {
    let mut d = derivation(file);
    let (mut rates, mut accelerations) = (Table::default(), Table::default());
    for &unknown in &d.unknowns {
        rates.push(d.coordinates[unknown].rate);
        accelerations.push(d.coordinates[unknown].acceleration);
    }
    let (velocity, acceleration) = (d.velocity_side(), d.acceleration_side());
    let mut steps = Vec::new();
    for step in d.solution(&[(velocity, rates.clone()), (acceleration, accelerations.clone())], Form::Entries) {
        let Step::Guard { group, .. } = step else {
            steps.push(step);
            continue;
        };
        let group = d.groups[group].clone();
        let matrix = d.block_matrix(&group);
        let [[a, b], [c, e]] = [[matrix[0][0], matrix[0][1]], [matrix[1][0], matrix[1][1]]];
        let (ae, bc) = (d.graph.multiply(a, e), d.graph.multiply(b, c));
        let node = d.graph.subtract(ae, bc);
        steps.push(Step::Let { symbol: group.determinant.unwrap().symbol, node });
    }
    let results = rates.into_iter().chain(accelerations).map(|symbol| d.graph.variable(symbol));
    let results: Vec<_> = results.collect();
    schedule(&d.graph, &steps, &results, &Given::default(), &[], false).operations()
}

/// Multiplications / additions / divisions of other generators for the same four-bar: CasADi 38 / 11 / 4, SymPy's `cse`
/// 41 / 11 / 1, wrenfold 39 / 11 / 2.
#[test]
fn four_bar_in_products() {
    let found = velocity_and_acceleration_in_products("four_bar");
    println!("{found:?}");
    let limit = Operations { functions: 3, multiplications: 34, additions: 11, divisions: 1 };
    assert!(found.within(limit), "{found:?}");
}

/// For the same leg CasADi emits 176 / 61 / 20, wrenfold 249 / 59 / 10.
#[test]
fn jansen_in_products() {
    let found = velocity_and_acceleration_in_products("jansen");
    println!("{found:?}");
    let limit = Operations { functions: 11, multiplications: 180, additions: 61, divisions: 5 };
    assert!(found.within(limit), "{found:?}");
}

/// Calls of functions in position, velocity and acceleration together if no angle is asked for: sines with cosines,
/// roots, others.
fn calls(file: &str) -> [usize; 3] {
    let source = source::tokens_of(file).to_string();
    let silent = source.split_inclusive(';').filter(|statement| !statement.contains("output ")).collect::<String>();
    // The brace that closes the mechanism was removed with its last statement, if that was an output.
    let closing = if silent.trim_end().ends_with('}') { "" } else { "}" };
    let tokens = linkage_compiler::expand(format!("{silent}{closing}").parse().unwrap(), &"::linkage".parse().unwrap());
    let file: syn::File = syn::parse2(tokens).unwrap();
    let mut calls = [0; 3];
    syn::visit::visit_file(&mut Calls { within: false, calls: &mut calls }, &file);
    calls
}

struct Calls<'a> {
    within: bool,
    calls: &'a mut [usize; 3],
}

impl Calls<'_> {
    fn count(&mut self, name: &str) {
        let name = if name == "elbow_chord" { "chord" } else { name };
        let circular = ["sines_cosines", "sine", "cosine", "sin", "cos", "sin_cos"];
        let others = ["arctangent2", "sqrt", "hypotenuse", "arccosine"];
        let known: Vec<&str> = ["sine_cosine", "chord"].into_iter().chain(circular).chain(others).collect();
        match known.iter().position(|known| *known == name) {
            Some(place) if self.within => self.calls[place.min(2)] += 1,
            _ => {}
        }
    }
}

impl syn::visit::Visit<'_> for Calls<'_> {
    fn visit_impl_item_fn(&mut self, function: &syn::ImplItemFn) {
        self.within = ["assemble", "velocity", "acceleration"].iter().any(|name| function.sig.ident == name);
        syn::visit::visit_impl_item_fn(self, function);
        self.within = false;
    }

    fn visit_expr_method_call(&mut self, call: &syn::ExprMethodCall) {
        self.count(&call.method.to_string());
        syn::visit::visit_expr_method_call(self, call);
    }

    fn visit_expr_path(&mut self, path: &syn::ExprPath) {
        self.count(&path.path.segments.last().unwrap().ident.to_string());
    }
}

/// One sine and cosine for the crank and one root for each dyad are all the functions there are.
#[test]
fn a_cascade_of_dyads_needs_one_sine_and_a_root_each() {
    assert_eq!(calls("four_bar"), [1, 1, 0]);
    assert_eq!(calls("jansen"), [1, 5, 0]);
}

/// An unknown that is the cosine of an angle is computed once, together with the sine.
#[test]
fn an_unknown_may_be_a_cosine() {
    let source = "mechanism Odd { input theta; unknown y, z, w; equation y = sin(theta); equation z = cos(y); \
                  equation w = sin(y) + sin(z); }";
    let mechanism = linkage_compiler::read(source.parse().unwrap()).unwrap().remove(0);
    let text: String = linkage_compiler::programs(&mechanism).unwrap().concat();
    let position = text.split("\n\n").find(|function| function.starts_with("assemble(")).unwrap();
    let count = |what: &str| position.matches(what).count();
    assert_eq!([count(".sine_cosine()"), count("cos("), count("sin(")], [3, 0, 0], "{position}");
}

/// Nodes, operations of each kind and bytes of an expansion.
fn size(source: &str) -> [usize; 6] {
    let mechanism = linkage_compiler::read(source.parse().unwrap()).unwrap().remove(0);
    let expansion = linkage_compiler::compile(&mechanism, &"::linkage".parse().unwrap()).unwrap();
    let Operations { functions, divisions, multiplications, additions } = expansion.operations;
    [expansion.nodes, functions, divisions, multiplications, additions, expansion.tokens.to_string().len()]
}

/// The operations of one call of a function.
fn cost(derivation: &linkage::derivation::Derivation, function: &str) -> Operations {
    let kernel = derivation.kernels.iter().find(|kernel| kernel.function == function).expect(function);
    let linkage::derivation::Operations { functions, divisions, multiplications, additions } = kernel.operations;
    Operations { functions, divisions, multiplications, additions }
}

/// Each derivative alone, at given directions. By hand the jerk takes 10 multiplications for each link: x and y, the
/// square and the cube of its rate, 3 theta' theta'', and two for each row.
#[test]
fn higher_orders() {
    let limits = [
        (NortonFourBar::DERIVATION, "jerk", 39, 14),
        (NortonFourBar::DERIVATION, "velocity_ratio_derivatives", 25, 8),
        (NortonFourBar::DERIVATION, "sensitivity", 15, 3),
        (FiveBar::DERIVATION, "velocity_ratio_derivatives", 57, 20),
    ];
    for (derivation, function, multiplications, additions) in limits {
        let found = cost(derivation, function);
        println!("{function} {found:?}");
        let limit = Operations { functions: 0, divisions: 1, multiplications, additions };
        assert!(found.within(limit), "{function} {found:?}");
    }
}

/// Jerk and second derivatives of a chain are linear in its length; du/dp has an entry for every parameter of
/// each block before. What twice as many more loops cost: some 20 kB of text are the same for any length.
#[test]
fn higher_orders_of_a_chain() {
    let asking = |words: &str, loops| size(&families::chain(loops).replacen('{', &format!("{{ derive {words};"), 1));
    // Up to sixteen loops some texts are written out that longer chains do not have: constructors of branches, the list
    // of all branches, sensitivities in `DERIVATION`, the formula of the residual's rounding errors. Four more loops
    // after two more: 2 where that is linear, (24^2 - 20^2) / (20^2 - 18^2) = 2.32 where it is quadratic.
    for (words, most) in [("jerk, velocity_ratio_derivatives", 2.01), ("sensitivity", 2.32)] {
        let sizes = [18, 20, 24].map(|loops| asking(words, loops));
        for (kind, last) in sizes[2].iter().enumerate() {
            let [first, half, whole] = [sizes[0][kind], sizes[1][kind], *last];
            let ratio = (whole - half) as f64 / (half - first) as f64;
            println!("{words}: {first}, {half}, {whole}: {ratio:.3}");
            assert!((1.99..=most).contains(&ratio), "{words}: {first}, {half}, {whole}");
        }
    }
}

/// Solved as one block, a chain's Jacobian would cost the square of its length.
#[test]
fn a_chain_grows_linearly() {
    for (whole, half) in size(&families::chain(64)).into_iter().zip(size(&families::chain(32))) {
        let ratio = whole as f64 / half as f64;
        assert!((1.9..=2.1).contains(&ratio), "{half} became {whole}");
    }
}

/// Loops through every unknown have a Jacobian without zeros: the square of their number.
#[test]
fn dense_loops_grow_with_their_jacobian() {
    for (whole, half) in size(&families::dense(8)).into_iter().zip(size(&families::dense(4))) {
        assert!(whole as f64 <= 4.2 * half as f64, "{half} became {whole}");
    }
}
