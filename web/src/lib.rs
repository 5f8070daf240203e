//! The module of the page: questions about a text of mechanisms, and their answers, as JSON.
//!
//! A [`Session`] keeps the compiled text and the motion that was followed last. All else is in the question: the values of
//! parameters, and the position, so that a session that was stopped goes on in a new one.

mod about;
mod at;
mod circuits;
mod drag;
#[cfg(target_family = "wasm")]
mod exports;
mod follow;
mod limit;
mod machine;
mod motion;
mod picture;
mod positions;
mod question;
mod refusal;
mod report;
mod session;
mod sheet;
mod simulate;
#[cfg(feature = "compiler")]
mod text;

pub use question::Question;
pub use refusal::Refusal;
pub use session::Session;
#[cfg(feature = "compiler")]
pub use text::compiled;
