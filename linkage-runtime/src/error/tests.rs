//! Errors with names of any type have the text of those with static names.

use std::fmt::Debug;
use std::sync::Arc;

use super::{InputError, InputValues, Name, PathError, PositionError};
use crate::RangeEnd;

/// An error of each variant of an enum. A variant that is not in the list is not matched, and does not compile.
macro_rules! each {
    ($name:ident: $($variant:ident $fields:tt)*) => {{
        let errors = vec![$($name::$variant $fields),*];
        for error in &errors {
            match error {
                $($name::$variant { .. } => (),)*
            }
        }
        errors
    }};
}

fn input<N: Name>(n: impl Fn(&'static str) -> N) -> Vec<InputError<N>> {
    let (f, e) = (|| n("FourBar"), || n("drop"));
    let all = each! { InputError:
        OutOfRange { of: Some(f()), quantity: n("theta"), value: 1.5, least: 0.0, most: 1.0 }
        EmptyRange { scene: e(), stop: n("stop on s"), lower: 2.0, upper: 1.0 }
        EmptyJointRange { mechanism: f(), of: n("s"), least: 2.0, most: 1.0 }
        NotPeriodic { mechanism: f() }
        Inconsistent { scene: e(), coordinate: n("s"), quantity: n("rate"), gap: 0.1 }
        BeyondStop { scene: e(), stop: n("stop on s"), gap: 0.1 }
        ColumnLength { mechanism: f(), column: n("theta"), length: 3, expected: 4 }
    };
    let without = InputError::OutOfRange { of: None, quantity: n("theta"), value: 1.5, least: f64::MIN, most: 1.0 };
    all.into_iter().chain([without]).collect()
}

fn position<N: Name>(n: impl Fn(&'static str) -> N, inputs: &[InputValues<N>]) -> Vec<PositionError<N>> {
    let (f, g) = (|| n("FourBar"), || n("phi, psi"));
    let (iterations, residual, regularity) = (7, 0.25, 0.125);
    let all = each! { PositionError:
        Singular { mechanism: f(), group: g(), regularity }
        Unbuildable { mechanism: f(), group: g(), gap: 0.5, inputs: InputValues::default() }
        Undetermined { mechanism: f(), group: g() }
        NotConverged { mechanism: f(), group: Some(g()), iterations, residual, regularity }
        OtherBranch { mechanism: f(), group: g() }
        NotImplied { mechanism: f(), equation: n("implied loop 1"), residual }
        NoClosedForm { mechanism: f(), group: g() }
        TooManyBranches { mechanism: f() }
        NoMode { mechanism: f(), group: g(), number: 6, count: 4 }
        Undecided { mechanism: f(), group: g(), regularity }
        NotFinite { mechanism: f(), quantity: n("s") }
        Input (InputError::NotPeriodic { mechanism: f() })
    };
    let with = inputs.iter().map(|inputs| {
        let inputs = inputs.clone();
        PositionError::Unbuildable { mechanism: f(), group: g(), gap: 0.5, inputs }
    });
    let whole = PositionError::NotConverged { mechanism: f(), group: None, iterations, residual, regularity };
    all.into_iter().chain(with).chain([whole]).collect()
}

fn path<N: Name>(n: impl Fn(&'static str) -> N) -> Vec<PathError<N>> {
    let (f, g) = (|| n("FourBar"), || n("phi, psi"));
    each! { PathError:
        DeadPoint { mechanism: f(), group: g(), gap: 0.5 }
        JointRange { mechanism: f(), of: n("s"), end: RangeEnd::Most, gap: 0.5 }
        ChangePoint { mechanism: f(), group: g() }
        NoDirection { mechanism: f() }
        Lost { mechanism: f(), group: g(), iterations: 7, residual: 0.25, regularity: 0.125 }
        TooManySteps { mechanism: f(), steps: 100 }
        Position (PositionError::TooManyBranches { mechanism: f() })
        Input (InputError::NotPeriodic { mechanism: f() })
    }
}

/// Checks that errors with other names have the same texts, each of its own.
fn check<E: Debug + ToString, F: Debug + ToString>(fixed: &[E], others: &[F]) {
    assert_eq!(fixed.len(), others.len());
    for (place, (fixed, other)) in fixed.iter().zip(others).enumerate() {
        assert_eq!(fixed.to_string(), other.to_string(), "{place}");
        assert_eq!(format!("{fixed:?}"), format!("{other:?}"), "{place}");
    }
}

#[test]
fn names_of_any_type_have_the_same_text() {
    // Borrowed from a text that ends with this function.
    let text = "FourBar drop theta phi, psi stop on s implied loop 1 rate x y z".to_owned();
    let borrowed = |name: &'static str| -> &str {
        let start = text.find(name).expect(name);
        &text[start..start + name.len()]
    };
    let names = ["theta", "s", "x", "y"].map(borrowed);
    let are_angles = [true, false, true, true];
    let values = [std::f64::consts::FRAC_PI_3, 0.25, 0.5];
    let [some, more] = [2, 4].map(|count| InputValues::new(&names[..count], &are_angles[..count], values));
    let [fixed_some, fixed_more] = [&["theta", "s"] as &[_], &["theta", "s", "x", "y"]]
        .map(|names| InputValues::new(names, &are_angles[..names.len()], values));
    assert_eq!(
        [some.to_string(), more.to_string()],
        ["theta = 60°, s = 0.25", "theta = 60°, s = 0.25, x = 28.64789°, …"]
    );
    assert!(some.iter().eq([("theta", values[0]), ("s", 0.25)]));

    let (fixed, of_borrowed) = (input(|name| name), input(borrowed));
    check(&fixed, &of_borrowed);
    check(&fixed, &of_borrowed.into_iter().map(|error| error.map_names(String::from)).collect::<Vec<_>>());

    let (fixed, of_borrowed) = (position(|name| name, &[fixed_some, fixed_more]), position(borrowed, &[some, more]));
    check(&fixed, &of_borrowed);
    assert_eq!(fixed, of_borrowed);
    let owned: Vec<PositionError<Arc<str>>> = of_borrowed.iter().map(|error| error.map_names(Arc::from)).collect();
    check(&fixed, &owned);
    check(&fixed, &of_borrowed.iter().map(|error| error.map_names(String::from)).collect::<Vec<_>>());
    // An error of each differs from all others.
    for (place, one) in owned.iter().enumerate() {
        assert!(owned.iter().enumerate().all(|(other, error)| (error == one) == (place == other)), "{one}");
    }

    let (fixed, of_borrowed) = (path(|name| name), path(borrowed));
    check(&fixed, &of_borrowed);
    check(&fixed, &of_borrowed.into_iter().map(|error| error.map_names(String::from)).collect::<Vec<_>>());
}

/// Emitted functions return errors by value: one of 24 bytes more takes the derivative of a scene 20 instructions more.
#[test]
fn errors_are_small() {
    assert!(size_of::<InputValues>() <= 48 && size_of::<PositionError>() <= 96);
    assert_eq!(size_of::<PositionError<&str>>(), size_of::<Result<[f64; 2], PositionError>>());
}
