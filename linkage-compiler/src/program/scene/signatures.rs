//! The signatures of the functions of a scene: names, arguments and return types.

use super::reads::Read;
use std::collections::BTreeSet;

use crate::ids::{CoordinateId, InputId, SceneId, Table};
use crate::model::{Driver, Load, LoadKind, Mechanism, SceneRequest};
use crate::program::expression::Type;
use crate::program::function::{Access, Argument, Body, Function, Passed};
use crate::program::names::{Arguments, Order, TypeNames, argument, type_names};
use crate::program::signatures::{Parameter, fallible, total};

/// The functions of one scene, without bodies: plain data, as that of a driver.
#[derive(Debug, Clone)]
pub struct SceneSignatures {
    /// The scene among those of the mechanism.
    pub id: SceneId,
    pub scene: String,
    pub parameters: Vec<Parameter>,
    pub requests: BTreeSet<SceneRequest>,
    pub has_inertia: bool,
    /// For each friction and stop, true for a friction by the reaction in a joint.
    pub contacts: Vec<bool>,
    /// The joints whose forces it shows.
    pub joints: Vec<Joint>,
    pub types: TypeNames,
    pub arguments: Arguments,
    /// The field that holds the mechanism.
    pub field: String,
    /// The field names of the inputs, the ids of free inputs and those of driven ones.
    pub inputs: Table<InputId, String>,
    /// The field names of the dependent coordinates, and of all coordinates.
    pub dependent: Vec<String>,
    pub fields: Vec<String>,
    pub free: Vec<InputId>,
    pub driven: Vec<InputId>,
    /// The type with one value for each driven input.
    pub drives_type: String,
    /// The type of the forces in its joints.
    pub reactions_type: String,
    /// The argument for the moves of the coordinates.
    pub moves: String,
    pub unknowns: usize,
}

/// A joint whose force is shown.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Joint {
    /// Its place among the forces in joints of the mechanism.
    pub place: usize,
    pub name: String,
    /// The point at a pin; none of a guide.
    pub at: Option<String>,
    /// The link on which the force acts.
    pub on: String,
    /// The fields of its force: one for a vector, or two numbers.
    pub fields: Vec<String>,
}

impl Joint {
    fn of(place: usize, load: &Load) -> Self {
        let (at, on) = match &load.kind {
            LoadKind::Pin { joint, link } => (Some(joint.clone()), link.clone()),
            LoadKind::Guide { block, .. } => (None, block.clone()),
        };
        Self { place, name: load.field.clone(), at, on, fields: load.fields() }
    }
}

impl SceneSignatures {
    pub fn new(mechanism: &Mechanism, driver: &Driver, id: SceneId) -> Self {
        let scene = &mechanism.scenes[id];
        let parameters = scene.parameters.iter().map(|&id| &mechanism.scene_parameters[id]);
        let loads = &mechanism.opened.loads;
        let is_driven = |input: &InputId| scene.drives.iter().any(|drive| drive.input == *input);
        let (driven, free) = driver.inputs.ids().partition(is_driven);
        let field = |index: CoordinateId| mechanism.coordinates[index].name.field.clone();
        let inputs = driver.inputs.iter().map(|&index| field(index));
        Self {
            id,
            scene: scene.name.to_string(),
            parameters: parameters.map(|parameter| Parameter::of(&mechanism.graph, parameter)).collect(),
            requests: scene.requests.clone(),
            has_inertia: scene.inertia.is_some(),
            contacts: scene.contacts.iter().map(|contact| contact.bearing.is_some()).collect(),
            joints: scene.loads.iter().map(|&place| Joint::of(place, &loads[place])).collect(),
            types: TypeNames { itself: scene.name.to_string(), ..type_names(mechanism, driver) },
            arguments: Arguments::new(mechanism),
            field: argument(mechanism, "mechanism"),
            inputs: inputs.collect(),
            dependent: driver.unknowns.iter().map(|&index| field(index)).collect(),
            fields: mechanism.coordinate_order(driver).into_iter().map(field).collect(),
            free,
            driven,
            drives_type: format!("{}Drives", scene.name),
            reactions_type: format!("{}Reactions", scene.name),
            moves: argument(mechanism, "moves"),
            unknowns: driver.unknowns.len(),
        }
    }

