//! The methods of the price list, for one mechanism each.

use linkage::accuracy::{Method, Newton, Reached};
use linkage::{Error, Mechanism, Real, position};

/// Newton's method from the prediction of the velocity ratios until the closures are closed to rounding.
pub struct ToTolerance;

impl<M, T, const U: usize, const V: usize> Method<M, T, U, V> for ToTolerance
where
    M: Mechanism<T, U, V>,
    T: Real,
{
    type From = Reached<M::Coordinates, M::Pose>;
    type Position = Reached<M::Coordinates, M::Pose>;

    fn position(mechanism: &M, from: &Self::From, inputs: impl Into<M::Inputs>) -> Result<Self::Position, Error> {
        let guess = Newton::<0>::position(mechanism, from, inputs)?.coordinates;
        Ok(Reached::at(mechanism, position::newton(mechanism, &guess)?.coordinates))
    }
}

/// The solution of a dyad by Cramer's rule, its determinant as the difference of two products.
#[inline]
pub fn dyad(first: [f64; 2], second: [f64; 2], right: [f64; 2]) -> [f64; 2] {
    let inverse = 1.0 / (first[0] * second[1] - first[1] * second[0]);
    [(right[0] * second[1] - right[1] * second[0]) * inverse, (first[0] * right[1] - first[1] * right[0]) * inverse]
}

/// The derivative by its angle of a link along a direction.
#[inline]
pub fn turned(length: f64, direction: linkage::nalgebra::UnitComplex<f64>) -> [f64; 2] {
    [-length * direction.im, length * direction.re]
}

#[inline]
pub fn less(right: [f64; 2], column: [f64; 2], rate: f64) -> [f64; 2] {
    [right[0] - column[0] * rate, right[1] - column[1] * rate]
}

/// Numbers of the oracle as scalars.
pub fn scalars<T: Real>(values: &[f64]) -> Vec<T> {
    values.iter().map(|&value| linkage::nalgebra::convert(value)).collect()
}

