//! The functions of a mechanism: one kernel each, in the order in which a mechanic derives them.

mod acceleration;
mod assemble;
mod block;
mod body;
mod branch;
mod closures;
mod comments;
mod contacts;
mod external;
mod jerk;
mod limits;
mod motion;
mod position;
mod quantities;
mod ratio_derivatives;
mod scene;
mod sensitivity;
mod signature;
mod unreduced;
mod velocity;

use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use proc_macro2::{Delimiter, Ident, TokenStream};
use quote::quote;

use super::kernel::{self, Code, Given, Operand, Shape, Source};
use super::names::{Scope, ident};
use super::pose::PosePlan;
use super::tokens::Tokens;
use super::types::{self, field};
use super::{Emitted, Types, document};
use crate::derivation::{Derivation, Form, Formulas, QuantityFormulas};
use crate::graph::{ExternalId, NodeId, SymbolId, Texts};
use crate::lower::{Operations, Stage};
use crate::model::{Driver, Mechanism, Request};
use body::{Body, argument_of, bind, check_finite, columns_of, in_parts, literal, member, pose_members};
pub(in crate::emit) use branch::{AngleTurn, Branches};
use comments::{count, fenced, lines, without_result};
pub(in crate::emit) use scene::of_scene;
use signature::Words;

/// The name of an argument, beside which no name of the user's may stand.
pub(super) fn argument(mechanism: &Mechanism, wish: &str) -> String {
    let mut name = wish.to_owned();
    let parameters = mechanism.parameters.iter().chain(&mechanism.scene_parameters);
    let parameters = parameters.map(|parameter| &parameter.name.field);
    let all: Vec<&String> =
        parameters.chain(mechanism.coordinates.iter().map(|coordinate| &coordinate.name.field)).collect();
    while all.contains(&&name) {
        name.push('_');
    }
    name
}

/// The arguments that functions have in common.
#[derive(Clone)]
struct Arguments {
    pose: Ident,
    q: Ident,
    rate: Ident,
    acceleration: Ident,
    jerk: Ident,
    right: Ident,
    branch: Ident,
    turn: Ident,
    inputs: Ident,
    guess: Ident,
}

struct Methods<'a> {
    mechanism: &'a Mechanism,
    driver: &'a Driver,
    types: &'a Types,
    arguments: Arguments,
    words: Words,
    /// Names that kernels must not give to values of their own.
    scope: Rc<Scope>,
    named: Vec<(NodeId, String)>,
    functions: Tokens,
    /// The members of a branch.
    branches: Option<Branches>,
    /// Whether every group has one.
    is_assembled: bool,
    /// What each function does, by its name.
    kernels: Vec<(String, Operations)>,
    /// What the functions written so far use of the runtime.
    uses: BTreeSet<&'static str>,
    /// The functions of the user's that they call.
    externals: BTreeSet<ExternalId>,
}

impl<'a> Methods<'a> {
    /// Beside the arguments no value may be called like `field`.
    fn new(mechanism: &'a Mechanism, driver: &'a Driver, types: &'a Types, field: Option<&Ident>) -> Self {
        let name = |wish: &str| ident(&argument(mechanism, wish));
        let arguments = Arguments {
            pose: name("pose"),
            q: name("q"),
            rate: name("rate"),
            acceleration: name("acceleration"),
            jerk: name("jerk"),
            right: name("right"),
            branch: name("branch"),
            turn: name("turn"),
            inputs: name("inputs"),
            guess: name("guess"),
        };
        let reserved = [
            &arguments.pose,
            &arguments.q,
            &arguments.rate,
            &arguments.acceleration,
            &arguments.jerk,
            &arguments.right,
            &arguments.branch,
            &arguments.turn,
            &arguments.inputs,
            &arguments.guess,
        ];
        let reserved = reserved.into_iter().chain(field).map(ToString::to_string);
        let scope = Rc::new(Scope::new(reserved));
        Self {
            mechanism,
            driver,
            types,
            arguments,
            words: Words::new(),
            scope,
            named: mechanism.named.clone(),
            functions: Tokens::default(),
            branches: None,
            is_assembled: false,
            kernels: Vec::new(),
            uses: BTreeSet::new(),
            externals: BTreeSet::new(),
        }
    }
}

