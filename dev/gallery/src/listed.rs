//! The mechanisms of the gallery as objects: a test of all of them is a function over `&dyn Listed<f64>` that loops over
//! [`all`], compiled once.
//!
//! The functions for doubles are compiled in this crate. [`all_of`] and its like are generic: the crate that calls one
//! compiles all mechanisms for its scalar.
//!
//! Lists of coordinates, rates and accelerations are in the order of their fields; points are listed as x, y, x, y, ..

use std::marker::PhantomData;
use std::rc::Rc;
use std::sync::LazyLock;

use linkage::analysis::{Analysis, Columns};
use linkage::derivation::Derivation;
use linkage::kinematic::{FullKinematics, Kinematic, Kinematics, PerCoordinate};
use linkage::position::newton;
use linkage::sheet::{RatioProperty, ratio_properties};
use linkage::{Column, Dim, Matrix, Mechanism, OutputMotion, PointMotion, PositionError, Real};
use nalgebra::DMatrix;

use crate::fixture::{Fixture, inputs, named, pairs};

/// A mechanism by its names.
pub trait Named: Send + Sync {
    /// The file of `src/mechanisms` without its ending.
    fn file(&self) -> &'static str;
    /// The name of the mechanism or of its driver.
    fn name(&self) -> &'static str;
}

/// A mechanism of the gallery in a scalar.
pub trait Listed<T: Real>: Named {
    /// The names of the unknowns.
    fn unknowns(&self) -> &'static [&'static str];
    /// The names of the inputs.
    fn inputs(&self) -> &'static [&'static str];
    /// The number of branches; 1 if the position is found by Newton's method.
    fn branch_count(&self) -> usize;
    /// The inputs among the coordinates, or their derivatives.
    fn inputs_of(&self, q: &[T]) -> Vec<T>;
    /// The coordinates of these unknowns and inputs, each in the order of their names.
    fn coordinates(&self, unknowns: &[T], inputs: &[T]) -> Vec<T>;
    /// The default values of the parameters, in the order of declaration.
    fn defaults(&self) -> Vec<f64>;
    /// The branches as `Debug` writes them; none if the position is found by Newton's method.
    fn branches(&self) -> Vec<String>;
    /// The constant `DERIVATION`.
    fn derivation(&self) -> &'static Derivation<'static>;
    /// The mechanism with these parameters, in the order of declaration.
    fn with_parameters(&self, parameters: &[T]) -> Box<dyn Built<T>>;
}

/// A mechanism with its parameters.
pub trait Built<T: Real> {
    /// The position at coordinates.
    fn pose(&self, q: &[T]) -> Box<dyn Posed<T>>;
    /// The position at the inputs of q, on a branch or by Newton's method from q.
    fn position(&self, q: &[T], branch: usize) -> Result<Box<dyn Posed<T>>, PositionError>;
    /// The position that `moving` starts from.
    fn assembled(&self, q: &[T], branch: usize) -> Result<Box<dyn Posed<T>>, PositionError>;
    /// The coordinates that Newton's method finds from a guess.
    fn solved(&self, guess: &[T]) -> Result<Vec<T>, PositionError>;
    /// The velocity and the acceleration at q, with points and outputs.
    fn motion(&self, q: &[T], input_rates: &[T], given: &[T]) -> Result<Motion<T>, PositionError>;
    /// Position, velocity and acceleration in one computation, from q as in `position`, or from q on its branch by
    /// Newton's method; with points and outputs if `full`.
    fn moving(
        &self,
        q: &[T],
        branch: usize,
        input_rates: &[T],
        given: &[T],
        full: bool,
    ) -> Result<Moving<T>, PositionError>;
    /// Position, velocity and acceleration by separate calls.
    fn moving_by_parts(
        &self,
        q: &[T],
        branch: usize,
        input_rates: &[T],
        given: &[T],
    ) -> Result<Moving<T>, PositionError> {
        let pose = self.assembled(q, branch)?;
        let rates = pose.velocity(input_rates)?;
        let accelerations = pose.acceleration(&rates, given)?;
        Ok(Moving { pose, rates, accelerations, points: None, outputs: None })
    }
}

