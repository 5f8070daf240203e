//! One kernel: what it is given, its stages, and the Rust that carries them out.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use proc_macro2::{Delimiter, Ident, Literal, TokenStream};
use quote::{ToTokens, quote};

use super::expression::{define, direction_name, signed};
use super::names::{Names, Scope, Taken, call_of, ident, string};
use super::pose::PosePlan;
use super::tokens::Tokens;
use crate::derivation::Derivation;
use crate::graph::{ExternalId, Function, NodeId, SymbolId};
use crate::lower::{self, ChordOf, Line, Operations, Schedule, Signed, Stage, Value, ValueId};

/// Where the symbols of a kernel come from: each source is a pattern that is written if any of its
/// fields is used.
pub(super) struct Source<'a> {
    /// The argument of the function, but for `self`.
    pub argument: Option<Ident>,
    /// The expression taken apart, such as `*rate`.
    pub from: Tokens,
    /// What holds them.
    pub of: Shape,
    /// The fields, and the symbols they are known by.
    pub fields: Vec<(Cow<'a, str>, SymbolId)>,
}

/// What is taken apart.
pub(super) enum Shape {
    /// The named fields of a type.
    Fields(Tokens),
    /// The columns of a matrix with as many rows.
    Columns(usize),
    /// Nothing: the argument is the symbol itself.
    Argument,
}

/// What a kernel starts from.
pub(super) struct Given<'a> {
    pub sources: Vec<Source<'a>>,
    /// The pose, if sines and cosines are given by one.
    pub pose: Option<&'a PosePlan>,
    /// The argument that says which solution of a group is meant.
    pub branch: &'a Ident,
    /// The argument that gives angles their turns, and the places of those that have one.
    pub turn: &'a Ident,
    pub turns: BTreeMap<SymbolId, usize>,
    /// The dyad, if there is one, whose solution has a result in the range of the scalar where its triangle is plain.
    pub dyads: Vec<Option<usize>>,
}

/// A value that a kernel returns.
#[derive(Clone)]
pub(super) enum Operand {
    Name(Ident),
    /// Nought or one.
    Constant(Tokens),
    Formula(Tokens),
}

impl ToTokens for Operand {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        match self {
            Self::Name(name) => name.to_tokens(tokens),
            Self::Constant(value) | Self::Formula(value) => value.to_tokens(tokens),
        }
    }
}

/// The lines of a kernel, the names of what it returns and the number of operations.
pub(super) struct Code {
    pub body: Tokens,
    pub results: Vec<Operand>,
    /// Which of them are finite in any case.
    pub proven: Vec<bool>,
    /// What says of a dyad whether its triangle is plain, where that is asked for.
    pub plain: BTreeMap<usize, Ident>,
    pub operations: Operations,
    /// The names that the body has given.
    pub taken: Taken,
    /// The arguments that the body uses.
    pub arguments: Vec<Ident>,
    /// What the body uses of the runtime.
    pub uses: BTreeSet<&'static str>,
    /// The functions of the user's that it calls.
    pub externals: BTreeSet<ExternalId>,
}

