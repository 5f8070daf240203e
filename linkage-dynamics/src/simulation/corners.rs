//! The memory of the kinks of a motion.

use crate::{MotionError, NameOf, Scene};
use linkage_runtime::__shared::to_f64;
use linkage_runtime::{BorrowedName, Real, real};

/// The most kinks in a row without a longer step between them. A force that always points towards its kink, such as
/// -x'/|x'|, has them without end.
const MAX_IN_A_ROW: u32 = 16;

/// Kinks gather at a time if the last two are nearer to each other than two others by this factor. Those of a periodic
/// law are not.
const GATHERED: f64 = 1e-3;

/// The change of a law between two neighbouring times.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corner<T, N> {
    /// The last time before the change.
    pub(super) before: T,
    /// The first time after it.
    pub(super) after: T,
    /// The effect with the law.
    pub(super) effect: N,
}

/// The change of a law of a scene.
pub(super) type CornerOf<S> = Corner<<S as Scene>::Scalar, NameOf<S>>;

/// The kinks of a motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corners<T, N> {
    /// The start of the step.
    pub(super) from: T,
    pub(super) is_forward: bool,
    /// The end of the simulation.
    pub(super) end: T,
    /// The change at the end of the step.
    pub(super) ahead: Option<Corner<T, N>>,
    /// A change that the integration of a drive has shown.
    pub(super) found: Option<Corner<T, N>>,
    /// The effect whose kink is at the end of the last step, for a kink of the state.
    pub(super) passed: Option<N>,
    /// The kink of the state before which the last step has ended, and the sign of its expression; that before which
    /// this step is to end.
    pub(super) towards: Option<(usize, i8)>,
    pub(super) approached: Option<(usize, i8)>,
    /// The effect whose kink of the state this step is to go over, and the side on which the motion then is.
    pub(super) crossing: Option<(N, (usize, i8))>,
    /// The kink of the state that the motion went over last, the sign of its expression since, and the length of that step.
    pub(super) side: Option<(usize, i8)>,
    pub(super) over: T,
    /// The number of times in a row that a step was shortened for a drive.
    pub(super) shortened: u32,
    /// The number of kinks in a row without a longer step, and the time of the first of these.
    pub(super) in_a_row: u32,
    pub(super) first: T,
    /// The last kink, the time since the one before it, and the longest such time.
    pub(super) last: Option<(N, T)>,
    pub(super) gap: T,
    pub(super) longest: T,
}

impl<T: Real, N: BorrowedName> Corners<T, N> {
    pub(super) fn new(start: T, end: T) -> Self {
        Self {
            from: start,
            is_forward: end >= start,
            end,
            ahead: None,
            found: None,
            passed: None,
            towards: None,
            approached: None,
            crossing: None,
            side: None,
            over: T::zero(),
            shortened: 0,
            in_a_row: 0,
            first: start,
            last: None,
            gap: T::zero(),
            longest: T::zero(),
        }
    }

    /// Counts a kink of this effect at a time.
    ///
    /// # Errors
    /// [`MotionError::KinksWithoutEnd`] after too many in a row.
    pub(super) fn note(&mut self, scene: N, effect: N, t: T) -> Result<(), MotionError<N>> {
        if self.in_a_row == 0 {
            self.first = t;
        }
        self.in_a_row += 1;
        if let Some((_, last)) = self.last {
            self.gap = (t - last).abs();
            self.longest = self.longest.max(self.gap);
        }
        self.last = Some((effect, t));
        if self.in_a_row > MAX_IN_A_ROW {
            return Err(MotionError::KinksWithoutEnd { scene, effect, t: to_f64(self.first) });
        }
        Ok(())
    }

    /// The last step is repeated: it does not end before a kink.
    pub(super) fn forget_approach(&mut self) {
        self.approached = None;
    }

    /// The error of an integration, which names the effect if kinks that gather at a time have ended it.
    pub(super) fn explained(&self, scene: N, error: MotionError<N>) -> MotionError<N> {
        let gather = self.gap < self.longest * real(GATHERED);
        match (error, self.last) {
            (MotionError::TooManySteps { t, .. } | MotionError::StepTooSmall { t, .. }, Some((effect, _)))
                if gather || self.in_a_row > 1 =>
            {
                MotionError::KinksWithoutEnd { scene, effect, t }
            }
            _ => error,
        }
    }
}
