//! The numbers of an analysis by hand at a position, from J, A and gamma alone: no mechanism needs more code for them.
//!
//! With `Psi' = J u' + A v'` the second derivative is `Psi'' = J u'' + A v'' + J' u' + A' v'`, where `J'` and `A'` are the
//! derivatives of J and A with respect to time. Gamma is a quadratic form of the rates, gamma(q') = B(q', q'), and the
//! columns of J' and A' are B(e, q') for the unit vectors e of the coordinates. B follows from gamma by
//! B(a, b) = (gamma(a + b) - gamma(a - b)) / 4.
//!
//! ```
//! use linkage::analysis::Analysis;
//! use linkage::{Elbow, linkage};
//!
//! linkage! {
//!     mechanism FourBar {
//!         param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
//!         input theta2;
//!         unknown theta3, theta4;
//!         loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
//!     }
//! }
//!
//! let m = FourBar::default();
//! let pose = m.assemble(0.3, FourBarBranch::new(Elbow::Left))?;
//! let at = Analysis::of(&m, &pose, 41.9, 10.0)?;
//! // J' has the entry -l3 cos(theta3) theta3' in its first row.
//! let entry = -m.l3 * pose.theta3.re * at.unknown_rates[0];
//! assert!((at.jacobian_rates.unknowns[(0, 0)] - entry).abs() < 1e-12 * entry.abs());
//! // Both methods give the same accelerations.
//! let [first, second] = at.accelerations;
//! assert!((first - second).largest() < 1e-13 * second.largest());
//! // With one input the velocity ratios are the transmission ratios.
//! assert_eq!(at.transmission_ratios(), Some(at.ratios.column(0)));
//! # Ok::<(), linkage::PositionError>(())
//! ```

use nalgebra::{Matrix2, Point2, Vector2};

use crate::error::all_finite;
use crate::jacobian::Scales;
use crate::linear::power_of_two_below;
use crate::scalar::arithmetic::*;
use crate::{
    Build, Column, Dim, Kinematic, Matrix, Mechanism, Name, PerInput, PerUnknown, PointMotion, PositionErrorOf, Real,
    real,
};

/// The columns of a matrix by the unknowns, and those by the inputs: J and A, for instance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Columns<T: Real, U: Dim, V: Dim> {
    /// The columns of the unknowns.
    pub unknowns: Matrix<T, U, U>,
    /// The columns of the inputs.
    pub inputs: Matrix<T, U, V>,
}

/// The numbers of an analysis by hand at a position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Analysis<T: Real, U: Dim, V: Dim> {
    /// J and A.
    pub jacobian: Columns<T, U, V>,
    /// det J.
    pub determinant: T,
    /// W = -J^-1 A.
    pub ratios: Matrix<T, U, V>,
    /// u' = W v'.
    pub unknown_rates: Column<T, U>,
    /// v'.
    pub input_rates: Column<T, V>,
    /// `v''`.
    pub input_accelerations: Column<T, V>,
    /// J' and A'.
    pub jacobian_rates: Columns<T, U, V>,
    /// (J u')_u and (A v')_v: they are J' and A' if J does not depend on v, nor A on u.
    pub jacobians_of_rates: Columns<T, U, V>,
    /// gamma.
    pub gamma: Column<T, U>,
    /// The parts of gamma: quadratic in u', quadratic in v', bilinear in both.
    pub gamma_parts: [Column<T, U>; 3],
    /// `H1 = A v''`, `H2 = J' (W v')`, `H3 = A' v'`, and their sum H0.
    pub terms: [Column<T, U>; 4],
    /// `u''` by two methods: -J^-1 H0, and `W v'' - J^-1 gamma`.
    pub accelerations: [Column<T, U>; 2],
}

/// The [`Analysis`] of a mechanism.
pub type AnalysisOf<M> = Analysis<<M as Mechanism>::Scalar, <M as Mechanism>::U, <M as Mechanism>::V>;

