//! A particle on a curve, written by hand: x = X(v), y = Y(v) are its two constraints, whose multipliers are the force
//! that the curve exerts on it.

use super::three_numbers;
use linkage_dynamics::contact::ReducedEquations;
use linkage_dynamics::{
    Accelerations, Bearing, Contact, ContactCoordinate, ContactLaw, Equations, Mode, MotionError, Prescribed, Rates,
    ReactionRow, Scene, StateColumn, StateParts, Unreduced,
};
use linkage_runtime::{Column, D, Group, Matrix, Mechanism, PositionError};

/// The curve, with the coordinate v along it.
#[derive(Debug, Clone, Copy)]
pub enum Curve {
    /// A straight line at this angle; v is the distance.
    Line(f64),
    /// An ellipse with these semi-axes; v is zero at its lowest point.
    Ellipse(f64, f64),
}

impl Curve {
    /// The point, and its first and second derivative.
    pub fn at(self, v: f64) -> [[f64; 2]; 3] {
        match self {
            Self::Line(angle) => {
                let (sine, cosine) = angle.sin_cos();
                [[v * cosine, v * sine], [cosine, sine], [0.0, 0.0]]
            }
            Self::Ellipse(a, b) => {
                let (sine, cosine) = v.sin_cos();
                [[a * sine, -b * cosine], [a * cosine, b * sine], [-a * sine, b * cosine]]
            }
        }
    }
}

/// u = (x, y), v = (v). Positions and rates are x, y, v.
#[derive(Debug, Clone, Copy)]
pub struct Path(pub Curve);

impl Mechanism for Path {
    three_numbers::mechanism!();

    const NAME: &'static str = "Path";
    const UNKNOWNS: &'static [&'static str] = &["x", "y"];
    const INPUTS: &'static [&'static str] = &["v"];
    const UNKNOWN_ANGLES: &'static [bool] = &[false, false];
    const INPUT_ANGLES: &'static [bool] = &[true];
    const GROUPS: &'static [Group<'static>] = &[Group { name: "x, y", equations: &[0, 1], unknowns: &[0, 1] }];

    fn residual(&self, [x, y, v]: &[f64; 3]) -> Column<f64, D<2>> {
        let [point, ..] = self.0.at(*v);
        [x - point[0], y - point[1]].into()
    }
    fn residual_scales(&self, [x, y, v]: &[f64; 3]) -> Column<f64, D<2>> {
        let [point, ..] = self.0.at(*v);
        [1.0 + x.abs() + point[0].abs(), 1.0 + y.abs() + point[1].abs()].into()
    }
    fn jacobian_unknowns(&self, _: &[f64; 3]) -> Matrix<f64, D<2>, D<2>> {
        Matrix::identity()
    }
    fn jacobian_inputs(&self, [_, _, v]: &[f64; 3]) -> Matrix<f64, D<2>, D<1>> {
        let [_, slope, _] = self.0.at(*v);
        Matrix::from([slope.map(|component| -component)])
    }
    fn jacobian_unknowns_scales(&self, _: &[f64; 3]) -> Matrix<f64, D<2>, D<2>> {
        Matrix::identity()
    }
    fn jacobian_inputs_scales(&self, _: &[f64; 3]) -> Matrix<f64, D<2>, D<1>> {
        Matrix::from([[1.0, 1.0]])
    }
    fn determinant(&self, _: &[f64; 3]) -> f64 {
        1.0
    }
    fn block_determinants(&self, _: &[f64; 3]) -> Column<f64, D<1>> {
        [1.0].into()
    }
    fn gamma(&self, [_, _, v]: &[f64; 3], [_, _, rate]: &[f64; 3]) -> Column<f64, D<2>> {
        let [.., second] = self.0.at(*v);
        second.map(|component| -component * rate * rate).into()
    }
    fn solve_jacobian(&self, _: &[f64; 3], right: &Column<f64, D<2>>) -> Result<Column<f64, D<2>>, PositionError> {
        Ok(*right)
    }
}

