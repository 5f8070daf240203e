//! The methods under comparison.

use std::borrow::Borrow;
use std::hint::black_box;
use std::rc::Rc;

use linkage::accuracy::{Newton, PositionMethod, Reached};
use linkage::derivation::Operations;
use linkage::{Assembly, Build, D, Dim, Mechanism, PerUnknown, PositionError, Real, position};

use super::comparison::{Point, Work};
use linkage_examples::accuracy_cost::oracle::Case;

/// A position found as coordinates.
pub type Near<M> = Reached<<M as Mechanism>::Coordinates, <M as Mechanism>::Pose>;

/// u, u' or u'' at a pose, by the order of the derivative.
pub type Rates<M> = fn(&M, &<M as Mechanism>::Pose, usize) -> Result<PerUnknown<M>, PositionError>;

/// Newton's method from the prediction by velocity ratios, until the residual is at rounding error.
pub struct ToTolerance;

impl<M: Mechanism> PositionMethod<M> for ToTolerance {
    type From = Near<M>;
    type Position = Near<M>;

    fn position(
        mechanism: &M,
        from: &Near<M>,
        inputs: impl Into<M::Inputs>,
    ) -> Result<Near<M>, PositionError<M::Name>> {
        let guess = Newton::<0>::position(mechanism, from, inputs)?.coordinates;
        Ok(Reached::at(mechanism, position::newton(mechanism, &guess)?.coordinates))
    }
}

/// A table shared by several poses.
pub struct Shared<R>(R);

impl<M: Mechanism, R: PositionMethod<M, From = R>> PositionMethod<M> for Shared<R> {
    type From = Rc<R>;
    type Position = R::Position;

    fn position(m: &M, from: &Rc<R>, inputs: impl Into<M::Inputs>) -> Result<R::Position, PositionError<M::Name>> {
        R::position(m, from, inputs)
    }
}

/// u' or u'' by a given solver of J x = `right`.
#[inline(always)]
pub fn in_products<M: Mechanism<V = D<1>>>(
    m: &M,
    pose: &M::Pose,
    order: usize,
    solution: impl Fn(&PerUnknown<M>) -> PerUnknown<M>,
) -> PerUnknown<M> {
    let rates = solution(&-m.jacobian_inputs(pose).column(0));
    if order == 1 { rates } else { solution(&-m.gamma(pose, &M::rates(rates, [scalar(1.0)].into()))) }
}

/// The work of a position method from the start of each case, followed by the rates.
pub fn along<R: PositionMethod<M> + 'static, M: Mechanism<Name = &'static str, V = D<1>> + 'static>(
    method: &'static str,
    point: Point,
    starts: Vec<(Case, M, R::From)>,
    rates: Rates<M>,
    predicted: Option<f64>,
) -> Work {
    let order = point.order;
    let method_at = |m: &M, from: &R::From, input: M::Scalar| R::position(m, from, M::Inputs::from([input].into()));
    let starts = starts.into_iter().map(|(case, m, from)| (scalar(case.input), case, m, from)).collect::<Vec<_>>();
    let errors = starts.iter().map(|(input, case, m, from)| {
        let found = rates(m, method_at(m, from, *input)?.borrow(), order)?;
        Ok(case.error(order, found.as_slice()))
    });
    let errors = errors.collect();
    let inputs = starts.iter().map(|(_, case, ..)| case.input).collect();
    let pass = move || {
        for (input, _, m, from) in &starts {
            let Ok(position) = method_at(m, from, black_box(*input)) else { continue };
            if order == 0 {
                black_box(position);
            } else {
                let _ = black_box(rates(m, position.borrow(), order));
            }
        }
    };
    Work { method, point, errors, inputs, predicted, pass: Box::new(pass) }
}