/// The `impl` blocks of one driver; without a derivation every body is left open.
pub(super) fn of_driver(
    mechanism: &Mechanism,
    driver: &Driver,
    types: &Types,
    plan: Option<&PosePlan>,
    mut derivation: Option<&mut Derivation>,
    private: &TokenStream,
) -> Emitted {
    let mut methods = Methods::new(mechanism, driver, types, None);
    let formulas = derivation.as_deref_mut().map(Formulas::new);
    let mut kernels = derivation.as_deref_mut().zip(plan).map(|(derivation, plan)| Kernels::new(derivation, plan));
    if let Some(kernels) = &kernels {
        methods.name_points(kernels.derivation);
    }
    methods.position(kernels.as_mut());
    methods.assemble(kernels.as_mut());
    let wanted = |request| mechanism.requests.contains(&request);
    if wanted(Request::Limits) {
        methods.limits(kernels.as_mut());
    }
    methods.closures(kernels.as_mut());
    methods.velocity(kernels.as_mut(), formulas.as_ref());
    methods.acceleration(kernels.as_mut());
    if wanted(Request::Jerk) {
        methods.jerk(kernels.as_mut());
    }
    methods.quantities(kernels.as_mut(), formulas.as_ref(), Family::Points);
    methods.quantities(kernels.as_mut(), formulas.as_ref(), Family::Outputs);
    methods.motion(kernels.as_mut());
    if wanted(Request::VelocityRatioDerivatives) {
        methods.ratio_derivatives(kernels.as_mut(), formulas.as_ref());
    }
    if wanted(Request::Sensitivity) {
        methods.sensitivity(kernels.as_mut(), formulas.as_ref());
    }
    let mut tokens = methods.block(kernels.as_ref(), private);
    tokens.extend(methods.calls(private));
    if let Some(branches) = &methods.branches {
        tokens.extend(types::branch(mechanism, types, branches, methods.is_assembled, private));
    }
    if let Some((derivation, formulas)) = derivation.zip(formulas) {
        tokens.extend(document::constant(mechanism, driver, derivation, &formulas, &methods.kernels, private));
    }
    let operations = methods.kernels.iter().fold(Operations::default(), |sum, (_, kernel)| sum.plus(*kernel));
    Emitted { tokens, operations }
}

/// A derivation and the pose planned for it.
struct Kernels<'a> {
    derivation: &'a mut Derivation,
    plan: &'a PosePlan,
    /// The formulas written so far.
    texts: RefCell<Texts>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Family {
    Points,
    Outputs,
}

impl Formulas {
    fn of(&self, family: Family) -> &[QuantityFormulas] {
        match family {
            Family::Points => &self.points,
            Family::Outputs => &self.outputs,
        }
    }
}

impl<'a> Kernels<'a> {
    fn new(derivation: &'a mut Derivation, plan: &'a PosePlan) -> Self {
        Self { derivation, plan, texts: RefCell::default() }
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

    /// Stages that name W.
    fn ratio_stages(&mut self) -> Vec<Stage> {
        let ratios = self.derivation.ratios.clone();
        let systems: Vec<_> =
            ratios.into_iter().enumerate().map(|(input, ratios)| (self.derivation.ratio_side(input), ratios)).collect();
        self.derivation.solution(&systems, Form::Factored)
    }

    /// Without a pose the determinants are computed where they are judged.
    fn with_determinants(&self, stages: Vec<Stage>) -> Vec<Stage> {
        let with = |stage: Stage| {
            let block = if let Stage::Guard { block, .. } = stage { Some(block) } else { None };
            let determinant = block.and_then(|block| self.derivation.blocks[block].determinant);
            let named = determinant.map(|d| Stage::Let { symbol: d.symbol, node: d.value });
            named.into_iter().chain([stage])
        };
        stages.into_iter().flat_map(with).collect()
    }

    /// The results to be checked where some are the user's own, in the order of the coordinates: the unknowns, and
    /// the inputs that are in no closure. Rates of unknowns are sums of multiples of the rates of the other inputs,
    /// so that they are not finite where those are not.
    fn checked(&self, results: &[Operand]) -> Vec<Operand> {
        let (derivation, rows) = (&self.derivation, self.derivation.jacobian_inputs());
        let is_idle = |place: usize| {
            let mut entries = rows.iter().filter_map(|row| row.get(&place));
            entries.all(|&entry| derivation.graph.is_zero(entry))
        };
        let idle = derivation.inputs.iter().enumerate().filter(|(place, _)| is_idle(*place));
        let checked = derivation.unknowns.iter().chain(idle.map(|(_, index)| index));
        checked.map(|&index| results[index].clone()).collect()
    }

    fn text(&self, node: NodeId) -> String {
        self.texts.borrow_mut().of(&self.derivation.graph, node).to_owned()
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
            name(&quantity.jerk, declared, "_jerk");
        }
        for (quantity, declared) in derivation.outputs.iter().zip(self.mechanism.outputs.iter().map(|o| &o.name.field))
        {
            name(&quantity.value, declared, "");
            name(&quantity.rate, declared, "_rate");
        }
    }

