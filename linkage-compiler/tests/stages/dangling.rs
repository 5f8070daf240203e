//! Planned code that refers to what does not exist cannot be lowered: nothing is printed in its place.

use linkage_compiler::derivation;
use linkage_compiler::lower;
use linkage_compiler::program::{
    self, Body, Expression, Function, Functions, Intrinsic, Pattern, Receiver, Statement, Value, Variable,
};
use quote::quote;

/// The error of a mechanism one of whose functions has this body, `None` if it is lowered.
fn error_of(body: Body) -> Option<String> {
    let tokens = quote! {
        mechanism Slider {
            param r = 1, l = 3;
            input phi;
            unknown s, psi;
            loop r@phi + l@psi = (s, 0);
        }
    };
    let mechanism = linkage_compiler::read(tokens).unwrap().remove(0);
    let driver = &mechanism.drivers[linkage_compiler::ids::Id::new(0)];
    let mut derivation = derivation::derive(&mechanism, driver);
    let planned = program::plan(&mechanism, driver, &mut derivation).unwrap();
    let functions = planned.functions.into_table().into_iter().map(|function| match function.name.as_str() {
        "branch_near" => Function { body: Some(body.clone()), ..function },
        _ => function,
    });
    let planned = program::Program { functions: functions.collect::<Functions<Body>>(), ..planned };
    lower::program(planned, &derivation).err().map(|dangling| dangling.to_string())
}

#[test]
fn a_reference_to_nothing_is_an_error() {
    let value = |value| Body::plain(value);
    let before = |statement| Body { before: vec![statement], ..Body::default() };
    let guess = || Expression::name("guess");
    for (body, what) in [
        (value(Expression::name("nothing")), "the variable `nothing`"),
        (value(Expression::Result(7)), "result 7 of the kernel"),
        (value(Expression::Local(3)), "local value 3"),
        (value(Expression::own_call("nowhere", [])), "the function `nowhere`"),
        (value(Expression::called_on(Receiver::ItsType, "nowhere", [])), "the function `nowhere`"),
        (value(Expression::call(Intrinsic::IsNonzero, [guess()])), "1 arguments of `is_nonzero`"),
        (value(Expression::List(vec![guess().field("s"), Expression::name("x").borrowed()])), "the variable `x`"),
        (before(Statement::Let(Pattern::Bound(Variable::Local(0)), guess())), "local value 0"),
        (before(Statement::Do(Expression::name("nothing").tried())), "the variable `nothing`"),
    ] {
        let error = error_of(body).expect(what);
        assert!(
            error.starts_with(&format!("the code of `branch_near` refers to {what}, which does not exist")),
            "{error}"
        );
    }
    assert_eq!(error_of(value(guess().dereferenced())), None);
    // The statements of an inner function are code as well.
    let inside = Expression::Closure {
        arguments: vec![Pattern::bound("one")],
        statements: vec![Statement::Do(Expression::name("two"))],
        value: Box::new(Expression::name("one")),
        moves: false,
    };
    assert!(error_of(value(inside)).is_some_and(|error| error.contains("the variable `two`")));
    // An argument of an inner function has no meaning after it.
    let closure = Expression::Closure {
        arguments: vec![Pattern::bound("one")],
        statements: Vec::new(),
        value: Box::new(Expression::name("one")),
        moves: false,
    };
    let after = value(Expression::Tuple(vec![closure, Expression::name("one")]));
    assert!(error_of(after).is_some_and(|error| error.contains("the variable `one`")));
}

/// A body keeps its value, so that the test above breaks what it means to break.
#[test]
fn a_result_is_known_by_its_kernel() {
    let body = Body {
        value: Value::Result(Expression::own_call("branch_of", [Expression::name("guess")])),
        ..Body::default()
    };
    assert_eq!(error_of(body), None);
}