impl<T: Real, U: Dim, V: Dim> Analysis<T, U, V> {
    /// The numbers at a position, at these rates `v'` and accelerations `v''` of the inputs.
    ///
    /// # Errors
    /// [`PositionError::Singular`](crate::PositionError::Singular) if J is singular,
    /// [`PositionError::NotFinite`](crate::PositionError::NotFinite) if a number is not finite.
    pub fn of<M: Kinematic<Scalar = T, U = U, V = V>>(
        mechanism: &M,
        pose: &M::Pose,
        input_rates: impl Into<M::Inputs>,
        input_accelerations: impl Into<M::Inputs>,
    ) -> Result<Self, PositionErrorOf<M>> {
        let (input_rates, input_accelerations) = (input_rates.into(), input_accelerations.into());
        let rates = mechanism.velocity(pose, input_rates)?;
        let ratios = mechanism.velocity_ratios(pose)?;
        let jacobian = Columns { unknowns: mechanism.jacobian_unknowns(pose), inputs: mechanism.jacobian_inputs(pose) };
        let (unknown_rates, input_rates) = M::rate_parts(&rates);
        let input_accelerations: PerInput<M> = input_accelerations.into();
        let form = Form { mechanism, pose, scales: Scales::of(mechanism, pose) };
        let (still, held) = (unknown_rates.dim().zeros(), input_rates.dim().zeros());
        let jacobian_rates = form.columns(&unknown_rates, &input_rates);
        let jacobians_of_rates = Columns {
            unknowns: form.columns(&unknown_rates, &held).unknowns,
            inputs: form.columns(&still, &input_rates).inputs,
        };
        let gamma = mechanism.gamma(pose, &rates);
        let turned_back = form.gamma(unknown_rates, -input_rates);
        let gamma_parts =
            [form.gamma(unknown_rates, held), form.gamma(still, input_rates), (gamma - turned_back) * real::<T>(0.5)];
        let driven = jacobian.inputs * input_accelerations;
        let turned = jacobian_rates.unknowns * (ratios * input_rates);
        let moved = jacobian_rates.inputs * input_rates;
        let sum = driven + turned + moved;
        let first = mechanism.solve_jacobian(pose, &-sum)?;
        let second = ratios * input_accelerations + mechanism.solve_jacobian(pose, &-gamma)?;
        let found = Self {
            jacobian,
            determinant: mechanism.determinant(pose),
            ratios,
            unknown_rates,
            input_rates,
            input_accelerations,
            jacobian_rates,
            jacobians_of_rates,
            gamma,
            gamma_parts,
            terms: [driven, turned, moved, sum],
            accelerations: [first, second],
        };
        all_finite(mechanism.name(), Name::from_static("the analysis"), found.numbers())?;
        Ok(found)
    }

    /// The velocity ratios of a mechanism with one input: the transmission ratios, each the rate of an unknown divided by
    /// that of the input. None for several inputs.
    #[must_use]
    pub fn transmission_ratios(&self) -> Option<Column<T, U>> {
        match self.ratios.columns().as_slice() {
            [only] => Some(*only),
            _ => None,
        }
    }

    /// The determinant of the columns of [J A] that are left if those of a choice of inputs are taken out, in their order:
    /// where it is zero, these inputs cannot drive the mechanism. Coordinates are counted from 0, the unknowns before the
    /// inputs. None unless the choice has as many different coordinates as there are inputs.
    #[must_use]
    pub fn determinant_of(&self, choice: &[usize]) -> Option<T> {
        let Columns { unknowns, inputs } = &self.jacobian;
        let (u, v) = inputs.dims();
        let count = u.count() + v.count();
        let is_choice = |(place, coordinate): (usize, &usize)| {
            *coordinate < count && choice.iter().take(place).all(|other| other != coordinate)
        };
        if choice.len() != v.count() || !choice.iter().enumerate().all(is_choice) {
            return None;
        }
        let mut left = (0..count).filter(|coordinate| !choice.contains(coordinate));
        let column = |coordinate: usize| match coordinate.checked_sub(u.count()) {
            None => unknowns.column(coordinate),
            Some(input) => inputs.column(input),
        };
        let columns = u.column(|_| left.next().map_or_else(|| u.zeros(), column));
        Some(determinant(u.columns(columns)))
    }

    fn numbers(&self) -> impl Iterator<Item = &T> + Clone {
        let columns = [&self.jacobian_rates, &self.jacobians_of_rates];
        let matrices = columns.into_iter().flat_map(|columns| columns.unknowns.iter().chain(columns.inputs.iter()));
        matrices.chain(self.gamma_parts.iter().chain(&self.terms).chain(&self.accelerations).flatten())
    }
}

/// The quadratic form gamma at a position.
struct Form<'a, M: Mechanism> {
    mechanism: &'a M,
    pose: &'a M::Pose,
    scales: crate::jacobian::ScalesOf<M>,
}

impl<M: Mechanism> Form<'_, M> {
    fn gamma(&self, unknowns: PerUnknown<M>, inputs: PerInput<M>) -> PerUnknown<M> {
        self.mechanism.gamma(self.pose, &M::rates(unknowns, inputs))
    }

    /// B(e, q') for each coordinate. The step along e is about as large as q', in the scales of the coordinates, and a power
    /// of two, so that lengths in another unit change no digit.
    fn columns(&self, unknowns: &PerUnknown<M>, inputs: &PerInput<M>) -> Columns<M::Scalar, M::U, M::V> {
        let of = &self.scales.coordinates;
        let fastest = unknowns.component_div(&of.unknowns).largest().max(inputs.component_div(&of.inputs).largest());
        let (u, v) = (unknowns.dim(), inputs.dim());
        if fastest.is_zero() {
            return Columns { unknowns: u.zero_matrix(u), inputs: u.zero_matrix(v) };
        }
        let step = |scale: M::Scalar| power_of_two_below(scale * fastest);
        let quarter = |step: M::Scalar| (step * real::<M::Scalar>(4.0)).recip();
        Columns {
            unknowns: u.columns(u.column(|place| {
                let step = step(of.unknowns.part(place));
                let along = u.unit(place) * step;
                let [one, other] = [*unknowns + along, *unknowns - along].map(|unknowns| self.gamma(unknowns, *inputs));
                (one - other) * quarter(step)
            })),
            inputs: u.columns(v.column(|place| {
                let step = step(of.inputs.part(place));
                let along = v.unit(place) * step;
                let [one, other] = [*inputs + along, *inputs - along].map(|inputs| self.gamma(*unknowns, inputs));
                (one - other) * quarter(step)
            })),
        }
    }
}

