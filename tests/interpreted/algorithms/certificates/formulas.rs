//! The formulas over numbers of any kind: those of emitted code, operation for operation, of the whole gallery.

use std::fmt::Debug;

use linkage::{Certifiable, Column, D, Dim, Formulas, Interval, Number, linkage};
use linkage_gallery::{Fixture, all_mechanisms};

use super::super::{Numbers, Positions, equal, same};
use super::operations::{Operations, given};
use super::{certifiable, only, ready};

/// All that the formulas compute of these parameters, unknowns and inputs, and of rates like them.
fn computed<M: Certifiable, N: Number>(m: &M, [parameters, unknowns, inputs]: [&[N]; 3]) -> Vec<String> {
    fn column<N: Number, R: Dim>(numbers: &[N]) -> Column<N, R> {
        Column::from_slice(numbers).expect("as many numbers")
    }
    fn text<X: Debug>(all: &[X]) -> String {
        format!("{all:?}")
    }
    let of = m.over(column::<N, _>(parameters));
    let (u, v) = (column(unknowns), column(inputs));
    let mut all = vec![
        text(of.residual(&u, &v).as_slice()),
        text(of.gamma(&u, &v, &u, &v).as_slice()),
        text(of.quantities(&u, &v).as_slice()),
    ];
    all.extend(of.jacobian_unknowns(&u, &v).iter().map(|column| text(column.as_slice())));
    all.extend(of.jacobian_inputs(&u, &v).iter().map(|column| text(column.as_slice())));
    all.extend((0..).map_while(|place| of.ranged(place, &u, &v)).map(|ranged| format!("{ranged:?}")));
    all
}

/// The names and numbers of a mechanism.
fn facts<M: Certifiable>(m: &M) -> Vec<String> {
    let parameters = Certifiable::parameters(m);
    let names = (0..=parameters.iter().count()).map(|place| m.parameter_name(place).to_string());
    let quantities = (0..=m.quantity_count().count()).map(|place| m.quantity_name(place).to_string());
    let users =
        (0..=m.dims().2.count()).map(|group| format!("{:?}", m.user_function(group).map(|name| name.to_string())));
    names
        .chain(quantities)
        .chain(users)
        .chain([format!("{parameters:?}", parameters = parameters.as_slice())])
        .collect()
}

/// The operations of the formulas: with the same ones results are the same for numbers of every kind.
fn operations<M: Certifiable>(m: &M) -> Vec<String> {
    let (u, v, _) = m.dims();
    let names = [("parameter", m.parameters().iter().count()), ("unknown", u.count()), ("input", v.count())];
    let operations = names.map(|(name, count)| given(name, count));
    computed::<M, Operations>(m, [&operations[0], &operations[1], &operations[2]])
}

/// Doubles and intervals.
fn numbers<M: Certifiable>(m: &M, starts: &[Numbers]) -> Vec<String> {
    let parameters: Vec<f64> = Certifiable::parameters(m).iter().copied().collect();
    let mut all = Vec::new();
    for [unknowns, inputs] in starts {
        all.extend(computed::<M, f64>(m, [&parameters, unknowns, inputs]));
        let wide = |numbers: &[f64]| -> Vec<Interval> {
            numbers.iter().map(|number| Interval::around(*number, 1e-3).expect("a radius")).collect()
        };
        all.extend(computed::<M, Interval>(m, [&wide(&parameters), &wide(unknowns), &wide(inputs)]));
    }
    all
}

fn compare_operations<const V: usize, M: Fixture<Scalar = f64, V = D<V>> + Certifiable>() {
    assert_eq!(M::USER_FUNCTIONS.len(), M::GROUPS.len());
    let mechanism = M::with_parameters(&M::defaults());
    certifiable::<V, M, _>(|own| {
        same::<M>(&facts(&mechanism), &facts(own));
        same::<M>(&operations(&mechanism), &operations(own));
    });
}

pub fn compare<const V: usize, M: Fixture<Scalar = f64, V = D<V>> + Certifiable>() {
    let Positions { mechanism, starts, .. } = Positions::<M>::drawn(20);
    certifiable::<V, M, _>(|own| same::<M>(&numbers(&mechanism, &starts), &numbers(own, &starts)));
}

with_text! { CONSTANTS:
    /// Constants of all kinds: doubles, ratios, ratios of numbers that are none, numbers near a double, multiples of pi.
    #[derive(Debug, Clone, Copy)]
    mechanism Constants {
        param a = 2, bend = 30deg;
        input phi in -0.3..;
        unknown x, y in 0.1..9.5;
        equation x = 0.1 * a * cos(phi + 60deg) - phi / 3 + 0.5;
        equation y = -0.7 * x - 9007199254740993 / 7 * cos(bend) + 1e300 * a - 1e30 * x;
        output one = 1.5 * x - 9007199254740993 / 7 + 45deg;
        output other = pi * x - (2 + 1/3) * phi + sqrt(5) * a - y^2 - 0.3 * (x - y)^2;
        output third = -9007199254740993 / 7 * x^3 - 1e300 * (phi + 0.25)^2;
        derive intervals;
    }
}

#[test]
fn constants_keep_their_kinds() {
    let start = [vec![0.3, 0.4], vec![0.7]];
    fn all<M: Certifiable>(m: &M, start: &Numbers) -> Vec<String> {
        [operations(m), numbers(m, std::slice::from_ref(start))].concat()
    }
    let at_run_time = ready::<1, _>(&only(CONSTANTS), |own| all(own, &start));
    equal("Constants", &all(&Constants::default(), &start), &at_run_time);
}

macro_rules! operations_of {
    ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {
        $($(compare_operations::<_, linkage_gallery::$file::$Mechanism>();)+)*
    };
}

#[test]
fn operations_are_those_of_emitted_code() {
    all_mechanisms!(operations_of);
}

#[test]
fn numbers_are_those_of_emitted_code() {
    eight!(compare);
}
