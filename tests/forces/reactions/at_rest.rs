//! Frictions and stops of a machine at rest: the modes in which all their laws hold, by trial of all.

use linkage_oracle::newton_euler::{Along, Law, Machine, Solution};

/// A contact with s' = 0.
#[derive(Debug, Clone, Copy)]
pub(super) enum Contact {
    /// With this limit.
    Friction(f64),
    /// On its lower limit.
    Lower,
    /// On its upper limit.
    Upper,
}

/// `Held`, or with this force, which s'' leaves: s'' is not opposite to `leaving`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Mode {
    Held,
    Left { force: f64, leaving: f64 },
}

impl Contact {
    fn modes(self) -> Vec<Mode> {
        let left = |force, leaving| Mode::Left { force, leaving };
        match self {
            Self::Friction(limit) => vec![Mode::Held, left(-limit, 1.0), left(limit, -1.0)],
            Self::Lower => vec![Mode::Held, left(0.0, 1.0)],
            Self::Upper => vec![Mode::Held, left(0.0, -1.0)],
        }
    }

    /// True if the contact bears this force.
    fn bears(self, force: f64) -> bool {
        match self {
            Self::Friction(limit) => force.abs() <= limit,
            Self::Lower => force >= 0.0,
            Self::Upper => force <= 0.0,
        }
    }
}

/// The motion that starts at rest, and the modes of the contacts.
pub(super) fn settled(machine: &Machine, contacts: &[(Along, Contact)]) -> (Solution, Vec<Mode>) {
    let mut choices: Vec<Vec<Mode>> = vec![Vec::new()];
    for (_, contact) in contacts {
        let longer = |modes: &Vec<Mode>| {
            let modes = modes.clone();
            contact.modes().into_iter().map(move |mode| [modes.clone(), vec![mode]].concat())
        };
        choices = choices.iter().flat_map(longer).collect();
    }
    let mut fitting =
        choices.into_iter().filter_map(|modes| fitting(machine, contacts, &modes).map(|found| (found, modes)));
    fitting.next().expect("modes in which all laws hold")
}

/// The motion in these modes, if all laws hold.
fn fitting(machine: &Machine, contacts: &[(Along, Contact)], modes: &[Mode]) -> Option<Solution> {
    let mut machine = machine.clone();
    let mut held = Vec::new();
    for ((along, _), mode) in contacts.iter().zip(modes) {
        held.push(match mode {
            Mode::Held => Some(machine.hold(along.clone(), 0.0)),
            Mode::Left { force, .. } => {
                machine.load(along.clone(), Law::Force(*force));
                None
            }
        });
    }
    let solution = machine.solve();
    let mut all = contacts.iter().zip(modes).zip(held);
    let holds = all.all(|(((along, contact), mode), held)| match (mode, held) {
        (Mode::Left { leaving, .. }, _) => solution.motion(along)[2] * leaving >= 0.0,
        (Mode::Held, held) => held.is_some_and(|held| contact.bears(solution.held(held))),
    });
    holds.then_some(solution)
}
