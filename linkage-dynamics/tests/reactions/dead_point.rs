//! The pendulum in a journal bearing, driven by its horizontal position: the angle and the height are unknowns, so that
//! the simulation leaves the inputs where the pendulum is horizontal. The reactions are those of any coordinates.

use super::curve::{Curve, Particle, Path};
use linkage_dynamics::simulation::simulate;
use linkage_dynamics::{
    Bearing, Contact, ContactCoordinate, ContactLaw, Equations, Mode, MotionError, Prescribed, ReactionRow, Scene,
    StateColumn, Unreduced,
};
use linkage_runtime::{Column, D, Group, Matrix, Mechanism, PositionError};

const LENGTH: f64 = 0.8;
const MASS: f64 = 1.5;
const GRAVITY: f64 = 9.81;

/// u = (phi, y), v = (x): x = l sin phi, y = -l cos phi. Positions and rates are phi, y, x.
#[derive(Debug, Clone, Copy)]
struct Sideways;

impl Mechanism for Sideways {
    type Scalar = f64;
    type U = D<2>;
    type V = D<1>;
    type G = D<1>;
    type Coordinates = [f64; 3];
    type Rates = [f64; 3];
    type Inputs = Column<f64, D<1>>;
    type Pose = [f64; 3];

    const NAME: &'static str = "Sideways";
    const UNKNOWNS: &'static [&'static str] = &["phi", "y"];
    const INPUTS: &'static [&'static str] = &["x"];
    const UNKNOWN_ANGLES: &'static [bool] = &[true, false];
    const INPUT_ANGLES: &'static [bool] = &[false];
    const GROUPS: &'static [Group] = &[Group { name: "phi, y", equations: &[0, 1], unknowns: &[0, 1] }];

    fn coordinates(unknowns: Column<f64, D<2>>, inputs: Column<f64, D<1>>) -> [f64; 3] {
        [unknowns[0], unknowns[1], inputs[0]]
    }
    fn parts([phi, y, x]: &[f64; 3]) -> (Column<f64, D<2>>, Column<f64, D<1>>) {
        ([*phi, *y].into(), [*x].into())
    }
    fn rates(unknowns: Column<f64, D<2>>, inputs: Column<f64, D<1>>) -> [f64; 3] {
        Self::coordinates(unknowns, inputs)
    }
    fn rate_parts(rates: &[f64; 3]) -> (Column<f64, D<2>>, Column<f64, D<1>>) {
        Self::parts(rates)
    }
    fn pose_at(&self, q: &[f64; 3]) -> [f64; 3] {
        *q
    }
    fn is_finite(pose: &[f64; 3]) -> bool {
        pose.iter().all(|number| number.is_finite())
    }
    fn residual(&self, [phi, y, x]: &[f64; 3]) -> Column<f64, D<2>> {
        [x - LENGTH * phi.sin(), y + LENGTH * phi.cos()].into()
    }
    fn residual_scales(&self, [_, y, x]: &[f64; 3]) -> Column<f64, D<2>> {
        [x.abs() + LENGTH, y.abs() + LENGTH].into()
    }
    fn jacobian_unknowns(&self, [phi, ..]: &[f64; 3]) -> Matrix<f64, D<2>, D<2>> {
        Matrix::from([[-LENGTH * phi.cos(), -LENGTH * phi.sin()], [0.0, 1.0]])
    }
    fn jacobian_inputs(&self, _: &[f64; 3]) -> Matrix<f64, D<2>, D<1>> {
        Matrix::from([[1.0, 0.0]])
    }
    fn jacobian_unknowns_scales(&self, _: &[f64; 3]) -> Matrix<f64, D<2>, D<2>> {
        Matrix::from([[LENGTH, LENGTH], [0.0, 1.0]])
    }
    fn jacobian_inputs_scales(&self, _: &[f64; 3]) -> Matrix<f64, D<2>, D<1>> {
        Matrix::from([[1.0, 0.0]])
    }
    fn determinant(&self, [phi, ..]: &[f64; 3]) -> f64 {
        -LENGTH * phi.cos()
    }
    fn block_determinants(&self, pose: &[f64; 3]) -> Column<f64, D<1>> {
        [self.determinant(pose)].into()
    }
    fn gamma(&self, [phi, ..]: &[f64; 3], [rate, ..]: &[f64; 3]) -> Column<f64, D<2>> {
        [LENGTH * phi.sin() * rate * rate, -LENGTH * phi.cos() * rate * rate].into()
    }
    fn solve_jacobian(&self, pose: &[f64; 3], right: &Column<f64, D<2>>) -> Result<Column<f64, D<2>>, PositionError> {
        let determinant = self.determinant(pose);
        if determinant.abs() < 1e-14 {
            return Err(PositionError::Singular { mechanism: Self::NAME, group: "phi, y", regularity: 0.0 });
        }
        let phi = right[0] / determinant;
        Ok([phi, right[1] + LENGTH * pose[0].sin() * phi].into())
    }
}

struct Journal(f64);

impl Scene for Journal {
    type Scalar = f64;
    type U = D<2>;
    type V = D<1>;
    type State = D<4>;
    type Contacts = D<1>;
    type Mechanism = Sideways;
    type Reactions = ();

