//! Links in line, of decimal lengths among others: folded, stretched, and off by one ulp to a thousandth. The position of
//! the given doubles, from the textbook's formulas in 48 digits, is within each bound.
//!
//! ```text
//! IN_LINE=1000000 cargo test --release --all-features --test digits in_line -- --nocapture    this many positions
//! ```

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use linkage::{Elbow, PositionError, Slider, Slope, linkage};
use linkage_oracle::precise::{Big, Scalar, big, direction};
use linkage_rounding::Rounded;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use crate::rounding::every_function::median;

linkage! {
    mechanism FourBar {
        param a, b, c, d;
        input v;
        unknown p, r;
        loop a@v + b@p = d@0 + c@r;
        output coupler = angle(b@p);
        output rocker = angle(c@r);
        output half = tan(p / 2);
        output height = abs(sin(r));
        output chord = sqrt(2 + 2*cos(r));
    }
}

linkage! {
    mechanism SliderCrank {
        param a, b, h;
        input v;
        unknown p, s;
        loop a@v + b@p = (s, h)@0;
        output coupler = angle(b@p);
    }
}

linkage! {
    mechanism Inverted {
        param a, d, h;
        input v;
        unknown r, s;
        loop a@v = d@0 + (s, h)@r;
        output swing = angle(a@v - d@0);
    }
}

linkage! {
    mechanism SixBar {
        param a, b, c, d, e, f, g, k;
        input v;
        unknown p, r, u, w;
        loop a@v + b@p = d@0 + c@r;
        loop e@r + f@u = g@0 + k@w;
    }
}

linkage! {
    mechanism Harmonic {
        param a, b;
        input h;
        unknown p;
        equation a * cos(p) + b * sin(p) = h;
    }
}

fn positions() -> usize {
    linkage_trials::count("IN_LINE", 1_000, 4_000)
}

/// A vector, or a complex number.
type Vector = [Big; 2];

fn scaled(length: &Big, [x, y]: &Vector) -> Vector {
    [length * x, length * y]
}

fn minus([x, y]: &Vector, [u, v]: &Vector) -> Vector {
    [x - u, y - v]
}

fn product([x, y]: &Vector, [u, v]: &Vector) -> Vector {
    [x * u - y * v, x * v + y * u]
}

fn quotient([x, y]: &Vector, [u, v]: &Vector) -> Vector {
    let square = u * u + v * v;
    [(x * u + y * v) / &square, (y * u - x * v) / &square]
}

fn cross([x, y]: &Vector, [u, v]: &Vector) -> Big {
    x * v - y * u
}

fn at(angle: f64) -> Vector {
    if angle == 0.0 {
        return [big(1.0), big(0.0)];
    }
    let (x, y) = direction(&big(angle));
    [x, y]
}

/// The root of a number that is not negative.
fn root(square: Big) -> Option<Big> {
    if square < big(0.0) {
        None
    } else if square == big(0.0) {
        Some(square)
    } else {
        Some(square.sqrt())
    }
}

/// Directions of p and r for p e^(i p) - q e^(i r) = line; the joint between them is left of the line if `left`.
fn dyad(line: &Vector, p: &Big, q: &Big, left: bool) -> Option<[Vector; 2]> {
    let [x, y] = line;
    let square = x * x + y * y;
    let (sum, difference) = (p + q, p - q);
    let twice = root((&sum * &sum - &square) * (&square - &difference * &difference))?;
    let along = &square + &sum * &difference;
    let link = quotient(&product(line, &[along, if left { twice } else { -twice }]), &[big(2.0) * square, big(0.0)]);
    let other = minus(&link, line);
    Some([quotient(&link, &[p.clone(), big(0.0)]), quotient(&other, &[q.clone(), big(0.0)])])
}

/// Errors and bounds.
#[derive(Default)]
struct Found {
    /// By result: error and bound.
    pairs: BTreeMap<&'static str, Vec<[f64; 2]>>,
    unknown: usize,
    across_cut: usize,
    /// Positions with links that do not reach each other, by less than an ulp.
    apart: usize,
    positions: usize,
}

