//! The pendulum in a journal bearing, driven by its horizontal position: the angle and the height are unknowns, so that
//! the simulation leaves the inputs where the pendulum is horizontal. The reactions are those of any coordinates.

use super::curve::{Curve, Particle, Path};
use super::three_numbers;
use linkage_dynamics::simulation::{Start, simulate};
use linkage_dynamics::{
    Accelerations, Bearing, Contact, ContactCoordinate, ContactLaw, Equations, Mode, MotionError, Prescribed,
    ReactionRow, Scene, StateColumn, StateParts, Unreduced,
};
use linkage_runtime::{Column, D, Group, Matrix, Mechanism, PositionError};

const LENGTH: f64 = 0.8;
const MASS: f64 = 1.5;
const GRAVITY: f64 = 9.81;

/// u = (phi, y), v = (x): x = l sin phi, y = -l cos phi. Positions and rates are phi, y, x.
#[derive(Debug, Clone, Copy)]
struct Sideways;

impl Mechanism for Sideways {
    three_numbers::mechanism!();

    const NAME: &'static str = "Sideways";
    const UNKNOWNS: &'static [&'static str] = &["phi", "y"];
    const INPUTS: &'static [&'static str] = &["x"];
    const UNKNOWN_ANGLES: &'static [bool] = &[true, false];
    const INPUT_ANGLES: &'static [bool] = &[false];
    const GROUPS: &'static [Group<'static>] = &[Group { name: "phi, y", equations: &[0, 1], unknowns: &[0, 1] }];

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
    three_numbers::scene!();

    type Contacts = D<1>;
    type Mechanism = Sideways;

    const NAME: &'static str = "Journal";
    const BEARINGS: bool = true;

    fn mechanism(&self) -> &Sideways {
        &Sideways
    }
    fn equations(&self, _: f64, state: &StateColumn<Self>) -> Result<Equations<f64, D<2>, D<1>>, MotionError> {
        let StateParts { q, input_rates: rate } = Self::parts(state);
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
        let row = |of: [f64; 2]| ReactionRow { rows: of.into(), ..ReactionRow::zero((D, D, D)) };
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
}

#[test]
fn a_bearing_acts_in_any_coordinates() {
    let (factor, angle) = (0.05, 2.0_f64);
    let journal = Journal(factor);
    let path = Path(Curve::Ellipse(LENGTH, LENGTH));
    let particle =
        Particle { path, mass: MASS, inertia: 0.0, gravity: GRAVITY, push: |_| 0.0, factors: [factor], normal: None };
    let (x, y) = (LENGTH * angle.sin(), -LENGTH * angle.cos());
    let mut one = simulate(&journal, Start { t: 0.0, q: [angle, y, x], input_rates: [0.0] }, 12.0, 1e-11).unwrap();
    let mut other = simulate(&particle, Start { t: 0.0, q: [x, y, angle], input_rates: [0.0] }, 12.0, 1e-11).unwrap();
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
