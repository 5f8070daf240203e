//! The mistakes that are planted into the programs.

mod engine;
mod four_bar;
mod pendulum;
mod press;

pub use engine::ENGINE;
pub use four_bar::FOUR_BAR;
pub use pendulum::PENDULUM;
pub use press::PRESS;

/// A mistake: its name, the text of the program that is replaced, and the replacement, with `«` and `»` around the token
/// of each message; without these it is accepted.
pub type Mistake = (&'static str, &'static str, &'static str);