/// The work of computing rates at given angles.
pub fn given<M: Mechanism<V = D<1>> + 'static>(
    method: &'static str,
    point: Point,
    starts: Vec<(M, Case)>,
    rates: Rates<M>,
) -> Work {
    let order = point.order;
    let starts = starts.into_iter().map(|(m, case)| (m, coordinates::<M>(&case.unknowns, case.input), case));
    let starts: Vec<_> = starts.collect();
    let errors = starts.iter().map(|(m, q, case)| {
        let found = rates(m, &m.pose_at(q), order)?;
        Ok(case.error(order, found.as_slice()))
    });
    let errors = errors.collect();
    let inputs = starts.iter().map(|(.., case)| case.input).collect();
    let pass = move || {
        for (m, q, _) in &starts {
            let pose = m.pose_at(black_box(q));
            let _ = black_box(rates(m, &pose, order));
        }
    };
    Work { method, point, errors, inputs, predicted: None, pass: Box::new(pass) }
}

/// Reference values as coordinates.
pub fn coordinates<M: Mechanism<V = D<1>>>(unknowns: &[f64], input: f64) -> M::Coordinates {
    M::coordinates(M::U::least().column(|row| scalar(unknowns[row])), [scalar(input)].into())
}

/// The position near a case.
pub fn near<M: Mechanism<V = D<1>>>(case: &Case, m: &M) -> Near<M> {
    Reached::at(m, coordinates::<M>(&case.before.1, case.before.0))
}

/// The branch of a case.
pub fn branch<M: Assembly<V = D<1>>>(case: &Case, m: &M) -> M::Branch {
    m.branch_of(&near(case, m).pose)
}

/// A reference value as a scalar.
pub fn scalar<T: Real>(value: f64) -> T {
    linkage::nalgebra::convert(value)
}

/// The solution of a dyad by Cramer's rule, its determinant as the difference of two products.
#[inline]
pub fn dyad(first: [f64; 2], second: [f64; 2], right: [f64; 2]) -> [f64; 2] {
    let inverse = 1.0 / (first[0] * second[1] - first[1] * second[0]);
    [(right[0] * second[1] - right[1] * second[0]) * inverse, (first[0] * right[1] - first[1] * right[0]) * inverse]
}

/// The operations of so many dyads by Cramer's rule.
pub fn by_dyads(dyads: usize) -> Operations {
    Operations { functions: 0, divisions: dyads, multiplications: 14 * dyads, additions: 5 * dyads }
}

/// The derivative of a link's vector with respect to its angle.
#[inline]
pub fn turned(length: f64, direction: linkage::nalgebra::UnitComplex<f64>) -> [f64; 2] {
    [-length * direction.im, length * direction.re]
}

#[inline]
pub fn less(right: [f64; 2], column: [f64; 2], rate: f64) -> [f64; 2] {
    [right[0] - column[0] * rate, right[1] - column[1] * rate]
}

