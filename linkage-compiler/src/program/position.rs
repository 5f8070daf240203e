//! Functions for the position: from coordinates, near a guess, and group by group in closed form.

use linkage_ir::{Constant, Intrinsic};

use super::branch::Position;
use super::doc::{lines, without_result};
use super::expression::{Expression, Pattern, Statement, Type, Variable};
use super::function::{Access, Body, Kernel, Output, Shape, Source, Value};
use super::names::{Arguments, Order};
use super::plan::{Plan, unnamed};
use crate::derivation::{Step, needed_names};
use crate::graph::{Function as Elementary, NodeId, SymbolId};
use crate::ids::GroupId;

/// The promise of a function that takes a branch.
pub(super) const OF_A_BRANCH: &str =
    "At a change point a branch may jump to another motion; a `RangeOfMotion` stays on one.";

const ASSEMBLE: [&str; 6] = [
    "The position at these inputs in closed form, group by group, on the given branch.",
    OF_A_BRANCH,
    "",
    "# Errors",
    "`PositionError::Unbuildable` if the links of a group do not reach, `PositionError::Undetermined` if its position is arbitrary,",
    "as between joints that coincide, `PositionError::NotFinite` if a number is not finite.",
];

const ASSEMBLE_OPEN: [&str; 4] =
    ["The position at these inputs.", "", "# Errors", "`PositionError::NotFinite` if a number is not finite."];

const ERRORS_BY_NUMBER: [&str; 6] = [
    "",
    "# Errors",
    "`PositionError::NoMode` if the group has fewer positions, `PositionError::NoClosedForm` if the branch has no number, as that of",
    "`branch_of`, `PositionError::Undecided` if rounding error hides how many positions there are, `PositionError::Unbuildable` if",
    "the links of another group do not reach, `PositionError::Undetermined` if a position is arbitrary, as between joints that",
    "coincide, `PositionError::NotFinite` if a number is not finite.",
];

const BRANCHES_BY_NUMBER: [&str; 9] = [
    "Every position that exists at these inputs, with its branch: `for found in mechanism.branches(v)? { .. }`.",
    "",
    "A group without closed form has its positions in the order of its first unknown, from -pi to pi, then of the next. The",
    "numbers count them at these inputs only: along a motion they change places, so that `assemble_near` follows it, not a number.",
    "",
    "# Errors",
    "`PositionError::Undecided` if rounding error hides how many positions a group has, `PositionError::NotFinite` if a number",
    "is not finite. Branches on which a group cannot be assembled or is undetermined are omitted, and so are numbers without a",
    "position.",
];

/// The function that assembles a position and keeps the positions of groups.
const REMEMBERING: &str = "assemble_remembering";

impl Plan<'_, '_> {
    pub(super) fn position(&mut self) {
        self.pose_at();
        self.widening();
        if self.signatures.is_open {
            // The inputs are the position: nothing is solved, and there are no branches.
            self.assemble();
            return;
        }
        self.solve();
        self.check_implied();
        self.assemble();
        self.branches();
        self.branch_of();
        self.branch_near();
    }

    fn pose_at(&mut self) {
        let groups = &self.derivation.groups;
        let determinants = self.pose.determinants.iter();
        let determinants: Vec<NodeId> =
            determinants.filter_map(|(group, _, _)| Some(groups[*group].determinant?.value)).collect();
        let circular = self.directions();
        let numbers: Vec<SymbolId> = self.pose.values.iter().map(|(_, _, symbol)| *symbol).collect();
        let numbers = self.variables(&numbers);
        let externals = self.pose.externals.iter().map(|(node, ..)| *node);
        let results = determinants.into_iter().chain(circular).chain(numbers).chain(externals);
        let kernel = self.kernel(vec![self.coordinates(Order::Value)], Vec::new(), unnamed(results));
        let body = Body::of(kernel, self.pose_of_results());
        let calls = match self.mechanism.externals.as_slice() {
            [] => "",
            _ => " and one call of each user function",
        };
        let doc = [format!("The pose at these coordinates: computes one sine and cosine for each angle{calls}.")];
        self.add(self.signatures.pose_at(), without_result(doc.to_vec()), body);
    }

