//! The mechanisms of the gallery as objects: a test of all of them is a function over `&dyn Listed<f64>` that loops over
//! [`all`], compiled once.
//!
//! The functions for doubles are compiled in this crate. [`all_of`] and its like are generic: the crate that calls one
//! compiles all mechanisms for its scalar.

use std::marker::PhantomData;
use std::rc::Rc;
use std::sync::LazyLock;

use linkage::derivation::Derivation;
use linkage::{Column, Dim, Group, Matrix, Mechanism, PositionError, Real};
use nalgebra::DMatrix;

use crate::{ClosedForm, Fixture, HigherOrders, Kinematics, Motion, Moving};

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
    /// The groups in the order of solution.
    fn groups(&self) -> &'static [Group];
    /// The number of branches; 1 if the position is found by Newton's method.
    fn branch_count(&self) -> usize;
    /// The inputs among the coordinates, or their derivatives.
    fn inputs_of(&self, q: &[T]) -> Vec<T>;
    /// The unknowns and the inputs among the coordinates, in the order of their names.
    fn parts(&self, q: &[T]) -> [Vec<T>; 2];
    /// The default values of the parameters, in the order of declaration.
    fn defaults(&self) -> Vec<f64>;
    /// The branches as `Debug` writes them; none if the position is found by Newton's method.
    fn branches(&self) -> Vec<String>;
    /// The constant `DERIVATION`.
    fn derivation(&self) -> &'static Derivation<'static>;
    /// The mechanism with these parameters, in the order of declaration.
    fn with_parameters(&self, parameters: &[T]) -> Box<dyn Built<T>>;
}

/// A mechanism with its parameters; the functions are those of [`Kinematics`].
pub trait Built<T: Real> {
    fn pose(&self, q: &[T]) -> Box<dyn Posed<T>>;
    fn position(&self, q: &[T], branch: usize) -> Result<Box<dyn Posed<T>>, PositionError>;
    fn assembled(&self, q: &[T], branch: usize) -> Result<Box<dyn Posed<T>>, PositionError>;
    fn solved(&self, guess: &[T]) -> Result<Vec<T>, PositionError>;
    fn motion(&self, q: &[T], input_rates: &[T], given: &[T]) -> Result<Motion<T>, PositionError>;
    fn moving(
        &self,
        q: &[T],
        branch: usize,
        input_rates: &[T],
        given: &[T],
        full: bool,
    ) -> Result<Moving<Box<dyn Posed<T>>, T>, PositionError>;
    fn moving_by_parts(
        &self,
        q: &[T],
        branch: usize,
        input_rates: &[T],
        given: &[T],
    ) -> Result<Moving<Box<dyn Posed<T>>, T>, PositionError>;
}

/// A mechanism at a position; the functions are those of [`Mechanism`] and [`Kinematics`].
pub trait Posed<T: Real> {
    /// q.
    fn coordinates(&self) -> Vec<T>;
    fn is_finite(&self) -> bool;
    fn residual(&self) -> Vec<T>;
    fn residual_scales(&self) -> Vec<T>;
    fn jacobian(&self) -> DMatrix<T>;
    fn jacobian_unknowns(&self) -> DMatrix<T>;
    fn jacobian_inputs(&self) -> DMatrix<T>;
    fn determinant(&self) -> T;
    fn block_determinants(&self) -> Vec<T>;
    fn solve_jacobian(&self, right: &[T]) -> Result<Vec<T>, PositionError>;
    fn velocity_ratios(&self) -> Result<DMatrix<T>, PositionError>;
    fn gamma(&self, rates: &[T]) -> Vec<T>;
    fn velocity(&self, input_rates: &[T]) -> Result<Vec<T>, PositionError>;
    fn acceleration(&self, rates: &[T], given: &[T]) -> Result<Vec<T>, PositionError>;
    fn points(&self) -> Result<Vec<T>, PositionError>;
    fn point_velocities(&self, rates: &[T]) -> Result<Vec<T>, PositionError>;
    fn point_accelerations(&self, rates: &[T], bent: &[T]) -> Result<Vec<T>, PositionError>;
    fn point_ratios(&self) -> Result<Vec<DMatrix<T>>, PositionError>;
    fn outputs(&self) -> Result<Vec<T>, PositionError>;
    fn output_velocities(&self, rates: &[T]) -> Result<Vec<T>, PositionError>;
    fn output_accelerations(&self, rates: &[T], bent: &[T]) -> Result<Vec<T>, PositionError>;
    fn output_ratios(&self) -> Result<Vec<DMatrix<T>>, PositionError>;
}