impl Found {
    fn result(&mut self, context: &str, name: &'static str, found: Rounded, off: f64) {
        // The exact result has 48 digits, and `off` 16.
        let off = (off.abs() - 1e-40).max(0.0);
        assert!(off <= found.error() * (1.0 + 1e-12), "{name} = {found:?} is off by {off:e}: {context}");
        if found.error().is_finite() {
            self.pairs.entry(name).or_default().push([off, found.error()]);
        } else {
            self.unknown += 1;
        }
    }

    fn number(&mut self, context: &str, name: &'static str, found: Rounded, exact: &Big) {
        self.result(context, name, found, (exact - big(found.value())).double());
    }

    /// An angle from -pi to pi, by its direction.
    fn angle(&mut self, context: &str, name: &'static str, found: Rounded, exact: &Vector) {
        let [across, along] = quotient(exact, &at(found.value())).map(|part| part.double());
        let (across, along) = (along, across);
        let off = across.atan2(along);
        let is_above = exact[1] >= big(0.0);
        let off = match found.value() + off {
            value if is_above && value < -1.0 => off + TAU,
            value if !is_above && value > 1.0 => off - TAU,
            _ => off,
        };
        if found.error() > PI {
            self.across_cut += 1;
            assert!(off.abs() <= found.error(), "{name} = {found:?} is off by {off:e}: {context}");
        } else {
            self.result(context, name, found, off);
        }
    }
}

/// Lengths, decimal or not, and their disturbance.
struct Draw(SmallRng);

impl Draw {
    /// The decimals of whole numbers of one unit.
    fn decimals<const N: usize>(&mut self, numbers: [i32; N]) -> [f64; N] {
        let divisor = [1.0, 10.0, 100.0, 1000.0][self.0.random_range(0..4)];
        numbers.map(|number| f64::from(number) / divisor)
    }

    /// A number that is off by nothing, by some ulps, or by 1e-16 to 1e-3 of itself.
    fn near(&mut self, number: f64) -> f64 {
        let sign = if self.0.random_bool(0.5) { 1.0 } else { -1.0 };
        match self.0.random_range(0..5) {
            0..2 => number,
            2 => number * (1.0 + sign * f64::EPSILON * f64::from(self.0.random_range(1..5))),
            3 => number * (1.0 + sign * 10_f64.powf(self.0.random_range(-16.0..-8.0))),
            _ => number * (1.0 + sign * 10_f64.powf(self.0.random_range(-8.0..-3.0))),
        }
    }

    /// An angle and two lengths with a whole distance: the third side of their triangle.
    fn aligned(&mut self) -> (f64, [i32; 3]) {
        let [a, d] = [0; 2].map(|_| self.0.random_range(1..60));
        match self.0.random_range(0..5) {
            0 if a != d => (0.0, [a, d, (a - d).abs()]),
            1 => (PI, [a, d, a + d]),
            2 => (-PI, [a, d, a + d]),
            kind => {
                let by = self.0.random_range(1..6);
                let [a, d, e] = [[3, 4, 5], [4, 3, 5], [5, 12, 13], [15, 8, 17]][self.0.random_range(0..4)];
                (if kind == 3 { FRAC_PI_2 } else { -FRAC_PI_2 }, [a * by, d * by, e * by])
            }
        }
    }

    /// Two lengths whose sum or difference is a distance.
    fn reaching(&mut self, distance: i32) -> [i32; 2] {
        let other = self.0.random_range(1..60);
        match self.0.random_range(0..3) {
            0 if distance > 1 => {
                let part = self.0.random_range(1..distance);
                [part, distance - part]
            }
            1 => [other, other + distance],
            _ => [other + distance, other],
        }
    }

