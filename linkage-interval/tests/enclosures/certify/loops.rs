//! Mechanisms of vector loops, written out by hand over every number.

use std::fmt::Debug;
use std::marker::PhantomData;

use linkage_interval::Interval;
use linkage_runtime::{
    Build, Certifiable, Column, D, Dim, Formulas, Group, Matrix, Mechanism, Number, PositionError, UpTo,
};

/// The angle of a vector.
#[derive(Debug, Clone, Copy)]
pub enum Angle {
    Fixed,
    Input,
    Unknown(usize),
    /// Twice an unknown.
    Twice(usize),
}

/// The length of a vector.
#[derive(Debug, Clone, Copy)]
pub enum Length {
    Parameter(usize),
    Unknown(usize),
}

/// A vector: factor, length, angle, and quarter turns added to it.
pub type Term = (f64, Length, Angle, u32);

/// A fault in the emitted formulas.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    None,
    SignInJ,
    SignInA,
    SignInGamma,
}

/// A mechanism as data.
pub trait Shape: Copy + Debug + PartialEq + 'static {
    type P: Dim + Default;
    type U: Dim + Default;
    type Q: Dim + Default;
    const LOOPS: &'static [&'static [Term]];
    /// Points as sums of vectors.
    const POINTS: &'static [&'static [Term]] = &[];
    /// Outputs as differences of two unknowns.
    const OUTPUTS: &'static [(usize, usize)] = &[];
    /// Further outputs: sums of multiples of the directions of points.
    const DIRECTIONS: &'static [&'static [(f64, usize)]] = &[];
    const UNKNOWN_ANGLES: &'static [bool];
    const GROUPS: &'static [Group<'static>];
    const USER_FUNCTIONS: &'static [Option<&'static str>] = &[None];
    const FAULT: Fault = Fault::None;
}

/// A mechanism with its parameters.
#[derive(Debug, Clone, Copy)]
pub struct Loops<S: Shape, N: Number> {
    pub parameters: Column<N, S::P>,
    shape: PhantomData<S>,
}

/// A vector with its factors.
struct Vector<N> {
    xy: [N; 2],
    /// The unit vector, and the same turned by a quarter turn.
    direction: [N; 2],
    across: [N; 2],
    length: N,
    factor: N,
}

impl<S: Shape, N: Number> Loops<S, N> {
    pub fn new(parameters: impl Into<Column<N, S::P>>) -> Self {
        Self { parameters: parameters.into(), shape: PhantomData }
    }

    fn vector(&self, term: &Term, u: &Column<N, S::U>, v: N) -> Vector<N> {
        let &(factor, length, angle, quarters) = term;
        let factor = N::exactly(factor);
        let length = match length {
            Length::Parameter(place) => self.parameters[place],
            Length::Unknown(place) => u[place],
        };
        let (sine, cosine) = match angle {
            Angle::Fixed => (N::zero(), N::one()),
            Angle::Input => v.sine_cosine(),
            Angle::Unknown(place) => u[place].sine_cosine(),
            Angle::Twice(place) => (u[place] + u[place]).sine_cosine(),
        };
        let direction = match quarters % 4 {
            0 => [cosine, sine],
            1 => [-sine, cosine],
            2 => [-cosine, -sine],
            _ => [sine, -cosine],
        };
        let across = [-direction[1], direction[0]];
        let size = factor * length;
        Vector { xy: direction.map(|part| size * part), direction, across, length, factor }
    }

    fn sum(&self, terms: &[Term], u: &Column<N, S::U>, v: N) -> [N; 2] {
        let vectors = terms.iter().map(|term| self.vector(term, u, v).xy);
        vectors.reduce(|[x, y], [a, b]| [x + a, y + b]).unwrap_or([N::zero(); 2])
    }

    /// The derivatives of all loops by an angle or a length.
    fn by(&self, u: &Column<N, S::U>, v: N, variable: Angle) -> Column<N, S::U> {
        let mut column = Column::repeat(N::zero());
        for (row, terms) in S::LOOPS.iter().enumerate() {
            for term in *terms {
                let vector = self.vector(term, u, v);
                let by_angle = match (variable, term.2) {
                    (Angle::Input, Angle::Input) => Some(N::one()),
                    (Angle::Unknown(one), Angle::Unknown(other)) if one == other => Some(N::one()),
                    (Angle::Unknown(one), Angle::Twice(other)) if one == other => Some(N::exactly(2.0)),
                    _ => None,
                };
                let by_length = matches!((variable, term.1), (Angle::Unknown(a), Length::Unknown(b)) if a == b);
                for axis in 0..2 {
                    let place = 2 * row + axis;
                    if let Some(turns) = by_angle {
                        column[place] = column[place] + turns * vector.factor * vector.length * vector.across[axis];
                    }
                    if by_length {
                        column[place] = column[place] + vector.factor * vector.direction[axis];
                    }
                }
            }
        }
        column
    }
}