/// A mechanism that derives jerk, the derivatives of the velocity ratios and sensitivities.
pub trait ListedWithOrders<T: Real>: Listed<T> {
    /// The mechanism with these parameters at these coordinates.
    fn at(&self, parameters: &[T], q: &[T]) -> Box<dyn PosedWithOrders<T>>;
}

/// The functions of [`HigherOrders`] at a position.
pub trait PosedWithOrders<T: Real>: Posed<T> {
    fn jerk(&self, rates: &[T], bent: &[T], given: &[T]) -> Result<Vec<T>, PositionError>;
    fn point_jerks(&self, q: [&[T]; 3]) -> Result<Vec<T>, PositionError>;
    fn output_jerks(&self, q: [&[T]; 3]) -> Result<Vec<T>, PositionError>;
    fn velocity_ratio_derivatives(&self) -> Result<Vec<DMatrix<T>>, PositionError>;
    fn point_ratio_derivatives(&self) -> Result<Vec<DMatrix<T>>, PositionError>;
    fn output_ratio_derivatives(&self) -> Result<Vec<DMatrix<T>>, PositionError>;
    fn sensitivity(&self) -> Result<DMatrix<T>, PositionError>;
    fn point_sensitivities(&self) -> Result<Vec<DMatrix<T>>, PositionError>;
    fn output_sensitivities(&self) -> Result<Vec<DMatrix<T>>, PositionError>;
}

/// The values at coordinates that dual numbers differentiate, and no more: all else would be compiled for them in vain.
pub trait Values<T: Real>: Named {
    fn residual(&self, parameters: &[T], q: &[T]) -> Vec<T>;
    fn points(&self, parameters: &[T], q: &[T]) -> Result<Vec<T>, PositionError>;
    fn outputs(&self, parameters: &[T], q: &[T]) -> Result<Vec<T>, PositionError>;
}

/// A type of the gallery, as an object.
struct Entry<M> {
    file: &'static str,
    defaults: fn() -> Vec<f64>,
    branches: fn() -> Vec<String>,
    derivation: &'static Derivation<'static>,
    of: PhantomData<fn() -> M>,
}

impl<M> Entry<M> {
    const fn of<F: Fixture>(branches: fn() -> Vec<String>, derivation: &'static Derivation<'static>) -> Self {
        Self { file: F::FILE, defaults: || F::default().parameters(), branches, derivation, of: PhantomData }
    }
}

/// The branches of a closed form as `Debug` writes them.
fn written<M: ClosedForm>() -> Vec<String> {
    M::all_branches().iter().map(|branch| format!("{branch:?}")).collect()
}

impl<M: Mechanism> Named for Entry<M> {
    fn file(&self) -> &'static str {
        self.file
    }
    fn name(&self) -> &'static str {
        M::NAME
    }
}

impl<T: Real, M: Kinematics<T> + 'static> Listed<T> for Entry<M> {
    fn unknowns(&self) -> &'static [&'static str] {
        M::UNKNOWNS
    }
    fn inputs(&self) -> &'static [&'static str] {
        M::INPUTS
    }
    fn groups(&self) -> &'static [Group] {
        M::GROUPS
    }
    fn branch_count(&self) -> usize {
        M::branch_count()
    }
    fn inputs_of(&self, q: &[T]) -> Vec<T> {
        M::inputs_of(q)
    }
    fn parts(&self, q: &[T]) -> [Vec<T>; 2] {
        let (unknowns, inputs) = M::parts(&M::named(q));
        [unknowns.as_slice().to_vec(), inputs.as_slice().to_vec()]
    }
    fn defaults(&self) -> Vec<f64> {
        (self.defaults)()
    }
    fn branches(&self) -> Vec<String> {
        (self.branches)()
    }
    fn derivation(&self) -> &'static Derivation<'static> {
        self.derivation
    }
    fn with_parameters(&self, parameters: &[T]) -> Box<dyn Built<T>> {
        Box::new(Rc::new(M::with_parameters(parameters)))
    }
}

impl<T: Real, M: Kinematics<T>> Values<T> for Entry<M> {
    fn residual(&self, parameters: &[T], q: &[T]) -> Vec<T> {
        let m = M::with_parameters(parameters);
        m.residual(&m.pose(q)).as_slice().to_vec()
    }
    fn points(&self, parameters: &[T], q: &[T]) -> Result<Vec<T>, PositionError> {
        let m = M::with_parameters(parameters);
        m.points(&m.pose(q))
    }
    fn outputs(&self, parameters: &[T], q: &[T]) -> Result<Vec<T>, PositionError> {
        let m = M::with_parameters(parameters);
        m.outputs(&m.pose(q))
    }
}

