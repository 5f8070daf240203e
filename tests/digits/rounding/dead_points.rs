//! Every emitted function of every mechanism of the gallery near singular coordinates, where `f64` computes groups that
//! are solved by factorisation in twice the precision: the values of `Rounded` have its bits, and the results of 31
//! digits are within their bounds.

use linkage_double::DoubleDouble;
use linkage_gallery::{Fixture, WithHigherOrders, all_mechanisms};
use linkage_oracle::Oracle;
use linkage_rounding::Rounded;

use crate::rounding::every_function::{Found, Three, arguments};
use crate::rounding::poses;
use crate::rounding::results::{Arguments, assembled, given, higher_orders};

/// Singular coordinates of each mechanism, if no number is asked for.
const SINGULAR: usize = 2;

/// Fractions of the way to the singular coordinates that are left; pivots are below 1/64 from about the second on.
const LEFT: [f64; 5] = [3e-2, 1e-3, 1e-5, 1e-8, 1e-11];

/// Halvings of the way between coordinates whose determinants differ in sign: all bits of the place.
const HALVINGS: usize = 60;

/// Calls with coordinates near those where the determinant is zero, on the way from one sample to the next.
fn near_singular<F: Fixture>(mut compare: impl FnMut(&str, &Arguments<f64>)) {
    let samples: Vec<Arguments<f64>> = Oracle::of::<F>().samples(12 * poses(SINGULAR)).map(arguments).collect();
    let mut found = 0;
    for pair in samples.windows(2) {
        let at = |part: f64| {
            let ends = pair[0].q.iter().zip(&pair[1].q);
            ends.map(|(from, to)| from + part * (to - from)).collect::<Vec<f64>>()
        };
        let m = F::with_parameters(&pair[0].parameters);
        let is_positive = |part: f64| m.determinant(&m.pose(&at(part))) > 0.0;
        let from = is_positive(0.0);
        if from == is_positive(1.0) || found == poses(SINGULAR) {
            continue;
        }
        found += 1;
        let mut ends = [0.0, 1.0];
        for _ in 0..HALVINGS {
            let middle = (ends[0] + ends[1]) / 2.0;
            ends[usize::from(is_positive(middle) != from)] = middle;
        }
        for left in LEFT {
            let near = Arguments { q: at(ends[0] - left), ..pair[0].clone() };
            compare(&format!("{} {found}, {left:e} from singular", F::FILE), &near);
        }
    }
}

fn bits_of_doubles<F: Fixture>() {
    let mut found = Found::default();
    near_singular::<F>(|context, plain| {
        let three = Three {
            plain: given::<f64, F>(plain),
            rounded: given::<Rounded, F::Of<Rounded>>(&plain.map(Rounded::from)),
            exact: given::<DoubleDouble, F::Of<DoubleDouble>>(&plain.map(DoubleDouble::from)),
        };
        found.compare(context, three);
        // The position of the same inputs, at or near which the group is singular; `DoubleDouble` may have another.
        for branch in 0..F::branch_count().min(4) {
            let three = Three {
                plain: assembled::<f64, F>(plain, branch),
                rounded: assembled::<Rounded, F::Of<Rounded>>(&plain.map(Rounded::from), branch),
                exact: Vec::new(),
            };
            found.compare(&format!("{context}, branch {branch}"), three);
        }
    });
    println!("{}: {} results, {} unknown", F::FILE, found.results, found.unknown);
    found.report(&["velocity", "acceleration"]);
}

fn bits_of_higher_orders<F: WithHigherOrders>() {
    let mut found = Found::default();
    near_singular::<F>(|context, plain| {
        let three = Three {
            plain: higher_orders::<f64, F>(plain),
            rounded: higher_orders::<Rounded, F::OfOrders<Rounded>>(&plain.map(Rounded::from)),
            exact: higher_orders::<DoubleDouble, F::OfOrders<DoubleDouble>>(&plain.map(DoubleDouble::from)),
        };
        found.compare(context, three);
    });
    println!("{}: {} results of higher order, {} unknown", F::FILE, found.results, found.unknown);
}

macro_rules! tests {
    ($($file:ident: $($Mechanism:ident $method:ident)+ $(, $orders:ident)?;)*) => {$(
        mod $file {
            use linkage_gallery::$file::{$($Mechanism),+};

            #[test]
            fn values_have_the_bits_of_doubles() {
                $(super::bits_of_doubles::<$Mechanism>();)+
            }

            tests!(@ $($orders)? $($Mechanism)+);
        }
    )*};
    (@ orders $Mechanism:ident) => {
        #[test]
        fn higher_orders() {
            super::bits_of_higher_orders::<$Mechanism>();
        }
    };
    (@ $($Mechanism:ident)+) => {};
}

all_mechanisms!(tests);