    /// All signatures in the order of emission: the most used first.
    pub fn all(&self) -> Vec<Function<Body>> {
        let (has_inertia, mut all) = (self.has_inertia, Vec::new());
        if has_inertia {
            all.extend([self.acceleration(), self.rates()]);
        }
        if !self.driven.is_empty() {
            all.extend([self.drive_forces(), self.drives()]);
        }
        let requests = [SceneRequest::Energy, SceneRequest::Power, SceneRequest::Reactions, SceneRequest::Equilibrium];
        for request in requests.into_iter().filter(|request| self.requests.contains(request)) {
            match request {
                SceneRequest::Energy => all.push(self.energy()),
                SceneRequest::Power => all.push(self.power()),
                SceneRequest::Reactions => {}
                SceneRequest::Equilibrium => all.extend([self.equilibrium(), self.balance()]),
            }
        }
        if self.has_reactions() {
            all.push(self.reactions());
            all.extend(has_inertia.then(|| self.reactions_of()));
        }
        if has_inertia {
            all.push(self.mass_matrix());
        }
        all.push(self.forces());
        if has_inertia {
            all.push(self.unreduced());
        }
        all.push(self.check());
        if !self.contacts.is_empty() {
            all.push(self.contacts());
            all.extend((self.count_bearings() > 0).then(|| self.bearings()));
            all.push(self.equations());
        }
        all
    }

    pub fn mass_matrix(&self) -> Function<Body> {
        let v = self.inputs.len();
        fallible("mass_matrix", [self.coordinates(Order::Value)], Type::Matrix(v, v))
    }

    pub fn forces(&self) -> Function<Body> {
        fallible("forces", self.state(), Type::Vector(self.inputs.len()))
    }

    pub fn rates(&self) -> Function<Body> {
        let (rates, inputs) = (self.types.rates.clone(), self.types.inputs.clone());
        fallible("rates", self.state(), Type::StateRates { rates, inputs })
    }

    pub fn acceleration(&self) -> Function<Body> {
        fallible("acceleration", self.state(), Type::Own(self.types.inputs.clone()))
    }

    pub fn unreduced(&self) -> Function<Body> {
        fallible("unreduced", self.whole_state(), Type::Sized("Unreduced", vec![self.unknowns, self.inputs.len()]))
    }

    pub fn drives(&self) -> Function<Body> {
        total("drives", [self.time()], self.each_drive(Type::Runtime("Prescribed", Vec::new())))
    }

    pub fn drive_forces(&self) -> Function<Body> {
        fallible("drive_forces", self.state(), self.each_drive(Type::Scalar))
    }

    fn each_drive(&self, of: Type) -> Type {
        Type::Each(self.drives_type.clone(), Box::new(of))
    }

    pub fn energy(&self) -> Function<Body> {
        let arguments = self.state().into_iter().skip(1);
        fallible("energy", arguments, Type::Runtime("Energy", Vec::new()))
    }

    pub fn power(&self) -> Function<Body> {
        fallible("power", self.state(), Type::Runtime("Power", Vec::new()))
    }

    /// True if a statement asks for the force in a joint.
    pub fn has_reactions(&self) -> bool {
        self.has_multipliers() || !self.joints.is_empty()
    }

    pub fn has_multipliers(&self) -> bool {
        self.requests.contains(&SceneRequest::Reactions) && self.unknowns > 0
    }

    pub fn reactions(&self) -> Function<Body> {
        fallible("reactions", self.state(), Type::Own(self.reactions_type.clone()))
    }

    /// The reactions of a known motion.
    pub fn reactions_of(&self) -> Function<Body> {
        let forces = Type::List(Box::new(Type::Scalar), self.contacts.len());
        let forces = Argument { name: self.arguments.contact_forces.clone(), passed: Passed::ByReference(forces) };
        let forces = (!self.contacts.is_empty()).then_some(forces);
        let motion = self.whole_state().into_iter().chain([self.coordinates(Order::Acceleration)]).chain(forces);
        let of = Type::Own(self.reactions_type.clone());
        Function { access: Access::Hidden, ..fallible("reactions_of", motion, of) }
    }

    pub fn balance(&self) -> Function<Body> {
        let arguments = [self.time(), self.coordinates(Order::Value)];
        fallible("balance", arguments, Type::Runtime("Balance", vec![self.free.len()]))
    }

    pub fn equilibrium(&self) -> Function<Body> {
        let guess = Argument { name: self.arguments.guess.clone(), ..self.coordinates(Order::Value) };
        fallible("equilibrium", [self.time(), guess], self.coordinates_type(Order::Value))
    }