impl<S: Shape, N: Number> Formulas for Loops<S, N> {
    type Number = N;
    type U = S::U;
    type V = D<1>;
    type Q = S::Q;

    fn residual(&self, u: &Column<N, S::U>, v: &Column<N, D<1>>) -> Column<N, S::U> {
        let loops: Vec<[N; 2]> = S::LOOPS.iter().map(|terms| self.sum(terms, u, v[0])).collect();
        Column::from_fn(|row| loops[row / 2][row % 2])
    }
    fn jacobian_unknowns(&self, u: &Column<N, S::U>, v: &Column<N, D<1>>) -> Column<Column<N, S::U>, S::U> {
        Column::from_fn(|place| {
            let column = self.by(u, v[0], Angle::Unknown(place));
            if S::FAULT == Fault::SignInJ && place == 0 { column.map(|entry| -entry) } else { column }
        })
    }
    fn jacobian_inputs(&self, u: &Column<N, S::U>, v: &Column<N, D<1>>) -> Column<Column<N, S::U>, D<1>> {
        let column = self.by(u, v[0], Angle::Input);
        Column::repeat(if S::FAULT == Fault::SignInA { column.map(|entry| -entry) } else { column })
    }
    fn gamma(
        &self,
        u: &Column<N, S::U>,
        v: &Column<N, D<1>>,
        du: &Column<N, S::U>,
        dv: &Column<N, D<1>>,
    ) -> Column<N, S::U> {
        let mut gamma = Column::repeat(N::zero());
        for (row, terms) in S::LOOPS.iter().enumerate() {
            for term in *terms {
                let vector = self.vector(term, u, v[0]);
                let turn = match term.2 {
                    Angle::Fixed => N::zero(),
                    Angle::Input => dv[0],
                    Angle::Unknown(place) => du[place],
                    Angle::Twice(place) => du[place] + du[place],
                };
                let growth = match term.1 {
                    Length::Parameter(_) => N::zero(),
                    Length::Unknown(place) => du[place],
                };
                for axis in 0..2 {
                    let across = vector.factor * (growth + growth) * turn * vector.across[axis];
                    let inward = vector.xy[axis] * turn.square();
                    let inward = if S::FAULT == Fault::SignInGamma { -inward } else { inward };
                    gamma[2 * row + axis] = gamma[2 * row + axis] + across - inward;
                }
            }
        }
        gamma
    }
    fn quantities(&self, u: &Column<N, S::U>, v: &Column<N, D<1>>) -> Column<N, S::Q> {
        let points: Vec<[N; 2]> = S::POINTS.iter().map(|terms| self.sum(terms, u, v[0])).collect();
        Column::from_fn(|place| match points.get(place / 2) {
            Some(point) => point[place % 2],
            None if place - 2 * points.len() < S::OUTPUTS.len() => {
                let (one, other) = S::OUTPUTS[place - 2 * points.len()];
                u[one] - u[other]
            }
            None => {
                let terms = S::DIRECTIONS[place - 2 * points.len() - S::OUTPUTS.len()].iter();
                let angles =
                    terms.map(|&(factor, point)| N::exactly(factor) * points[point][1].arctangent2(points[point][0]));
                angles.reduce(|sum, angle| sum + angle).unwrap_or(N::zero())
            }
        })
    }
}

impl<S: Shape> Loops<S, f64> {
    /// The coordinates from numbers.
    pub fn at(u: impl Into<Column<f64, S::U>>, v: f64) -> (Column<f64, S::U>, Column<f64, D<1>>) {
        (u.into(), [v].into())
    }

    fn scales(&self) -> f64 {
        self.parameters.largest()
    }
}

impl<S: Shape> Mechanism for Loops<S, f64> {
    type Scalar = f64;
    type Name = &'static str;
    type U = S::U;
    type V = D<1>;
    type G = UpTo<8>;
    type Coordinates = (Column<f64, S::U>, Column<f64, D<1>>);
    type Rates = (Column<f64, S::U>, Column<f64, D<1>>);
    type Inputs = Column<f64, D<1>>;
    type Pose = (Column<f64, S::U>, Column<f64, D<1>>);
    type Branch = ();