impl<T: Real, M: HigherOrders<T> + 'static> ListedWithOrders<T> for Entry<M> {
    fn at(&self, parameters: &[T], q: &[T]) -> Box<dyn PosedWithOrders<T>> {
        let mechanism = M::with_parameters(parameters);
        let pose = Kinematics::pose(&mechanism, q);
        Box::new(At { mechanism: Rc::new(mechanism), pose })
    }
}

/// A mechanism and its position.
struct At<M: Mechanism> {
    mechanism: Rc<M>,
    pose: M::Pose,
}

/// A mechanism at a position, as an object.
fn at<T: Real, M: Kinematics<T> + 'static>(mechanism: &Rc<M>, pose: M::Pose) -> Box<dyn Posed<T>> {
    Box::new(At { mechanism: Rc::clone(mechanism), pose })
}

/// A motion from a position that is an object.
fn of_object<T: Real, M: Kinematics<T> + 'static>(
    mechanism: &Rc<M>,
    moving: Moving<M::Pose, T>,
) -> Moving<Box<dyn Posed<T>>, T> {
    let Moving { pose, rates, accelerations, points, outputs } = moving;
    Moving { pose: at(mechanism, pose), rates, accelerations, points, outputs }
}

impl<T: Real, M: Kinematics<T> + 'static> Built<T> for Rc<M> {
    fn pose(&self, q: &[T]) -> Box<dyn Posed<T>> {
        at(self, Kinematics::pose(&**self, q))
    }
    fn position(&self, q: &[T], branch: usize) -> Result<Box<dyn Posed<T>>, PositionError> {
        Kinematics::position(&**self, q, branch).map(|pose| at(self, pose))
    }
    fn assembled(&self, q: &[T], branch: usize) -> Result<Box<dyn Posed<T>>, PositionError> {
        Kinematics::assembled(&**self, q, branch).map(|pose| at(self, pose))
    }
    fn solved(&self, guess: &[T]) -> Result<Vec<T>, PositionError> {
        Kinematics::solved(&**self, guess)
    }
    fn motion(&self, q: &[T], input_rates: &[T], given: &[T]) -> Result<Motion<T>, PositionError> {
        Kinematics::motion(&**self, q, input_rates, given)
    }
    fn moving(
        &self,
        q: &[T],
        branch: usize,
        input_rates: &[T],
        given: &[T],
        full: bool,
    ) -> Result<Moving<Box<dyn Posed<T>>, T>, PositionError> {
        Kinematics::moving(&**self, q, branch, input_rates, given, full).map(|moving| of_object(self, moving))
    }
    fn moving_by_parts(
        &self,
        q: &[T],
        branch: usize,
        input_rates: &[T],
        given: &[T],
    ) -> Result<Moving<Box<dyn Posed<T>>, T>, PositionError> {
        Kinematics::moving_by_parts(&**self, q, branch, input_rates, given).map(|moving| of_object(self, moving))
    }
}

impl<T: Real, M: Kinematics<T>> Posed<T> for At<M> {
    fn coordinates(&self) -> Vec<T> {
        M::listed(&self.pose)
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
        matrix(&self.mechanism.jacobian_unknowns(&self.pose))
    }
    fn jacobian_inputs(&self) -> DMatrix<T> {
        matrix(&self.mechanism.jacobian_inputs(&self.pose))
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
        self.mechanism.velocity_ratios(&self.pose)
    }
    fn gamma(&self, rates: &[T]) -> Vec<T> {
        self.mechanism.gamma_of(&self.pose, rates)
    }
    fn velocity(&self, input_rates: &[T]) -> Result<Vec<T>, PositionError> {
        self.mechanism.velocity(&self.pose, input_rates)
    }
    fn acceleration(&self, rates: &[T], given: &[T]) -> Result<Vec<T>, PositionError> {
        self.mechanism.acceleration(&self.pose, rates, given)
    }
    fn points(&self) -> Result<Vec<T>, PositionError> {
        self.mechanism.points(&self.pose)
    }
    fn point_velocities(&self, rates: &[T]) -> Result<Vec<T>, PositionError> {
        self.mechanism.point_velocities(&self.pose, rates)
    }
    fn point_accelerations(&self, rates: &[T], bent: &[T]) -> Result<Vec<T>, PositionError> {
        self.mechanism.point_accelerations(&self.pose, rates, bent)
    }
    fn point_ratios(&self) -> Result<Vec<DMatrix<T>>, PositionError> {
        self.mechanism.point_ratios(&self.pose)
    }
    fn outputs(&self) -> Result<Vec<T>, PositionError> {
        self.mechanism.outputs(&self.pose)
    }
    fn output_velocities(&self, rates: &[T]) -> Result<Vec<T>, PositionError> {
        self.mechanism.output_velocities(&self.pose, rates)
    }
    fn output_accelerations(&self, rates: &[T], bent: &[T]) -> Result<Vec<T>, PositionError> {
        self.mechanism.output_accelerations(&self.pose, rates, bent)
    }
    fn output_ratios(&self) -> Result<Vec<DMatrix<T>>, PositionError> {
        self.mechanism.output_ratios(&self.pose)
    }
}