/// Writes a kernel. The last stage is the `Return`, whose values are given back as expressions.
pub(super) fn write(
    derivation: &Derivation,
    given: &Given,
    stages: &[Stage],
    named: &[(NodeId, String)],
    scope: &Rc<Scope>,
) -> Code {
    let nothing = lower::Given::default();
    let at_hand = given.pose.map_or(&nothing, |plan| &plan.given);
    let schedule = lower::schedule(&derivation.graph, stages, at_hand, named);
    let mut used = Vec::new();
    for &id in schedule.used() {
        if let Value::Symbol(symbol) = schedule.value(id) {
            used.push(*symbol);
        }
    }
    used.sort_unstable();
    let mut own = Vec::new();
    for stage in stages {
        own.append(&mut stage.introduced());
    }
    let mut symbols = Vec::new();
    for &symbol in &used {
        if !own.contains(&symbol) {
            symbols.push(symbol);
        }
    }
    let mut names = Names::new(&derivation.graph, scope);
    // In the order of their making: the user's own names come first and stay as they are.
    for &symbol in &symbols {
        names.introduce(symbol);
    }
    // Most lines name a product or a short sum.
    const LINE: usize = 12;
    let mut body = Tokens::with_room_for(LINE * (schedule.lines.len() + given.sources.len()));
    let mut arguments = Vec::new();
    let keyword = ident("let");
    for source in &given.sources {
        if pattern(&mut body, &keyword, source, &symbols, &names) {
            arguments.extend(source.argument.clone());
        }
    }
    if let Some(pose) = given.pose {
        arguments.extend(take_directions(&mut body, &keyword, pose, &schedule, &mut names));
    }
    let proven = match schedule.lines.last() {
        Some(Line::Return(values)) => schedule.proven(values),
        _ => Vec::new(),
    };
    let open = given.dyads.iter().zip(&proven).filter(|(_, proven)| !**proven);
    names.plain.extend(open.filter_map(|(dyad, _)| Some(((*dyad)?, ident("_")))));
    let mut results = Vec::new();
    let writer = Writer { given, derivation, schedule: &schedule, used: &used, keyword };
    for line in &schedule.lines {
        write_line(&writer, &mut body, line, &mut names, &mut results);
    }
    let mut uses = BTreeSet::new();
    for line in &schedule.lines {
        uses.extend(used_by(line));
    }
    uses.extend(names.takes_numbers().then_some("real"));
    let (externals, plain) = (std::mem::take(&mut names.externals), std::mem::take(&mut names.plain));
    Code {
        body,
        results,
        proven,
        plain,
        operations: schedule.operations(),
        taken: names.into_taken(),
        arguments,
        uses,
        externals,
    }
}

/// What a line uses of the runtime.
fn used_by(line: &Line) -> Option<&'static str> {
    match line {
        Line::Guard { .. } => Some("regular"),
        Line::Factor { .. } => Some("Factorization"),
        Line::Chord { of: ChordOf::Triangle { .. }, .. } => Some("elbow_chord"),
        Line::Chord { of: ChordOf::Reach { may_cancel: true, .. }, .. } => Some("reach_chord"),
        Line::Chord { .. } => Some("chord"),
        Line::Solvable { .. } => Some("solvable"),
        Line::Newton { .. } => Some("newton_group"),
        Line::Pivots { .. } => Some("product_of_pivots"),
        _ => None,
    }
}