    const NAME: &'static str = "Loops";
    const UNKNOWNS: &'static [&'static str] = &["u0", "u1", "u2", "u3", "u4", "u5", "u6", "u7", "u8", "u9"];
    const INPUTS: &'static [&'static str] = &["v"];
    const UNKNOWN_ANGLES: &'static [bool] = S::UNKNOWN_ANGLES;
    const INPUT_ANGLES: &'static [bool] = &[true];
    const GROUPS: &'static [Group<'static>] = S::GROUPS;

    fn dims(&self) -> (S::U, D<1>, UpTo<8>) {
        (Dim::least(), D, Dim::new(S::GROUPS.len()).expect("few groups"))
    }
    fn coordinates(u: Column<f64, S::U>, v: Column<f64, D<1>>) -> Self::Coordinates {
        (u, v)
    }
    fn parts(q: &Self::Coordinates) -> (Column<f64, S::U>, Column<f64, D<1>>) {
        *q
    }
    fn rates(u: Column<f64, S::U>, v: Column<f64, D<1>>) -> Self::Rates {
        (u, v)
    }
    fn rate_parts(rates: &Self::Rates) -> (Column<f64, S::U>, Column<f64, D<1>>) {
        *rates
    }
    fn pose_at(&self, q: &Self::Coordinates) -> Self::Pose {
        *q
    }
    fn is_finite(pose: &Self::Pose) -> bool {
        pose.0.is_finite() && pose.1.is_finite()
    }
    fn branch_of(&self, _: &Self::Pose) {}
    fn residual(&self, q: &Self::Pose) -> Column<f64, S::U> {
        Formulas::residual(self, &q.0, &q.1)
    }
    fn residual_scales(&self, _: &Self::Pose) -> Column<f64, S::U> {
        Column::repeat(self.scales())
    }
    fn jacobian_unknowns(&self, q: &Self::Pose) -> Matrix<f64, S::U, S::U> {
        Matrix::from_columns(Formulas::jacobian_unknowns(self, &q.0, &q.1))
    }
    fn jacobian_inputs(&self, q: &Self::Pose) -> Matrix<f64, S::U, D<1>> {
        Matrix::from_columns(Formulas::jacobian_inputs(self, &q.0, &q.1))
    }
    fn jacobian_unknowns_scales(&self, _: &Self::Pose) -> Matrix<f64, S::U, S::U> {
        Matrix::from_fn(|_, column| if S::UNKNOWN_ANGLES[column] { self.scales() } else { 1.0 })
    }
    fn jacobian_inputs_scales(&self, _: &Self::Pose) -> Matrix<f64, S::U, D<1>> {
        Matrix::from_fn(|_, _| self.scales())
    }
    fn determinant(&self, _: &Self::Pose) -> f64 {
        f64::NAN
    }
    fn block_determinants(&self, _: &Self::Pose) -> Column<f64, UpTo<8>> {
        self.dims().2.repeat(f64::NAN)
    }
    fn gamma(&self, q: &Self::Pose, rates: &Self::Rates) -> Column<f64, S::U> {
        Formulas::gamma(self, &q.0, &q.1, &rates.0, &rates.1)
    }
    fn solve_jacobian(&self, _: &Self::Pose, _: &Column<f64, S::U>) -> Result<Column<f64, S::U>, PositionError> {
        Err(PositionError::NotFinite { mechanism: Self::NAME, quantity: "not used here" })
    }
}

impl<S: Shape> Certifiable for Loops<S, f64> {
    type P = S::P;
    type Q = S::Q;
    type Over<N: Number> = Loops<S, N>;

    const PARAMETERS: &'static [&'static str] = &[];
    const QUANTITIES: &'static [&'static str] = &[];
    const USER_FUNCTIONS: &'static [Option<&'static str>] = S::USER_FUNCTIONS;

    fn parameters(&self) -> Column<f64, S::P> {
        self.parameters
    }
    fn with(&self, parameters: Column<f64, S::P>) -> Self {
        Loops::new(parameters)
    }
    fn over<N: Number>(&self, parameters: Column<N, S::P>) -> Loops<S, N> {
        Loops::new(parameters)
    }
}

/// An interval of one number.
pub fn exactly(value: f64) -> Interval {
    Interval::from(value)
}