/// A particle on a curve with gravity, a force along v, and frictions of v by the reaction.
#[derive(Debug, Clone, Copy)]
pub struct Particle<const C: usize> {
    pub path: Path,
    pub mass: f64,
    pub inertia: f64,
    pub gravity: f64,
    /// The generalised force on v at a time.
    pub push: fn(f64) -> f64,
    pub factors: [f64; C],
    /// The direction of the component that counts, or None for the whole reaction.
    pub normal: Option<[f64; 2]>,
}

impl<const C: usize> Particle<C> {
    /// The kinetic and potential energy.
    pub fn energy(&self, v: f64, rate: f64) -> f64 {
        let [point, slope, _] = self.path.0.at(v);
        let inertia = self.mass * (slope[0] * slope[0] + slope[1] * slope[1]) + self.inertia;
        0.5 * inertia * rate * rate + self.mass * self.gravity * point[1]
    }

    /// The friction forces in these modes.
    pub fn frictions(&self, t: f64, v: f64, rate: f64, modes: Column<Mode, D<C>>) -> Result<[f64; C], MotionError> {
        let [point, ..] = self.path.0.at(v);
        let state = Self::state(&[point[0], point[1], v], &[rate].into());
        let motion =
            linkage_dynamics::contact::Contacts::in_modes(modes).motion(&ReducedEquations::of(self, t, &state)?)?;
        Ok(motion.forces.into())
    }
}

impl<const C: usize> Scene for Particle<C> {
    three_numbers::scene!();

    type Contacts = D<C>;
    type Mechanism = Path;

    const NAME: &'static str = "Particle";
    const BEARINGS: bool = true;

    fn mechanism(&self) -> &Path {
        &self.path
    }
    fn equations(&self, t: f64, state: &StateColumn<Self>) -> Result<Equations<f64, D<2>, D<1>>, MotionError> {
        let StateParts { q, input_rates: rate } = Self::parts(state);
        let [_, slope, second] = self.path.0.at(q[2]);
        let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        let mass = [[self.mass * dot(slope, slope) + self.inertia]];
        let quadratic = self.mass * dot(slope, second) * rate[0] * rate[0];
        let forces = [(self.push)(t) - self.mass * self.gravity * slope[1] - quadratic];
        Equations::at(&self.path, &q, rate, mass, forces)
    }
    fn contacts(
        &self,
        _: f64,
        q: &[f64; 3],
        _: &Rates<Self>,
    ) -> Result<Column<Contact<f64, D<2>, D<1>>, D<C>>, MotionError> {
        let along = ContactCoordinate { value: q[2], unknowns: Column::zeros(), inputs: [1.0].into(), bias: 0.0 };
        let contact = |factor: f64| Contact { name: "friction on v", along, law: ContactLaw::Bearing { factor } };
        Ok(Column::from(self.factors.map(contact)))
    }
    fn bearings(
        &self,
        _: f64,
        _: &[f64; 3],
        _: &Rates<Self>,
    ) -> Result<Column<Option<Bearing<f64, D<2>, D<1>, D<C>>>, D<C>>, MotionError> {
        // The constraints exert -lambda on the particle.
        let row =
            |of: [f64; 2]| ReactionRow { rows: of.map(|component| -component).into(), ..ReactionRow::zero((D, D, D)) };
        let components = match self.normal {
            Some(normal) => [row(normal), ReactionRow::zero((D, D, D))],
            None => [row([1.0, 0.0]), row([0.0, 1.0])],
        };
        Ok(Column::repeat(Some(Bearing { components })))
    }
    fn unreduced(&self, t: f64, _: &[f64; 3], _: &Rates<Self>) -> Result<Unreduced<f64, D<2>, D<1>>, MotionError> {
        Ok(Unreduced {
            unknowns: Matrix::identity() * self.mass,
            mixed: Matrix::zeros(),
            inputs: Matrix::from([[self.inertia]]),
            unknown_forces: [0.0, -self.mass * self.gravity].into(),
            input_forces: [(self.push)(t)].into(),
        })
    }
}