    fn solve(&mut self) {
        let guess = self.signatures.arguments.guess.clone();
        let newton = |name| Body::result(Expression::call(name, [Expression::own(), Expression::name(&guess)]));
        let doc = lines([
            "The position near `guess` at the inputs of `guess`, by Newton's method.",
            "",
            "# Errors",
            "`PositionError::NotConverged` if no position is found, `PositionError::OtherBranch` if the determinant of a group differs",
            "in sign from that at the guess, `PositionError::NotFinite` if a number is not finite.",
        ]);
        self.add(self.signatures.solve(), doc, newton(Intrinsic::Newton));
        let doc = lines([
            "The position near `guess` at the inputs of `guess`, by Newton's method, on any branch.",
            "",
            "# Errors",
            "`PositionError::NotConverged` if no position is found, `PositionError::NotFinite` if a number is not finite.",
        ]);
        self.add(self.signatures.solve_any_branch(), doc, newton(Intrinsic::NewtonAnyBranch));
    }

    /// Cosine and sine of each angle of a pose.
    fn directions(&mut self) -> Vec<NodeId> {
        let angles: Vec<NodeId> = self.pose.angles().collect();
        let graph = &mut self.derivation.graph;
        let both = [Elementary::Cos, Elementary::Sin];
        angles.into_iter().flat_map(|angle| both.map(|function| graph.call(function, &[angle]))).collect()
    }

    /// A pose from results: determinants, cosines and sines, numbers, and values of user functions.
    pub(super) fn pose_of_results(&self) -> Expression {
        let mut next = (0..).map(Expression::Result);
        let mut take = || next.next().unwrap_or_else(Expression::zero);
        let mut members = Vec::new();
        for (_, field, _) in &self.pose.determinants {
            members.push((field.clone(), take()));
        }
        for field in self.pose.directions.values() {
            members.push((field.clone(), Expression::call(Intrinsic::Unit, [take(), take()])));
        }
        let numbers = self.pose.values.iter().map(|(_, field, _)| field);
        for field in numbers.chain(self.pose.externals.iter().map(|(_, field, _)| field)) {
            members.push((field.clone(), take()));
        }
        Expression::structure(self.signatures.pose_type(), members)
    }

    fn assemble(&mut self) {
        self.assembly = self.derivation.assembly();
        let (steps, results) = self.position_steps();
        let nodes: Vec<NodeId> = results.iter().map(|output| output.node).collect();
        let steps = needed_names(&self.derivation.graph, steps, &nodes);
        self.position =
            Position::new((self.mechanism, self.driver), self.derivation, &self.pose, &self.assembly, &steps);
        let Arguments { inputs, turn, guess, .. } = self.signatures.arguments.clone();
        let source = if !self.position.is_closed {
            self.guess()
        } else if self.position.turns.is_empty() {
            self.inputs(Order::Value)
        } else {
            Source { from: Expression::name(&inputs), ..self.inputs(Order::Value) }
        };
        let turns = self.position.turns.iter().enumerate();
        let kernel = Kernel {
            turns: turns.map(|(index, turn)| (turn.symbol, index)).collect(),
            dyads: self.dyads(),
            ..self.kernel(vec![source], steps, results)
        };
        let mut body = Body::of(kernel, self.pose_of_results());
        body.after.push(Statement::CheckPosition);
        self.with_implied(&mut body);
        if !self.position.is_closed && !self.position.turns.is_empty() {
            body.before = self.nearest_turns(&guess, &turn);
        }
        self.position_alone(&body);
        if !self.position.is_closed {
            let doc = self.near_doc();
            self.add(self.signatures.assemble_near(), doc, body);
            match self.position.is_listed() {
                true => self.assemble_by_number(),
                false => self.no_assemble(),
            }
        } else if self.signatures.is_open {
            self.add(self.signatures.assemble(), lines(ASSEMBLE_OPEN), body);
        } else if self.position.turns.is_empty() {
            self.add(self.signatures.assemble(), lines(ASSEMBLE), body);
        } else {
            let doc = lines(["The position at these inputs on this branch, with angles in the given turns."]);
            self.add(self.signatures.assemble_in_turns(), doc, body);
            self.assemble_by_turns();
        }
    }