/// A motion in lists: each with its first and second derivative.
pub struct Motion<T> {
    pub coordinates: [Vec<T>; 3],
    pub points: [Vec<T>; 3],
    pub outputs: [Vec<T>; 3],
}

/// A position with its rates and accelerations, and the motion of points and outputs if it is computed.
pub struct Moving<T> {
    pub pose: Box<dyn Posed<T>>,
    pub rates: Vec<T>,
    pub accelerations: Vec<T>,
    pub points: Option<[Vec<T>; 3]>,
    pub outputs: Option<[Vec<T>; 3]>,
}

/// A mechanism at a position; the functions are those of [`Mechanism`] and [`Kinematic`].
pub trait Posed<T: Real> {
    fn coordinates(&self) -> Vec<T>;
    fn is_finite(&self) -> bool;
    fn residual(&self) -> Vec<T>;
    fn residual_scales(&self) -> Vec<T>;
    /// Psi_q, by rows of constraints and columns of coordinates.
    fn jacobian(&self) -> DMatrix<T>;
    fn jacobian_unknowns(&self) -> DMatrix<T>;
    fn jacobian_inputs(&self) -> DMatrix<T>;
    fn determinant(&self) -> T;
    fn block_determinants(&self) -> Vec<T>;
    fn solve_jacobian(&self, right: &[T]) -> Result<Vec<T>, PositionError>;
    fn velocity_ratios(&self) -> Result<DMatrix<T>, PositionError>;
    fn gamma(&self, rates: &[T]) -> Vec<T>;
    /// q' for the inputs' v'.
    fn velocity(&self, input_rates: &[T]) -> Result<Vec<T>, PositionError>;
    /// q'' for q' and the inputs' v''.
    fn acceleration(&self, rates: &[T], given: &[T]) -> Result<Vec<T>, PositionError>;
    fn points(&self) -> Result<Vec<T>, PositionError>;
    fn point_velocities(&self, rates: &[T]) -> Result<Vec<T>, PositionError>;
    fn point_accelerations(&self, rates: &[T], bent: &[T]) -> Result<Vec<T>, PositionError>;
    /// For each point the matrix of its velocity by the inputs' rates.
    fn point_ratios(&self) -> Result<Vec<DMatrix<T>>, PositionError>;
    fn outputs(&self) -> Result<Vec<T>, PositionError>;
    fn output_rates(&self, rates: &[T]) -> Result<Vec<T>, PositionError>;
    fn output_accelerations(&self, rates: &[T], bent: &[T]) -> Result<Vec<T>, PositionError>;
    /// For each output the row of its rate by the inputs' rates.
    fn output_ratios(&self) -> Result<Vec<DMatrix<T>>, PositionError>;
}

/// A mechanism that derives jerk, the derivatives of the velocity ratios and sensitivities.
pub trait ListedWithOrders<T: Real>: Listed<T> {
    /// The mechanism with these parameters at these coordinates.
    fn at(&self, parameters: &[T], q: &[T]) -> Box<dyn PosedWithOrders<T>>;
}

/// The functions of `derive jerk, velocity_ratio_derivatives, sensitivity` at a position.
pub trait PosedWithOrders<T: Real>: Posed<T> {
    /// q''' for q', q'' and the inputs' v'''.
    fn jerk(&self, rates: &[T], bent: &[T], given: &[T]) -> Result<Vec<T>, PositionError>;
    fn point_jerks(&self, q: [&[T]; 3]) -> Result<Vec<T>, PositionError>;
    fn output_jerks(&self, q: [&[T]; 3]) -> Result<Vec<T>, PositionError>;
    /// For each unknown its second derivatives by the inputs.
    fn velocity_ratio_derivatives(&self) -> Result<Vec<DMatrix<T>>, PositionError>;
    /// For each x and y of each point its second derivatives by the inputs.
    fn point_ratio_derivatives(&self) -> Result<Vec<DMatrix<T>>, PositionError>;
    fn output_ratio_derivatives(&self) -> Result<Vec<DMatrix<T>>, PositionError>;
    /// du/dp, a column for each parameter.
    fn sensitivity(&self) -> Result<DMatrix<T>, PositionError>;
    /// For each point two rows.
    fn point_sensitivities(&self) -> Result<Vec<DMatrix<T>>, PositionError>;
    fn output_sensitivities(&self) -> Result<Vec<DMatrix<T>>, PositionError>;
}

