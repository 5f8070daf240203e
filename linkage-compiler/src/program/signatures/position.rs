//! Functions that compute a position.

use super::Signatures;
use super::form::{fallible, hidden, inlined, public_inlined, total};
use crate::ids::InputId;
use crate::program::branch::Position;
use crate::program::expression::Type;
use crate::program::function::{Access, Argument, Body, Function, Passed};
use crate::program::names::Order;

impl Signatures {
    pub fn pose_at(&self) -> Function<Body> {
        let access = if self.has_scenes { Access::PublicLayer } else { Access::PublicInlined };
        Function { access, ..total("pose_at", [self.coordinates(Order::Value)], self.pose_type()) }
    }

    pub fn solve(&self) -> Function<Body> {
        let solution = Type::Around("Solution", Box::new(self.coordinates_type(Order::Value)));
        fallible("solve", [self.guess()], solution)
    }

    pub fn solve_any_branch(&self) -> Function<Body> {
        let found = Type::Around("AnyBranch", Box::new(self.coordinates_type(Order::Value)));
        fallible("solve_any_branch", [self.guess()], found)
    }

    /// The functions that assemble a position, and `branches`.
    pub fn assemblies(&self, position: &Position) -> Vec<Function<Body>> {
        if position.is_listed() {
            let mut all = vec![self.assemble_near(), self.assemble_remembering(position), self.assemble()];
            all.push(self.branches(position));
            return all;
        }
        if !position.is_closed {
            return vec![self.assemble_near(), self.no_assemble(position), self.branches(position)];
        }
        let mut all = Vec::new();
        if !position.turns.is_empty() {
            all.push(self.assemble_in_turns());
        }
        all.push(self.assemble());
        if !position.turns.is_empty() {
            all.push(self.assemble_near());
        }
        if !self.is_open {
            all.push(self.branches(position));
        }
        all
    }

    pub fn assemble(&self) -> Function<Body> {
        public_inlined(fallible("assemble", [self.inputs_by(Order::Value), self.branch()], self.pose_type()))
    }

    /// `assemble` of a mechanism without closed form: it returns an error, and a call of it is a warning that says why.
    pub fn no_assemble(&self, position: &Position) -> Function<Body> {
        let mut doc = position.obstacles();
        doc.push("Use `assemble_near` with a guess, or `solve`.".to_owned());
        let itself = fallible("assemble", [self.inputs_by(Order::Value), self.branch()], self.pose_type());
        Function { access: Access::Deprecated, doc, ..itself }
    }

    pub fn assemble_near(&self) -> Function<Body> {
        fallible("assemble_near", [self.guess(), self.branch()], self.pose_type())
    }

    /// `assemble` that keeps the positions of groups without closed form.
    pub fn assemble_remembering(&self, position: &Position) -> Function<Body> {
        let inputs = Passed::ByValue(Type::Own(self.types.inputs.clone()));
        let inputs = Argument { name: self.arguments.inputs.clone(), passed: inputs };
        let groups = position.modes.iter().map(|group| Type::Runtime("Memory", vec![group.loops, group.count]));
        let mut groups: Vec<Type> = groups.collect();
        let of = match (groups.pop(), groups.is_empty()) {
            (Some(only), true) => only,
            (last, _) => Type::Tuple(groups.into_iter().chain(last).collect()),
        };
        let memory = Argument { name: self.arguments.memory.clone(), passed: Passed::ByMutableReference(of) };
        inlined(fallible("assemble_remembering", [inputs, self.branch(), memory], self.pose_type()))
    }

    pub fn assemble_in_turns(&self) -> Function<Body> {
        let inputs = Passed::ByValue(Type::Own(self.types.inputs.clone()));
        let inputs = Argument { name: self.arguments.inputs.clone(), passed: inputs };
        let turn = Argument { name: self.arguments.turn.clone(), passed: Passed::Turns };
        inlined(fallible("assemble_in_turns", [inputs, self.branch(), turn], self.pose_type()))
    }

    /// `branches`; where the positions cannot be listed it returns an error, and a call of it is a warning that says why.
    pub fn branches(&self, position: &Position) -> Function<Body> {
        let of = Type::Branches { branch: self.types.branch.clone(), pose: self.types.pose.clone() };
        let itself = fallible("branches", [self.inputs_by(Order::Value)], of);
        let mut doc = position.obstacles();
        if !doc.is_empty() {
            doc.push("Its positions cannot be listed: use `assemble_near` with a guess, or `solve`.".to_owned());
        } else if !position.has_few_branches() {
            let most = Position::MOST_BRANCHES;
            doc.push(format!("It has more than {most} branches: use `assemble` with one of them."));
        } else {
            return itself;
        }
        Function { access: Access::Deprecated, doc, ..itself }
    }

    pub fn branch_of(&self) -> Function<Body> {
        total("branch_of", [self.pose()], Type::Bare(self.types.branch.clone()))
    }

    pub fn branch_near(&self) -> Function<Body> {
        total("branch_near", [self.guess()], Type::Bare(self.types.branch.clone()))
    }

    /// The limits of one input.
    pub fn limits(&self, position: &Position, index: InputId) -> Function<Body> {
        let from = match position.is_closed {
            true => self.inputs_by(Order::Value),
            false => self.guess(),
        };
        let name = match self.inputs.len() {
            1 => "limits".to_owned(),
            _ => format!("limits_of_{}", self.inputs[index].name.field),
        };
        fallible(name, [from, self.branch()], Type::Runtime("Limits", Vec::new()))
    }

    /// x and y of each joint.
    pub fn joints(&self, count: usize) -> Function<Body> {
        total("joints", [self.pose()], Type::Vector(2 * count))
    }

    /// The place and the direction of each force in a joint.
    pub fn force_places(&self, count: usize) -> Function<Body> {
        let of = Type::List(Box::new(Type::Scalar), 4);
        hidden(total("force_places", [self.pose()], Type::List(Box::new(of), count)))
    }

    /// x and y along the guide of each slider and sleeve of a drawing.
    pub fn guides(&self, count: usize) -> Function<Body> {
        let of = Type::List(Box::new(Type::Scalar), 2);
        hidden(total("guides", [self.pose()], Type::List(Box::new(of), count)))
    }
}