    /// `assemble` of a mechanism whose groups without closed form list their positions by number.
    fn assemble_by_number(&mut self) {
        let Some(steps) = self.assembly.listed_steps() else { return };
        let (_, results) = self.position_steps();
        let nodes: Vec<NodeId> = results.iter().map(|output| output.node).collect();
        let steps = needed_names(&self.derivation.graph, steps, &nodes);
        let Arguments { inputs, branch, .. } = self.signatures.arguments.clone();
        let source = Source { from: Expression::name(&inputs), ..self.inputs(Order::Value) };
        let kernel = Kernel { dyads: self.dyads(), ..self.kernel(vec![source], steps, results) };
        let mut body = Body::of(kernel, self.pose_of_results());
        body.after.push(Statement::CheckPosition);
        self.with_implied(&mut body);
        let doc = lines([
            "The position at these inputs on this branch. The positions of groups without closed form are kept for the next call.",
        ]);
        self.add(self.signatures.assemble_remembering(&self.position), doc, body);

        let at = [Expression::name(&inputs).converted(), Expression::name(&branch)];
        let call = self.remembering(at, self.no_memory());
        let body = Body::result(call);
        let listed: Vec<String> =
            self.position.modes.iter().map(|group| format!("`{}`", group.unknowns.replace(", ", "`, `"))).collect();
        let mut doc = lines([
            "The position at these inputs on the given branch, group by group: in closed form, but the group of",
            &format!("{} by its number among all its positions at these inputs.", listed.join(" and that of ")),
            OF_A_BRANCH,
        ]);
        doc.extend(lines(ERRORS_BY_NUMBER));
        self.add(self.signatures.assemble(), doc, body);
    }

    /// The call that assembles a position and keeps those of its groups.
    fn remembering(&self, at: [Expression; 2], memory: Expression) -> Expression {
        Expression::own_call(REMEMBERING, at.into_iter().chain([memory.mutably_borrowed()]))
    }

    /// A memory without positions.
    fn no_memory(&self) -> Expression {
        let empty = Expression::of_type(Type::Runtime("Memory", Vec::new()), Intrinsic::Default, []);
        match self.position.modes.as_slice() {
            [_] => empty,
            several => Expression::Tuple(several.iter().map(|_| empty.clone()).collect()),
        }
    }

    /// `assemble` of a mechanism without closed form.
    fn no_assemble(&mut self) {
        let signature = self.signatures.no_assemble(&self.position);
        let group = self.position.open.first().map_or("", |(names, _)| names.as_str());
        let error = Expression::call(Intrinsic::NoClosedForm, [Expression::mechanism(), Expression::text(group)]);
        let mut doc = signature.doc.clone();
        doc.extend(lines(["", "# Errors", "`PositionError::NoClosedForm`, always."]));
        self.add(signature, doc, Body::result(error));
    }