impl<T: Real, M: HigherOrders<T>> PosedWithOrders<T> for At<M> {
    fn jerk(&self, rates: &[T], bent: &[T], given: &[T]) -> Result<Vec<T>, PositionError> {
        self.mechanism.jerk(&self.pose, rates, bent, given)
    }
    fn point_jerks(&self, q: [&[T]; 3]) -> Result<Vec<T>, PositionError> {
        self.mechanism.point_jerks(&self.pose, q)
    }
    fn output_jerks(&self, q: [&[T]; 3]) -> Result<Vec<T>, PositionError> {
        self.mechanism.output_jerks(&self.pose, q)
    }
    fn velocity_ratio_derivatives(&self) -> Result<Vec<DMatrix<T>>, PositionError> {
        self.mechanism.velocity_ratio_derivatives(&self.pose)
    }
    fn point_ratio_derivatives(&self) -> Result<Vec<DMatrix<T>>, PositionError> {
        self.mechanism.point_ratio_derivatives(&self.pose)
    }
    fn output_ratio_derivatives(&self) -> Result<Vec<DMatrix<T>>, PositionError> {
        self.mechanism.output_ratio_derivatives(&self.pose)
    }
    fn sensitivity(&self) -> Result<DMatrix<T>, PositionError> {
        self.mechanism.sensitivity(&self.pose)
    }
    fn point_sensitivities(&self) -> Result<Vec<DMatrix<T>>, PositionError> {
        self.mechanism.point_sensitivities(&self.pose)
    }
    fn output_sensitivities(&self) -> Result<Vec<DMatrix<T>>, PositionError> {
        self.mechanism.output_sensitivities(&self.pose)
    }
}

/// A list as a column.
fn column<T: Real, R: Dim>(list: &[T]) -> Column<T, R> {
    Column::from_fn(|place| list[place])
}

/// A matrix of any size.
fn matrix<T: Real, R: Dim, C: Dim>(of: &Matrix<T, R, C>) -> DMatrix<T> {
    DMatrix::from_iterator(R::COUNT, C::COUNT, of.columns().iter().flat_map(|column| column.iter().copied()))
}

macro_rules! lists {
    ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {
        /// All mechanisms in a scalar.
        #[must_use]
        pub fn all_of<T: Real>() -> Vec<&'static dyn Listed<T>> {
            vec![$($(entry!($file $Mechanism $method)),+),*]
        }

        /// All mechanisms of the lines with `orders` in a scalar.
        #[must_use]
        pub fn with_orders_of<T: Real>() -> Vec<&'static dyn ListedWithOrders<T>> {
            let mut all: Vec<&'static dyn ListedWithOrders<T>> = Vec::new();
            $(with_orders!(all $file [$($Mechanism $method)+] $($orders)?);)*
            all
        }

        /// The values of all mechanisms in a scalar.
        #[must_use]
        pub fn values_of<T: Real>() -> Vec<&'static dyn Values<T>> {
            vec![$($(entry!($file $Mechanism $method)),+),*]
        }

        /// The values of all mechanisms of the lines with `orders` in a scalar.
        #[must_use]
        pub fn values_with_orders_of<T: Real>() -> Vec<&'static dyn Values<T>> {
            let mut all: Vec<&'static dyn Values<T>> = Vec::new();
            $(with_orders!(all $file [$($Mechanism $method)+] $($orders)?);)*
            all
        }
    };
}

macro_rules! with_orders {
    ($all:ident $file:ident [$($Mechanism:ident $method:ident)+]) => {};
    ($all:ident $file:ident [$($Mechanism:ident $method:ident)+] orders) => {
        $($all.push(entry!($file $Mechanism $method));)+
    };
}

macro_rules! entry {
    ($file:ident $Mechanism:ident $method:ident) => {
        const {
            type Doubles = crate::$file::$Mechanism;
            &Entry::<crate::$file::$Mechanism<T>>::of::<Doubles>(branches!($method), Doubles::DERIVATION)
        }
    };
}

macro_rules! branches {
    (newton) => {
        Vec::new
    };
    ($method:ident) => {
        written::<Doubles>
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