/// Defines `works()` for a mechanism: each method at each of its points.
macro_rules! works {
    ($Mechanism:ident, $U:literal, $(closed, products $products:ident)? $(newton $steps:literal)?) => {
        use linkage::accuracy::{Newton, Table};
        use linkage::nalgebra::SVector;
        use linkage::{Column, Mechanism, PerUnknown, PositionError, Real};
        use linkage_double::DoubleDouble;

        use super::methods::{self, Shared, ToTolerance, near};
        use linkage_examples::accuracy_cost::oracle::{Case, poses_of};
        use super::comparison::{Work, points};
        use linkage::price::{Counts, Machine};

        type Pose<T> = <$Mechanism<T> as Mechanism>::Pose;
        type Unknowns<T> = PerUnknown<$Mechanism<T>>;

        fn mechanism<T: Real>(case: &Case) -> $Mechanism<T> {
            $Mechanism::from(std::array::from_fn(|index| methods::scalar(case.parameters[index])))
        }

        /// u, u' or u'' at a pose.
        #[inline(always)]
        fn emitted<T: Real>(m: &$Mechanism<T>, pose: &Pose<T>, order: usize) -> Result<Unknowns<T>, PositionError> {
            if order == 0 {
                return Ok(<$Mechanism<T>>::unknowns(&pose.coordinates()));
            }
            let rates = m.velocity(pose, T::one())?;
            if order == 1 {
                return Ok(<$Mechanism<T>>::rate_parts(&rates).0);
            }
            let all: SVector<T, { $U + 1 }> = m.acceleration(pose, &rates, T::zero())?.into();
            Ok(Column::from_fn(|row| all[row]))
        }

        $(
            use linkage::accuracy::ClosedForm;

            use super::methods::branch;

            /// u' or u'' by products of stored sines and cosines.
            #[inline(always)]
            fn in_products(m: &$Mechanism, pose: &Pose<f64>, order: usize) -> Result<Unknowns<f64>, PositionError> {
                Ok(methods::in_products(m, pose, order, |right| $products(m, pose, right)))
            }
        )?

        pub fn works(machine: &Machine) -> Vec<Work> {
            let counts = Counts::of(<$Mechanism<f64>>::DERIVATION);
            let name = module_path!().rsplit("::").next().expect("a module");
            let cases = |index: usize| poses_of(name).swap_remove(index).cases.into_iter();
            let mut works = Vec::new();
            for (index, poses) in poses_of(name).iter().enumerate() {
                for point in points(poses) {
                    let at = || point.clone();
                    if poses.angles_given {
                        macro_rules! given {
                            ($method:literal, $T:ty, $rates:expr) => {{
                                let all = cases(index).map(|case| (mechanism::<$T>(&case), case));
                                works.push(methods::given($method, at(), all.collect(), $rates));
                            }};
                        }
                        given!("f32", f32, emitted);
                        given!("f64", f64, emitted);
                        given!("double-double", DoubleDouble, emitted);
                        $({
                            let _ = $products;
                            given!("f64, products", f64, in_products);
                        })?
                        continue;
                    }
                    macro_rules! from_input {
                        ($method:literal, $R:ty, $T:ty, $from:expr, $rates:expr, $operations:expr) => {{
                            let all = cases(index).map(|case| {
                                let m = mechanism::<$T>(&case);
                                let from = $from(&case, &m);
                                (case, m, from)
                            });
                            let predicted = $operations.map(|operations| machine.time::<$T>(operations));
                            works.push(methods::along::<$R, _>($method, at(), all.collect(), $rates, predicted));
                        }};
                    }
                    let newton = |steps| Some(counts.newton(steps, point.order));
                    $(
                        let operations = Some(counts.closed(point.order));
                        from_input!("f32", ClosedForm, f32, branch, emitted, operations);
                        from_input!("f64", ClosedForm, f64, branch, emitted, operations);
                        from_input!("double-double", ClosedForm, DoubleDouble, branch, emitted, operations);
                        if point.order > 0 {
                            let _ = $products;
                            let operations = Some(counts.solved_by(methods::by_dyads($U / 2), point.order));
                            from_input!("f64, products", ClosedForm, f64, branch, in_products, operations);
                        }
                    )?
                    $(
                        from_input!("f32", Newton<3>, f32, near, emitted, newton(3));
                        from_input!("double-double", Newton<$steps>, DoubleDouble, near, emitted, newton($steps));
                    )?
                    from_input!("Newton, 1 step", Newton<1>, f64, near, emitted, newton(1));
                    from_input!("Newton, 2 steps", Newton<2>, f64, near, emitted, newton(2));
                    from_input!("Newton, 3 steps", Newton<3>, f64, near, emitted, newton(3));
                    // The number of its steps is not known beforehand.
                    from_input!("Newton to tolerance", ToTolerance, f64, near, emitted, None);
                    // A table covers a turn.
                    if ["benign", "turn"].contains(&&*poses.pose) {
                        macro_rules! table {
                            ($method:literal, $N:literal) => {{
                                type Entries = Table<$Mechanism, $N>;
                                let m = mechanism::<f64>(&poses.cases[0]);
                                let start = near(&poses.cases[0], &m).coordinates;
                                let table = std::rc::Rc::new(Entries::turn(&m, &start).expect("a whole turn"));
                                let shared = |_: &Case, _: &$Mechanism| table.clone();
                                let operations = Some(counts.table(point.order));
                                from_input!($method, Shared<Entries>, f64, shared, emitted, operations);
                            }};
                        }
                        table!("table of 64", 65);
                        table!("table of 1024", 1025);
                    }
                }
            }
            works
        }
    };
}
