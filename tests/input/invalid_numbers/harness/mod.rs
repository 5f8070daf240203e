//! The calls: their arguments, the checks of their results, and their outcomes.

mod algorithms;
mod draw;
mod finite;
pub mod tally;

pub use algorithms::{driven, integrations, mechanism, scene};
pub use draw::{Draw, Pool, Source};
pub use tally::{Tally, listen};

use crate::called::{Call, Called};

/// The calls of one mechanism or one scene with the arguments of one trial.
#[derive(Clone, Copy)]
pub enum Subject {
    /// Its own functions.
    Functions(&'static Called),
    /// Algorithms of the runtime.
    Algorithms(fn(&mut Tally, &mut Source)),
}

impl Subject {
    pub fn try_out(self, t: &mut Tally, s: &mut Source) {
        match self {
            Self::Functions(of) => functions(of, t, s),
            Self::Algorithms(run) => run(t, s),
        }
    }
}

/// One call of each function; first those that find positions, which are arguments of the others.
fn functions(of: &'static Called, t: &mut Tally, s: &mut Source) {
    let mut call = |name: &'static str, run: Call| {
        s.begin_call();
        t.text(s.seed, (of.scene.unwrap_or(of.name), name), || run(s));
    };
    for (name, run) in of.functions.iter().filter(|(name, _)| name.starts_with("solve")) {
        call(name, *run);
    }
    for (name, run) in of.functions.iter().chain(of.of_pose) {
        call(name, *run);
    }
}
