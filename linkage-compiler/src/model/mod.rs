//! What was meant: a mechanism with every name resolved, every expression in the graph
//! and every check made. No later stage meets a mistake of the user, but for singular structure.

mod check;
mod expression;
mod guess;
mod kind;
mod lower;
mod mechanism;
mod name;
mod request;
mod scene;
mod scope;

pub use kind::Kind;
pub use lower::resolve;
pub use mechanism::{
    Call, Closure, Coordinate, Driver, ExternalFunction, Extreme, Mechanism, Output, Parameter, Point,
};
pub use name::Name;
pub use request::Request;
pub use scene::{Account, Body, Contact, ContactLaw, Drive, Law, Scene, Wish};