    /// `assemble` and `assemble_near` of a mechanism with turns of angles.
    fn assemble_by_turns(&mut self) {
        let Arguments { inputs, branch, turn, guess, .. } = self.signatures.arguments.clone();
        let [v, on, near] = [&inputs, &branch, &guess].map(Expression::name);
        let fields = self.position.turns.iter().map(|turn| on.clone().field(&turn.field));
        let turns = Expression::call(Intrinsic::Turns, [Expression::List(fields.collect())]).borrowed();
        let call = Expression::own_call("assemble_in_turns", [v.converted(), on.clone(), turns]);
        let body = Body::result(call);
        self.add(self.signatures.assemble(), lines(ASSEMBLE), body);

        let names: Vec<_> = self.position.turns.iter().map(|turn| format!("`{}`", turn.coordinate)).collect();
        let doc = lines([
            "The position at the inputs of a guess in closed form, on the given branch, but with the turns of",
            &format!("{} nearest to the guess.", names.join(", ")),
            "",
            "# Errors",
            "Those of `assemble`, and `InputError::OutOfRange` if a turn of the guess is out of the range of `i32`.",
        ]);
        let inputs = Type::Bare(self.signatures.types.inputs.clone());
        let inputs = Expression::of_type(inputs, Intrinsic::From, [near]);
        let call = Expression::own_call("assemble_in_turns", [inputs, on, Expression::name(&turn).borrowed()]);
        let mut body = Body::result(call);
        body.before = self.nearest_turns(&guess, &turn);
        self.add(self.signatures.assemble_near(), doc, body);
    }

    /// Statements that bind `turn` to the turns nearest to a guess.
    pub(super) fn nearest_turns(&self, guess: &str, turn: &str) -> Vec<Statement> {
        let near = self.position.turns.iter().map(|turn| Expression::name(guess).field(&turn.coordinate));
        let near = Expression::List(near.collect());
        let countable = Expression::call(Intrinsic::Countable, [Expression::mechanism(), near.clone()]);
        let nearest = Type::Runtime("NearestTurns", Vec::new());
        let nearest = Expression::of_type(nearest, Intrinsic::New, [near]);
        vec![Statement::Do(countable.tried()), Statement::Let(Pattern::bound(turn.to_owned()), nearest)]
    }

    /// The inputs of a guess, and the guesses of the unknowns without closed form.
    pub(super) fn guess(&self) -> Source {
        let coordinates = &self.derivation.coordinates;
        let inputs = self.derivation.inputs.iter().map(|&index| (index, coordinates[index].value));
        let fields = inputs.chain(self.assembly.guesses.iter().copied());
        let fields: Vec<_> = fields.map(|(index, symbol)| (coordinates[index].name.clone(), symbol)).collect();
        let is_whole = fields.len() == coordinates.len();
        let guess = &self.signatures.arguments.guess;
        Source {
            from: Expression::name(guess).dereferenced(),
            shape: Shape::fields(self.signatures.coordinates_type(Order::Value), fields, is_whole),
        }
    }

    fn near_doc(&self) -> Vec<String> {
        let is_iterated = |group: GroupId| {
            let mut steps = self.assembly.steps.iter();
            steps.any(|step| matches!(step, Step::Newton { group: other, .. } if *other == group))
        };
        let groups = self.derivation.groups.enumerated().filter(|(number, _)| is_iterated(*number));
        let iterated: Vec<_> = groups.map(|(_, group)| group.names(self.derivation)).collect();
        let mut doc = lines([
            "The position at the inputs of a guess, group by group: in closed form on the given branch,",
            &format!("but {} by Newton's method from the guess.", iterated.join(", then ")),
            "",
            "# Errors",
            "`PositionError::Unbuildable` if the links of a group do not reach, `PositionError::Undetermined` if its position is arbitrary,",
            "`PositionError::NotConverged` if Newton's method finds no position, `PositionError::OtherBranch` if the position it finds is",
            "beyond a dead point, `PositionError::NotFinite` if a number is not finite.",
        ]);
        if self.position.is_listed() {
            doc.insert(2, "The numbers of positions in the branch are not used.".to_owned());
        }
        doc
    }