/// The values at coordinates that dual numbers differentiate, and no more: all else would be compiled for them in vain.
pub trait Values<T: Real>: Named {
    fn residual(&self, parameters: &[T], q: &[T]) -> Vec<T>;
    fn points(&self, parameters: &[T], q: &[T]) -> Result<Vec<T>, PositionError>;
    fn outputs(&self, parameters: &[T], q: &[T]) -> Result<Vec<T>, PositionError>;
}

/// A mechanism with its analysis by hand.
pub trait Analysed: Named {
    /// The analysis at coordinates and at rates and accelerations of the inputs.
    fn analysis(
        &self,
        parameters: &[f64],
        q: &[f64],
        input_rates: &[f64],
        given: &[f64],
    ) -> Result<ByHand, PositionError>;
    /// The determinants of [J A] without the columns of these choices of inputs.
    fn determinants(&self, parameters: &[f64], q: &[f64], choices: &[Vec<usize>]) -> Result<Vec<f64>, PositionError>;
    /// The properties of the velocity ratios at a position that Newton's method finds.
    fn properties(
        &self,
        parameters: &[f64],
        q: &[f64],
        input_rates: &[f64],
    ) -> Result<[RatioProperty; 6], PositionError>;
}

/// The numbers of an analysis by hand in lists.
pub struct ByHand {
    pub jacobian_rates: [DMatrix<f64>; 2],
    pub jacobians_of_rates: [DMatrix<f64>; 2],
    pub gamma: Vec<f64>,
    pub gamma_parts: [Vec<f64>; 3],
    pub terms: [Vec<f64>; 4],
    pub accelerations: [Vec<f64>; 2],
    /// The numbers of the names in formulas.
    pub values: linkage::sheet::Values,
}

/// A type of the gallery, as an object.
struct Entry<M>(PhantomData<fn() -> M>);

impl<M: Fixture> Named for Entry<M> {
    fn file(&self) -> &'static str {
        M::FILE
    }
    fn name(&self) -> &'static str {
        M::NAME
    }
}

impl<T: Real, M: Fixture<Scalar = T> + 'static> Listed<T> for Entry<M> {
    fn unknowns(&self) -> &'static [&'static str] {
        M::UNKNOWNS
    }
    fn inputs(&self) -> &'static [&'static str] {
        M::INPUTS
    }
    fn branch_count(&self) -> usize {
        M::branches().len().max(1)
    }
    fn inputs_of(&self, q: &[T]) -> Vec<T> {
        M::inputs(&named::<M, _>(q)).as_slice().to_vec()
    }
    fn coordinates(&self, unknowns: &[T], inputs: &[T]) -> Vec<T> {
        numbers::<M>(M::coordinates(column(unknowns), column(inputs)))
    }
    fn defaults(&self) -> Vec<f64> {
        M::defaults()
    }
    fn branches(&self) -> Vec<String> {
        M::branches().iter().map(|branch| format!("{branch:?}")).collect()
    }
    fn derivation(&self) -> &'static Derivation<'static> {
        M::DERIVATION
    }
    fn with_parameters(&self, parameters: &[T]) -> Box<dyn Built<T>> {
        Box::new(Rc::new(M::with_parameters(parameters)))
    }
}

