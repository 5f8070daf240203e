//! The methods for the Jansen leg.

works!(Jansen, 10, closed, products by_products);

use linkage_gallery::jansen::*;

/// Solves J x = `right` dyad by dyad.
fn by_products(m: &Jansen, pose: &JansenPose, right: &Unknowns<f64>) -> Unknowns<f64> {
    let turned = |length: f64, direction| methods::turned(length, direction);
    let minus = |[x, y]: [f64; 2]| [-x, -y];
    let row = |first: usize| [right[first], right[first + 1]];
    let (b, d, c, g) =
        (turned(m.b, pose.angle_b), turned(m.d, pose.angle_d), turned(m.c, pose.angle_c), turned(m.g, pose.angle_g));
    let [to_b, to_j] = methods::dyad(minus(b), turned(m.j, pose.angle_j), row(0));
    let [to_d, to_e] = methods::dyad(minus(d), turned(m.e, pose.angle_e), methods::less(row(2), b, to_b));
    let [to_c, to_k] = methods::dyad(minus(c), turned(m.k, pose.angle_k), row(4));
    let known = methods::less(methods::less(row(6), d, to_d), minus(c), to_c);
    let [to_f, to_g] = methods::dyad(turned(m.f, pose.angle_f), minus(g), known);
    let known = methods::less(row(8), g, to_g);
    let [to_h, to_i] = methods::dyad(turned(m.h, pose.angle_h), minus(turned(m.i, pose.angle_i)), known);
    [to_b, to_j, to_d, to_e, to_c, to_k, to_f, to_g, to_h, to_i].into()
}