/// The determinant by elimination with partial pivoting.
fn determinant<T: Real, N: Dim>(mut matrix: Matrix<T, N, N>) -> T {
    let (mut product, count) = (T::one(), matrix.dims().0.count());
    for place in 0..count {
        let larger = |best: usize, row: usize| {
            if matrix.part(row, place).abs() > matrix.part(best, place).abs() { row } else { best }
        };
        let pivot_row = (place + 1..count).fold(place, larger);
        if pivot_row != place {
            for column in matrix.columns_mut() {
                column.as_mut_slice().swap(place, pivot_row);
            }
            product = -product;
        }
        let pivot = matrix.part(place, place);
        if pivot.is_zero() {
            return pivot;
        }
        product *= pivot;
        for row in place + 1..count {
            let factor = matrix.part(row, place) / pivot;
            matrix.take_row(row, place, factor);
        }
    }
    product
}

/// A link that turns: its rate and acceleration, as the skew matrices of the points on it.
///
/// ```
/// use linkage::analysis::Turning;
/// use linkage::nalgebra::Vector2;
///
/// let coupler = Turning { rate: -18.4, acceleration: -260.0 };
/// let arm = Vector2::new(8.3, 23.6);
/// assert_eq!(coupler.relative_velocity(arm), coupler.rate_matrix() * arm);
/// let omega = coupler.rate_matrix();
/// let along = omega * omega * arm + coupler.acceleration_matrix() * arm;
/// assert!((coupler.relative_acceleration(arm) - along).norm() < 1e-12 * along.norm());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turning<T: Real = f64> {
    /// The rate of its angle.
    pub rate: T,
    /// The second derivative of its angle.
    pub acceleration: T,
}

impl<T: Real> Turning<T> {
    /// Omega: the matrix of the rate.
    #[must_use]
    pub fn rate_matrix(&self) -> Matrix2<T> {
        skew(self.rate)
    }

    /// Alpha: the matrix of the acceleration.
    #[must_use]
    pub fn acceleration_matrix(&self) -> Matrix2<T> {
        skew(self.acceleration)
    }

    /// The velocity of a point of the link at `arm` from another one, relative to that: Omega r.
    #[must_use]
    pub fn relative_velocity(&self, arm: Vector2<T>) -> Vector2<T> {
        self.rate_matrix() * arm
    }

    /// The acceleration of a point of the link at `arm` from another one, relative to that: Omega^2 r + alpha r.
    #[must_use]
    pub fn relative_acceleration(&self, arm: Vector2<T>) -> Vector2<T> {
        let square = self.rate * self.rate;
        self.acceleration_matrix() * arm - arm * square
    }

    /// The motion of the point of the link at `arm` from a point with this motion.
    #[must_use]
    pub fn point(&self, from: &PointMotion<T>, arm: Vector2<T>) -> PointMotion<T> {
        PointMotion {
            position: Point2::from(from.position.coords + arm),
            velocity: from.velocity + self.relative_velocity(arm),
            acceleration: from.acceleration + self.relative_acceleration(arm),
        }
    }
}

fn skew<T: Real>(rate: T) -> Matrix2<T> {
    Matrix2::new(T::zero(), -rate, rate, T::zero())
}

/// A vector of length z at an angle phi with its derivatives: one of a sum that leads to a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PolarVector<T: Real = f64> {
    /// z and phi.
    pub value: [T; 2],
    /// z' and phi'.
    pub rate: [T; 2],
}

impl<T: Real> PolarVector<T> {
    /// [cos phi, -z sin phi; sin phi, z cos phi]: the velocity is this matrix times (z', phi').
    #[must_use]
    pub fn matrix(&self) -> Matrix2<T> {
        let [length, angle] = self.value;
        let (sine, cosine) = angle.sine_cosine();
        Matrix2::new(cosine, -length * sine, sine, length * cosine)
    }

    /// The derivative of the vector with respect to time.
    #[must_use]
    pub fn velocity(&self) -> Vector2<T> {
        self.matrix() * Vector2::from(self.rate)
    }
}