    pub fn contacts(&self) -> Function<Body> {
        let contact = Type::Sized("Contact", vec![self.unknowns, self.inputs.len()]);
        let of = Type::List(Box::new(contact), self.contacts.len());
        Function { access: Access::Hidden, ..fallible("contacts", self.whole_state(), of) }
    }

    /// The number of frictions by reaction.
    pub fn count_bearings(&self) -> usize {
        self.contacts.iter().filter(|by_reaction| **by_reaction).count()
    }

    pub fn bearings(&self) -> Function<Body> {
        let sizes = vec![self.unknowns, self.inputs.len(), self.contacts.len()];
        let of = Type::List(Box::new(Type::Sized("Bearing", sizes)), self.count_bearings());
        Function { access: Access::Hidden, ..fallible("bearings", self.whole_state(), of) }
    }

    pub fn equations(&self) -> Function<Body> {
        let of = Type::Sized("Equations", vec![self.unknowns, self.inputs.len()]);
        Function { access: Access::Hidden, ..fallible("equations", self.state(), of) }
    }

    /// The expressions at whose zeros laws have kinks.
    pub fn kinks(&self, many: usize) -> Function<Body> {
        let of = Type::List(Box::new(Type::Scalar), many);
        Function { access: Access::Hidden, ..total("kinks", self.whole_state(), of) }
    }

    /// The changes of gaps while each coordinate moves.
    pub fn gap_changes(&self, many: usize) -> Function<Body> {
        let moves = Argument { name: self.moves.clone(), ..self.coordinates(Order::Rate) };
        let of = Type::List(Box::new(Type::Scalar), many);
        Function { access: Access::Hidden, ..total("gap_changes", [self.coordinates(Order::Value), moves], of) }
    }

    pub fn check(&self) -> Function<Body> {
        fallible("check", [], Type::Tuple(Vec::new()))
    }

    pub fn check_effects(&self, takes_time: bool) -> Function<Body> {
        let rates = Passed::ByValue(Type::Own(self.types.inputs.clone()));
        let rates = Argument { name: self.arguments.input_rates.clone(), passed: rates };
        let time = takes_time.then(|| self.time());
        let arguments = time.into_iter().chain([self.coordinates(Order::Value), rates]);
        Function { access: Access::Cold, ..fallible("check_effects", arguments, Type::Tuple(Vec::new())) }
    }

    /// The argument for a dependency of a layer, if there is one.
    pub fn of_layer(&self, read: Read) -> Option<Argument> {
        let Arguments { q, pose, ratios, rates, bias, .. } = &self.arguments;
        let list = |of: Type, many: usize| Type::List(Box::new(of), many);
        let (name, of) = match read {
            Read::Time => return Some(self.time()),
            Read::Q => (q, self.coordinates_type(Order::Value)),
            Read::Pose => (pose, Type::Own(self.types.pose.clone())),
            Read::Ratios => (ratios, list(list(Type::Scalar, self.unknowns), self.inputs.len())),
            Read::Rates => (rates, self.coordinates_type(Order::Rate)),
            Read::Bias => (bias, list(Type::Scalar, self.unknowns)),
            Read::InputRates | Read::Inertia | Read::Forces => return None,
        };
        Some(Argument { name: name.clone(), passed: Passed::ByReference(of) })
    }

    /// t, q and v'.
    fn state(&self) -> [Argument; 3] {
        let rates = Passed::Converted(Type::Own(self.types.inputs.clone()));
        let rates = Argument { name: self.arguments.input_rates.clone(), passed: rates };
        [self.time(), self.coordinates(Order::Value), rates]
    }

    /// t, q and q'.
    fn whole_state(&self) -> [Argument; 3] {
        [self.time(), self.coordinates(Order::Value), self.coordinates(Order::Rate)]
    }

    fn time(&self) -> Argument {
        Argument { name: self.arguments.time.clone(), passed: Passed::ByValue(Type::Scalar) }
    }

    fn coordinates(&self, order: Order) -> Argument {
        let passed = Passed::ByReference(self.coordinates_type(order));
        Argument { name: self.arguments.of(order).to_owned(), passed }
    }

    fn coordinates_type(&self, order: Order) -> Type {
        Type::Own(order.type_of(&self.types).to_owned())
    }
}

/// A private function that is inlined into the functions of its scene.
pub fn layer(name: &str, arguments: Vec<Argument>, of: Type) -> Function<Body> {
    Function { access: Access::Layer, ..total(name, arguments, of) }
}