impl<T: Real, M: Fixture<Scalar = T>> Values<T> for Entry<M> {
    fn residual(&self, parameters: &[T], q: &[T]) -> Vec<T> {
        let m = M::with_parameters(parameters);
        m.residual(&m.pose_at(&named::<M, _>(q))).as_slice().to_vec()
    }
    fn points(&self, parameters: &[T], q: &[T]) -> Result<Vec<T>, PositionError> {
        let m = M::with_parameters(parameters);
        Ok(pairs(M::each_point(m.points(&m.pose_at(&named::<M, _>(q)))?)))
    }
    fn outputs(&self, parameters: &[T], q: &[T]) -> Result<Vec<T>, PositionError> {
        let m = M::with_parameters(parameters);
        Ok(M::each_output(m.outputs(&m.pose_at(&named::<M, _>(q)))?).as_slice().to_vec())
    }
}

impl<M: Fixture<Scalar = f64>> Analysed for Entry<M> {
    fn analysis(
        &self,
        parameters: &[f64],
        q: &[f64],
        input_rates: &[f64],
        given: &[f64],
    ) -> Result<ByHand, PositionError> {
        let (m, q) = (M::with_parameters(parameters), named::<M, _>(q));
        let at = Analysis::of(&m, &m.pose_at(&q), inputs::<M>(input_rates), inputs::<M>(given))?;
        let names = M::DERIVATION.parameters.iter().map(|parameter| parameter.name);
        let pair = |columns: Columns<f64, M::U, M::V>| [matrix(columns.unknowns), matrix(columns.inputs)];
        let list = |column: Column<f64, M::U>| column.as_slice().to_vec();
        Ok(ByHand {
            jacobian_rates: pair(at.jacobian_rates),
            jacobians_of_rates: pair(at.jacobians_of_rates),
            gamma: list(at.gamma),
            gamma_parts: at.gamma_parts.map(list),
            terms: at.terms.map(list),
            accelerations: at.accelerations.map(list),
            values: linkage::sheet::Values::of::<M>(M::DERIVATION, names.zip(parameters.iter().copied()), &q, &at),
        })
    }
    fn determinants(&self, parameters: &[f64], q: &[f64], choices: &[Vec<usize>]) -> Result<Vec<f64>, PositionError> {
        let m = M::with_parameters(parameters);
        let still = vec![0.0; M::INPUTS.len()];
        let at = Analysis::of(&m, &m.pose_at(&named::<M, _>(q)), inputs::<M>(&still), inputs::<M>(&still))?;
        Ok(choices.iter().map(|choice| at.determinant_of(choice).expect("different coordinates")).collect())
    }
    fn properties(
        &self,
        parameters: &[f64],
        q: &[f64],
        input_rates: &[f64],
    ) -> Result<[RatioProperty; 6], PositionError> {
        let m = M::with_parameters(parameters);
        let q = newton(&m, &named::<M, _>(q))?.coordinates;
        ratio_properties(&m, M::DERIVATION, &q, inputs::<M>(input_rates))
    }
}

impl<T: Real, M: Fixture<Scalar = T> + 'static> ListedWithOrders<T> for Entry<M>
where
    At<M>: PosedWithOrders<T>,
{
    fn at(&self, parameters: &[T], q: &[T]) -> Box<dyn PosedWithOrders<T>> {
        let mechanism = M::with_parameters(parameters);
        let pose = mechanism.pose_at(&named::<M, _>(q));
        Box::new(At { mechanism: Rc::new(mechanism), pose })
    }
}

/// A mechanism and its position.
pub(crate) struct At<M: Mechanism> {
    pub(crate) mechanism: Rc<M>,
    pub(crate) pose: M::Pose,
}

/// A mechanism at a position, as an object.
pub fn posed<M: Fixture + 'static>(mechanism: &Rc<M>, pose: M::Pose) -> Box<dyn Posed<M::Scalar>> {
    Box::new(At { mechanism: Rc::clone(mechanism), pose })
}

