//! Every emitted function of every mechanism of the gallery near singular coordinates, where `f64` computes groups that
//! are solved by factorisation in twice the precision: the values of `Rounded` have its bits, and the results of 31
//! digits are within their bounds.

use linkage_double::DoubleDouble;
use linkage_gallery::checks::each;
use linkage_gallery::listed::{Listed, ListedWithOrders, all, same_as, with_orders};
use linkage_oracle::{Oracle, scalars};
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
fn near_singular(of: &dyn Listed<f64>, mut compare: impl FnMut(&str, &Arguments<f64>)) {
    let samples: Vec<Arguments<f64>> = Oracle::of(of).samples(12 * poses(SINGULAR)).map(arguments).collect();
    let mut found = 0;
    for pair in samples.windows(2) {
        let at = |part: f64| {
            let ends = pair[0].q.iter().zip(&pair[1].q);
            ends.map(|(from, to)| from + part * (to - from)).collect::<Vec<f64>>()
        };
        let m = of.with_parameters(&pair[0].parameters);
        let is_positive = |part: f64| m.pose(&at(part)).determinant() > 0.0;
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
            compare(&format!("{} {found}, {left:e} from singular", of.file()), &near);
        }
    }
}

#[test]
fn values_have_the_bits_of_doubles() {
    each(all(), |of| bits_of_doubles(of, same_as(scalars::rounded(), of), same_as(scalars::doubled(), of)));
}

fn bits_of_doubles(of: &dyn Listed<f64>, rounded: &dyn Listed<Rounded>, doubled: &dyn Listed<DoubleDouble>) {
    let mut found = Found::default();
    near_singular(of, |context, plain| {
        let three = Three {
            plain: given(of, plain),
            rounded: given(rounded, &plain.map(Rounded::from)),
            exact: given(doubled, &plain.map(DoubleDouble::from)),
        };
        found.compare(context, three);
        // The position of the same inputs, at or near which the group is singular; `DoubleDouble` may have another.
        for branch in 0..of.branch_count().min(4) {
            let three = Three {
                plain: assembled(of, plain, branch),
                rounded: assembled(rounded, &plain.map(Rounded::from), branch),
                exact: Vec::new(),
            };
            found.compare(&format!("{context}, branch {branch}"), three);
        }
    });
    println!("{}: {} results, {} unknown", of.file(), found.results, found.unknown);
    found.report(&["velocity", "acceleration"]);
}

#[test]
fn higher_orders_have_the_bits_of_doubles() {
    each(with_orders(), |of| {
        let (rounded, doubled) = (scalars::rounded_with_orders(), scalars::doubled_with_orders());
        bits_of_higher_orders(of, same_as(rounded, of), same_as(doubled, of));
    });
}

fn bits_of_higher_orders(
    of: &dyn ListedWithOrders<f64>,
    rounded: &dyn ListedWithOrders<Rounded>,
    doubled: &dyn ListedWithOrders<DoubleDouble>,
) {
    let mut found = Found::default();
    near_singular(of, |context, plain| {
        let three = Three {
            plain: higher_orders(of, plain),
            rounded: higher_orders(rounded, &plain.map(Rounded::from)),
            exact: higher_orders(doubled, &plain.map(DoubleDouble::from)),
        };
        found.compare(context, three);
    });
    println!("{}: {} results of higher order, {} unknown", of.file(), found.results, found.unknown);
}