    /// The steps of a position, and the results that form a pose.
    pub(super) fn position_steps(&mut self) -> (Vec<Step>, Vec<Output>) {
        let determinants: Vec<NodeId> =
            self.pose.determinants.iter().map(|(group, _, _)| self.assembly.determinants[group]).collect();
        let circular = self.directions();
        let mut circular = self.assembly.solved(&mut self.derivation.graph, &circular);
        for (parts, angle) in circular.chunks_exact_mut(2).zip(self.pose.angles()) {
            let angle = self.derivation.graph.as_symbol(angle);
            if let Some(named) = angle.and_then(|angle| self.assembly.named_directions.get(&angle)) {
                parts.copy_from_slice(named);
            }
        }
        let numbers: Vec<SymbolId> = self.pose.values.iter().map(|(_, _, symbol)| *symbol).collect();
        let numbers = self.variables(&numbers);
        let externals: Vec<NodeId> = self.pose.externals.iter().map(|(node, ..)| *node).collect();
        let externals = self.assembly.solved(&mut self.derivation.graph, &externals);
        let mut names: Vec<String> = self.pose.determinants.iter().map(|(_, field, _)| field.clone()).collect();
        names.extend(self.pose.directions.values().flat_map(|field| [format!("cos_{field}"), format!("sin_{field}")]));
        names.extend(self.pose.values.iter().map(|(_, field, _)| field.clone()));
        names.extend(self.pose.externals.iter().map(|(_, field, _)| field.clone()));
        let nodes = determinants.into_iter().chain(circular).chain(numbers).chain(externals);
        let results = nodes.zip(names).map(|(node, name)| Output::named(node, name)).collect();
        (self.assembly.steps.clone(), results)
    }

    /// For each result of a position, the RRR dyad that determines it, if any.
    pub(super) fn dyads(&self) -> Vec<Option<GroupId>> {
        let dyad_of = |symbol: Option<SymbolId>| symbol.and_then(|s| self.assembly.of_dyads.get(&s).copied());
        let mut dyads = vec![None; self.pose.determinants.len()];
        dyads.extend(self.pose.angles().flat_map(|angle| [dyad_of(self.derivation.graph.as_symbol(angle)); 2]));
        dyads.extend(self.pose.values.iter().map(|(_, _, symbol)| dyad_of(Some(*symbol))));
        dyads.extend(self.pose.externals.iter().map(|_| None));
        dyads
    }

    /// `branches`: the positions on all branches.
    fn branches(&mut self) {
        let signature = self.signatures.branches(&self.position);
        if signature.access == Access::Deprecated {
            let (function, error) = match self.position.open.first() {
                Some((group, _)) => (
                    Expression::call(Intrinsic::NoList, [Expression::mechanism(), Expression::text(group)]),
                    "`PositionError::NoClosedForm`",
                ),
                None => (
                    Expression::call(Intrinsic::TooManyBranches, [Expression::mechanism()]),
                    "`PositionError::TooManyBranches`",
                ),
            };
            let mut doc = signature.doc.clone();
            doc.extend(lines(["", "# Errors", &format!("{error}, always.")]));
            self.add(signature, doc, Body::result(function));
            return;
        }
        let Arguments { inputs, branch, memory, .. } = self.signatures.arguments.clone();
        let all = Expression::of_type(Type::Bare(self.signatures.types.branch.clone()), Intrinsic::All, []);
        let is_listed = self.position.is_listed();
        let at = [&inputs, &branch].map(Expression::name);
        let assemble = match is_listed {
            true => self.remembering(at, Expression::name(&memory)),
            false => Expression::own_call("assemble", at),
        };
        let assemble = Expression::Closure {
            arguments: vec![Pattern::bound(branch)],
            statements: Vec::new(),
            value: Box::new(assemble),
            moves: true,
        };
        let mut body = Body::result(Expression::call(Intrinsic::Existing, [all, assemble]));
        let converted = Expression::name(&inputs).converted();
        body.before = vec![Statement::Let(Pattern::bound(inputs), converted)];
        if is_listed {
            body.before.push(Statement::Let(Pattern::Mutable(Variable::Name(memory)), self.no_memory()));
            self.add(signature, lines(BRANCHES_BY_NUMBER), body);
            return;
        }
        let doc = lines([
            "Every position that exists at these inputs, with its branch: `for found in mechanism.branches(v)? { .. }`.",
            "",
            "# Errors",
            "`PositionError::NotFinite` if a number is not finite. Branches on which a group cannot be assembled or is undetermined",
            "are omitted.",
        ]);
        self.add(signature, doc, body);
    }