impl<T: Real, M: Fixture<Scalar = T> + 'static> Built<T> for Rc<M> {
    fn pose(&self, q: &[T]) -> Box<dyn Posed<T>> {
        posed(self, self.pose_at(&named::<M, _>(q)))
    }
    fn position(&self, q: &[T], branch: usize) -> Result<Box<dyn Posed<T>>, PositionError> {
        if M::branches().is_empty() { Ok(self.pose(&self.solved(q)?)) } else { self.assembled(q, branch) }
    }
    fn assembled(&self, q: &[T], branch: usize) -> Result<Box<dyn Posed<T>>, PositionError> {
        let q = named::<M, _>(q);
        M::assembled(self, &q, branch_at(&**self, &q, branch)).map(|pose| posed(self, pose))
    }
    fn solved(&self, guess: &[T]) -> Result<Vec<T>, PositionError> {
        newton(&**self, &named::<M, _>(guess)).map(|solution| numbers::<M>(solution.coordinates))
    }
    fn motion(&self, q: &[T], input_rates: &[T], given: &[T]) -> Result<Motion<T>, PositionError> {
        let motion = M::motion(self, &named::<M, _>(q), inputs::<M>(input_rates), inputs::<M>(given))?;
        Ok(Motion {
            coordinates: [
                numbers::<M>(motion.position),
                numbers::<M>(motion.rates),
                numbers::<M>(motion.accelerations),
            ],
            points: of_points(M::each_point(motion.points)),
            outputs: of_outputs(M::each_output(motion.outputs)),
        })
    }
    fn moving(
        &self,
        q: &[T],
        branch: usize,
        input_rates: &[T],
        given: &[T],
        full: bool,
    ) -> Result<Moving<T>, PositionError> {
        let (q, rates, bent) = (named::<M, _>(q), inputs::<M>(input_rates), inputs::<M>(given));
        let branch = branch_at(&**self, &q, branch);
        let (Kinematics { pose, rates, accelerations }, points, outputs) = match full {
            false => (M::kinematics(self, &q, branch, rates, bent)?, None, None),
            true => {
                let all = M::full_kinematics(self, &q, branch, rates, bent)?;
                let FullKinematics { pose, rates, accelerations, points, outputs } = all;
                let (points, outputs) = (of_points(M::each_point(points)), of_outputs(M::each_output(outputs)));
                (Kinematics { pose, rates, accelerations }, Some(points), Some(outputs))
            }
        };
        let (rates, accelerations) = (numbers::<M>(rates), numbers::<M>(accelerations));
        Ok(Moving { pose: posed(self, pose), rates, accelerations, points, outputs })
    }
}

/// The branch of this number, or that of the coordinates if the position is found by Newton's method.
fn branch_at<M: Fixture>(m: &M, q: &M::Coordinates, number: usize) -> M::Branch {
    M::branches().get(number).copied().unwrap_or_else(|| m.branch_of(&m.pose_at(q)))
}