/// What is the same for every mechanism: `works()`, each method at each of its points.
macro_rules! works {
    (
        $Mechanism:ident, $Coordinates:ident, $Pose:ident, $Inputs:ident, $U:literal,
        $(closed, products $products:ident)? $(newton $steps:literal)?
    ) => {
        use std::borrow::Borrow;
        use std::hint::black_box;
        use std::rc::Rc;

        use linkage::accuracy::{Method, Newton, Reached, Table};
        use linkage::nalgebra::SVector;
        use linkage::{Error, Mechanism, Real, linkage};
        use linkage_double::DoubleDouble;

        use super::methods::{ToTolerance, scalars};
        use super::oracle::{Case, poses_of};
        use super::stall::{Point, Work, largest, points};

        fn mechanism<T: Real>(case: &Case) -> $Mechanism<T> {
            let parameters = scalars::<T>(&case.parameters);
            $Mechanism::from(std::array::from_fn(|index| parameters[index]))
        }

        fn coordinates<T: Real>(unknowns: &[f64], input: f64) -> $Coordinates<T> {
            let unknowns = SVector::<T, $U>::from_iterator(scalars::<T>(unknowns));
            let zero = $Coordinates::from(SVector::from([T::zero(); $U + 1]));
            let inputs = SVector::<T, 1>::from_iterator(scalars::<T>(&[input]));
            let all = <$Mechanism<T> as Mechanism<T, $U, 1>>::with_unknowns(&zero, unknowns);
            <$Mechanism<T> as Mechanism<T, $U, 1>>::with_inputs(&all, inputs)
        }

        type Rates<T> = fn(&$Mechanism<T>, &$Pose<T>, usize) -> Result<SVector<T, $U>, Error>;

        /// u' or u'' at a pose, as emitted.
        #[inline(always)]
        fn emitted<T: Real>(m: &$Mechanism<T>, pose: &$Pose<T>, order: usize) -> Result<SVector<T, $U>, Error> {
            let velocity = m.velocity(pose, T::one())?;
            let rates = if order == 1 { velocity } else { m.acceleration(pose, &velocity, T::zero())? };
            Ok(<$Mechanism<T> as Mechanism<T, $U, 1>>::unknowns(&rates))
        }

        $(
            /// The same by products of stored sines and cosines.
            #[inline(always)]
            fn in_products(m: &$Mechanism, pose: &$Pose, order: usize) -> Result<SVector<f64, $U>, Error> {
                let rates = $products(m, pose, &-m.jacobian_inputs(pose).column(0));
                if order == 1 {
                    return Ok(rates);
                }
                let zero = $Coordinates::from(SVector::from([0.0; $U + 1]));
                let velocity = <$Mechanism as Mechanism<f64, $U, 1>>::with_unknowns(&zero, rates);
                let velocity = <$Mechanism as Mechanism<f64, $U, 1>>::with_inputs(&velocity, SVector::from([1.0]));
                Ok($products(m, pose, &-m.gamma(pose, &velocity)))
            }

            use linkage::Assembly;
            use linkage::accuracy::ClosedForm;

            fn branch<T: Real>(case: &Case, m: &$Mechanism<T>) -> <$Mechanism<T> as Assembly<T, $U, 1>>::Branch {
                Assembly::branch_of(m, &near(case, m).pose)
            }
        )?

        /// What a work is made of: a case, a mechanism, where the road starts, and the input.
        type Starts<T, F> = Rc<Vec<(Case, $Mechanism<T>, F, T)>>;

        /// A road to the position, and then rates.
        fn along<R, T: Real>(method: &'static str, point: Point, starts: &Starts<T, R::From>, rates: Rates<T>) -> Work
        where
            R: Method<$Mechanism<T>, T, $U, 1> + 'static,
        {
            let order = point.order;
            let evaluate = move |m: &$Mechanism<T>, from: &R::From, input: T| -> Result<Vec<T>, Error> {
                let position = R::position(m, from, $Inputs::from(SVector::<T, 1>::new(input)))?;
                let pose: &$Pose<T> = position.borrow();
                let unknowns = if order == 0 {
                    <$Mechanism<T> as Mechanism<T, $U, 1>>::unknowns(&pose.coordinates())
                } else {
                    rates(m, pose, order)?
                };
                Ok(unknowns.iter().copied().collect())
            };
            let error = largest(starts.iter().map(|(case, m, from, input)| {
                evaluate(m, from, *input).map(|found| case.error(order, &found))
            }));
            let (starts, cases) = (Rc::clone(starts), starts.len());
            let pass = move || {
                for (_, m, from, input) in starts.iter() {
                    let input = $Inputs::from(SVector::<T, 1>::new(black_box(*input)));
                    let Ok(position) = R::position(m, from, input) else { continue };
                    if order == 0 {
                        black_box(position);
                    } else {
                        let _ = black_box(rates(m, position.borrow(), order));
                    }
                }
            };
            Work { method, point, error, cases, pass: Box::new(pass) }
        }

        /// At given angles.
        fn given<T: Real>(method: &'static str, point: Point, cases: Vec<Case>, rates: Rates<T>) -> Work {
            let order = point.order;
            let starts = cases.into_iter().map(|case| (mechanism::<T>(&case), coordinates::<T>(&case.unknowns, case.input), case));
            let starts: Vec<_> = starts.collect();
            let error = largest(starts.iter().map(|(m, q, case)| {
                let found = rates(m, &m.pose_at(q), order)?;
                Ok(case.error(order, found.as_slice()))
            }));
            let cases = starts.len();
            let pass = move || {
                for (m, q, _) in &starts {
                    let pose = m.pose_at(black_box(q));
                    let _ = black_box(rates(m, &pose, order));
                }
            };
            Work { method, point, error, cases, pass: Box::new(pass) }
        }

        fn near<T: Real>(case: &Case, m: &$Mechanism<T>) -> Reached<$Coordinates<T>, $Pose<T>> {
            Reached::at(m, coordinates(&case.before.1, case.before.0))
        }

        pub fn works() -> Vec<Work> {
            let name = module_path!().rsplit("::").next().expect("a module");
            let starts = |pose: usize| poses_of(name).swap_remove(pose).cases;
            let mut works = Vec::new();
            for (index, poses) in poses_of(name).iter().enumerate() {
                for point in points(poses) {
                    let at = || point.clone();
                    if poses.angles_given {
                        works.push(given::<f32>("f32", at(), starts(index), emitted));
                        works.push(given::<f64>("f64", at(), starts(index), emitted));
                        works.push(given::<DoubleDouble>("double-double", at(), starts(index), emitted));
                        $({
                            let _ = $products;
                            works.push(given::<f64>("f64, products", at(), starts(index), in_products));
                        })?
                        continue;
                    }
                    macro_rules! road {
                        ($method:literal, $R:ty, $T:ty, $from:expr, $rates:expr) => {{
                            let all = starts(index).into_iter().map(|case| {
                                let m = mechanism::<$T>(&case);
                                let (from, input) = ($from(&case, &m), scalars::<$T>(&[case.input])[0]);
                                (case, m, from, input)
                            });
                            works.push(along::<$R, $T>($method, at(), &Rc::new(all.collect()), $rates));
                        }};
                    }
                    $(
                        road!("f32", ClosedForm, f32, branch, emitted);
                        road!("f64", ClosedForm, f64, branch, emitted);
                        road!("double-double", ClosedForm, DoubleDouble, branch, emitted);
                        if point.order > 0 {
                            let _ = $products;
                            road!("f64, products", ClosedForm, f64, branch, in_products);
                        }
                    )?
                    $(
                        road!("f32", Newton<3>, f32, near, emitted);
                        road!("double-double", Newton<$steps>, DoubleDouble, near, emitted);
                    )?
                    road!("Newton, 1 step", Newton<1>, f64, near, emitted);
                    road!("Newton, 2 steps", Newton<2>, f64, near, emitted);
                    road!("Newton, 3 steps", Newton<3>, f64, near, emitted);
                    road!("Newton to tolerance", ToTolerance, f64, near, emitted);
                    if poses.pose == "benign" {
                        macro_rules! table {
                            ($method:literal, $N:literal) => {{
                                type Entries = Table<$Coordinates, f64, $U, $N>;
                                let first = &poses.cases[0];
                                let start = coordinates(&first.before.1, first.before.0);
                                let table = Rc::new(Entries::turn(&mechanism::<f64>(first), &start).expect("a whole turn"));
                                road!($method, Shared<Entries>, f64, |_: &Case, _: &$Mechanism| Rc::clone(&table), emitted);
                            }};
                        }
                        table!("table of 64", 65);
                        table!("table of 1024", 1025);
                    }
                }
            }
            works
        }

        /// A table that several poses look into.
        struct Shared<R>(R);

        impl<R> Method<$Mechanism, f64, $U, 1> for Shared<R>
        where
            R: Method<$Mechanism, f64, $U, 1, From = R>,
        {
            type From = Rc<R>;
            type Position = R::Position;

            fn position(m: &$Mechanism, from: &Rc<R>, inputs: impl Into<$Inputs>) -> Result<R::Position, Error> {
                R::position(m, from, inputs)
            }
        }
    };
}
