//! The scene that is simulated, and its events.

use linkage_interpreter::SceneAtRunTime;
use linkage_runtime::UpTo;

/// The number of inputs: open chains have several.
pub type Inputs = UpTo<6>;

/// A scene with numbers.
pub type Running<'p> = SceneAtRunTime<'p, Inputs>;

/// True for the name of a mark that is more than a kink of a law.
pub fn is_event(mark: &str) -> bool {
    !mark.starts_with("kink of ")
}