    /// A four-bar a, b, c, d with its input.
    fn four_bar(&mut self) -> ([f64; 4], f64) {
        let (v, [a, d, distance]) = self.aligned();
        let [b, c] = self.reaching(distance);
        let [a, b, c, d] = self.decimals([a, b, c, d]);
        let v = if self.0.random_bool(0.2) { v + TAU } else { v };
        if self.0.random_range(0..4) > 0 {
            return ([a, b, self.near(c), d], v);
        }
        // At any input in line within rounding error.
        let v = (self.0.random_range(-4.0..4.0_f64) * 8.0).round() / 10.0;
        let distance = (d - a * v.cos()).hypot(a * v.sin());
        let c = if b < distance { distance - b } else { b + distance };
        ([a, b, self.near(c), d], v)
    }
}

/// Compares a dyad of the first loop.
fn compare_dyad(found: &mut Found, context: &str, [p, r]: [Rounded; 2], exact: &[Vector; 2]) {
    found.angle(context, "p", p, &exact[0]);
    found.angle(context, "r", r, &exact[1]);
}

fn four_bar(draw: &mut Draw, found: &mut Found) {
    let ([a, b, c, d], v) = draw.four_bar();
    let m = FourBar::<Rounded>::from([a, b, c, d].map(Rounded::from));
    let line = minus(&[big(d), big(0.0)], &scaled(&big(a), &at(v)));
    for side in [Elbow::Left, Elbow::Right] {
        let context = format!("four-bar {a:?}, {b:?}, {c:?}, {d:?} at {v:?}, {side:?}");
        let Some(pose) = buildable(&context, m.assemble(Rounded::from(v), FourBarBranch::new(side))) else { continue };
        found.positions += 1;
        let Some(exact) = dyad(&line, &big(b), &big(c), side == Elbow::Left) else {
            found.apart += 1;
            continue;
        };
        let q = pose.coordinates();
        compare_dyad(found, &context, [q.p, q.r], &exact);
        let [p, r] = &exact;
        if let Ok(outputs) = m.outputs(&pose) {
            found.angle(&context, "coupler", outputs.coupler, p);
            found.angle(&context, "rocker", outputs.rocker, r);
            if p[0] > big(0.0) {
                found.number(&context, "half", outputs.half, &(&p[1] / (big(1.0) + &p[0])));
            } else if p[1] != big(0.0) {
                found.number(&context, "half", outputs.half, &((big(1.0) - &p[0]) / &p[1]));
            } else {
                // At the pole.
                assert_eq!(outputs.half.error(), f64::INFINITY, "{context}");
            }
            let height = if r[1] < big(0.0) { -r[1].clone() } else { r[1].clone() };
            found.number(&context, "height", outputs.height, &height);
            if let Some(chord) = root(big(2.0) + big(2.0) * &r[0]) {
                found.number(&context, "chord", outputs.chord, &chord);
            }
        }
        let Ok(rates) = m.velocity(&pose, FourBarInputs { v: Rounded::from(1.0) }) else { continue };
        let crank = at(v);
        let sine = cross(r, p);
        let laws = [big(a) * cross(&crank, r) / (big(b) * &sine), big(a) * cross(&crank, p) / (big(c) * &sine)];
        found.number(&context, "p'", rates.p, &laws[0]);
        found.number(&context, "r'", rates.r, &laws[1]);
    }
}

/// The position; errors of links that do not reach each other or have no direction are right where there is none.
fn buildable<P>(context: &str, position: Result<P, PositionError>) -> Option<P> {
    match position {
        Ok(pose) => Some(pose),
        Err(PositionError::Unbuildable { .. } | PositionError::Undetermined { .. }) => None,
        Err(error) => panic!("{error}: {context}"),
    }
}

