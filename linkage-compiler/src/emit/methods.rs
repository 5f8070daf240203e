//! The functions of a mechanism: one kernel each, in the order in which a mechanic derives them.

use std::collections::BTreeSet;

use proc_macro2::{Delimiter, Group, Ident, Literal, TokenStream, TokenTree};
use quote::quote;

use super::Types;
use super::kernel::{self, Code, Given, Source};
use super::names::{RUNTIME_FUNCTIONS, ident, unique};
use super::pose::PosePlan;
use super::types::field;
use crate::derivation::{Derivation, Quantity, solve_closed};
use crate::graph::{NodeId, Number, SymbolId};
use crate::model::{Driver, Mechanism};
use crate::simplify::schedule::{Operations, Stage};

/// The name of an argument, beside which no name of the user's may stand.
pub(super) fn argument(mechanism: &Mechanism, wish: &str) -> String {
    let mut name = wish.to_owned();
    let parameters = mechanism.parameters.iter().map(|parameter| &parameter.name.field);
    let all: Vec<&String> =
        parameters.chain(mechanism.coordinates.iter().map(|coordinate| &coordinate.name.field)).collect();
    while all.contains(&&name) {
        name.push('_');
    }
    name
}

/// The arguments that functions have in common.
struct Arguments {
    pose: Ident,
    q: Ident,
    rate: Ident,
    acceleration: Ident,
    right: Ident,
}

struct Methods<'a> {
    mechanism: &'a Mechanism,
    driver: &'a Driver,
    types: &'a Types,
    arguments: Arguments,
    /// Names that kernels must not give to values of their own.
    reserved: Vec<String>,
    named: Vec<(NodeId, String)>,
    functions: TokenStream,
}

/// The `impl` blocks of one driver; without a derivation every body is left open.
pub(super) fn of_driver(
    mechanism: &Mechanism,
    driver: &Driver,
    types: &Types,
    plan: Option<&PosePlan>,
    derivation: Option<&mut Derivation>,
    private: &TokenStream,
) -> TokenStream {
    let name = |wish: &str| ident(&argument(mechanism, wish));
    let arguments = Arguments {
        pose: name("pose"),
        q: name("q"),
        rate: name("rate"),
        acceleration: name("acceleration"),
        right: name("right"),
    };
    let reserved = [&arguments.pose, &arguments.q, &arguments.rate, &arguments.acceleration, &arguments.right]
        .map(ToString::to_string)
        .to_vec();
    let mut methods = Methods {
        mechanism,
        driver,
        types,
        arguments,
        reserved,
        named: mechanism.named.clone(),
        functions: TokenStream::new(),
    };
    let mut kernels = derivation.zip(plan).map(|(derivation, plan)| Kernels::new(derivation, plan));
    if let Some(kernels) = &kernels {
        methods.name_points(kernels.derivation);
    }
    methods.position(kernels.as_mut());
    methods.closures(kernels.as_mut());
    methods.velocity(kernels.as_mut());
    methods.acceleration(kernels.as_mut());
    methods.quantities(kernels.as_mut(), Family::Points);
    methods.quantities(kernels.as_mut(), Family::Outputs);
    methods.motion(kernels.as_mut());
    methods.block(kernels.as_ref().map(|kernels| &*kernels.derivation), private)
}

/// A derivation and the pose planned for it.
struct Kernels<'a> {
    derivation: &'a mut Derivation,
    plan: &'a PosePlan,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Family {
    Points,
    Outputs,
}

impl<'a> Kernels<'a> {
    fn new(derivation: &'a mut Derivation, plan: &'a PosePlan) -> Self {
        Self { derivation, plan }
    }

    fn is_closed(&self) -> bool {
        self.derivation.determinant.is_some()
    }

    /// Stages that solve J x = right for each right side, after the verdict on J.
    fn solve(&mut self, systems: &[(Vec<NodeId>, Vec<SymbolId>)]) -> Vec<Stage> {
        let jacobian = self.derivation.jacobian_unknowns();
        let Some(determinant) = self.derivation.determinant else {
            let mut stages = vec![Stage::Factor { matrix: jacobian, sizes: self.derivation.sizes.clone() }];
            stages.extend(
                systems.iter().map(|(right, targets)| Stage::Solve { targets: targets.clone(), right: right.clone() }),
            );
            return stages;
        };
        // A determinant that is a number other than zero needs no verdict.
        let constant = self.derivation.graph.constant_value(determinant.value).is_some_and(|value| value != 0.0);
        let (node, mut stages) = if constant {
            (determinant.value, Vec::new())
        } else {
            let node = self.derivation.graph.variable(determinant.symbol);
            (node, vec![Stage::Guard { determinant: node, size: determinant.size }])
        };
        for (right, targets) in systems {
            let solution = solve_closed(&mut self.derivation.graph, &jacobian, node, right);
            stages.extend(targets.iter().zip(solution).map(|(&symbol, node)| Stage::Let { symbol, node }));
        }
        stages
    }

    fn rates(&self, of: &[usize]) -> Vec<SymbolId> {
        of.iter().map(|&index| self.derivation.coordinates[index].rate).collect()
    }

    fn accelerations(&self, of: &[usize]) -> Vec<SymbolId> {
        of.iter().map(|&index| self.derivation.coordinates[index].acceleration).collect()
    }

    fn variables(&mut self, symbols: &[SymbolId]) -> Vec<NodeId> {
        symbols.iter().map(|&symbol| self.derivation.graph.variable(symbol)).collect()
    }

    /// Names for W, by unknown and input.
    fn ratio_symbols(&mut self) -> Vec<Vec<SymbolId>> {
        let single = self.derivation.inputs.len() == 1;
        let inputs = self.derivation.inputs.clone();
        let unknowns = self.derivation.unknowns.clone();
        let mut columns = Vec::new();
        for input in inputs {
            let mut column = Vec::new();
            for &unknown in &unknowns {
                let (of, by) = (&self.derivation.coordinates[unknown].name, &self.derivation.coordinates[input].name);
                let name = if single { format!("{of}_ratio") } else { format!("{of}_by_{by}") };
                column.push(self.derivation.graph.symbol(name));
            }
            columns.push(column);
        }
        columns
    }