    // Sources of symbols.

    fn parameters(&self) -> Source<'_> {
        let fields = self.mechanism.parameters.iter().map(|p| (Cow::from(&p.name.field), p.symbol)).collect();
        Source {
            argument: None,
            from: Tokens::behind(&self.words.own),
            of: Shape::Fields(Tokens::name(&self.words.own_type)),
            fields,
        }
    }

    fn pose_source<'k>(&self, kernels: &'k Kernels) -> Source<'k> {
        let mut fields: Vec<_> =
            kernels.plan.values.iter().map(|(_, field, symbol)| (Cow::from(field), *symbol)).collect();
        fields.extend(kernels.plan.determinants.iter().map(|(_, field, symbol)| (Cow::from(field), *symbol)));
        fields.extend(kernels.plan.externals.iter().map(|(_, field, symbol)| (Cow::from(field), *symbol)));
        // Directions are fields as well, so that the pattern is never complete.
        fields.extend(kernels.plan.directions.values().map(|field| (Cow::from(field), SymbolId::NONE)));
        let (pose, of) = (&self.arguments.pose, &self.types.pose);
        Source { argument: Some(pose.clone()), from: Tokens::behind(pose), of: Shape::Fields(Tokens::name(of)), fields }
    }

    fn coordinates<'k>(
        &self,
        kernels: &'k Kernels,
        from: &Ident,
        symbol: fn(&crate::derivation::Coordinate) -> SymbolId,
    ) -> Source<'k> {
        let fields = kernels.derivation.coordinates.iter().map(|c| (Cow::from(&c.name), symbol(c))).collect();
        let of = &self.types.coordinates;
        Source { argument: Some(from.clone()), from: Tokens::behind(from), of: Shape::Fields(Tokens::name(of)), fields }
    }

    fn inputs<'k>(
        &self,
        kernels: &'k Kernels,
        from: &Ident,
        symbol: fn(&crate::derivation::Coordinate) -> SymbolId,
    ) -> Source<'k> {
        let fields = kernels
            .derivation
            .inputs
            .iter()
            .map(|&index| &kernels.derivation.coordinates[index])
            .map(|c| (Cow::from(&c.name), symbol(c)))
            .collect();
        let of = &self.types.inputs;
        Source {
            argument: Some(from.clone()),
            from: quote!(#from.into()).into(),
            of: Shape::Fields(Tokens::name(of)),
            fields,
        }
    }

    /// The start of a kernel that assembles nothing.
    fn given<'k>(&'k self, sources: Vec<Source<'k>>, pose: Option<&'k PosePlan>) -> Given<'k> {
        let Arguments { branch, turn, .. } = &self.arguments;
        Given { sources, pose, branch, turn, turns: BTreeMap::new(), dyads: Vec::new() }
    }

    /// A kernel on a pose and what else it is given.
    fn on_pose<'k>(&'k self, kernels: &'k Kernels, sources: Vec<Source<'k>>, stages: &[Stage]) -> Code {
        let mut all = vec![self.parameters(), self.pose_source(kernels)];
        all.extend(sources);
        let given = self.given(all, Some(kernels.plan));
        kernel::write(kernels.derivation, &given, stages, &self.named, &self.scope)
    }

    // Functions.

    /// Writes a function; without a body it is a stub that only has the right signature.
    fn function(&mut self, docs: &[String], signature: impl Into<Tokens>, body: Option<Body>) {
        let Body { tokens: body, operations, uses, externals, .. } = body.unwrap_or_else(|| Body {
            tokens: quote!(::core::unreachable!()).into(),
            operations: Operations::default(),
            arguments: Vec::new(),
            uses: BTreeSet::new(),
            externals: BTreeSet::new(),
        });
        let works = operations != Operations::default();
        let work = if works { format!("Operations: {}.", count(operations)) } else { String::new() };
        let mut tokens = Tokens::default();
        tokens.doc(docs, &work);
        tokens.join(signature.into());
        if works {
            self.kernels.push((tokens.name_of_function(), operations));
        }
        self.uses.extend(uses);
        self.externals.extend(externals);
        // A body in its braces is one token, however long.
        tokens.group(Delimiter::Brace, body);
        self.functions.join(tokens);
    }

    fn coordinate_fields(&self) -> Vec<Ident> {
        let order = self.mechanism.coordinate_order(self.driver);
        order.iter().map(|&index| field(&self.mechanism.coordinates[index].name)).collect()
    }
}