impl<T: Real, M: Fixture<Scalar = T>> Posed<T> for At<M> {
    fn coordinates(&self) -> Vec<T> {
        numbers::<M>(M::coordinates_of(&self.pose))
    }
    fn is_finite(&self) -> bool {
        M::is_finite(&self.pose)
    }
    fn residual(&self) -> Vec<T> {
        self.mechanism.residual(&self.pose).as_slice().to_vec()
    }
    fn residual_scales(&self) -> Vec<T> {
        self.mechanism.residual_scales(&self.pose).as_slice().to_vec()
    }
    fn jacobian(&self) -> DMatrix<T> {
        self.mechanism.jacobian(&self.pose)
    }
    fn jacobian_unknowns(&self) -> DMatrix<T> {
        matrix(self.mechanism.jacobian_unknowns(&self.pose))
    }
    fn jacobian_inputs(&self) -> DMatrix<T> {
        matrix(self.mechanism.jacobian_inputs(&self.pose))
    }
    fn determinant(&self) -> T {
        self.mechanism.determinant(&self.pose)
    }
    fn block_determinants(&self) -> Vec<T> {
        self.mechanism.block_determinants(&self.pose).as_slice().to_vec()
    }
    fn solve_jacobian(&self, right: &[T]) -> Result<Vec<T>, PositionError> {
        self.mechanism.solve_jacobian(&self.pose, &column(right)).map(|solution| solution.as_slice().to_vec())
    }
    fn velocity_ratios(&self) -> Result<DMatrix<T>, PositionError> {
        self.mechanism.velocity_ratios(&self.pose).map(matrix)
    }
    fn gamma(&self, rates: &[T]) -> Vec<T> {
        self.mechanism.gamma(&self.pose, &named::<M, _>(rates)).as_slice().to_vec()
    }
    fn velocity(&self, input_rates: &[T]) -> Result<Vec<T>, PositionError> {
        self.mechanism.velocity(&self.pose, inputs::<M>(input_rates)).map(numbers::<M>)
    }
    fn acceleration(&self, rates: &[T], given: &[T]) -> Result<Vec<T>, PositionError> {
        self.mechanism.acceleration(&self.pose, &named::<M, _>(rates), inputs::<M>(given)).map(numbers::<M>)
    }
    fn points(&self) -> Result<Vec<T>, PositionError> {
        Ok(pairs(M::each_point(self.mechanism.points(&self.pose)?)))
    }
    fn point_velocities(&self, rates: &[T]) -> Result<Vec<T>, PositionError> {
        Ok(pairs(M::each_point(self.mechanism.point_velocities(&self.pose, &named::<M, _>(rates))?)))
    }
    fn point_accelerations(&self, rates: &[T], bent: &[T]) -> Result<Vec<T>, PositionError> {
        let (rates, bent) = (named::<M, _>(rates), named::<M, _>(bent));
        Ok(pairs(M::each_point(self.mechanism.point_accelerations(&self.pose, &rates, &bent)?)))
    }
    fn point_ratios(&self) -> Result<Vec<DMatrix<T>>, PositionError> {
        Ok(M::each_point(self.mechanism.point_ratios(&self.pose)?).into_iter().map(matrix).collect())
    }
    fn outputs(&self) -> Result<Vec<T>, PositionError> {
        Ok(M::each_output(self.mechanism.outputs(&self.pose)?).as_slice().to_vec())
    }
    fn output_rates(&self, rates: &[T]) -> Result<Vec<T>, PositionError> {
        Ok(M::each_output(self.mechanism.output_rates(&self.pose, &named::<M, _>(rates))?).as_slice().to_vec())
    }
    fn output_accelerations(&self, rates: &[T], bent: &[T]) -> Result<Vec<T>, PositionError> {
        let (rates, bent) = (named::<M, _>(rates), named::<M, _>(bent));
        Ok(M::each_output(self.mechanism.output_accelerations(&self.pose, &rates, &bent)?).as_slice().to_vec())
    }
    fn output_ratios(&self) -> Result<Vec<DMatrix<T>>, PositionError> {
        Ok(M::each_output(self.mechanism.output_ratios(&self.pose)?).into_iter().map(matrix).collect())
    }
}

/// The numbers of coordinates, rates or accelerations, in the order of the fields.
fn numbers<M: Kinematic>(by_name: impl Into<PerCoordinate<M>>) -> Vec<M::Scalar> {
    let numbers: <M::N as Dim>::Array<M::Scalar> = by_name.into().into();
    numbers.as_ref().to_vec()
}

/// A list as a column.
fn column<T: Real, R: Dim>(list: &[T]) -> Column<T, R> {
    Column::from_slice(list).expect("as many numbers as coordinates")
}

/// A matrix of any size.
fn matrix<T: Real, R: Dim, C: Dim>(matrix: Matrix<T, R, C>) -> DMatrix<T> {
    let (rows, columns) = matrix.dims();
    DMatrix::from_iterator(rows.count(), columns.count(), matrix.iter().copied())
}