    const NAME: &'static str = "Journal";
    const BEARINGS: bool = true;

    fn mechanism(&self) -> &Sideways {
        &Sideways
    }
    fn state(q: &[f64; 3], input_rates: &Column<f64, D<1>>) -> StateColumn<Self> {
        [q[0], q[1], q[2], input_rates[0]].into()
    }
    fn parts(state: &StateColumn<Self>) -> ([f64; 3], Column<f64, D<1>>) {
        ([state[0], state[1], state[2]], [state[3]].into())
    }
    fn check(&self) -> Result<(), MotionError> {
        Ok(())
    }
    fn derivative(&self, t: f64, state: &StateColumn<Self>) -> Result<StateColumn<Self>, MotionError> {
        let Equations { mass, forces, ratios, .. } = self.equations(t, state)?;
        let unknowns = ratios * Column::from([state[3]]);
        Ok([unknowns[0], unknowns[1], state[3], forces[0] / mass[(0, 0)]].into())
    }
    fn equations(&self, _: f64, state: &StateColumn<Self>) -> Result<Equations<f64, D<2>, D<1>>, MotionError> {
        let (q, rate) = Self::parts(state);
        // y' = tan(phi) x', y'' = tan(phi) x'' + phi'^2 l / cos(phi).
        let (tangent, cosine) = (q[0].tan(), q[0].cos());
        let turn = rate[0] / (LENGTH * cosine);
        let bias = turn * turn * LENGTH / cosine;
        let mass = [[MASS * (1.0 + tangent * tangent)]];
        Equations::at(&Sideways, &q, rate, mass, [-MASS * tangent * (GRAVITY + bias)])
    }
    fn contacts(
        &self,
        _: f64,
        q: &[f64; 3],
        _: &[f64; 3],
    ) -> Result<Column<Contact<f64, D<2>, D<1>>, D<1>>, MotionError> {
        let along = ContactCoordinate { value: q[0], unknowns: [1.0, 0.0].into(), inputs: [0.0].into(), bias: 0.0 };
        Ok([Contact { name: "friction on phi", along, law: ContactLaw::Bearing { factor: self.0 } }].into())
    }
    fn bearings(
        &self,
        _: f64,
        _: &[f64; 3],
        _: &[f64; 3],
    ) -> Result<Column<Option<Bearing<f64, D<2>, D<1>, D<1>>>, D<1>>, MotionError> {
        let row = |of: [f64; 2]| ReactionRow { rows: of.into(), ..ReactionRow::zero() };
        Ok([Some(Bearing { components: [row([-1.0, 0.0]), row([0.0, -1.0])] })].into())
    }
    fn unreduced(&self, _: f64, _: &[f64; 3], _: &[f64; 3]) -> Result<Unreduced<f64, D<2>, D<1>>, MotionError> {
        Ok(Unreduced {
            unknowns: Matrix::from([[0.0, 0.0], [0.0, MASS]]),
            mixed: Matrix::zeros(),
            inputs: Matrix::from([[MASS]]),
            unknown_forces: [0.0, -MASS * GRAVITY].into(),
            input_forces: [0.0].into(),
        })
    }
    fn reactions(
        &self,
        _: f64,
        _: &linkage_dynamics::Coordinates<Self>,
        _: &linkage_dynamics::Rates<Self>,
        _: &linkage_dynamics::Accelerations<Self>,
        _: &Column<f64, Self::Contacts>,
    ) -> Result<(), MotionError> {
        Ok(())
    }

    fn prescribed(&self, _: f64) -> Column<Option<Prescribed<f64>>, D<1>> {
        [None].into()
    }
}

#[test]
fn a_bearing_acts_in_any_coordinates() {
    let (factor, angle) = (0.05, 2.0_f64);
    let journal = Journal(factor);
    let path = Path(Curve::Ellipse(LENGTH, LENGTH));
    let particle =
        Particle { path, mass: MASS, inertia: 0.0, gravity: GRAVITY, push: |_| 0.0, factors: [factor], normal: None };
    let (x, y) = (LENGTH * angle.sin(), -LENGTH * angle.cos());
    let mut one = simulate(&journal, (0.0, [angle, y, x], [0.0]), 12.0, 1e-11).unwrap();
    let mut other = simulate(&particle, (0.0, [x, y, angle], [0.0]), 12.0, 1e-11).unwrap();
    for k in 0..=60 {
        let t = f64::from(k) * 0.2;
        let one = one.at([t]).next().unwrap().unwrap();
        let other = other.at([t]).next().unwrap().unwrap();
        assert!((one.q[0] - other.q[2]).abs() < 1e-8, "{t}: {one:?} {other:?}");
        assert!((one.rates[0] - other.rates[2]).abs() < 1e-8, "{t}: {one:?} {other:?}");
    }
    assert!(one.passages().exchanges > 2, "{:?}", one.passages());
    assert_eq!(one.state().contacts[0].mode, Mode::Stick);
    assert_eq!(other.state().contacts[0].mode, Mode::Stick);
}