fn slider_crank(draw: &mut Draw, found: &mut Found) {
    let up = draw.0.random_bool(0.5);
    let v = [FRAC_PI_2, -FRAC_PI_2, 0.0, PI, (draw.0.random_range(-3.0..3.0_f64) * 10.0).round() / 10.0]
        [draw.0.random_range(0..5)];
    let [a, b] = [0; 2].map(|_| draw.0.random_range(1..60));
    let reach = if up { b } else { -b };
    // The coupler is perpendicular to the guide.
    let [a, b, h] = draw.decimals([a, b, (f64::from(a) * v.sin()).round() as i32 + reach]);
    let h = draw.near(if v.sin().abs().fract() < 1e-9 { h } else { a * v.sin() + b.copysign(reach.into()) });
    let m = SliderCrank::<Rounded>::from([a, b, h].map(Rounded::from));
    let crank = scaled(&big(a), &at(v));
    for side in [Slider::Far, Slider::Near] {
        let context = format!("slider-crank {a:?}, {b:?}, {h:?} at {v:?}, {side:?}");
        let Some(pose) = buildable(&context, m.assemble(Rounded::from(v), SliderCrankBranch::new(side))) else {
            continue;
        };
        found.positions += 1;
        let across = big(h) - &crank[1];
        let Some(along) = root((big(b) - &across) * (big(b) + &across)) else {
            found.apart += 1;
            continue;
        };
        let along = if side == Slider::Far { along } else { -along };
        let p = quotient(&[along.clone(), across], &[big(b), big(0.0)]);
        let q = pose.coordinates();
        found.angle(&context, "p", q.p, &p);
        found.number(&context, "s", q.s, &(&crank[0] + along));
        if let Ok(outputs) = m.outputs(&pose) {
            found.angle(&context, "coupler", outputs.coupler, &p);
        }
    }
}

fn inverted(draw: &mut Draw, found: &mut Found) {
    let (v, [a, d, distance]) = draw.aligned();
    let sign = if draw.0.random_bool(0.5) { 1 } else { -1 };
    let [a, d, h] = draw.decimals([a, d, sign * distance]);
    let h = if draw.0.random_bool(0.1) { 0.0 } else { h };
    let h = draw.near(h);
    let m = Inverted::<Rounded>::from([a, d, h].map(Rounded::from));
    let line = minus(&scaled(&big(a), &at(v)), &[big(d), big(0.0)]);
    for side in [Slider::Far, Slider::Near] {
        let context = format!("inverted slider-crank {a:?}, {d:?}, {h:?} at {v:?}, {side:?}");
        let Some(pose) = buildable(&context, m.assemble(Rounded::from(v), InvertedBranch::new(side))) else { continue };
        found.positions += 1;
        let Some(s) = root(&line[0] * &line[0] + &line[1] * &line[1] - big(h) * big(h)) else {
            found.apart += 1;
            continue;
        };
        let s = if side == Slider::Far { s } else { -s };
        let q = pose.coordinates();
        found.number(&context, "s", q.s, &s);
        found.angle(&context, "r", q.r, &quotient(&line, &[s, big(h)]));
        if let Ok(outputs) = m.outputs(&pose) {
            found.angle(&context, "swing", outputs.swing, &line);
        }
    }
}

fn six_bar(draw: &mut Draw, found: &mut Found) {
    let ([a, b, c, d], v) = draw.four_bar();
    // At an input of zero or pi the first dyad is horizontal, if it is in line, and the second reaches the same way.
    let [e, g] = [0; 2].map(|_| draw.0.random_range(1..60));
    let [f, k] = draw.reaching(if g > e { g - e } else { g + e });
    let [e, f, g, k] = draw.decimals([e, f, g, k]);
    let k = draw.near(k);
    let m = SixBar::<Rounded>::from([a, b, c, d, e, f, g, k].map(Rounded::from));
    let line = minus(&[big(d), big(0.0)], &scaled(&big(a), &at(v)));
    for sides in 0..4 {
        let [first, second] = [sides % 2, sides / 2].map(|side| [Elbow::Left, Elbow::Right][side]);
        let context = format!("six-bar {:?} at {v:?}, {first:?}, {second:?}", [a, b, c, d, e, f, g, k]);
        let Some(pose) = buildable(&context, m.assemble(Rounded::from(v), SixBarBranch::new(first, second))) else {
            continue;
        };
        found.positions += 1;
        let exact = dyad(&line, &big(b), &big(c), first == Elbow::Left).and_then(|one| {
            let rest = minus(&[big(g), big(0.0)], &scaled(&big(e), &one[1]));
            Some((one, dyad(&rest, &big(f), &big(k), second == Elbow::Left)?))
        });
        let Some((one, other)) = exact else {
            found.apart += 1;
            continue;
        };
        let q = pose.coordinates();
        compare_dyad(found, &context, [q.p, q.r], &one);
        found.angle(&context, "u", q.u, &other[0]);
        found.angle(&context, "w", q.w, &other[1]);
    }
}

