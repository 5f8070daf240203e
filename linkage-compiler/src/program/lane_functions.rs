//! The trait for many positions at once: its function for one of several lanes, without branches, and its function for a
//! lane alone.

use linkage_ir::Operations;
use linkage_ir::{Constant, Intrinsic};

use super::Derived;
use super::branch::Position;
use super::expression::{Expression, Pattern, Receiver, Statement, Type, Variable};
use super::function::{Access, Body, Function, Passed};
use super::functions::Functions;
use super::implementation::{Associated, ConstantValue, Implementation, Implemented, fallible_of_trait, of_trait};
use super::lane_columns::{Column, Columns, inputs, start};
use super::signatures::Name;
use super::signatures::Signatures;

/// The implementation of a driver with these functions, and the columns to find.
pub(super) fn of_driver<B>(
    signatures: &Signatures,
    position: &Position,
    functions: &Functions<B>,
    derived: Option<&Derived>,
) -> (Implementation<Body>, Vec<Column>) {
    let columns = Columns::of(signatures, position, derived);
    let (parameters, start) = (signatures.parameters.len(), start(signatures, position).len());
    let branch = Type::Bare(signatures.types.branch.clone());
    let types = vec![
        ("Scalar", Associated::Type(Type::Scalar)),
        ("Branch", Associated::Type(branch)),
        ("Given", Associated::Dimension(columns.given.len())),
        ("Found", Associated::Dimension(columns.found.len())),
    ];
    let found = columns.found.iter().map(|column| column.name.clone()).collect();
    let constants = vec![
        ("NAME", ConstantValue::Own),
        ("GIVEN", ConstantValue::Texts(columns.given.clone())),
        ("FOUND", ConstantValue::Texts(found)),
        ("PARAMETERS", ConstantValue::Count(parameters)),
        ("START", ConstantValue::Count(start)),
        ("COORDINATES", ConstantValue::Count(columns.coordinates.len())),
    ];
    let of = Lanes { signatures, position, functions, columns: &columns };
    let mut functions = of.in_lane();
    functions.push(of.exact());
    let (of, on, error) = (Implemented::Lanes, signatures.types.itself.clone(), "PositionError");
    (Implementation { of, on, is_generic: true, error, types, constants, functions }, columns.found)
}

struct Lanes<'a, B> {
    signatures: &'a Signatures,
    position: &'a Position,
    functions: &'a Functions<B>,
    columns: &'a Columns,
}

/// The functions of a lane without branches.
const KINEMATICS: &str = "kinematics_in_lane";
const QUANTITIES_IN_LANE: &str = "quantities_in_lane";

fn name(name: &str) -> Expression {
    Expression::name(name)
}

fn bound(name: &str, value: Expression) -> Statement {
    Statement::Let(Pattern::bound(name.to_owned()), value)
}

/// `if !QUANTITIES { return value; }`
fn unless_quantities(value: Expression) -> Statement {
    Statement::ReturnUnless(Expression::Constant(Constant::Quantities), value)
}

