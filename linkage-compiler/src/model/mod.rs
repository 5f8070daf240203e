//! Semantic analysis: names resolved, expressions in the graph, all checks made. Later stages report only mistakes that
//! appear in derivatives, see `derivation::check`.

mod advice;
mod chain;
mod chains;
mod check;
mod displaced;
mod equation;
mod equation_angles;
mod expression;
mod functions;
mod guess;
mod joints;
mod kind;
mod kinematic_chain;
mod links;
mod meant;
mod mechanism;
mod name;
mod opened;
mod opening;
mod output_angles;
mod power;
mod range;
mod redundant;
mod request;
mod resolve;
mod resolver;
mod scene;
mod scope;
mod slips;
mod undeclared;

pub use chain::{Chain, Link};
pub use functions::VECTOR_FUNCTIONS;
pub use guess::{Guess, GuessedGroup};
pub use joints::Joints;
pub use kind::{Kind, Measure};
pub use kinematic_chain::{ChainJoint, ChainLink, KinematicChain};
pub use mechanism::{
    Call, Constraint, Coordinate, Driver, ExternalFunction, Extreme, JointRange, Mechanism, Output, Parameter, Point,
};
pub use name::{Name, TypeName};
pub use opened::{Load, LoadKind, Opened};
pub use output_angles::{OutputAngle, output_angles};
pub use request::Request;
pub use resolve::resolve;
pub use scene::{Account, Body, Contact, ContactLaw, Drive, Law, Scene, SceneRequest};