/// Positions, velocities and accelerations of points.
fn of_points<T: Real, N: Dim>(points: Column<PointMotion<T>, N>) -> [Vec<T>; 3] {
    [
        pairs(points.map(|point| point.position)),
        pairs(points.map(|point| point.velocity)),
        pairs(points.map(|point| point.acceleration)),
    ]
}

/// Values, rates and second derivatives of outputs.
fn of_outputs<T: Real, N: Dim>(outputs: Column<OutputMotion<T>, N>) -> [Vec<T>; 3] {
    [
        outputs.map(|output| output.value).as_slice().to_vec(),
        outputs.map(|output| output.rate).as_slice().to_vec(),
        outputs.map(|output| output.acceleration).as_slice().to_vec(),
    ]
}

macro_rules! lists {
    ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {
        /// All mechanisms in a scalar.
        #[must_use]
        pub fn all_of<T: Real>() -> Vec<&'static dyn Listed<T>> {
            vec![$($(&Entry::<crate::$file::$Mechanism<T>>(PhantomData)),+),*]
        }

        /// All mechanisms of the lines with `orders` in a scalar.
        #[must_use]
        pub fn with_orders_of<T: Real>() -> Vec<&'static dyn ListedWithOrders<T>> {
            let lines: Vec<Vec<&'static dyn ListedWithOrders<T>>> = vec![$(with_orders!($file [$($Mechanism)+] $($orders)?)),*];
            lines.concat()
        }

        /// The values of all mechanisms in a scalar.
        #[must_use]
        pub fn values_of<T: Real>() -> Vec<&'static dyn Values<T>> {
            vec![$($(&Entry::<crate::$file::$Mechanism<T>>(PhantomData)),+),*]
        }

        /// All mechanisms with their analysis by hand.
        #[must_use]
        pub fn analysed() -> Vec<&'static dyn Analysed> {
            vec![$($(&Entry::<crate::$file::$Mechanism<f64>>(PhantomData)),+),*]
        }

        /// The values of all mechanisms of the lines with `orders` in a scalar.
        #[must_use]
        pub fn values_with_orders_of<T: Real>() -> Vec<&'static dyn Values<T>> {
            let lines: Vec<Vec<&'static dyn Values<T>>> = vec![$(with_orders!($file [$($Mechanism)+] $($orders)?)),*];
            lines.concat()
        }
    };
}

macro_rules! with_orders {
    ($file:ident [$($Mechanism:ident)+]) => {
        Vec::new()
    };
    ($file:ident [$($Mechanism:ident)+] orders) => {
        vec![$(&Entry::<crate::$file::$Mechanism<T>>(PhantomData)),+]
    };
}

crate::all_mechanisms!(lists);

static ALL: LazyLock<Vec<&'static dyn Listed<f64>>> = LazyLock::new(all_of::<f64>);
static WITH_ORDERS: LazyLock<Vec<&'static dyn ListedWithOrders<f64>>> = LazyLock::new(with_orders_of::<f64>);

/// All mechanisms in doubles.
#[must_use]
pub fn all() -> &'static [&'static dyn Listed<f64>] {
    &ALL
}

/// All mechanisms of the lines with `orders` in doubles.
#[must_use]
pub fn with_orders() -> &'static [&'static dyn ListedWithOrders<f64>] {
    &WITH_ORDERS
}

/// The mechanism of these names in doubles.
///
/// # Panics
/// If there is none.
#[must_use]
pub fn listed(file: &str, name: &str) -> &'static dyn Listed<f64> {
    let found = ALL.iter().find(|one| one.file() == file && one.name() == name);
    *found.unwrap_or_else(|| panic!("{name} of {file} is not in the gallery"))
}

/// The mechanism of a list that has the same names as another.
///
/// # Panics
/// If there is none.
#[must_use]
pub fn same_as<'a, N: Named + ?Sized>(list: &[&'a N], other: &(impl Named + ?Sized)) -> &'a N {
    let found = list.iter().find(|one| one.file() == other.file() && one.name() == other.name());
    found.unwrap_or_else(|| panic!("{} of {} is not in the list", other.name(), other.file()))
}