impl<B> Lanes<'_, B> {
    fn has(&self, name: &str) -> bool {
        self.functions.iter().any(|function| function.name == name)
    }

    /// A call of a function of the driver; some read no parameters and take no `self`.
    fn call<const N: usize>(&self, function: &str, arguments: [&str; N]) -> Expression {
        let is_method = |other: &Function<B>| other.name == function && other.is_method;
        let arguments = arguments.map(name);
        match self.functions.iter().any(is_method) {
            true => Expression::own_call(function, arguments),
            false => Expression::called_on(Receiver::ItsType, function, arguments),
        }
    }

    /// The function for one lane, planned in several ways, the best one first. A part that has branches is left out: lanes
    /// are then computed one by one.
    fn in_lane(&self) -> Vec<Function<Body>> {
        let lanes = |count| Type::List(Box::new(Type::Lanes), count);
        let function = |body: Body| {
            let arguments = [
                ("given", Passed::ByReference(lanes(self.columns.given.len()))),
                ("branch", self.branch()),
                ("lane", Passed::ByValue(Type::Count)),
                ("found", Passed::ByMutableReference(lanes(self.columns.found.len()))),
            ];
            Function { access: Access::Lane, ..of_trait("lane", arguments, Type::Flag, body) }
        };
        let mut bodies = Vec::new();
        if self.has(KINEMATICS) {
            let has_quantities = self.columns.count_quantities() > 0;
            bodies.extend((has_quantities && self.has(QUANTITIES_IN_LANE)).then(|| self.lane(true)));
            bodies.push(self.lane(false));
        }
        bodies.push(Body::plain(Expression::Constant(Constant::False)));
        bodies.into_iter().map(function).collect()
    }

    /// The body of the function for one lane, with points and outputs or without.
    fn lane(&self, with_quantities: bool) -> Body {
        let at = |of: Expression| Expression::At(Box::new([of, name("lane")]));
        let mut statements = self.bound_inputs(&at).to_vec();
        // The coordinates of an open chain are given: only points and outputs read its kinematics.
        let is_read = !self.signatures.is_open || with_quantities;
        let kinematics = if is_read { Pattern::bound("kinematics".to_owned()) } else { Pattern::Ignored };
        let accepted = Pattern::bound("is_accepted".to_owned());
        let call = self.call(KINEMATICS, ["start", "branch", "rates", "accelerations"]);
        statements.push(Statement::Let(Pattern::Tuple(vec![kinematics, accepted]), call));
        if is_read {
            statements.push(Statement::Let(self.taken_apart(), name("kinematics")));
        }
        let Columns { coordinates, angles, .. } = self.columns;
        statements.extend(stored(coordinates.iter().cloned(), 0, &at));
        let mut all = vec![name("is_accepted")];
        let has_quantities = self.columns.count_quantities() > 0;
        if has_quantities || !angles.is_empty() {
            statements.push(unless_quantities(name("is_accepted")));
        }
        if has_quantities && !with_quantities {
            let value = Expression::Constant(Constant::False);
            return Body { after: statements, ..Body::plain(value) };
        }
        let pose = name("pose");
        let values = angles.iter().map(|angle| match angle.computed_from(&pose) {
            Some(parts) => Expression::call(Intrinsic::Arctangent2InLane, parts),
            None => angle.value(&pose),
        });
        statements.extend(stored(values, coordinates.len(), &at));
        let mut flags = Vec::new();
        for parts in angles.iter().filter_map(|angle| angle.computed_from(&pose)) {
            let flag = format!("has_angle_{}", flags.len() + 1);
            statements.push(bound(&flag, Expression::call(Intrinsic::HasArctangent2InLane, parts)));
            flags.push(name(&flag));
        }
        if with_quantities {
            let to = ["quantities", "are_accepted"].map(|name| Pattern::bound(name.to_owned()));
            let call = self.call(QUANTITIES_IN_LANE, ["pose", "rates", "accelerations"]);
            statements.push(Statement::Let(Pattern::Tuple(to.to_vec()), call));
            statements.extend(stored(self.quantities(), coordinates.len() + angles.len(), &at));
            all.push(name("are_accepted"));
        }
        let operations = Operations { functions: flags.len(), ..Operations::default() };
        all.extend(flags);
        Body { after: statements, operations, ..Body::plain(Expression::All(all)) }
    }

    /// The function for a lane alone: it calls `kinematics`, and the function for points and outputs.
    fn exact(&self) -> Function<Body> {
        let at = |of: Expression| of;
        let Columns { given, found, coordinates, angles, .. } = self.columns;
        let zeros = Expression::Repeated(Box::new(Expression::zero()), found.len());
        let mut statements = vec![Statement::Let(Pattern::Mutable(Variable::Name("found".to_owned())), zeros)];
        statements.extend(self.bound_inputs(&at));
        let (function, from) = match self.position.is_closed {
            true => ("kinematics", name("start")),
            false => ("kinematics_near", name("start").borrowed()),
        };
        // User functions need not have values.
        let function = if self.has("kinematics_alone") { "kinematics_alone" } else { function };
        let arguments = [from, name("branch"), name("rates"), name("accelerations")];
        let call = Expression::own_call(function, arguments).tried();
        let has_quantities = self.has("motion_of_quantities");
        // The coordinates of an open chain are given.
        if self.signatures.is_open && !has_quantities {
            statements.push(Statement::Do(call));
        } else {
            statements.push(Statement::Let(self.taken_apart(), call));
            statements.extend(stored(coordinates.iter().cloned(), 0, &at));
            let found = name("found");
            if has_quantities || !angles.is_empty() {
                statements.push(unless_quantities(Expression::call(Intrinsic::Ok, [found])));
            }
            let pose = name("pose");
            statements.extend(stored(angles.iter().map(|angle| angle.value(&pose)), coordinates.len(), &at));
            if has_quantities {
                let call = self.call("motion_of_quantities", ["pose", "rates", "accelerations"]);
                statements.push(bound("quantities", call));
                statements.extend(stored(self.quantities(), coordinates.len() + angles.len(), &at));
            }
        }
        let list = |count| Type::List(Box::new(Type::Scalar), count);
        let arguments = [("given", Passed::ByReference(list(given.len()))), ("branch", self.branch())];
        let body = Body { after: statements, ..Body::plain(name("found")) };
        fallible_of_trait("exact", arguments, list(found.len()), body)
    }

    fn branch(&self) -> Passed {
        Passed::ByValue(Type::Bare(self.signatures.types.branch.clone()))
    }

    /// Statements that bind the start, the rates and the accelerations of the inputs; `place` finds the lane in a column.
    fn bound_inputs(&self, at: &dyn Fn(Expression) -> Expression) -> [Statement; 3] {
        let (inputs, start) = (inputs(self.signatures), start(self.signatures, self.position));
        let types = &self.signatures.types;
        let of_start = if self.position.is_closed { &types.inputs } else { &types.coordinates };
        let mut columns = self.signatures.parameters.len()..;
        let mut by_name = |of: &String, names: &[&Name]| {
            let members = names.iter().zip(&mut columns);
            let members = members.map(|(name, column)| {
                (name.field.clone(), at(Expression::Index(Box::new(Expression::name("given")), column)))
            });
            let mut members: Vec<(String, Expression)> = members.collect();
            // A struct without fields has its scalar as a mark.
            members.extend(names.is_empty().then(|| ("scalar".to_owned(), Expression::Constant(Constant::Mark))));
            Expression::structure(Type::Own(of.clone()), members)
        };
        [
            bound("start", by_name(of_start, &start)),
            bound("rates", by_name(&types.inputs, &inputs)),
            bound("accelerations", by_name(&types.inputs, &inputs)),
        ]
    }

    /// The fields of `kinematics`.
    fn taken_apart(&self) -> Pattern<Variable> {
        let fields = ["pose", "rates", "accelerations"].map(|name| (name.to_owned(), Pattern::bound(name.to_owned())));
        let of = Type::Own(self.signatures.types.kinematics.clone());
        Pattern::Struct { of, fields: fields.to_vec(), is_whole: true }
    }

    fn quantities(&self) -> impl Iterator<Item = Expression> {
        (0..self.columns.count_quantities()).map(|index| Expression::Index(Box::new(name("quantities")), index))
    }
}

/// Statements that store columns from a number on; `place` finds the lane in a column.
fn stored(
    values: impl Iterator<Item = Expression>,
    from: usize,
    at: &dyn Fn(Expression) -> Expression,
) -> Vec<Statement> {
    let columns = (from..).map(|column| at(Expression::Index(Box::new(name("found")), column)));
    columns.zip(values).map(|(column, value)| Statement::Assign(column, value)).collect()
}