    fn ratio_stages(&mut self) -> (Vec<Stage>, Vec<Vec<SymbolId>>) {
        let symbols = self.ratio_symbols();
        let systems: Vec<_> = symbols
            .iter()
            .enumerate()
            .map(|(input, targets)| (self.derivation.ratio_side(input), targets.clone()))
            .collect();
        (self.solve(&systems), symbols)
    }

    fn text(&self, node: NodeId) -> String {
        self.derivation.graph.text(node)
    }
}

impl Methods<'_> {
    /// Partial results are called after the points and outputs that they are.
    fn name_points(&mut self, derivation: &Derivation) {
        let mut name = |nodes: &[NodeId], name: &str, suffix: &str| {
            let axes: &[&str] = if nodes.len() == 2 { &["_x", "_y"] } else { &[""] };
            self.named.extend(nodes.iter().zip(axes).map(|(&node, axis)| (node, format!("{name}{axis}{suffix}"))));
        };
        for (quantity, declared) in derivation.points.iter().zip(self.mechanism.points.iter().map(|p| &p.name.field)) {
            name(&quantity.value, declared, "");
            name(&quantity.rate, declared, "_rate");
            name(&quantity.acceleration, declared, "_acceleration");
        }
        for (quantity, declared) in derivation.outputs.iter().zip(self.mechanism.outputs.iter().map(|o| &o.name.field))
        {
            name(&quantity.value, declared, "");
            name(&quantity.rate, declared, "_rate");
        }
    }

    // Sources of symbols.

    fn parameters(&self) -> Source {
        let fields = self.mechanism.parameters.iter().map(|p| (p.name.field.clone(), p.symbol)).collect();
        Source { from: quote!(*self), of: Some(quote!(Self)), fields }
    }

    fn pose_source(&self, kernels: &Kernels) -> Source {
        let mut fields: Vec<_> =
            kernels.plan.values.iter().map(|(_, field, symbol)| (field.clone(), *symbol)).collect();
        fields.extend(
            kernels.derivation.determinant.iter().map(|determinant| ("determinant".to_owned(), determinant.symbol)),
        );
        // Directions are fields as well, so that the pattern is never complete.
        fields.extend(kernels.plan.directions.iter().map(|(_, field)| (field.clone(), SymbolId::NONE)));
        let (pose, of) = (&self.arguments.pose, &self.types.pose);
        Source { from: quote!(*#pose), of: Some(quote!(#of)), fields }
    }

    fn coordinates(
        &self,
        kernels: &Kernels,
        from: &TokenStream,
        symbol: fn(&crate::derivation::Coordinate) -> SymbolId,
    ) -> Source {
        let fields = kernels.derivation.coordinates.iter().map(|c| (c.name.clone(), symbol(c))).collect();
        let of = &self.types.coordinates;
        Source { from: from.clone(), of: Some(quote!(#of)), fields }
    }

    fn inputs(
        &self,
        kernels: &Kernels,
        from: &Ident,
        symbol: fn(&crate::derivation::Coordinate) -> SymbolId,
    ) -> Source {
        let fields = kernels
            .derivation
            .inputs
            .iter()
            .map(|&index| &kernels.derivation.coordinates[index])
            .map(|c| (c.name.clone(), symbol(c)))
            .collect();
        let of = &self.types.inputs;
        Source { from: quote!(#from.into()), of: Some(quote!(#of)), fields }
    }

    /// A kernel on a pose and what else it is given.
    fn on_pose(&self, kernels: &Kernels, sources: Vec<Source>, stages: &[Stage]) -> Code {
        let mut all = vec![self.parameters(), self.pose_source(kernels)];
        all.extend(sources);
        let given = Given { sources: all, pose: Some(kernels.plan) };
        kernel::write(kernels.derivation, &given, stages, &self.named, &self.reserved)
    }

    // Functions.

    fn function(
        &mut self,
        docs: &[String],
        operations: Option<Operations>,
        signature: &TokenStream,
        body: Option<TokenStream>,
    ) {
        let mut lines: Vec<String> =
            docs.iter().map(|line| if line.is_empty() { String::new() } else { format!(" {line}") }).collect();
        if let Some(operations) = operations.filter(|operations| *operations != Operations::default()) {
            lines.push(String::new());
            lines.push(format!(" Operations: {}.", count(operations)));
        }
        let body = body.unwrap_or_else(|| quote!(::core::unimplemented!()));
        let signature = without_unused(signature, &identifiers(&body), &self.reserved);
        self.functions.extend(quote! {
            #(#[doc = #lines])*
            #signature { #body }
        });
    }

    fn position(&mut self, kernels: Option<&mut Kernels>) {
        let Arguments { q, .. } = &self.arguments;
        let q = q.clone();
        let (coordinates, pose) = (&self.types.coordinates, &self.types.pose);
        let signature = quote!(fn pose_at(&self, #q: &#coordinates<T>) -> #pose<T>);
        let mut operations = None;
        let body = kernels.map(|kernels| {
            let mut stages = Vec::new();
            let values: Vec<NodeId> =
                kernels.derivation.determinant.iter().map(|determinant| determinant.value).collect();
            let angles: Vec<NodeId> = kernels.plan.angles().collect();
            let bare: Vec<SymbolId> = kernels.plan.values.iter().map(|(_, _, symbol)| *symbol).collect();
            let bare = kernels.variables(&bare);
            stages.push(Stage::Return(values.iter().chain(&angles).chain(&bare).copied().collect()));
            let sources = vec![self.parameters(), self.coordinates(kernels, &quote!(*#q), |c| c.value)];
            let given = Given { sources, pose: None };
            let code = kernel::write(kernels.derivation, &given, &stages, &self.named, &self.reserved);
            let circular = code.operations.functions + kernels.plan.directions.len();
            operations = Some(Operations { functions: circular, ..code.operations });
            let mut results = code.results.into_iter();
            let mut fields = TokenStream::new();
            if let (true, Some(value)) = (kernels.is_closed(), if values.is_empty() { None } else { results.next() }) {
                fields.extend(quote!(determinant: #value,));
            }
            for ((_, field), value) in kernels.plan.directions.iter().zip(results.by_ref()) {
                let field = ident(field);
                fields.extend(quote!(#field: direction(#value),));
            }
            for ((_, field, _), value) in kernels.plan.values.iter().zip(results) {
                let field = ident(field);
                let member = member(&field, &value);
                fields.extend(quote!(#member,));
            }
            let body = code.body;
            quote!(#body #pose { #fields })
        });
        let docs = ["The position at these coordinates, ready for use: one sine and cosine for each angle.".to_owned()];
        self.function(&docs, operations, &quote!(#[must_use] pub #signature), body);

        // The name of a function is never that of a `let`, so the trait's can be called beside it.
        let (guess, solution) = (quote!(&#coordinates<T>), quote!(Solution<#coordinates<T>>));
        let docs = [
            "The position near `guess` whose inputs are those of `guess`, by Newton's method.".to_owned(),
            String::new(),
            "# Errors".to_owned(),
            "`NotConverged` if no position is found, `NotFinite` if a number is not finite.".to_owned(),
        ];
        self.function(
            &docs,
            None,
            &quote!(pub fn solve(&self, guess: #guess) -> Result<#solution, Error>),
            Some(quote!(newton(self, guess))),
        );
    }

    fn matrix_function(
        &mut self,
        kernels: Option<&Kernels>,
        name: &str,
        docs: &[String],
        of: &TokenStream,
        rows: Option<Vec<Vec<NodeId>>>,
    ) {
        let (pose, pose_type) = (&self.arguments.pose, &self.types.pose);
        let function = ident(name);
        let signature = quote!(#[must_use] pub fn #function(&self, #pose: &#pose_type<T>) -> #of);
        let code = kernels.zip(rows).map(|(kernels, rows)| {
            let columns = rows.first().map_or(0, Vec::len);
            let flat: Vec<NodeId> = (0..columns).flat_map(|column| rows.iter().map(move |row| row[column])).collect();
            let code = self.on_pose(kernels, Vec::new(), &[Stage::Return(flat)]);
            let matrix = columns_of(&code.results, rows.len());
            let body = code.body;
            (quote!(#body #matrix), code.operations)
        });
        let (body, operations) = code.unzip();
        self.function(docs, operations, &signature, body);
    }

    fn closures(&mut self, kernels: Option<&mut Kernels>) {
        let kernels = kernels.as_deref();
        let (u, v) = (self.driver.unknowns.len(), self.driver.inputs.len());
        let (nu, nv) = (literal(u), literal(v));
        let nq = literal(u + v);
        let rows = |nodes: Option<&Vec<NodeId>>| nodes.map(|nodes| nodes.iter().map(|&node| vec![node]).collect());
        let formula = |nodes: Option<&Vec<NodeId>>, symbol: &str| -> Vec<String> {
            let (Some(kernels), Some(nodes)) = (kernels, nodes) else { return Vec::new() };
            let lines =
                nodes.iter().enumerate().map(|(row, &node)| format!("{symbol}_{} = {}", row + 1, kernels.text(node)));
            fenced(lines)
        };
        let derivation = kernels.map(|kernels| &*kernels.derivation);
        let residual = derivation.map(|derivation| &derivation.residual);
        let mut docs = vec!["The closures Psi(q), zero where the mechanism is closed.".to_owned()];
        docs.extend(formula(residual, "Psi"));
        self.matrix_function(kernels, "residual", &docs, &quote!(SVector<T, #nu>), rows(residual));
        let docs =
            ["The sum of the magnitudes of each closure's terms: what makes a residual small or large.".to_owned()];
        self.matrix_function(
            kernels,
            "closure_sizes",
            &docs,
            &quote!(SVector<T, #nu>),
            rows(derivation.map(|d| &d.sizes)),
        );

        let matrix = |kernels: &Kernels, rows: &[Vec<NodeId>], symbol: &str| -> Vec<String> {
            let entries =
                rows.iter().enumerate().flat_map(|(i, row)| row.iter().enumerate().map(move |(j, &node)| (i, j, node)));
            let shown = entries.filter(|(_, _, node)| !kernels.derivation.graph.is_zero(*node));
            fenced(shown.map(|(i, j, node)| format!("{symbol}_{}{} = {}", i + 1, j + 1, kernels.text(node))))
        };
        let list = |indices: &[usize]| -> String {
            let names: Vec<String> =
                indices.iter().map(|&index| format!("`{}`", self.mechanism.coordinates[index].name.text)).collect();
            names.join(", ")
        };
        let order = self.mechanism.coordinate_order(self.driver);
        let (unknowns, inputs, all) = (list(&self.driver.unknowns), list(&self.driver.inputs), list(&order));
        let full = derivation.map(|derivation| derivation.jacobian.clone());
        let j = derivation.map(Derivation::jacobian_unknowns);
        let a = derivation.map(Derivation::jacobian_inputs);
        let mut docs = vec![format!("The constraint Jacobian J = `Psi_u`; its columns are {unknowns}.")];
        docs.extend(kernels.zip(j.as_ref()).map(|(k, rows)| matrix(k, rows, "J")).unwrap_or_default());
        self.matrix_function(kernels, "jacobian_unknowns", &docs, &quote!(SMatrix<T, #nu, #nu>), j.clone());
        let mut docs = vec![format!("The constraint Jacobian of the inputs A = `Psi_v`; its columns are {inputs}.")];
        docs.extend(kernels.zip(a.as_ref()).map(|(k, rows)| matrix(k, rows, "A")).unwrap_or_default());
        self.matrix_function(kernels, "jacobian_inputs", &docs, &quote!(SMatrix<T, #nu, #nv>), a);
        let docs = [format!("The whole constraint Jacobian `Psi_q`; its columns are {all}.")];
        self.matrix_function(kernels, "jacobian", &docs, &quote!(SMatrix<T, #nu, #nq>), full);
        self.determinant(kernels, j);
    }

    fn determinant(&mut self, kernels: Option<&Kernels>, jacobian: Option<Vec<Vec<NodeId>>>) {
        let (pose, pose_type) = (self.arguments.pose.clone(), &self.types.pose);
        let signature = quote!(#[must_use] pub fn determinant(&self, #pose: &#pose_type<T>) -> T);
        let mut docs = vec!["det J, zero in the singular configurations.".to_owned()];
        let determinant = kernels.and_then(|kernels| kernels.derivation.determinant.map(|d| kernels.text(d.value)));
        let body = match (determinant, kernels.zip(jacobian)) {
            (Some(text), _) => {
                docs.extend(fenced([format!("det J = {text}")].into_iter()));
                Some(quote!(#pose.determinant))
            }
            (None, Some(_)) => {
                docs.push("Of a block of this size it is the product of the pivots of a factorisation.".to_owned());
                Some(quote!(product_of_pivots(self.jacobian_unknowns(#pose))))
            }
            (None, None) => None,
        };
        self.function(&docs, None, &signature, body);
    }

    fn velocity(&mut self, mut kernels: Option<&mut Kernels>) {
        let (u, v) = (self.driver.unknowns.len(), self.driver.inputs.len());
        let (nu, nv) = (literal(u), literal(v));
        let (pose, pose_type) = (self.arguments.pose.clone(), self.types.pose.clone());
        let (rate, right) = (self.arguments.rate.clone(), self.arguments.right.clone());
        let (inputs, coordinates) = (self.types.inputs.clone(), self.types.coordinates.clone());

        let code = kernels.as_deref_mut().map(|kernels| {
            let symbols: Vec<SymbolId> = kernels
                .derivation
                .unknowns
                .clone()
                .iter()
                .map(|&index| {
                    let name = format!("{}_part", kernels.derivation.coordinates[index].name);
                    kernels.derivation.graph.symbol(name)
                })
                .collect();
            let sides: Vec<SymbolId> =
                (0..u).map(|row| kernels.derivation.graph.symbol(format!("right_{}", row + 1))).collect();
            let side = kernels.variables(&sides);
            let mut stages = kernels.solve(&[(side, symbols.clone())]);
            stages.push(Stage::Return(kernels.variables(&symbols)));
            let fields = sides.iter().map(|&side| (String::new(), side)).collect();
            let source = Source { from: quote!(#right.data.0), of: None, fields };
            let code = self.on_pose(kernels, vec![source], &stages);
            let (results, body) = (code.results, code.body);
            (quote!(#body Ok(SVector::from([#(#results),*]))), code.operations)
        });
        let (body, operations) = code.unzip();
        let docs = lines(["The x of J x = `right`.", "", "# Errors", "`Singular` where J has no inverse."]);
        let signature = quote!(pub fn solve_jacobian(&self, #pose: &#pose_type<T>, #right: &SVector<T, #nu>) -> Result<SVector<T, #nu>, Error>);
        self.function(&docs, operations, &signature, body);

        let code = kernels.as_deref_mut().map(|kernels| {
            let (mut stages, symbols) = kernels.ratio_stages();
            let flat: Vec<SymbolId> = symbols.into_iter().flatten().collect();
            stages.push(Stage::Return(kernels.variables(&flat)));
            let code = self.on_pose(kernels, Vec::new(), &stages);
            let (matrix, body) = (columns_of(&code.results, u), code.body);
            (quote!(#body Ok(#matrix)), code.operations)
        });
        let (body, operations) = code.unzip();
        let meaning = if v == 1 {
            "The velocity ratios W = -J^-1 A with u' = W v'; for one input they are the transmission ratios."
        } else {
            "The velocity ratios W = -J^-1 A with u' = W v': the rate of each unknown for a unit rate of each input."
        };
        let docs = lines([meaning, "", "# Errors", "`Singular` where J has no inverse."]);
        let signature =
            quote!(pub fn velocity_ratios(&self, #pose: &#pose_type<T>) -> Result<SMatrix<T, #nu, #nv>, Error>);
        self.function(&docs, operations, &signature, body);

        let code = kernels.map(|kernels| {
            let (unknowns, all) = (kernels.derivation.unknowns.clone(), (0..u + v).collect::<Vec<_>>());
            let side = kernels.derivation.velocity_side();
            let mut stages = kernels.solve(&[(side, kernels.rates(&unknowns))]);
            stages.push(Stage::Return(kernels.variables(&kernels.rates(&all))));
            let sources = vec![self.inputs(kernels, &rate, |c| c.rate)];
            let code = self.on_pose(kernels, sources, &stages);
            let (fields, results, body) = (self.coordinate_fields(), code.results, code.body);
            let solved: Vec<_> = unknowns.iter().map(|&index| results[index].clone()).collect();
            let finite = check_finite("velocity", &solved);
            (quote!(#body #finite Ok(#coordinates { #(#fields: #results),* })), code.operations)
        });
        let (body, operations) = code.unzip();
        let docs = lines([
            "The velocity q' at the input rates v'.",
            "",
            "# Errors",
            "`Singular` where J has no inverse, `NotFinite` if a rate is not finite.",
        ]);
        let signature = quote!(pub fn velocity(&self, #pose: &#pose_type<T>, #rate: impl Into<#inputs<T>>) -> Result<#coordinates<T>, Error>);
        self.function(&docs, operations, &signature, body);
    }

    fn coordinate_fields(&self) -> Vec<Ident> {
        let order = self.mechanism.coordinate_order(self.driver);
        order.iter().map(|&index| field(&self.mechanism.coordinates[index].name)).collect()
    }

    fn acceleration(&mut self, kernels: Option<&mut Kernels>) {
        let (u, v) = (self.driver.unknowns.len(), self.driver.inputs.len());
        let nu = literal(u);
        let (pose, pose_type) = (self.arguments.pose.clone(), self.types.pose.clone());
        let (rate, acceleration) = (self.arguments.rate.clone(), self.arguments.acceleration.clone());
        let (inputs, coordinates) = (self.types.inputs.clone(), self.types.coordinates.clone());
        let mut docs = vec!["The quadratic velocity term gamma = `(Psi_q q')_q q'`.".to_owned()];
        let mut gamma = None;
        let mut code = None;
        if let Some(kernels) = kernels {
            let nodes = kernels.derivation.gamma.clone();
            docs.extend(fenced(
                nodes.iter().enumerate().map(|(row, &node)| format!("gamma_{} = {}", row + 1, kernels.text(node))),
            ));
            let rates =
                |methods: &Self, kernels: &Kernels| vec![methods.coordinates(kernels, &quote!(*#rate), |c| c.rate)];
            let written = self.on_pose(kernels, rates(self, kernels), &[Stage::Return(nodes)]);
            let (results, body) = (written.results, written.body);
            gamma = Some((quote!(#body SVector::from([#(#results),*])), written.operations));

            let (unknowns, all) = (kernels.derivation.unknowns.clone(), (0..u + v).collect::<Vec<_>>());
            let side = kernels.derivation.acceleration_side();
            let mut stages = kernels.solve(&[(side, kernels.accelerations(&unknowns))]);
            stages.push(Stage::Return(kernels.variables(&kernels.accelerations(&all))));
            let mut sources = rates(self, kernels);
            sources.push(self.inputs(kernels, &acceleration, |c| c.acceleration));
            let written = self.on_pose(kernels, sources, &stages);
            let (fields, results, body) = (self.coordinate_fields(), written.results, written.body);
            let solved: Vec<_> = unknowns.iter().map(|&index| results[index].clone()).collect();
            let finite = check_finite("acceleration", &solved);
            code = Some((quote!(#body #finite Ok(#coordinates { #(#fields: #results),* })), written.operations));
        }
        let (body, operations) = gamma.unzip();
        let signature =
            quote!(#[must_use] pub fn gamma(&self, #pose: &#pose_type<T>, #rate: &#coordinates<T>) -> SVector<T, #nu>);
        self.function(&docs, operations, &signature, body);
        let (body, operations) = code.unzip();
        let docs = lines([
            "The acceleration q'' at the velocity q' and the input accelerations v'': J u'' = -(A v'' + gamma).",
            "",
            "# Errors",
            "`Singular` where J has no inverse, `NotFinite` if a rate is not finite.",
        ]);
        let signature = quote!(pub fn acceleration(&self, #pose: &#pose_type<T>, #rate: &#coordinates<T>, #acceleration: impl Into<#inputs<T>>) -> Result<#coordinates<T>, Error>);
        self.function(&docs, operations, &signature, body);
    }

    fn quantities(&mut self, kernels: Option<&mut Kernels>, family: Family) {
        let (names, group, word) = match family {
            Family::Points => (
                self.mechanism.points.iter().map(|p| field(&p.name)).collect::<Vec<_>>(),
                self.types.points.clone(),
                "point",
            ),
            Family::Outputs => {
                (self.mechanism.outputs.iter().map(|o| field(&o.name)).collect(), self.types.outputs.clone(), "output")
            }
        };
        if names.is_empty() {
            return;
        }
        let (pose, pose_type) = (self.arguments.pose.clone(), self.types.pose.clone());
        let (rate, acceleration) = (self.arguments.rate.clone(), self.arguments.acceleration.clone());
        let coordinates = self.types.coordinates.clone();
        let v = self.driver.inputs.len();
        let nv = literal(v);
        let item = if family == Family::Points { quote!(Vector2<T>) } else { quote!(T) };
        let quantities = |kernels: &Kernels| -> Vec<Quantity> {
            match family {
                Family::Points => kernels.derivation.points.clone(),
                Family::Outputs => kernels.derivation.outputs.clone(),
            }
        };
        let dimension = if family == Family::Points { 2 } else { 1 };
        let rows = literal(dimension);
        let build = |results: &[TokenStream]| -> TokenStream {
            let values = results.chunks(dimension).map(|parts| match parts {
                [x, y] => quote!(Vector2::new(#x, #y)),
                parts => quote!(#(#parts)*),
            });
            let members = names.iter().zip(values).map(|(name, value)| member(name, &value));
            quote!(#group { #(#members),* })
        };
        let what = if family == Family::Points { "positions of the points" } else { "values of the outputs" };
        type Part = fn(&Quantity) -> &Vec<NodeId>;
        let kinds: [(String, String, usize, Part); 3] = [
            (format!("{word}s"), format!("The {what}."), 0, |quantity| &quantity.value),
            (format!("{word}_velocities"), format!("The rates of the {word}s at the velocity q'."), 1, |quantity| {
                &quantity.rate
            }),
            (
                format!("{word}_accelerations"),
                format!("The accelerations of the {word}s at the velocity q' and the acceleration q''."),
                2,
                |quantity| &quantity.acceleration,
            ),
        ];
        for (name, meaning, order, part) in kinds {
            let code = kernels.as_deref().map(|kernels| {
                let nodes: Vec<NodeId> =
                    quantities(kernels).iter().flat_map(|quantity| part(quantity).clone()).collect();
                let mut sources = Vec::new();
                if order > 0 {
                    sources.push(self.coordinates(kernels, &quote!(*#rate), |c| c.rate));
                }
                if order > 1 {
                    sources.push(self.coordinates(kernels, &quote!(*#acceleration), |c| c.acceleration));
                }
                let mut code = self.on_pose(kernels, sources, &[Stage::Return(nodes)]);
                let (bindings, results) = bind(
                    &code.results,
                    &component_names(&names, dimension, &["", "_rate", "_acceleration"][order..=order]),
                    &mut code.taken,
                );
                let (body, built, verdict) = (code.body, build(&results), check_finite(&name, &results));
                (quote!(#body #bindings #verdict Ok(#built)), code.operations)
            });
            let (body, operations) = code.unzip();
            let mut docs = vec![meaning];
            if order == 0
                && let Some(kernels) = kernels.as_deref()
            {
                let axes: &[&str] = if dimension == 2 { &[".x", ".y"] } else { &[""] };
                let list = quantities(kernels);
                let formulas = names.iter().zip(&list).flat_map(|(name, quantity)| {
                    axes.iter().zip(&quantity.value).map(move |(axis, &node)| (format!("{name}{axis}"), node))
                });
                docs.extend(fenced(formulas.map(|(name, node)| format!("{name} = {}", kernels.text(node)))));
            }
            docs.extend(lines(["", "# Errors", "`NotFinite` where a formula has no finite value."]));
            let function = ident(&name);
            let more = [quote!(, #rate: &#coordinates<T>), quote!(, #acceleration: &#coordinates<T>)];
            let more = &more[..order];
            let signature =
                quote!(pub fn #function(&self, #pose: &#pose_type<T> #(#more)*) -> Result<#group<#item>, Error>);
            self.function(&docs, operations, &signature, body);
        }
        // W_l = l_u W + l_v.
        let code = kernels.map(|kernels| {
            let (mut stages, symbols) = kernels.ratio_stages();
            let mut nodes = Vec::new();
            for quantity in quantities(kernels) {
                for (input, column) in symbols.iter().enumerate() {
                    for row in &quantity.jacobian {
                        let mut terms = vec![(Number::ONE, row[kernels.derivation.inputs[input]])];
                        for (position, &symbol) in column.iter().enumerate() {
                            let ratio = kernels.derivation.graph.variable(symbol);
                            let entry = row[kernels.derivation.unknowns[position]];
                            terms.push((Number::ONE, kernels.derivation.graph.multiply(entry, ratio)));
                        }
                        nodes.push(kernels.derivation.graph.sum(&terms));
                    }
                }
            }
            // Ratios that no point depends on need not be solved for in closed form.
            let used = kernels.derivation.graph.symbols_of(&nodes);
            stages.retain(|stage| !matches!(stage, Stage::Let { symbol, .. } if !used.contains(symbol)));
            stages.push(Stage::Return(nodes));
            let mut code = self.on_pose(kernels, Vec::new(), &stages);
            let (mut values, mut bindings, mut flat) = (Vec::new(), TokenStream::new(), Vec::new());
            for (name, parts) in names.iter().zip(code.results.chunks(dimension * v)) {
                let matrix = columns_of(parts, dimension);
                let ratio = ident(&unique(&mut code.taken, &format!("{name}_ratios")));
                bindings.extend(quote!(let #ratio = #matrix;));
                values.push(ratio.clone());
                flat.push(ratio);
            }
            let body = code.body;
            let checks = flat.iter().map(|ratio| quote!(finite_matrix(Self::NAME, #word, &#ratio)?;));
            (quote!(#body #bindings #(#checks)* Ok(#group { #(#names: #values),* })), code.operations)
        });
        let (body, operations) = code.unzip();
        let name = ident(&format!("{word}_ratios"));
        let docs = lines([
            &format!("The velocity ratios `W_l` of the {word}s: l' = `W_l` v'."),
            "",
            "# Errors",
            "`Singular` where J has no inverse, `NotFinite` where a formula has no finite value.",
        ]);
        let signature =
            quote!(pub fn #name(&self, #pose: &#pose_type<T>) -> Result<#group<SMatrix<T, #rows, #nv>>, Error>);
        self.function(&docs, operations, &signature, body);
    }

    fn motion(&mut self, kernels: Option<&mut Kernels>) {
        let Types { coordinates, inputs, motion, points, outputs, .. } = self.types;
        let Arguments { q, rate, acceleration, .. } = &self.arguments;
        let signature = quote!(pub fn motion(&self, #q: &#coordinates<T>, #rate: impl Into<#inputs<T>>, #acceleration: impl Into<#inputs<T>>) -> Result<#motion<T>, Error>);
        let code = kernels.map(|kernels| {
            let unknowns = kernels.derivation.unknowns.clone();
            let all: Vec<usize> = (0..kernels.derivation.coordinates.len()).collect();
            let sides = [
                (kernels.derivation.velocity_side(), kernels.rates(&unknowns)),
                (kernels.derivation.acceleration_side(), kernels.accelerations(&unknowns)),
            ];
            let mut stages = kernels.solve(&sides);
            if let (Some(Stage::Guard { .. }), Some(d)) = (stages.first(), kernels.derivation.determinant) {
                stages.insert(0, Stage::Let { symbol: d.symbol, node: d.value });
            }
            let mut nodes = kernels.variables(&kernels.rates(&all));
            nodes.extend(kernels.variables(&kernels.accelerations(&all)));
            let quantities: Vec<Quantity> = kernels.derivation.points.iter().chain(&kernels.derivation.outputs).cloned().collect();
            for quantity in &quantities {
                nodes.extend(quantity.value.iter().chain(&quantity.rate).chain(&quantity.acceleration));
            }
            stages.push(Stage::Return(nodes));
            let sources = vec![
                self.parameters(),
                self.coordinates(kernels, &quote!(*#q), |c| c.value),
                self.inputs(kernels, rate, |c| c.rate),
                self.inputs(kernels, acceleration, |c| c.acceleration),
            ];
            let given = Given { sources, pose: None };
            let mut code = kernel::write(kernels.derivation, &given, &stages, &self.named, &self.reserved);
            let fields = self.coordinate_fields();
            let count = fields.len();
            let (rates, rest) = code.results.split_at(count);
            let (accelerations, rest) = rest.split_at(count);
            let (point_parts, output_parts) = rest.split_at(6 * self.mechanism.points.len());
            let names: Vec<Ident> = self.mechanism.points.iter().map(|p| field(&p.name)).collect();
            let (mut bindings, mut checked) = (TokenStream::new(), Vec::new());
            let mut members = TokenStream::new();
            if !names.is_empty() {
                let wishes = component_names(&names, 2, &["", "_rate", "_acceleration"]);
                let (tokens, parts) = bind(point_parts, &wishes, &mut code.taken);
                bindings.extend(tokens);
                let values = parts.chunks(6).map(|p| {
                    let [x, y, u, v, a, b] = [0, 1, 2, 3, 4, 5].map(|index| &p[index]);
                    quote!(PointMotion { position: Vector2::new(#x, #y), velocity: Vector2::new(#u, #v), acceleration: Vector2::new(#a, #b) })
                });
                members.extend(quote!(points: #points { #(#names: #values),* },));
                checked.extend(parts.iter().cloned());
            }
            let names: Vec<Ident> = self.mechanism.outputs.iter().map(|o| field(&o.name)).collect();
            if !names.is_empty() {
                let wishes = component_names(&names, 1, &["", "_rate", "_acceleration"]);
                let (tokens, parts) = bind(output_parts, &wishes, &mut code.taken);
                bindings.extend(tokens);
                let values = parts.chunks(3).map(|p| {
                    let [value, rate, acceleration] = [0, 1, 2].map(|index| &p[index]);
                    quote!(OutputMotion { value: #value, velocity: #rate, acceleration: #acceleration })
                });
                members.extend(quote!(outputs: #outputs { #(#names: #values),* },));
                checked.extend(parts.iter().cloned());
            }
            let mut finite: Vec<TokenStream> = unknowns.iter().flat_map(|&index| [rates[index].clone(), accelerations[index].clone()]).collect();
            finite.extend(checked);
            let verdict = check_finite("motion", &finite);
            let body = code.body;
            (
                quote! {
                    #body
                    #bindings
                    #verdict
                    Ok(#motion {
                        position: *#q,
                        velocity: #coordinates { #(#fields: #rates),* },
                        acceleration: #coordinates { #(#fields: #accelerations),* },
                        #members
                    })
                },
                code.operations,
            )
        });
        let (body, operations) = code.unzip();
        let docs = lines([
            "Everything at once at coordinates that close the mechanism: velocity, acceleration, points and outputs,",
            "every shared subexpression computed once.",
            "",
            "# Errors",
            "`Singular` where J has no inverse, `NotFinite` where a formula has no finite value.",
        ]);
        self.function(&docs, operations, &signature, body);
    }

    /// The `impl` blocks, in a scope of their own for the names that they use.
    fn block(self, derivation: Option<&Derivation>, private: &TokenStream) -> TokenStream {
        let Types { driver, inputs, unknowns, pose, coordinates, .. } = self.types;
        let text = driver.to_string();
        let (u, v) = (self.driver.unknowns.len(), self.driver.inputs.len());
        let (nu, nv) = (literal(u), literal(v));
        let functions = &self.functions;
        let written = identifiers(functions);
        let imports = imports(&written);
        let members: Vec<Ident> =
            self.driver.unknowns.iter().map(|&index| field(&self.mechanism.coordinates[index].name)).collect();
        let rest = members.is_empty().then(|| quote!(..));
        let pose_coordinates = derivation.map(|derivation| self.pose_coordinates(derivation));
        quote! {
            const _: () = {
                use ::core::convert::{From, Into};
                use ::core::result::Result::{self, Ok};
                use #private::{#(#imports),*};
                impl<T: Real> #driver<T> {
                    /// The name of the mechanism, as errors give it.
                    pub const NAME: &'static str = #text;
                    #functions
                }
                #pose_coordinates
                impl<T: Real> Mechanism<T, #nu, #nv> for #driver<T> {
                    const NAME: &'static str = #text;
                    type Coordinates = #coordinates<T>;
                    type Inputs = #inputs<T>;
                    type Unknowns = #unknowns<T>;
                    type Pose = #pose<T>;
                    fn unknowns(q: &Self::Coordinates) -> SVector<T, #nu> {
                        #unknowns::from(q).into()
                    }
                    fn with_unknowns(q: &Self::Coordinates, unknowns: SVector<T, #nu>) -> Self::Coordinates {
                        let #unknowns { #(#members,)* #rest } = unknowns.into();
                        #coordinates { #(#members,)* ..*q }
                    }
                    fn pose_at(&self, q: &Self::Coordinates) -> Self::Pose {
                        self.pose_at(q)
                    }
                    fn residual(&self, pose: &Self::Pose) -> SVector<T, #nu> {
                        self.residual(pose)
                    }
                    fn closure_sizes(&self, pose: &Self::Pose) -> SVector<T, #nu> {
                        self.closure_sizes(pose)
                    }
                    fn jacobian_unknowns(&self, pose: &Self::Pose) -> SMatrix<T, #nu, #nu> {
                        self.jacobian_unknowns(pose)
                    }
                    fn jacobian_inputs(&self, pose: &Self::Pose) -> SMatrix<T, #nu, #nv> {
                        self.jacobian_inputs(pose)
                    }
                    fn determinant(&self, pose: &Self::Pose) -> T {
                        self.determinant(pose)
                    }
                    fn solve_jacobian(&self, pose: &Self::Pose, right: &SVector<T, #nu>) -> Result<SVector<T, #nu>, Error> {
                        self.solve_jacobian(pose, right)
                    }
                }
            };
        }
    }

    /// Angles on request: the coordinates of a pose.
    fn pose_coordinates(&self, derivation: &Derivation) -> TokenStream {
        let plan = PosePlan::new(derivation, self.arguments.pose.to_string());
        let Types { pose, coordinates, .. } = self.types;
        let fields = self.coordinate_fields();
        let values = derivation.coordinates.iter().enumerate().map(|(index, coordinate)| {
            match plan.values.iter().find(|(other, _, _)| *other == index) {
                Some((_, field, _)) => {
                    let field = ident(field);
                    quote!(self.#field)
                }
                None => {
                    let angle = plan
                        .directions
                        .iter()
                        .find(|(angle, _)| derivation.graph.as_symbol(*angle) == Some(coordinate.value));
                    let field = ident(angle.map_or("", |(_, field)| field));
                    quote!(self.#field.angle())
                }
            }
        });
        let values: Vec<_> = values.collect();
        quote! {
            impl<T: Real> #pose<T> {
                #[doc = " The coordinates of this position; an angle that is held as its direction alone comes out"]
                #[doc = " between -pi and pi, at the price of an arc tangent."]
                #[must_use]
                pub fn coordinates(&self) -> #coordinates<T> {
                    #coordinates { #(#fields: #values),* }
                }
            }
        }
    }
}

/// What the functions use of the runtime, in the order in which rustfmt sorts it.
fn imports(written: &BTreeSet<String>) -> Vec<Ident> {
    let always = ["Error", "Mechanism", "Real", "SMatrix", "SVector", "Solution"];
    let types = ["Factorization", "OutputMotion", "PointMotion", "Vector2"];
    let mut names: Vec<&str> = always.to_vec();
    names.extend(types.iter().filter(|name| written.contains(**name)));
    names.sort_unstable();
    names.extend(RUNTIME_FUNCTIONS.iter().filter(|name| written.contains(**name)));
    names.into_iter().map(ident).collect()
}

/// A signature whose arguments are marked as unused where they are.
fn without_unused(signature: &TokenStream, used: &BTreeSet<String>, arguments: &[String]) -> TokenStream {
    let tokens = signature.clone().into_iter().map(|token| match token {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Parenthesis => {
            let inside = group.stream().into_iter().map(|token| match token {
                TokenTree::Ident(name) if arguments.iter().any(|a| name == a) && !used.contains(&name.to_string()) => {
                    TokenTree::Ident(ident(&format!("_{name}")))
                }
                token => token,
            });
            TokenTree::Group(Group::new(Delimiter::Parenthesis, inside.collect()))
        }
        token => token,
    });
    tokens.collect()
}

/// Every identifier of emitted code.
fn identifiers(tokens: &TokenStream) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut streams = vec![tokens.clone()];
    while let Some(stream) = streams.pop() {
        for token in stream {
            match token {
                TokenTree::Group(group) => streams.push(group.stream()),
                TokenTree::Ident(ident) => drop(found.insert(ident.to_string())),
                TokenTree::Punct(_) | TokenTree::Literal(_) => {}
            }
        }
    }
    found
}

/// A size without suffix, as people write it.
fn literal(count: usize) -> Literal {
    Literal::usize_unsuffixed(count)
}

/// `name: value`, or `name` alone if the value is called so.
fn member(name: &Ident, value: &TokenStream) -> TokenStream {
    if *name == value.to_string() { quote!(#name) } else { quote!(#name: #value) }
}

fn lines<const N: usize>(lines: [&str; N]) -> Vec<String> {
    lines.map(str::to_owned).to_vec()
}

fn fenced(lines: impl Iterator<Item = String>) -> Vec<String> {
    let mut block = vec![String::new(), "```text".to_owned()];
    block.extend(lines);
    block.push("```".to_owned());
    block
}

fn count(operations: Operations) -> String {
    let Operations { multiplications, additions, divisions, functions } = operations;
    let parts = [
        (functions, "function", "functions"),
        (divisions, "division", "divisions"),
        (multiplications, "multiplication", "multiplications"),
        (additions, "addition", "additions"),
    ];
    let parts: Vec<String> = parts
        .into_iter()
        .filter(|(count, ..)| *count > 0)
        .map(|(count, one, many)| format!("{count} {}", if count == 1 { one } else { many }))
        .collect();
    parts.join(", ")
}

/// A matrix from its entries, column by column.
fn columns_of(entries: &[TokenStream], rows: usize) -> TokenStream {
    let columns = entries.chunks(rows).map(|column| quote!([#(#column),*]));
    quote!(SMatrix::from([#(#columns),*]))
}

/// The names of the components of points and outputs, in the order in which kernels return them.
fn component_names(names: &[Ident], dimension: usize, orders: &[&str]) -> Vec<String> {
    let axes: &[&str] = if dimension == 2 { &["_x", "_y"] } else { &[""] };
    let mut all = Vec::new();
    for name in names {
        for order in orders {
            all.extend(axes.iter().map(|axis| format!("{name}{axis}{order}")));
        }
    }
    all
}

/// Whether an expression is nought or one.
fn is_constant(value: &TokenStream) -> bool {
    let text = value.to_string();
    [quote!(T::zero()), quote!(T::one())].iter().any(|constant| constant.to_string() == text)
}

/// `finite(NAME, what, [values])?;`, each value once.
fn check_finite(what: &str, values: &[TokenStream]) -> TokenStream {
    let mut seen = BTreeSet::new();
    let values: Vec<_> = values.iter().filter(|value| !is_constant(value) && seen.insert(value.to_string())).collect();
    if values.is_empty() {
        return TokenStream::new();
    }
    quote!(finite(Self::NAME, #what, [#(#values),*])?;)
}

/// Gives a name to every result that is not one already.
fn bind(results: &[TokenStream], wishes: &[String], taken: &mut BTreeSet<String>) -> (TokenStream, Vec<TokenStream>) {
    let mut bindings = TokenStream::new();
    let mut names = Vec::new();
    for (result, wish) in results.iter().zip(wishes) {
        let text = result.to_string();
        if syn::parse_str::<Ident>(&text).is_ok() || is_constant(result) {
            names.push(result.clone());
        } else {
            let name = ident(&unique(taken, wish));
            bindings.extend(quote!(let #name = #result;));
            names.push(quote!(#name));
        }
    }
    (bindings, names)
}
