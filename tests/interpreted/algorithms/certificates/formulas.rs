//! The formulas over numbers of any kind: those of emitted code, operation for operation, of the whole gallery.

use std::fmt::Debug;

use linkage::{Certifiable, Column, D, Dim, Formulas, Interval, Number};
use linkage_gallery::{Fixture, all_mechanisms};

use super::super::{Numbers, Positions, same};
use super::operations::{Operations, given};
use super::certifiable;

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
    let users = (0..=m.dims().2.count()).map(|group| format!("{:?}", m.user_function(group).map(|name| name.to_string())));
    names.chain(quantities).chain(users).chain([format!("{parameters:?}", parameters = parameters.as_slice())]).collect()
}

/// Numbers of all kinds.
fn numbers<M: Certifiable>(m: &M, starts: &[Numbers]) -> Vec<String> {
    let parameters: Vec<f64> = Certifiable::parameters(m).iter().copied().collect();
    let (u, v, _) = m.dims();
    let names = [("parameter", parameters.len()), ("unknown", u.count()), ("input", v.count())];
    let operations = names.map(|(name, count)| given(name, count));
    let mut all = computed::<M, Operations>(m, [&operations[0], &operations[1], &operations[2]]);
    for [unknowns, inputs] in starts {
        all.extend(computed::<M, f64>(m, [&parameters, unknowns, inputs]));
        let wide = |numbers: &[f64]| -> Vec<Interval> {
            numbers.iter().map(|number| Interval::around(*number, 1e-3).expect("a radius")).collect()
        };
        all.extend(computed::<M, Interval>(m, [&wide(&parameters), &wide(unknowns), &wide(inputs)]));
    }
    all
}

fn compare<const V: usize, M: Fixture<Scalar = f64, V = D<V>> + Certifiable>() {
    let Positions { mechanism, starts, .. } = Positions::<M>::drawn(20);
    certifiable::<V, M, _>(|own| {
        same::<M>(&facts(&mechanism), &facts(own));
        same::<M>(&numbers(&mechanism, &starts), &numbers(own, &starts));
    });
}

macro_rules! compared {
    ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {
        $($(compare::<_, linkage_gallery::$file::$Mechanism>();)+)*
    };
}

#[test]
fn formulas_are_those_of_emitted_code() {
    all_mechanisms!(compared);
}
