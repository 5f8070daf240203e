//! The forces in the joints of a scene as a list, for tables and drawings of any scene.

use core::fmt::Debug;

use crate::BorrowedName;

/// A joint whose force a scene shows, with its names as they are declared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Joint<N = &'static str> {
    /// A pin. Its force on a link is a vector along x and y of the ground.
    Pin {
        /// The field of the force.
        name: N,
        /// The point at the pin; the links that meet there if it has no name.
        at: N,
        /// The link on which the force acts.
        on: N,
        /// Its place among the forces in joints of the mechanism, for
        /// [`Skeleton::force_place`](crate::skeleton::Skeleton::force_place).
        place: usize,
    },
    /// A guide. Its force on what slides is a normal force and a moment.
    Guide {
        /// The coordinate whose vector is the guide; the fields of the force are this name with `_normal` and `_moment`.
        name: N,
        /// The link that slides.
        on: N,
        /// Its place, as that of a pin.
        place: usize,
    },
}

impl<N> Joint<N> {
    /// This joint with other names.
    #[inline]
    pub fn map_names<M>(self, mut f: impl FnMut(N) -> M) -> Joint<M> {
        match self {
            Self::Pin { name, at, on, place } => Joint::Pin { name: f(name), at: f(at), on: f(on), place },
            Self::Guide { name, on, place } => Joint::Guide { name: f(name), on: f(on), place },
        }
    }
}

/// The forces in the joints that a scene shows, in the order of their declaration. `N` is the type of names of its mechanism.
///
/// `linkage!` implements it for the type of the reactions of each scene; `()` is that of a scene that shows none.
///
/// ```
/// use linkage_runtime::{Joint, JointForces};
///
/// /// The largest force in a pin.
/// fn largest<F: JointForces<f64>>(forces: &F) -> f64 {
///     let pins = forces.joints().zip(forces.each()).filter(|(joint, _)| matches!(joint, Joint::Pin { .. }));
///     pins.map(|(_, [x, y])| x.hypot(y)).fold(0.0, f64::max)
/// }
/// assert_eq!(largest(&()), 0.0);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no forces in joints",
    note = "name them by `reaction at P;` or `reactions;` in a scene"
)]
pub trait JointForces<T, N: BorrowedName = &'static str>: Copy + PartialEq + Debug {
    /// The kinematics; `()` if there are no forces.
    type Mechanism;
    /// The joints of emitted code, where they are constants.
    const JOINTS: &'static [Joint];

    /// The joints. Those of emitted code are constants, those of a scene at run time are of the value.
    #[inline]
    fn joints(&self) -> impl Iterator<Item = Joint<N>> {
        Self::JOINTS.iter().map(|joint| joint.map_names(N::from_static))
    }
    /// The two numbers of each force: x and y of a pin, normal force and moment of a guide.
    fn each(&self) -> impl Iterator<Item = [T; 2]>;
}

impl<T, N: BorrowedName> JointForces<T, N> for () {
    type Mechanism = ();

    const JOINTS: &'static [Joint] = &[];

    fn each(&self) -> impl Iterator<Item = [T; 2]> {
        core::iter::empty()
    }
}
