//! The trait by which simulations call the functions of a scene.

use linkage_ir::{Constant, Intrinsic};

use super::SceneSignatures;
use crate::model::SceneRequest;
use crate::program::expression::{Expression, Pattern, Statement, Type, Variable};
use crate::program::function::{Body, Function, Passed};
use crate::program::implementation::{
    Associated, ConstantValue, Implementation, Implemented, Kink, fallible_of_trait, of_trait,
};
use crate::program::names::Order;

/// `Scene`, for a scene with inertia; `kinks` are those of its laws, and `has_change` says of which contacts the change of the gap
/// is known.
pub(in crate::program) fn of_scene(
    signatures: &SceneSignatures,
    kinks: Vec<Kink>,
    has_change: &[bool],
) -> Option<Implementation<Body>> {
    if !signatures.has_inertia {
        return None;
    }
    let [u, v, c] = [signatures.unknowns, signatures.inputs.len(), signatures.contacts.len()];
    let reactions = match signatures.has_reactions() {
        true => Type::Own(signatures.reactions_type.clone()),
        false => Type::Tuple(Vec::new()),
    };
    let types = vec![
        ("Scalar", Associated::Type(Type::Scalar)),
        ("U", Associated::Dimension(u)),
        ("V", Associated::Dimension(v)),
        ("State", Associated::Dimension(u + 2 * v)),
        ("Contacts", Associated::Dimension(c)),
        ("Mechanism", Associated::Type(Type::Own(signatures.types.driver.clone()))),
        ("Reactions", Associated::Type(reactions)),
    ];
    let has_bearings = signatures.count_bearings() > 0;
    let mut constants = vec![("NAME", ConstantValue::Text(signatures.types.itself.clone()))];
    constants.extend(has_bearings.then_some(("BEARINGS", ConstantValue::Flag(true))));
    let of = OfScene(signatures);
    let mut functions = vec![of.check(), of.derivative(), of.equations(), of.contacts(), of.reactions()];
    functions.extend(has_bearings.then(|| of.bearings()));
    functions.extend((!kinks.is_empty()).then(|| of.kink()));
    functions.extend(has_change.contains(&true).then(|| of.gap_changes(has_change)));
    functions.extend([of.unreduced(), of.prescribed()]);
    functions.extend(signatures.requests.contains(&SceneRequest::Energy).then(|| of.energy()));
    functions.extend(signatures.requests.contains(&SceneRequest::Power).then(|| of.power()));
    constants.extend((!kinks.is_empty()).then_some(("KINKS", ConstantValue::Kinks(kinks))));
    let (of, on, error) = (Implemented::Scene, signatures.types.itself.clone(), "MotionError");
    Some(Implementation { of, on, is_generic: true, error, types, constants, functions })
}

/// The functions of the trait for a scene.
struct OfScene<'a>(&'a SceneSignatures);

fn name(name: &str) -> Expression {
    Expression::name(name)
}

fn field(of: &str, field: &str) -> Expression {
    name(of).field(field)
}

/// A call of a function of the scene with t, q and q'.
fn call(function: &str) -> Expression {
    Expression::own_call(function, ["t", "q", "rates"].map(name))
}

/// `let StateParts { q, input_rates } = Self::parts(state);`
fn parts_of_state() -> Statement {
    let parts = Expression::of_type(Type::Itself, Intrinsic::Parts, [name("state")]);
    Statement::Let(taken_apart("StateParts", ["q", "input_rates"]), parts)
}

/// A pattern that binds all fields of a type of the runtime.
fn taken_apart(of: &'static str, fields: [&str; 2]) -> Pattern<Variable> {
    let fields = fields.map(|field| (field.to_owned(), Pattern::bound(field.to_owned())));
    Pattern::Struct { of: Type::Runtime(of, Vec::new()), fields: fields.to_vec(), is_whole: true }
}

fn listed<'a>(names: impl IntoIterator<Item = &'a String>) -> Pattern<Variable> {
    Pattern::List(names.into_iter().cloned().map(Pattern::bound).collect())
}