fn harmonic(draw: &mut Draw, found: &mut Found) {
    let by = draw.0.random_range(1..20);
    let [a, b, n] = [[3, 4, 5], [4, -3, 5], [-5, 12, 13], [15, 8, 17], [1, 0, 1], [0, 1, 1]][draw.0.random_range(0..6)];
    let sign = if draw.0.random_bool(0.5) { 1 } else { -1 };
    let [a, b, h] = draw.decimals([a * by, b * by, sign * n * by]);
    let h = draw.near(h);
    let m = Harmonic::<Rounded>::from([a, b].map(Rounded::from));
    for side in [Slope::Rising, Slope::Falling] {
        let context = format!("{a:?} cos + {b:?} sin = {h:?}, {side:?}");
        let Some(pose) = buildable(&context, m.assemble(Rounded::from(h), HarmonicBranch::new(side))) else { continue };
        found.positions += 1;
        // n cos(p - q) = h, where n e^(i q) = a + i b; it rises where p < q.
        let square = big(a) * big(a) + big(b) * big(b);
        let Some(sine) = root(&square - big(h) * big(h)) else {
            found.apart += 1;
            continue;
        };
        let turned = [big(h), if side == Slope::Rising { -sine } else { sine }];
        let exact = quotient(&product(&[big(a), big(b)], &turned), &[square, big(0.0)]);
        found.angle(&context, "p", pose.coordinates().p, &exact);
    }
}

/// 0.1 + 0.4 is longer than 0.6 - 0.1 by less than an ulp: the doubles have a triangle of 3e-8 rad, and f64 computes none.
#[test]
fn tenths_in_line() {
    let m = FourBar::<Rounded>::from([0.1, 0.1, 0.4, 0.6].map(Rounded::from));
    for side in [Elbow::Left, Elbow::Right] {
        let pose = m.assemble(Rounded::from(0.0), FourBarBranch::new(side)).unwrap();
        let p = pose.coordinates().p;
        assert!(p.value() == 0.0 && (2.98e-8..3.5e-8).contains(&p.error()), "{p:?}");
        let outputs = m.outputs(&pose).unwrap();
        // From -pi to pi, and known but for the side of the cut.
        assert!((TAU - 1e-7..TAU + 1e-7).contains(&outputs.rocker.error()), "{:?}", outputs.rocker);
        assert!(pose.r.im.error() < 1e-8, "{:?}", pose.r);
    }
}

type Kind = (&'static str, fn(&mut Draw, &mut Found));

#[test]
fn positions_of_links_in_line_are_within_their_bounds() {
    let kinds: [Kind; 5] = [
        ("four-bar", four_bar),
        ("slider-crank", slider_crank),
        ("inverted slider-crank", inverted),
        ("six-bar", six_bar),
        ("harmonic", harmonic),
    ];
    for (name, compare) in kinds {
        let mut draw = Draw(SmallRng::seed_from_u64(linkage_trials::seed(44)));
        let mut found = Found::default();
        let most = positions() / kinds.len();
        while found.positions < most {
            compare(&mut draw, &mut found);
        }
        let Found { pairs, unknown, across_cut, apart, positions } = found;
        println!("{name}: {positions} positions, {apart} not in reach, {across_cut} across the cut, {unknown} unknown");
        for (result, pairs) in pairs {
            let inexact: Vec<[f64; 2]> = pairs.iter().copied().filter(|[off, _]| *off > 0.0).collect();
            let ratio = median(inexact.iter().map(|[off, bound]| bound / off));
            println!(
                "    {result:8} {} results, {} inexact, median of bound / error {ratio:.1}",
                pairs.len(),
                inexact.len()
            );
        }
    }
}
