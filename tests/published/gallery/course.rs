//! A mechanism followed through its motion by Newton's method.

use approx::assert_abs_diff_eq;
use std::f64::consts::TAU;

use linkage::{D, Mechanism, position};

use super::exactness::exact;

/// Steps of a full turn: one a degree.
pub(super) const STEPS: u32 = 360;

pub(super) fn degrees(angle: f64) -> f64 {
    angle.to_radians()
}

/// The input of a mechanism that has one.
fn input<M: Mechanism<Scalar = f64, V = D<1>>>(q: &M::Coordinates) -> f64 {
    M::inputs(q)[0]
}

/// A mechanism followed from a start, and its positions on the way.
pub(super) struct Course<'a, M: Mechanism<Scalar = f64, V = D<1>>> {
    pub(super) mechanism: &'a M,
    pub(super) positions: Vec<M::Coordinates>,
}

/// Follows a mechanism while its input goes from that of `start` by `span`, each position found by Newton's method from
/// the prediction of the velocity ratios at the last one.
#[track_caller]
pub(super) fn follow<'a, M: Mechanism<Scalar = f64, V = D<1>>>(
    mechanism: &'a M,
    start: M::Coordinates,
    span: f64,
) -> Course<'a, M> {
    let mut course = Course { mechanism, positions: Vec::new() };
    let mut q = start;
    let from = input::<M>(&q);
    for step in 0..=STEPS {
        let to = from + span * f64::from(step) / f64::from(STEPS);
        q = course.assemble(course.predict(q, to));
        course.positions.push(q);
    }
    course
}

/// A full turn, which returns to the position of the start and never leaves the branch.
#[track_caller]
pub(super) fn turn<'a, M: Mechanism<Scalar = f64, V = D<1>>>(mechanism: &'a M, start: M::Coordinates) -> Course<'a, M> {
    let course = follow(mechanism, start, TAU);
    let first = mechanism.pose_at(&course.positions[0]);
    for q in &course.positions {
        assert!(mechanism.same_branch(&first, &mechanism.pose_at(q)), "{} changed its branch", M::NAME);
    }
    let difference = M::unknowns(&course.positions[STEPS as usize]) - M::unknowns(&course.positions[0]);
    for change in difference.iter() {
        // An angle may have made turns of its own.
        assert_abs_diff_eq!(*change, (change / TAU).round() * TAU, epsilon = 1e-12);
    }
    course
}

impl<M: Mechanism<Scalar = f64, V = D<1>>> Course<'_, M> {
    /// The prediction from a position to another input: u + W (to - v).
    #[track_caller]
    fn predict(&self, q: M::Coordinates, to: f64) -> M::Coordinates {
        let step = to - input::<M>(&q);
        let mut unknowns = M::unknowns(&q);
        if step != 0.0 {
            let pose = self.mechanism.pose_at(&q);
            let a = self.mechanism.jacobian_inputs(&pose).column(0);
            unknowns += -self.mechanism.solve_jacobian(&pose, &a).expect("a regular position") * step;
        }
        M::coordinates(unknowns, [to].into())
    }

    #[track_caller]
    fn assemble(&self, guess: M::Coordinates) -> M::Coordinates {
        let solution = match position::newton(self.mechanism, &guess) {
            Ok(solution) => solution,
            Err(error) => panic!("at {:.3}: {error}", input::<M>(&guess)),
        };
        let pose = self.mechanism.pose_at(&solution.coordinates);
        let sizes = self.mechanism.residual_scales(&pose);
        for (residual, size) in self.mechanism.residual(&pose).iter().zip(sizes.iter()) {
            exact(*residual, 0.0, *size);
        }
        solution.coordinates
    }

    /// The position at an input on the way.
    #[track_caller]
    pub(super) fn at(&self, wanted: f64) -> M::Coordinates {
        let distance = |q: &M::Coordinates| (input::<M>(q) - wanted).abs();
        let nearest = self.positions.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("positions");
        self.assemble(self.predict(*nearest, wanted))
    }

    /// The inputs at which `value` changes its sign, by bisection.
    pub(super) fn roots(&self, value: impl Fn(&M::Coordinates) -> f64) -> Vec<f64> {
        let mut roots = Vec::new();
        for pair in self.positions.windows(2) {
            let [mut low, mut high] = [0, 1].map(|index: usize| input::<M>(&pair[index]));
            let sign = value(&pair[0]).is_sign_positive();
            if sign == value(&pair[1]).is_sign_positive() {
                continue;
            }
            for _ in 0..60 {
                let middle = (low + high) / 2.0;
                if value(&self.at(middle)).is_sign_positive() == sign {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            roots.push((low + high) / 2.0);
        }
        roots
    }

    /// The least and the largest `value` on the way, by golden section about the least and largest sample.
    pub(super) fn range(&self, value: impl Fn(&M::Coordinates) -> f64) -> [f64; 2] {
        [-1.0, 1.0].map(|sign| {
            let height = |q: &M::Coordinates| sign * value(q);
            let index = (0..self.positions.len())
                .max_by(|&a, &b| height(&self.positions[a]).total_cmp(&height(&self.positions[b])))
                .expect("positions");
            let input = |index: usize| input::<M>(&self.positions[index]);
            let mut low = input(index.saturating_sub(1));
            let mut high = input((index + 1).min(self.positions.len() - 1));
            for _ in 0..60 {
                let [left, right] = [0.618, 0.382].map(|part| high - part * (high - low));
                if height(&self.at(left)) > height(&self.at(right)) {
                    high = right;
                } else {
                    low = left;
                }
            }
            value(&self.at((low + high) / 2.0))
        })
    }
}