impl OfScene<'_> {
    fn time(&self) -> (&'static str, Passed) {
        ("t", Passed::ByValue(Type::Scalar))
    }

    fn state(&self) -> (&'static str, Passed) {
        ("state", Passed::ByReference(self.state_type()))
    }

    fn state_type(&self) -> Type {
        Type::Column(Box::new(Type::Scalar), self.0.unknowns + 2 * self.0.inputs.len())
    }

    fn coordinates(&self, name: &'static str, order: Order) -> (&'static str, Passed) {
        (name, Passed::ByReference(Type::Own(order.type_of(&self.0.types).to_owned())))
    }

    /// t, q and q'.
    fn motion(&self) -> [(&'static str, Passed); 3] {
        [self.time(), self.coordinates("q", Order::Value), self.coordinates("rates", Order::Rate)]
    }

    /// A type of the runtime with the numbers of unknowns and inputs.
    fn sized(&self, name: &'static str) -> Type {
        Type::Sized(name, vec![self.0.unknowns, self.0.inputs.len()])
    }

    /// A column with an entry for each contact.
    fn each_contact(&self, of: Type) -> Type {
        Type::Column(Box::new(of), self.0.contacts.len())
    }

    fn has_contacts(&self) -> bool {
        !self.0.contacts.is_empty()
    }

    fn check(&self) -> Function<Body> {
        fallible_of_trait("check", [], Type::Tuple(Vec::new()), Body::result(Expression::own_call("check", [])))
    }

    fn derivative(&self) -> Function<Body> {
        let rates = Expression::own_call("rates", [name("t"), name("q").borrowed(), name("input_rates")]).tried();
        let apart = taken_apart("StateRates", ["rates", "input_accelerations"]);
        let rates_of = self.0.fields.iter().map(|of| field("rates", of));
        let accelerations = self.0.inputs.iter().map(|of| field("input_accelerations", of));
        let value = Expression::List(rates_of.chain(accelerations).collect()).converted();
        let body = Body { before: vec![parts_of_state(), Statement::Let(apart, rates)], ..Body::plain(value) };
        fallible_of_trait("derivative", [self.time(), self.state()], self.state_type(), body)
    }

    fn equations(&self) -> Function<Body> {
        let q = || name("q").borrowed();
        let state = [name("t"), q(), name("input_rates")];
        let value = if self.has_contacts() {
            Expression::own_call("equations", state)
        } else {
            let mechanism = Expression::own().field(&self.0.field).borrowed();
            let inertia = Expression::own_call("mass_matrix", [q()]).tried();
            let forces = Expression::own_call("forces", state).tried();
            let of = Type::Runtime("Equations", Vec::new());
            Expression::of_type(of, Intrinsic::EquationsAt, [mechanism, q(), name("input_rates"), inertia, forces])
        };
        let body = Body { before: vec![parts_of_state()], ..Body::result(value) };
        fallible_of_trait("equations", [self.time(), self.state()], self.sized("Equations"), body)
    }

    fn contacts(&self) -> Function<Body> {
        let all = if self.has_contacts() { call("contacts").tried() } else { Expression::List(Vec::new()) };
        let of = self.each_contact(self.sized("Contact"));
        fallible_of_trait("contacts", self.motion(), of, Body::plain(all.converted()))
    }

    fn reactions(&self) -> Function<Body> {
        let [time, q, rates] = self.motion();
        let accelerations = ("accelerations", Passed::ByReference(self.sized("Vector")));
        let forces = ("contact_forces", Passed::ByReference(self.each_contact(Type::Scalar)));
        let body = match self.0.has_reactions() {
            false => Body::plain(Expression::Tuple(Vec::new())),
            true => {
                let forces = name("contact_forces").dereferenced().converted().borrowed();
                let motion = ["t", "q", "rates"].map(name).into_iter().chain([name("accelerations").borrowed()]);
                let arguments = motion.chain(self.has_contacts().then_some(forces));
                let let_accelerations =
                    Statement::Let(Pattern::bound("accelerations".to_owned()), self.accelerations_by_name());
                Body {
                    before: vec![let_accelerations],
                    ..Body::result(Expression::own_call("reactions_of", arguments))
                }
            }
        };
        let arguments = [time, q, rates, accelerations, forces];
        fallible_of_trait("reactions", arguments, Type::OfTrait("Reactions"), body)
    }

    /// The accelerations by name, from an argument with columns. It is a block of its own: a coordinate may have the name
    /// of an argument.
    fn accelerations_by_name(&self) -> Expression {
        let column = |of: &str, count| {
            let list = Type::List(Box::new(Type::Scalar), count);
            Expression::of_type(list, Intrinsic::From, [field("accelerations", of)])
        };
        let columns = [column("unknowns", self.0.unknowns), column("inputs", self.0.inputs.len())];
        let apart = Pattern::Tuple(vec![listed(&self.0.dependent), listed(self.0.inputs.iter())]);
        let members = self.0.fields.iter().map(|field| (field.clone(), name(field)));
        let all = Expression::structure(Type::Own(self.0.types.accelerations.clone()), members);
        Expression::Block(vec![Statement::Let(apart, Expression::Tuple(columns.to_vec()))], Box::new(all))
    }

    /// The reactions that limit frictions; `None` for a contact without.
    fn bearings(&self) -> Function<Body> {
        let names: Vec<String> = (1..=self.0.count_bearings()).map(|number| format!("bearing_{number}")).collect();
        let mut left = names.iter();
        let contacts = self.0.contacts.iter();
        let all = contacts
            .map(|by_reaction| perhaps(by_reaction.then(|| left.next()).flatten().map(|bearing| name(bearing))));
        let all = Expression::List(all.collect()).converted();
        let body = Body { before: vec![Statement::Let(listed(&names), call("bearings").tried())], ..Body::plain(all) };
        let sizes = vec![self.0.unknowns, self.0.inputs.len(), self.0.contacts.len()];
        let of = Type::Around("Option", Box::new(Type::Sized("Bearing", sizes)));
        fallible_of_trait("bearings", self.motion(), self.each_contact(of), body)
    }

    /// One of the expressions at whose zeros a law has a kink.
    fn kink(&self) -> Function<Body> {
        let found = Expression::call(Intrinsic::Get, [call("kinks"), name("place")]);
        let found = Expression::call(Intrinsic::Copied, [found]);
        let [time, q, rates] = self.motion();
        let arguments = [("place", Passed::ByValue(Type::Count)), time, q, rates];
        of_trait(
            "kink",
            arguments,
            Type::Scalar,
            Body::plain(Expression::call(Intrinsic::UnwrapOr, [found, Expression::one()])),
        )
    }

    /// The change of the gap of each contact; `None` where it is not known.
    fn gap_changes(&self, has_change: &[bool]) -> Function<Body> {
        let names: Vec<String> =
            (1..=has_change.iter().filter(|has| **has).count()).map(|number| format!("change_{number}")).collect();
        let mut left = names.iter();
        let all = has_change.iter().map(|has| perhaps(has.then(|| left.next()).flatten().map(|change| name(change))));
        let all = Expression::List(all.collect()).converted();
        let changes = Expression::own_call("gap_changes", ["q", "moves"].map(name));
        let body = Body { before: vec![Statement::Let(listed(&names), changes)], ..Body::plain(all) };
        let of = Type::Around("Option", Box::new(Type::Scalar));
        let arguments = [self.coordinates("q", Order::Value), self.coordinates("moves", Order::Rate)];
        of_trait("gap_changes", arguments, self.each_contact(of), body)
    }

    fn unreduced(&self) -> Function<Body> {
        fallible_of_trait("unreduced", self.motion(), self.sized("Unreduced"), Body::result(call("unreduced")))
    }

    fn energy(&self) -> Function<Body> {
        let inputs = Type::Own(self.0.types.inputs.clone());
        let arguments = [self.coordinates("q", Order::Value), ("input_rates", Passed::ByReference(inputs))];
        let found = Expression::own_call("energy", [name("q"), name("input_rates").dereferenced()]).tried();
        let of = Type::Around("Option", Box::new(Type::Runtime("Energy", Vec::new())));
        fallible_of_trait("kinetic_and_potential", arguments, of, Body::plain(perhaps(Some(found))))
    }

    fn power(&self) -> Function<Body> {
        let inputs = Type::Own(self.0.types.inputs.clone());
        let arguments =
            [self.time(), self.coordinates("q", Order::Value), ("input_rates", Passed::ByReference(inputs))];
        let given = [name("t"), name("q"), name("input_rates").dereferenced()];
        let found = Expression::own_call("power", given).tried();
        let of = Type::Around("Option", Box::new(Type::Runtime("Power", Vec::new())));
        fallible_of_trait("applied_and_dissipated", arguments, of, Body::plain(perhaps(Some(found))))
    }

    /// The law of each input that has a drive.
    fn prescribed(&self) -> Function<Body> {
        let law = |at| self.0.driven.contains(&at).then(|| field("drives", &self.0.inputs[at]));
        let all = self.0.inputs.ids().map(|at| perhaps(law(at))).collect();
        let mut body = Body::plain(Expression::List(all).converted());
        if !self.0.driven.is_empty() {
            let drives = Expression::own_call("drives", [name("t")]);
            body.before.push(Statement::Let(Pattern::bound("drives".to_owned()), drives));
        }
        let of = Type::Around("Option", Box::new(Type::Runtime("Prescribed", Vec::new())));
        of_trait("prescribed", [self.time()], Type::Column(Box::new(of), self.0.inputs.len()), body)
    }
}

fn perhaps(value: Option<Expression>) -> Expression {
    match value {
        Some(value) => Expression::call(Intrinsic::Some, [value]),
        None => Expression::Constant(Constant::None),
    }
}