    fn branch_near(&mut self) {
        let Arguments { guess, .. } = self.signatures.arguments.clone();
        let pose = Expression::own_call("pose_at", [Expression::name(&guess)]).borrowed();
        let doc = without_result(lines([
            "The branch of a rough position, such as one read off a drawing: its coordinates need not satisfy the loop equations.",
        ]));
        let body = Body::plain(Expression::own_call("branch_of", [pose]));
        self.add(self.signatures.branch_near(), doc, body);
    }

    fn branch_of(&mut self) {
        let Arguments { pose, branch, turn, .. } = self.signatures.arguments.clone();
        let turns = self.position.turns_of_branch();
        let of = Type::Bare(self.signatures.types.branch.clone());
        let on = Expression::name(&pose);
        let sides = self.assembly.chords.iter().zip(&self.position.sides).filter_map(|(chord, side)| {
            let (_, field, _) = self.pose.determinants.iter().find(|(group, ..)| *group == chord.group)?;
            let determinant = on.clone().field(field);
            let determinant = if chord.is_opposite { Expression::Negative(Box::new(determinant)) } else { determinant };
            Some((side.field.clone(), Expression::call(Intrinsic::SideOf, [determinant])))
        });
        let zeros = turns.iter().map(|turn| (turn.field.clone(), Expression::Count(0)));
        let of_guess = Expression::Constant(Constant::OfGuess);
        let modes = self.position.modes.iter().map(|group| (group.field.clone(), of_guess.clone()));
        let members = Expression::structure(of.clone(), sides.chain(modes).chain(zeros));
        let mut doc = lines([
            "The branch of a position, by the signs of the determinants of its groups. It does not fail: for NaN it",
            "uses the sign bit.",
        ]);
        let mut body = Body::plain(members.clone());
        if !turns.is_empty() {
            doc = lines([
                "The branch of a position, by the signs of the determinants of its groups, with the turns of its angles:",
                "`assemble` on this branch reproduces the angles. It does not fail: for a determinant that is NaN it uses the",
                "sign bit, for an angle that is NaN the turn is 0.",
            ]);
            let given = self.pose.values.iter().filter(|(index, ..)| self.derivation.inputs.contains(index));
            let given = given
                .map(|(index, field, _)| (self.derivation.coordinates[*index].name.clone(), on.clone().field(field)));
            let inputs = Expression::structure(Type::Bare(self.signatures.types.inputs.clone()), given);
            let numbers = Expression::List(turns.iter().map(|turn| on.clone().field(&turn.number)).collect());
            let nearest = Type::Runtime("NearestTurns", Vec::new());
            let nearest = Expression::of_type(nearest, Intrinsic::New, [numbers]);
            let at = [inputs, Expression::name(&branch), Expression::name(&turn).borrowed()];
            let counted = Pattern::List(turns.iter().map(|turn| Pattern::bound(turn.field.clone())).collect());
            body.before = vec![
                Statement::Let(Pattern::bound(branch.clone()), members),
                Statement::Let(Pattern::bound(turn.clone()), nearest),
                // If the assembly fails, the turns are those of the angles alone.
                Statement::Let(Pattern::Ignored, Expression::own_call("assemble_in_turns", at)),
                Statement::Let(counted, Expression::call(Intrinsic::TurnsFound, [Expression::name(&turn)])),
            ];
            let turns = turns.iter().map(|turn| (turn.field.clone(), Expression::name(&turn.field))).collect();
            body.value = Value::Plain(Expression::Struct(of, turns, Some(Box::new(Expression::name(&branch)))));
        }
        self.add(self.signatures.branch_of(), doc, body);
    }
}
