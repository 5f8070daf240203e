//! Errors for motions that end at a singularity.

use nalgebra::ComplexField;

use super::frame::Change;
use super::independent::Independent;
use super::motion::{Motion, Parametrisation};
use crate::error::CrossingRates;
use crate::{Coordinates, MotionError, MotionErrorOf, NameOf, Scene, StateColumn};
use linkage_runtime::__shared::arithmetic::*;
use linkage_runtime::__shared::{smallest, to_f64};
use linkage_runtime::held::Held;
use linkage_runtime::jacobian::ulp::nearly_zero;
use linkage_runtime::jacobian::{Blocks, EliminationOf as Elimination, Scales};
use linkage_runtime::{Build, D, Dim, Mechanism, PositionError, real};

/// Below this regularity of the best choice of coordinates a failed step is ascribed to forces in joints. In the tests
/// steps fail at 0.0005 to 0.003.
const NEXT_TO_CHANGE_POINT: f64 = 0.01;

impl<S: Scene, W> Motion<'_, S, W> {
    /// The change-point error with the group of least regularity, and the rates along the motions that cross.
    pub(super) fn change_point_error(&self, q: &Coordinates<S>) -> MotionErrorOf<S> {
        MotionError::ChangePoint {
            scene: self.scene.name(),
            group: self.least_regular_group(q),
            crossing: self.crossing_rates(q),
        }
    }

    /// The error for forces in joints next to a change point.
    pub(super) fn no_reactions_error(&self, q: &Coordinates<S>) -> MotionErrorOf<S> {
        MotionError::UndeterminedReactions { scene: self.scene.name(), group: self.least_regular_group(q) }
    }

    /// The error of a step; next to a change point that of forces in joints, if frictions depend on them: steps fail
    /// there, since these forces become infinite or rounding errors.
    pub(super) fn of_reactions(&self, y: &StateColumn<S>, error: MotionErrorOf<S>) -> MotionErrorOf<S> {
        let is_of_step = matches!(
            error,
            MotionError::StepTooSmall { .. } | MotionError::TooManySteps { .. } | MotionError::Position(_)
        );
        let q = self.scene.parts_of(y).q;
        if !(self.scene.has_bearings() && is_of_step) {
            return error;
        }
        let mechanism = self.scene.mechanism();
        let freely =
            Independent::choose(mechanism, &mechanism.pose_at(&q), &self.scales, &mechanism.dims().1.repeat(false));
        if freely.regularity() < real(NEXT_TO_CHANGE_POINT) { self.no_reactions_error(&q) } else { error }
    }

    fn least_regular_group(&self, q: &Coordinates<S>) -> NameOf<S> {
        let mechanism = self.scene.mechanism();
        Blocks::of(mechanism, &mechanism.pose_at(q)).least_regular().1
    }

    /// True if the position is that of the change point, to its accuracy.
    pub(super) fn is_at_change_point(&self, q: &Coordinates<S>) -> bool {
        let Parametrisation::Over(sheet) = &self.parametrisation else { return false };
        let pivots = self.factors(&sheet.independent, q).pivots();
        pivots.iter().zip(&sheet.vanishes).any(|(pivot, &vanishes)| vanishes && pivot.abs() <= nearly_zero())
    }

    /// True if the errors of interpolated accelerations, divided by the pivot that vanishes, are larger than
    /// sqrt(epsilon): forces in joints grow as these quotients.
    pub(super) fn is_next_to_change_point(&self, q: &Coordinates<S>) -> bool {
        let Parametrisation::Over(sheet) = &self.parametrisation else { return false };
        let pivots = self.factors(&sheet.independent, q).pivots();
        let vanishing = pivots.iter().zip(&sheet.vanishes).filter(|&(_, &vanishes)| vanishes);
        let least = smallest(vanishing.map(|(&pivot, _)| pivot));
        !sheet.is_regular(&pivots) && sheet.errors.largest() > least * S::Scalar::default_epsilon().sqrt()
    }

    /// The rates of two coordinates along the two motions of one input that cross at a position: the zeros of the
    /// quadratic form N (Psi_q x)_q x, where N is the left null vector of [J A] and x in its null space. `None` where
    /// the position is not a crossing of two motions.
    fn crossing_rates(&self, q: &Coordinates<S>) -> Option<CrossingRates<NameOf<S>>> {
        if self.dims().1.count() != 1 {
            return None;
        }
        let mechanism = self.scene.mechanism();
        let pose = mechanism.pose_at(q);
        let jacobian = self.scales.jacobian(mechanism, &pose);
        if Elimination::<S::Mechanism>::new(jacobian).defect(nearly_zero()) != 1 {
            return None;
        }
        let elimination = Elimination::<S::Mechanism>::all_but(1, jacobian);
        let mut free = elimination.free();
        let columns = [free.next()?, free.next()?];
        let null_vector = |column: usize| elimination.null_vector(column).scaled(&self.scales.coordinates);
        let (one, two) = (null_vector(columns[0]), null_vector(columns[1]));
        let form = |x: &Change<S>| {
            let rates = S::Mechanism::rates(x.unknowns, x.inputs);
            let along = mechanism.gamma(&pose, &rates).component_div(&self.scales.residuals);
            to_f64(elimination.left_null_product(&along).sum())
        };
        // The form of (x, y) is a x^2 + 2 b x y + c y^2.
        let [a, c, sum] = [form(&one), form(&two), form(&(one + two))];
        let b = 0.5 * (sum - a - c);
        let discriminant = b * b - a * c;
        let is_crossing = discriminant > to_f64(nearly_zero::<S::Scalar>()) * (a * a + b * b + c * c);
        if !is_crossing {
            return None;
        }
        let root = b + ComplexField::sqrt(discriminant).copysign(b);
        let scales = D::map(columns, |column| to_f64(self.scales.coordinates.get(column)));
        let rates = D::map([[-c, root], [root, -a]], |[x, y]| {
            let [x, y] = [x * scales[0], y * scales[1]];
            let size = if x.abs() > y.abs() { x } else { y };
            [x / size, y / size]
        });
        Some(CrossingRates {
            coordinates: [mechanism.coordinate_name(columns[0]), mechanism.coordinate_name(columns[1])],
            rates,
        })
    }

    /// The error if no choice of coordinates is regular: a prescribed input is at a dead point, or two motions cross.
    pub(super) fn no_coordinates_error(&self, t: S::Scalar, q: &Coordinates<S>) -> MotionErrorOf<S> {
        let mechanism = self.scene.mechanism();
        let is_driven = self.prescribed_inputs(t).iter().any(|&held| held);
        let freely =
            Independent::choose(mechanism, &mechanism.pose_at(q), &self.scales, &mechanism.dims().1.repeat(false));
        let is_regular = freely.regularity() > nearly_zero();
        if is_driven && is_regular {
            self.singular_error(q)
        } else if self.scene.has_bearings() {
            self.no_reactions_error(q)
        } else {
            self.change_point_error(q)
        }
    }

    pub(super) fn singular_error(&self, q: &Coordinates<S>) -> MotionErrorOf<S> {
        let mechanism = self.scene.mechanism();
        let (regularity, group) = Blocks::of(mechanism, &mechanism.pose_at(q)).least_regular();
        let regularity = to_f64(regularity);
        PositionError::Singular { mechanism: mechanism.name(), group, regularity }.into()
    }
}

/// The change-point error for a start at one that is singular, else this error.
pub(super) fn start_error<S: Scene>(scene: &S, q: &Coordinates<S>, error: MotionErrorOf<S>) -> MotionErrorOf<S> {
    if !matches!(error, MotionError::Position(PositionError::Singular { .. })) {
        return error;
    }
    let mechanism = scene.mechanism();
    let pose = mechanism.pose_at(q);
    let motion = Motion::new(Held::Borrowed(scene), Scales::of(mechanism, &pose), [S::Scalar::zero(); 2]);
    let freely = Independent::choose(mechanism, &pose, &motion.scales, &mechanism.dims().1.repeat(false));
    if freely.regularity() <= nearly_zero() { motion.change_point_error(q) } else { error }
}