/// `let Type { field, other: name, .. } = *value;` with the fields that are used; nothing if none is.
fn pattern(body: &mut Tokens, keyword: &Ident, source: &Source, used: &[SymbolId], names: &Names) -> bool {
    let is_used = |symbol: SymbolId| used.binary_search(&symbol).is_ok();
    let from = &source.from;
    let of = match &source.of {
        Shape::Fields(of) => of,
        Shape::Argument => return source.fields.iter().any(|(_, symbol)| is_used(*symbol)),
        Shape::Columns(rows) => {
            let local = |symbol: &SymbolId| {
                if is_used(*symbol) { names.symbol(*symbol) } else { ident("_") }
            };
            let parts: Vec<Ident> = source.fields.iter().map(|(_, symbol)| local(symbol)).collect();
            let columns = parts.chunks(*rows).map(|column| quote!([#(#column),*]));
            body.extend(quote!(let [#(#columns),*] = #from;));
            return true;
        }
    };
    let mut fields = Tokens::default();
    let mut count = 0;
    for (field, symbol) in source.fields.iter().filter(|(_, symbol)| is_used(*symbol)) {
        let name = names.symbol(*symbol);
        if name != field.as_ref() {
            fields.word(field);
            fields.punct(':');
        }
        fields.ident(&name);
        fields.punct(',');
        count += 1;
    }
    if count == 0 {
        return false;
    }
    if count < source.fields.len() {
        fields.extend(quote!(..));
    }
    body.ident(keyword);
    body.join(of.clone());
    body.group(Delimiter::Brace, fields);
    body.punct('=');
    body.join(from.clone());
    body.punct(';');
    true
}

/// `let (sin_theta, cos_theta) = (pose.theta.im, pose.theta.re);` for the directions that are used;
/// gives the argument if any is.
fn take_directions(
    body: &mut Tokens,
    keyword: &Ident,
    pose: &PosePlan,
    schedule: &Schedule,
    names: &mut Names,
) -> Option<Ident> {
    let mut used: Vec<(NodeId, Function, ValueId)> = Vec::new();
    for &id in schedule.used() {
        if let Value::Direction(function, angle) = schedule.value(id) {
            used.push((*angle, *function, id));
        }
    }
    if used.is_empty() {
        return None;
    }
    used.sort_unstable();
    let argument = ident(&pose.argument);
    let (sine, cosine) = (ident("im"), ident("re"));
    for parts in used.chunk_by(|one, other| one.0 == other.0) {
        let field = pose.direction(parts[0].0);
        let field_ident = ident(field);
        let (mut left, mut right) = (Tokens::default(), Tokens::default());
        for (place, &(_, function, id)) in parts.iter().enumerate() {
            if place > 0 {
                left.punct(',');
                right.punct(',');
            }
            left.append(names.give(id, &direction_name(function, field)));
            right.ident(&argument);
            right.punct('.');
            right.ident(&field_ident);
            right.punct('.');
            right.ident(if function == Function::Sin { &sine } else { &cosine });
        }
        body.ident(keyword);
        if parts.len() == 1 {
            body.join(left);
            body.punct('=');
            body.join(right);
        } else {
            body.group(Delimiter::Parenthesis, left);
            body.punct('=');
            body.group(Delimiter::Parenthesis, right);
        }
        body.punct(';');
    }
    Some(argument)
}

/// What the lines of a kernel refer to.
#[derive(Clone)]
struct Writer<'a> {
    given: &'a Given<'a>,
    derivation: &'a Derivation,
    schedule: &'a Schedule,
    /// The symbols that are used.
    used: &'a [SymbolId],
    /// `let`, which most lines begin with.
    keyword: Ident,
}

fn write_line(writer: &Writer, body: &mut Tokens, line: &Line, names: &mut Names, results: &mut Vec<Operand>) {
    let Writer { given, derivation, schedule, used, keyword } = writer;
    match line {
        Line::Let(id) => {
            // What a value is made of has names before it has one itself.
            let name = names.invent(schedule, *id);
            assign(body, keyword, &name, |body| define(body, names, schedule, *id));
        }
        Line::SineCosine { sine, cosine, angle } => {
            let argument = signed(names, schedule, *angle);
            let argument = if !angle.negative && names.get(schedule, angle.value).is_some() {
                argument.into()
            } else {
                quote!((#argument))
            };
            let (sine, cosine) = (names.invent(schedule, *sine), names.invent(schedule, *cosine));
            body.extend(quote!(let (#sine, #cosine) = #argument.sine_cosine();));
        }
        Line::SinesCosines(several) => {
            let angles: Vec<_> = several.iter().map(|one| signed(names, schedule, one.angle)).collect();
            let mut name =
                |value: Option<ValueId>| value.map_or_else(|| ident("_"), |value| names.invent(schedule, value));
            let pairs = several.iter().map(|one| {
                let (sine, cosine) = (name(one.sine), name(one.cosine));
                quote!((#sine, #cosine))
            });
            let pairs: Vec<_> = pairs.collect();
            body.extend(quote!(let [#(#pairs),*] = T::sines_cosines([#(#angles),*]);));
        }
        Line::External { function, arguments, values } => {
            let arguments: Vec<_> = arguments.iter().map(|value| signed(names, schedule, *value)).collect();
            let call = call_of(derivation.graph.external_names(*function));
            let mut name =
                |value: &Option<ValueId>| value.map_or_else(|| ident("_"), |value| names.invent(schedule, value));
            let values: Vec<_> = values.iter().map(&mut name).collect();
            let pattern = if let [only] = values.as_slice() { quote!(#only) } else { quote!((#(#values),*)) };
            body.extend(quote!(let #pattern = Self::#call(#(#arguments),*);));
            names.externals.insert(*function);
        }
        Line::Name { symbol, value } => {
            let number = matches!(schedule.value(value.value), Value::Constant(_));
            let fresh = !value.negative && !number && names.get(schedule, value.value).is_none();
            let definition = signed(names, schedule, *value);
            let name = names.introduce(*symbol);
            assign(body, keyword, &name.ident, |body| body.join(definition));
            if fresh {
                names.set(value.value, name);
            }
        }
        Line::Turn { symbol, principal } => {
            let principal = signed(names, schedule, *principal);
            let name = names.introduce(*symbol).ident.clone();
            let turn = given.turn;
            assign(body, keyword, &name, |body| match given.turns.get(symbol) {
                Some(&place) => {
                    let place = Literal::usize_unsuffixed(place);
                    body.extend(quote!(#turn.number(#place, #principal)));
                }
                None => body.join(principal),
            });
        }
        Line::Guard { block, determinant, size } => {
            let (determinant, size) = (signed(names, schedule, *determinant), signed(names, schedule, *size));
            let group = string(&derivation.blocks[*block].names(derivation));
            body.extend(quote!(regular(Self::NAME, #group, #determinant, #size)?;));
        }
        Line::Factor { block, matrix, sizes } => {
            let columns = columns(matrix, schedule, names);
            let sizes: Vec<_> = sizes.iter().map(|size| signed(names, schedule, *size)).collect();
            let factors = names.unique("factors");
            let ident = ident(&factors);
            names.factors.insert(*block, factors);
            let group = string(&derivation.blocks[*block].names(derivation));
            // Where nothing is solved for, the verdict is still wanted.
            let solves = |line: &Line| matches!(line, Line::Solve { block: other, .. } if other == block);
            let named = schedule.lines.iter().any(solves).then(|| quote!(let #ident =));
            body.extend(quote!(#named Factorization::new(Self::NAME, #group, [#(#columns),*], [#(#sizes),*])?;));
        }
        Line::Solve { block, targets, right } => {
            let right: Vec<_> = right.iter().map(|value| signed(names, schedule, *value)).collect();
            let targets: Vec<_> = targets
                .iter()
                .map(|target| {
                    if used.binary_search(target).is_ok() { names.introduce(*target).ident.clone() } else { ident("_") }
                })
                .collect();
            let factors = ident(&names.factors[block]);
            body.extend(quote!(let [#(#targets),*] = #factors.solve([#(#right),*]);));
        }
        Line::Solvable { block, determinant, numerators, scales } => {
            let determinant = signed(names, schedule, *determinant);
            let [numerators, scales] = [numerators, scales]
                .map(|values| values.iter().map(|value| signed(names, schedule, *value)).collect::<Vec<_>>());
            let group = string(&derivation.blocks[*block].names(derivation));
            body.extend(quote!(solvable(Self::NAME, #group, #determinant, [#(#numerators),*], [#(#scales),*])?;));
        }
        Line::Chord { block, symbol, factors, size, of } => {
            let mut written = |value: Signed| signed(names, schedule, value);
            let [low, high, size] = [factors[0], factors[1], *size].map(&mut written);
            let of = of.map(&mut written);
            let group = string(&derivation.blocks[*block].names(derivation));
            let side = ident(&derivation.blocks[*block].branch(derivation));
            let name = names.introduce(*symbol).ident.clone();
            let branch = given.branch;
            if names.plain.contains_key(block) {
                let plain = ident(&names.unique(&format!("is_plain_{}", block + 1)));
                names.plain.insert(*block, plain);
            }
            let plain = names.plain.get(block).cloned().unwrap_or_else(|| ident("_"));
            body.extend(match of {
                ChordOf::Triangle { links: [p, q], line: [x, y], distance, scale } => quote!(
                    let (#name, #plain) = elbow_chord(
                        Self::NAME, #group, [#low, #high], [#size, #distance], [#p, #q], [#x, #y], #scale, #branch.#side,
                    )?;
                ),
                ChordOf::Reach { scales: [reach, offset], may_cancel } => {
                    let chord = ident(if may_cancel { "reach_chord" } else { "chord" });
                    quote!(
                        let #name = #chord(
                            Self::NAME, #group, [#low, #high], #size, [#reach, #offset], #branch.#side,
                        )?;
                    )
                }
            });
        }
        Line::Pivots { symbol, matrix } => {
            let columns = columns(matrix, schedule, names);
            let name = names.introduce(*symbol).ident.clone();
            body.extend(quote!(let #name = product_of_pivots([#(#columns),*]);));
        }
        Line::Newton { block, targets, start, system, .. } => {
            let start: Vec<_> = start.iter().map(|value| signed(names, schedule, *value)).collect();
            let group = string(&derivation.blocks[*block].names(derivation));
            let (unknowns, evaluation) = evaluation(writer, targets, system, names);
            let targets: Vec<_> = targets.iter().map(|&target| names.introduce(target).ident.clone()).collect();
            body.extend(quote!(
                let [#(#targets),*] =
                    newton_group(Self::NAME, #group, [#(#start),*], |[#(#unknowns),*]| { #evaluation })?;
            ));
        }
        Line::Return(values) => {
            *results = values.iter().map(|value| result(names, schedule, *value)).collect();
        }
    }
}

/// The body of a closure that evaluates a block: its residual, the sizes of its closures, the columns of its matrix.
fn evaluation(
    writer: &Writer,
    unknowns: &[SymbolId],
    system: &Schedule,
    names: &mut Names,
) -> (Vec<Ident>, TokenStream) {
    let mut inner = names.within();
    let unknowns: Vec<Ident> = unknowns.iter().map(|&unknown| inner.introduce(unknown).ident.clone()).collect();
    let (mut body, mut results) = (Tokens::default(), Vec::new());
    let writer = Writer { schedule: system, ..writer.clone() };
    for line in &system.lines {
        write_line(&writer, &mut body, line, &mut inner, &mut results);
    }
    if inner.takes_numbers() {
        names.take_number();
    }
    names.externals.append(&mut inner.externals);
    let (residual, rest) = results.split_at(unknowns.len());
    let (sizes, rows) = rest.split_at(unknowns.len());
    let columns = (0..unknowns.len()).map(|column| {
        let column = rows.iter().skip(column).step_by(unknowns.len());
        quote!([#(#column),*])
    });
    body.extend(quote!(([#(#residual),*], [#(#sizes),*], [#(#columns),*])));
    (unknowns, body.into())
}

/// `let name = …;`
fn assign(body: &mut Tokens, keyword: &Ident, name: &Ident, definition: impl FnOnce(&mut Tokens)) {
    body.ident(keyword);
    body.ident(name);
    body.punct('=');
    definition(body);
    body.punct(';');
}

fn result(names: &Names, schedule: &Schedule, value: Signed) -> Operand {
    match (schedule.value(value.value), names.get(schedule, value.value)) {
        (_, Some(name)) if !value.negative => Operand::Name(name.ident.clone()),
        (Value::Constant(number), _) if number.is_zero() || (number.is_one() && !value.negative) => {
            Operand::Constant(signed(names, schedule, value))
        }
        _ => Operand::Formula(signed(names, schedule, value)),
    }
}

/// The columns of a matrix given by rows.
fn columns(matrix: &[Vec<Signed>], schedule: &Schedule, names: &Names) -> Vec<TokenStream> {
    let column = |column: usize| {
        let entries: Vec<_> = matrix.iter().map(|row| signed(names, schedule, row[column])).collect();
        quote!([#(#entries),*])
    };
    (0..matrix.len()).map(column).collect()
}
