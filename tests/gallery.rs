//! The gallery of classic mechanisms, each followed through its whole motion and held against what is known
//! of it without any table: links that stay rigid, lines that are straight, strokes, ratios and sweeps.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use linkage::{Mechanism, linkage, position};

#[path = "source/cam_laws.rs"]
mod cam_laws;
mod source;

include!("mechanisms/andrews.rs");
include!("mechanisms/cam_follower.rs");
include!("mechanisms/cam_rocker.rs");
include!("mechanisms/cardan.rs");
include!("mechanisms/chebyshev.rs");
include!("mechanisms/coupled_wheels.rs");
include!("mechanisms/crank_shaper.rs");
include!("mechanisms/double_butterfly.rs");
include!("mechanisms/elliptic_trammel.rs");
include!("mechanisms/five_bar.rs");
include!("mechanisms/four_bar.rs");
include!("mechanisms/geared_five_bar.rs");
include!("mechanisms/geneva.rs");
include!("mechanisms/hart.rs");
include!("mechanisms/hoecken.rs");
include!("mechanisms/inverted_slider_crank.rs");
include!("mechanisms/jansen.rs");
include!("mechanisms/klann.rs");
include!("mechanisms/offset_slider_crank.rs");
include!("mechanisms/pantograph.rs");
include!("mechanisms/peaucellier.rs");
include!("mechanisms/roberts.rs");
include!("mechanisms/scotch_yoke.rs");
include!("mechanisms/stephenson_i.rs");
include!("mechanisms/stephenson_ii.rs");
include!("mechanisms/stephenson_iii.rs");
include!("mechanisms/v_twin.rs");
include!("mechanisms/watt_i.rs");
include!("mechanisms/watt_ii.rs");
include!("mechanisms/watt_line.rs");
include!("mechanisms/whitworth.rs");
include!("mechanisms/wiper.rs");

/// A length that follows from a closed loop is right to this many roundings of the sum of all lengths.
const ROUNDINGS: f64 = 8.0;

/// Steps of a full turn: one a degree.
const STEPS: u32 = 360;

#[track_caller]
fn close(found: f64, expected: f64, error: f64) {
    let found_error = (found - expected).abs();
    assert!(found_error <= error, "{found:?} is not {expected:?}: off by {found_error:e}, {error:e} is allowed");
}

/// Equal to the rounding of lengths whose sum is `size`.
#[track_caller]
fn exact(found: f64, expected: f64, size: f64) {
    close(found, expected, ROUNDINGS * f64::EPSILON * size);
}

fn degrees(angle: f64) -> f64 {
    angle.to_radians()
}

/// Every position of a course in closed form, on the branch that the course is on: the same position, loops
/// closed to rounding, and the determinant from the half chord as good as from the angles.
macro_rules! closed_form {
    ($mechanism:ident, $course:ident, $input:ident) => {
        for q in &$course.positions {
            let pose = $mechanism.pose_at(q);
            let found = $mechanism.assemble(q.$input, $mechanism.branch_of(&pose)).expect("an assembly");
            assert_eq!($mechanism.branch_of(&found), $mechanism.branch_of(&pose));
            let size = $mechanism.closure_sizes(&found).sum();
            exact($mechanism.residual(&found).amax(), 0.0, size);
            let (ours, theirs) = ($mechanism.block_determinants(&found), $mechanism.block_determinants(&pose));
            let (j, other) = ($mechanism.jacobian_unknowns(&found), $mechanism.jacobian_unknowns(&pose));
            close((j - other).amax(), 0.0, 1e-9 * (1.0 + j.amax()));
            for (ours, theirs) in ours.into_iter().zip(theirs) {
                close(ours, theirs, 1e-9 * (1.0 + theirs.abs() + size));
            }
        }
        // Whichever way a position is come by, it is the same to the bit.
        let at = |index: usize| {
            let q = &$course.positions[index];
            format!("{:?}", $mechanism.assemble(q.$input, $mechanism.branch_of(&$mechanism.pose_at(q))))
        };
        let in_order: Vec<String> = (0..$course.positions.len()).map(at).collect();
        for step in [36, 170] {
            for index in (0..in_order.len()).map(|count| count * step % in_order.len()) {
                assert_eq!(at(index), in_order[index]);
            }
        }
    };
}

/// Every position of a course from the one before it, group by group where a group has no closed form: the same
/// position, its loops closed to rounding.
macro_rules! from_the_last {
    ($mechanism:ident, $course:ident, $input:ident) => {
        for pair in $course.positions.windows(2) {
            let (mut guess, expected) = (pair[0], $mechanism.pose_at(&pair[1]));
            guess.$input = pair[1].$input;
            let found = $mechanism.assemble_near(&guess, $mechanism.branch_of(&expected)).expect("a position");
            let size = $mechanism.closure_sizes(&found).sum();
            exact($mechanism.residual(&found).amax(), 0.0, size);
            let (j, other) = ($mechanism.jacobian_unknowns(&found), $mechanism.jacobian_unknowns(&expected));
            close((j - other).amax(), 0.0, 1e-12 * (1.0 + j.amax()));
        }
    };
}

/// Where the input stands in a position.
type Input<M, const U: usize> = fn(&mut <M as Mechanism<f64, U, 1>>::Coordinates) -> &mut f64;

/// A mechanism followed from a start, and its positions on the way.
struct Course<'a, M: Mechanism<f64, U, 1>, const U: usize> {
    mechanism: &'a M,
    input: Input<M, U>,
    positions: Vec<M::Coordinates>,
}

/// Follows a mechanism while its input goes from that of `start` by `span`, each position found by Newton's
/// method from what the velocity ratios at the last one predict.
#[track_caller]
fn follow<'a, M: Mechanism<f64, U, 1>, const U: usize>(
    mechanism: &'a M,
    start: M::Coordinates,
    input: Input<M, U>,
    span: f64,
) -> Course<'a, M, U> {
    let mut course = Course { mechanism, input, positions: Vec::new() };
    let mut q = start;
    let from = *input(&mut q);
    for step in 0..=STEPS {
        let to = from + span * f64::from(step) / f64::from(STEPS);
        q = course.assemble(course.predict(q, to));
        course.positions.push(q);
    }
    course
}

/// A full turn, after which the mechanism stands as it stood at the start, never having left its branch.
#[track_caller]
fn turn<'a, M: Mechanism<f64, U, 1>, const U: usize>(
    mechanism: &'a M,
    start: M::Coordinates,
    input: Input<M, U>,
) -> Course<'a, M, U> {
    let course = follow(mechanism, start, input, TAU);
    let first = mechanism.pose_at(&course.positions[0]);
    for q in &course.positions {
        assert!(mechanism.same_branch(&first, &mechanism.pose_at(q)), "{} changed its branch", M::NAME);
    }
    let difference = M::unknowns(&course.positions[STEPS as usize]) - M::unknowns(&course.positions[0]);
    for change in difference.iter() {
        // An angle may have made turns of its own.
        close(*change, (change / TAU).round() * TAU, 1e-12);
    }
    course
}

impl<M: Mechanism<f64, U, 1>, const U: usize> Course<'_, M, U> {
    /// Straight on from a position to another input: u + W (to - v).
    #[track_caller]
    fn predict(&self, mut q: M::Coordinates, to: f64) -> M::Coordinates {
        let step = to - *(self.input)(&mut q);
        let mut guess = q;
        if step != 0.0 {
            let pose = self.mechanism.pose_at(&q);
            let a = self.mechanism.jacobian_inputs(&pose).column(0).into_owned();
            let ratios = -self.mechanism.solve_jacobian(&pose, &a).expect("a regular position");
            guess = M::with_unknowns(&q, M::unknowns(&q) + ratios * step);
        }
        *(self.input)(&mut guess) = to;
        guess
    }

    #[track_caller]
    fn assemble(&self, guess: M::Coordinates) -> M::Coordinates {
        let solution = match position::newton(self.mechanism, &guess) {
            Ok(solution) => solution,
            Err(error) => panic!("at {:.3}: {error}", *(self.input)(&mut { guess })),
        };
        assert!(solution.same_branch, "{} at {:.3} changed its branch", M::NAME, *(self.input)(&mut { guess }));
        let pose = self.mechanism.pose_at(&solution.coordinates);
        let sizes = self.mechanism.closure_sizes(&pose);
        for (residual, size) in self.mechanism.residual(&pose).iter().zip(sizes.iter()) {
            exact(*residual, 0.0, *size);
        }
        solution.coordinates
    }

    /// The position at an input on the way.
    #[track_caller]
    fn at(&self, input: f64) -> M::Coordinates {
        let distance = |q: &M::Coordinates| (*(self.input)(&mut { *q }) - input).abs();
        let nearest = self.positions.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("positions");
        self.assemble(self.predict(*nearest, input))
    }

    /// The inputs between which `value` changes its sign, each made a point by bisection.
    fn roots(&self, value: impl Fn(&M::Coordinates) -> f64) -> Vec<f64> {
        let mut roots = Vec::new();
        for pair in self.positions.windows(2) {
            let [mut low, mut high] = [0, 1].map(|index: usize| *(self.input)(&mut { pair[index] }));
            let sign = value(&pair[0]).is_sign_positive();
            if sign == value(&pair[1]).is_sign_positive() {
                continue;
            }
            for _ in 0..60 {
                let middle = (low + high) / 2.0;
                if value(&self.at(middle)).is_sign_positive() == sign {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            roots.push((low + high) / 2.0);
        }
        roots
    }

    /// The least and the largest `value` on the way, by golden section about the least and largest sample.
    fn range(&self, value: impl Fn(&M::Coordinates) -> f64) -> [f64; 2] {
        [-1.0, 1.0].map(|sign| {
            let height = |q: &M::Coordinates| sign * value(q);
            let index = (0..self.positions.len())
                .max_by(|&a, &b| height(&self.positions[a]).total_cmp(&height(&self.positions[b])))
                .expect("positions");
            let input = |index: usize| *(self.input)(&mut { self.positions[index] });
            let mut low = input(index.saturating_sub(1));
            let mut high = input((index + 1).min(self.positions.len() - 1));
            for _ in 0..60 {
                let [left, right] = [0.618, 0.382].map(|part| high - part * (high - low));
                if height(&self.at(left)) > height(&self.at(right)) {
                    high = right;
                } else {
                    low = left;
                }
            }
            value(&self.at((low + high) / 2.0))
        })
    }
}

/// Distances of named points that stay what they are through all positions.
macro_rules! rigid {
    ($course:expr, $($p:ident - $q:ident = $length:expr),+ $(,)?) => {
        let size: f64 = [$($length),+].iter().sum();
        for q in &$course.positions {
            let points = $course.mechanism.points(&$course.mechanism.pose_at(q)).unwrap();
            $(exact((points.$p - points.$q).norm(), $length, size);)+
        }
    };
}

/// A point, or one of its coordinates, at a position.
macro_rules! point {
    ($mechanism:expr, $point:ident $(, $axis:ident)?) => {
        |q: &_| $mechanism.points(&$mechanism.pose_at(q)).unwrap().$point$(.$axis)?
    };
}

/// The groups of unknowns in the order in which they are solved: dyads where an engineer sees dyads, a slider on
/// a line along an axis by itself, and what cannot be taken apart whole.
#[test]
fn assur_groups() {
    let groups: [(&str, &str); 32] = [
        ("andrews", "Rrr Rrr Rrr"),
        ("cam_follower", "Linear"),
        ("cam_rocker", "Linear Rrr"),
        ("cardan", "Linear"),
        ("chebyshev", "Rrr"),
        ("coupled_wheels", "Rrr"),
        ("crank_shaper", "Rpr Angle Linear"),
        ("double_butterfly", "Irreducible(6)"),
        ("elliptic_trammel", "Linear Linear"),
        ("five_bar", "Rrr"),
        ("four_bar", "Rrr"),
        ("geared_five_bar", "Linear Rrr"),
        ("geneva", "Rpr"),
        ("hart", "Rrr Rrr"),
        ("hoecken", "Rrr"),
        ("inverted_slider_crank", "Rpr"),
        ("jansen", "Rrr Rrr Rrr Rrr Rrr"),
        ("klann", "Rrr Rrr"),
        ("offset_slider_crank", "Angle Linear"),
        ("pantograph", "Rrr Rrr"),
        ("peaucellier", "Rrr Rrr Rrr"),
        ("roberts", "Rrr"),
        ("scotch_yoke", "Linear"),
        ("stephenson_i", "Rrr Rrr"),
        ("stephenson_ii", "Irreducible(4)"),
        ("stephenson_iii", "Rrr Rrr"),
        ("v_twin", "Rrp Rrp"),
        ("watt_i", "Rrr Rrr"),
        ("watt_ii", "Rrr Rrr"),
        ("watt_line", "Rrr"),
        ("whitworth", "Rpr Angle Linear"),
        ("wiper", "Rrr Rrr"),
    ];
    for (file, expected) in groups {
        let mechanism = linkage_compiler::read(source::tokens_of(file)).expect(file).remove(0);
        let derivation = linkage_compiler::derive(&mechanism).remove(0);
        let found: Vec<String> = derivation.blocks.iter().map(|block| format!("{:?}", block.group)).collect();
        assert_eq!(found.join(" "), expected, "{file}");
    }
}

#[test]
fn four_bar_on_both_branches() {
    let m = FourBar::default();
    for (theta3, theta4, side) in [(70.0, -50.0, 1.0), (-83.0, 38.0, -1.0)] {
        let start = FourBarCoordinates { theta2: degrees(20.0), theta3: degrees(theta3), theta4: degrees(theta4) };
        let course = turn(&m, start, |q| &mut q.theta2);
        closed_form!(m, course, theta2);
        rigid!(course, b - c = m.l3, b - g3 = m.l3 / 2.0, c - g4 = m.l4 / 2.0);
        // On one branch C is always above the line from B to D, on the other below it.
        assert!(course.positions.iter().all(|q| side * m.outputs(&m.pose_at(q)).unwrap().mu.sin() > 0.0));
        for q in &course.positions {
            let points = m.points(&m.pose_at(q)).unwrap();
            exact((points.c - nalgebra::vector![m.l1, 0.0]).norm(), m.l4, m.l1 + m.l2 + m.l3 + m.l4);
        }
    }
}

/// Peak velocity and acceleration of the 3-4-5 polynomial are 1.875 h / beta and 5.7735 h / beta^2, those of
/// cycloidal motion 2 h / beta and 2 pi h / beta^2: R. L. Norton, *Design of Machinery*, chapter 8, factors for peak
/// velocity and acceleration.
#[test]
fn cams_reach_their_published_peaks() {
    let m = CamFollower::default();
    let course = turn(&m, CamFollowerCoordinates { theta: 0.0, s: 0.0 }, |q| &mut q.theta);
    let velocity = course.range(|q| m.velocity(&m.pose_at(q), 1.0).unwrap().s);
    let acceleration = course.range(|q| m.motion(q, 1.0, 0.0).unwrap().acceleration.s);
    for (sign, velocity, acceleration) in [(-1.0, velocity[0], acceleration[0]), (1.0, velocity[1], acceleration[1])] {
        close(velocity * m.rise / m.height, sign * 1.875, 1e-14);
        close(acceleration * m.rise.powi(2) / m.height, sign * 10.0 / 3.0_f64.sqrt(), 1e-12);
        close(acceleration * m.rise.powi(2) / m.height, sign * 5.7735, 5e-5);
    }
    let m = CamRocker::default();
    let start = CamRockerCoordinates { theta: 0.0, psi: degrees(75.0), phi: 0.2, beta: degrees(100.0) };
    let course = turn(&m, start, |q| &mut q.theta);
    let velocity = course.range(|q| m.velocity(&m.pose_at(q), 1.0).unwrap().psi);
    let acceleration = course.range(|q| m.motion(q, 1.0, 0.0).unwrap().acceleration.psi);
    for (sign, velocity, acceleration) in [(-1.0, velocity[0], acceleration[0]), (1.0, velocity[1], acceleration[1])] {
        close(velocity * m.rise / m.swing, sign * 2.0, 1e-14);
        close(acceleration * m.rise.powi(2) / m.swing, sign * TAU, 1e-12);
    }
}

/// The pressure angle is that between the path of the follower and the line from the contact to the roller's axis;
/// the profile touches the roller where it is, at right angles to that line.
#[test]
fn cam_follower() {
    let m = CamFollower::default();
    let course = turn(&m, CamFollowerCoordinates { theta: 0.0, s: 0.0 }, |q| &mut q.theta);
    closed_form!(m, course, theta);
    rigid!(course, roller - contact = m.roller, pitch - profile = m.roller);
    let size = m.prime + m.roller + m.height;
    for q in &course.positions {
        let motion = m.motion(q, 1.0, 0.0).unwrap();
        let points = motion.points;
        exact(points.roller.position.x, m.offset, size);
        exact(points.pitch.position.norm(), points.roller.position.norm(), size);
        let normal = points.roller.position - points.contact.position;
        exact(motion.outputs.pressure.value.tan() * normal.y, -normal.x, size);
        let along = (points.pitch.position - points.profile.position) / m.roller;
        exact(along.dot(&points.profile.velocity), 0.0, size);
        // The point of the cam under the roller moves along the tangent beside the roller's axis.
        let contact = points.contact.position;
        let sliding = points.roller.velocity - nalgebra::vector![-contact.y, contact.x];
        exact(normal.dot(&sliding) / m.roller, 0.0, size);
    }
    let [least, largest] = course.range(|q| q.s);
    exact(least, 0.0, size);
    exact(largest, m.height, size);
    // In the lower dwell the pitch curve is the prime circle, in the upper one a larger circle.
    let foot = (m.prime.powi(2) - m.offset.powi(2)).sqrt();
    for (theta, radius) in
        [(2.2, m.offset.hypot(foot + m.height)), (3.0, m.offset.hypot(foot + m.height)), (5.9, m.prime)]
    {
        let pose = m.pose_at(&course.at(theta));
        exact(m.points(&pose).unwrap().pitch.norm(), radius, size);
    }
}

#[test]
fn cam_rocker() {
    let m = CamRocker::default();
    let start = CamRockerCoordinates { theta: 0.0, psi: degrees(75.0), phi: 0.2, beta: degrees(100.0) };
    let course = turn(&m, start, |q| &mut q.theta);
    closed_form!(m, course, theta);
    rigid!(course, a - b = m.rod, b - c = m.rocker);
    let [least, largest] = course.range(|q| q.psi);
    exact(least, m.rest, PI);
    exact(largest, m.rest + m.swing, PI);
    let size = m.distance + m.lever;
    for q in &course.positions {
        let points = m.points(&m.pose_at(q)).unwrap();
        let from_axis = points.roller + nalgebra::vector![m.distance, 0.0];
        exact(points.pitch.norm(), from_axis.norm(), size);
    }
    // The rocker rests while the follower does.
    for theta in [2.2, 3.0, 5.4, 6.0] {
        let velocity = m.velocity(&m.pose_at(&course.at(theta)), 1.0).unwrap();
        assert_eq!([velocity.psi, velocity.phi, velocity.beta], [0.0; 3]);
    }
}

#[test]
fn offset_slider_crank() {
    let m = OffsetSliderCrank::default();
    let start = OffsetSliderCrankCoordinates { theta2: degrees(60.0), theta3: degrees(153.0), d: 127.0 };
    let course = turn(&m, start, |q| &mut q.theta2);
    closed_form!(m, course, theta2);
    rigid!(course, o - a = m.a, a - b = m.b);
    // Crank and rod in line at both ends of the stroke.
    let [least, largest] = course.range(|q| q.d);
    exact(least, ((m.b - m.a).powi(2) - m.c * m.c).sqrt(), m.a + m.b);
    exact(largest, ((m.b + m.a).powi(2) - m.c * m.c).sqrt(), m.a + m.b);
}

#[test]
fn inverted_slider_crank() {
    let m = InvertedSliderCrank::default();
    let start = InvertedSliderCrankCoordinates { theta2: 0.0, theta4: degrees(109.5), b: 56.6 };
    let course = turn(&m, start, |q| &mut q.theta2);
    closed_form!(m, course, theta2);
    rigid!(course, o - a = m.a, d - b = m.c);
    for q in &course.positions {
        let points = m.points(&m.pose_at(q)).unwrap();
        // The slide stands at gamma, here a right angle, to its foot.
        exact((points.a - points.d).norm(), q.b.hypot(m.c), m.a + m.d + q.b);
    }
    let [least, largest] = course.range(|q| q.b);
    exact(least, ((m.d - m.a).powi(2) - m.c * m.c).sqrt(), m.d + m.a);
    exact(largest, ((m.d + m.a).powi(2) - m.c * m.c).sqrt(), m.d + m.a);
}

/// The ram turns back where the slotted arm lies on its line: there the crank's pin is `offset` below the
/// crank's pivot.
#[test]
fn whitworth_returns_faster() {
    let m = Whitworth::default();
    let start = WhitworthCoordinates { theta: FRAC_PI_2, psi: FRAC_PI_2, s: 80.0, phi: degrees(17.5), x: 191.0 };
    let course = turn(&m, start, |q| &mut q.theta);
    closed_form!(m, course, theta);
    rigid!(course, o - c = m.offset, o - pin = m.crank, c - e = m.arm, e - ram = m.rod);
    let dip = (m.offset / m.crank).asin();
    let velocity = |q: &WhitworthCoordinates| m.velocity(&m.pose_at(q), 1.0).unwrap().x;
    let [first, second] = course.roots(velocity)[..] else { panic!("two dead centres") };
    close(first, PI + dip, 1e-13);
    close(second, TAU - dip, 1e-13);
    let back = second - first;
    close((TAU - back) / back, (PI + 2.0 * dip) / (PI - 2.0 * dip), 1e-12);
    let [least, largest] = course.range(|q| q.x);
    exact(largest - least, 2.0 * m.arm, m.arm + m.rod);
    // The slotted arm turns all the way round.
    close(course.positions[STEPS as usize].psi - course.positions[0].psi, TAU, 1e-13);
}

/// The ram turns back with the lever, where the crank stands square to it.
#[test]
fn crank_shaper_returns_faster() {
    let m = CrankShaper::default();
    let start = CrankShaperCoordinates { theta: FRAC_PI_2, psi: FRAC_PI_2, s: 170.0, phi: degrees(-8.0), x: 99.0 };
    let course = turn(&m, start, |q| &mut q.theta);
    closed_form!(m, course, theta);
    rigid!(course, o - c = m.offset, o - pin = m.crank, c - e = m.lever, e - ram = m.rod);
    let swing = (m.crank / m.offset).asin();
    let velocity = |q: &CrankShaperCoordinates| m.velocity(&m.pose_at(q), 1.0).unwrap().x;
    let [first, second] = course.roots(velocity)[..] else { panic!("two dead centres") };
    close(first, PI + swing, 1e-13);
    close(second, TAU - swing, 1e-13);
    let back = second - first;
    close((TAU - back) / back, (PI + 2.0 * swing) / (PI - 2.0 * swing), 1e-12);
    let [least, largest] = course.range(|q| q.x);
    exact(largest - least, 2.0 * m.lever * m.crank / m.offset, m.lever + m.rod);
    let [least, largest] = course.range(|q| q.psi);
    close((largest - least) / 2.0, swing, 1e-14);
}

#[test]
fn watt_i() {
    let m = WattI::default();
    let start = WattICoordinates {
        theta2: FRAC_PI_2,
        theta3: degrees(31.4),
        theta4: degrees(109.7),
        theta5: degrees(79.0),
        theta6: degrees(132.3),
    };
    let course = turn(&m, start, |q| &mut q.theta2);
    closed_form!(m, course, theta2);
    let (bp, dq) = (m.px.hypot(m.py), m.qx.hypot(m.qy));
    let (cp, cq) = ((m.b - m.px).hypot(m.py), (m.c - m.qx).hypot(m.qy));
    rigid!(
        course,
        a - d = m.d,
        a - b = m.a,
        b - c = m.b,
        c - d = m.c,
        b - p = bp,
        c - p = cp,
        d - q = dq,
        c - q = cq,
        p - r = m.e,
        r - q = m.f
    );
}

#[test]
fn watt_ii() {
    let m = WattII::default();
    let start = WattIICoordinates {
        theta2: FRAC_PI_2,
        theta3: degrees(31.4),
        theta4: degrees(109.7),
        theta5: degrees(0.5),
        theta6: degrees(93.3),
    };
    let course = turn(&m, start, |q| &mut q.theta2);
    closed_form!(m, course, theta2);
    let cp = (m.c * m.c + m.e * m.e - 2.0 * m.c * m.e * m.delta.cos()).sqrt();
    rigid!(
        course,
        a - b = m.a,
        b - c = m.b,
        c - d = m.c,
        a - d = m.d,
        d - p = m.e,
        c - p = cp,
        p - q = m.f,
        q - f = m.g
    );
}

#[test]
fn stephenson_i() {
    let m = StephensonI::default();
    let start = StephensonICoordinates {
        theta2: FRAC_PI_2,
        theta3: degrees(31.4),
        theta4: degrees(109.7),
        theta5: degrees(60.0),
        theta6: degrees(151.0),
    };
    let course = turn(&m, start, |q| &mut q.theta2);
    closed_form!(m, course, theta2);
    let (ap, bp) = (m.px.hypot(m.py), (m.a - m.px).hypot(m.py));
    let (dq, cq) = (m.qx.hypot(m.qy), (m.c - m.qx).hypot(m.qy));
    rigid!(
        course,
        a - b = m.a,
        b - c = m.b,
        c - d = m.c,
        a - d = m.d,
        a - p = ap,
        b - p = bp,
        d - q = dq,
        c - q = cq,
        p - r = m.e,
        r - q = m.f
    );
}

#[test]
fn stephenson_ii() {
    let m = StephensonII::default();
    let start = StephensonIICoordinates {
        theta: 0.0,
        alpha: degrees(30.0),
        beta: degrees(21.0),
        tau: degrees(-90.0),
        rho: degrees(54.0),
    };
    let course = turn(&m, start, |q| &mut q.theta);
    from_the_last!(m, course, theta);
    let (ab, ce, de) = ((m.a - m.bx).hypot(m.by), m.ex.hypot(m.ey), (m.cd - m.ex).hypot(m.ey));
    rigid!(
        course,
        o - a = m.a,
        a - b = ab,
        a - c = m.p,
        b - d = m.q,
        c - d = m.cd,
        c - e = ce,
        d - e = de,
        e - g = m.r
    );
}

#[test]
fn stephenson_iii() {
    let m = StephensonIII::default();
    let start = StephensonIIICoordinates {
        theta2: FRAC_PI_2,
        theta3: degrees(31.4),
        theta4: degrees(109.7),
        theta5: degrees(-0.6),
        theta6: degrees(99.4),
    };
    let course = turn(&m, start, |q| &mut q.theta2);
    closed_form!(m, course, theta2);
    let (bp, cp) = (m.px.hypot(m.py), (m.b - m.px).hypot(m.py));
    rigid!(
        course,
        a - b = m.a,
        b - c = m.b,
        c - d = m.c,
        a - d = m.d,
        b - p = bp,
        c - p = cp,
        p - q = m.e,
        q - f = m.f
    );
}

#[test]
fn double_butterfly() {
    let m = DoubleButterfly::default();
    let start = DoubleButterflyCoordinates {
        crank: 1.036,
        coupler: 1.0,
        upper: -0.595,
        rocker: 1.408,
        lower: 0.508,
        link: -0.004,
        strut: 1.591,
    };
    let course = turn(&m, start, |q| &mut q.crank);
    from_the_last!(m, course, crank);
    let (ad, cd) = (m.dx.hypot(m.dy), (m.ac - m.dx).hypot(m.dy));
    let (eg, fg) = (m.gx.hypot(m.gy), (m.ef - m.gx).hypot(m.gy));
    let (bj, fj) = (m.jx.hypot(m.jy), (m.bf - m.jx).hypot(m.jy));
    let (di, hi) = (m.ix.hypot(m.iy), (m.dh - m.ix).hypot(m.iy));
    rigid!(
        course,
        a - b = m.ab,
        a - c = m.ac,
        a - d = ad,
        c - d = cd,
        c - e = m.ce,
        e - f = m.ef,
        e - g = eg,
        f - g = fg,
        b - f = m.bf,
        b - j = bj,
        f - j = fj,
        d - h = m.dh,
        d - i = di,
        h - i = hi,
        g - h = m.gh,
        i - j = m.ij
    );
}

fn jansen_start() -> JansenCoordinates<f64> {
    JansenCoordinates {
        crank: 0.0,
        angle_b: degrees(70.3),
        angle_j: degrees(141.3),
        angle_d: degrees(156.6),
        angle_e: degrees(-155.4),
        angle_c: degrees(-73.7),
        angle_k: degrees(-132.7),
        angle_f: degrees(-67.0),
        angle_g: degrees(151.9),
        angle_h: degrees(-75.7),
        angle_i: degrees(-109.3),
    }
}

/// Foot positions, ranges and the share of the turn on the ground, from circles that intersect, in 40-digit
/// arithmetic.
#[test]
fn jansen_walks() {
    let m = Jansen::default();
    let course = turn(&m, jansen_start(), |q| &mut q.crank);
    closed_form!(m, course, crank);
    rigid!(
        course,
        o - pin = m.m,
        pin - upper = m.j,
        pivot - upper = m.b,
        upper - back = m.e,
        pivot - back = m.d,
        pin - knee = m.k,
        pivot - knee = m.c,
        back - ankle = m.f,
        knee - ankle = m.g,
        ankle - foot = m.h,
        knee - foot = m.i
    );
    let foot = point!(m, foot);
    let size = [m.a, m.b, m.c, m.d, m.e, m.f, m.g, m.h, m.i, m.j, m.k, m.l, m.m].iter().sum();
    for (angle, [x, y]) in [
        (0.0, [-43.160_110_524_104_72, -91.756_932_926_123_22]),
        (45.0, [-24.398_517_179_300_76, -91.790_903_870_552_77]),
    ] {
        let found = foot(&course.at(degrees(angle)));
        exact(found.x, x, size);
        exact(found.y, y, size);
    }
    let [left, right] = course.range(point!(m, foot, x));
    exact(right - left, 67.908_421_691_508_24, size);
    let [bottom, top] = course.range(point!(m, foot, y));
    exact(top - bottom, 22.457_173_584_316_21, size);
    // The foot is within 1 of the lowest point from one crossing, through 0, to the other.
    let [lifts, lands] = course.roots(|q| foot(q).y - (bottom + 1.0))[..] else { panic!("two crossings") };
    close(lifts, degrees(81.187_870_798_704_8), 1e-12);
    close(lands, degrees(286.012_419_030_292), 1e-12);
    close(1.0 - (lands - lifts) / TAU, 0.431_042_921_579, 1e-12);
}

/// The reference pose of the patent's table 1, to its digits: foot (0, 0), knee (.232, .866), hip (.866, 1.5).
/// The step by intersecting circles in 40-digit arithmetic; Klann's own page gives its height as 52.3 % of the
/// stride.
#[test]
fn klann_walks() {
    let m = Klann::default();
    let start = KlannCoordinates {
        theta: PI,
        arm: PI,
        lower_angle: degrees(146.7),
        leg: degrees(45.0),
        upper_angle: degrees(165.0),
    };
    let course = turn(&m, start, |q| &mut q.theta);
    closed_form!(m, course, theta);
    // The third side of a triangle, by the law of cosines.
    let third = |a: f64, b: f64, angle: f64| (a * a + b * b - 2.0 * a * b * angle.cos()).sqrt();
    rigid!(
        course,
        o - pin = m.crank,
        pin - elbow = m.pin_elbow,
        elbow - knee = m.elbow_knee,
        pin - knee = third(m.pin_elbow, m.elbow_knee, PI + m.elbow_bend),
        lower - elbow = m.lower,
        knee - hip = m.knee_hip,
        knee - foot = m.knee_foot,
        foot - hip = third(m.knee_hip, m.knee_foot, m.knee_bend),
        upper - hip = m.upper
    );
    close(third(m.pin_elbow, m.elbow_knee, PI + m.elbow_bend), 1.1051, 5e-5);
    close(third(m.knee_hip, m.knee_foot, m.knee_bend), 1.732, 5e-4);
    let points = m.points(&m.pose_at(&course.positions[0])).unwrap();
    for (found, expected) in [(points.foot, [0.0, 0.0]), (points.knee, [0.232, 0.866]), (points.hip, [0.866, 1.5])] {
        close(found.x, expected[0], 5e-4);
        close(found.y, expected[1], 5e-4);
    }
    let size = m.crank + m.lower + m.upper + m.pin_elbow + m.elbow_knee + m.knee_hip + m.knee_foot;
    let [left, right] = course.range(point!(m, foot, x));
    let [bottom, top] = course.range(point!(m, foot, y));
    exact(right - left, 1.008_627_899_360_890_7, size);
    exact(top - bottom, 0.527_549_050_784_531_3, size);
    close((top - bottom) / (right - left), 0.523, 5e-4);
}

/// How far Hoecken's and Chebyshev's lines rise, in cranks of Hoecken: from intersecting circles in 40-digit
/// arithmetic.
const RISE: f64 = 0.009_753_733_086_360_006;

#[test]
fn hoecken_is_nearly_straight() {
    let m = Hoecken::default();
    let start = HoeckenCoordinates { theta2: FRAC_PI_2, theta3: degrees(20.0), theta4: degrees(130.0) };
    let course = turn(&m, start, |q| &mut q.theta2);
    closed_form!(m, course, theta2);
    rigid!(
        course,
        a - d = m.ground,
        a - b = m.crank,
        b - c = m.coupler,
        c - d = m.rocker,
        b - p = m.reach,
        c - p = m.reach - m.coupler
    );
    let size = m.crank + m.ground + m.coupler + m.rocker + m.reach;
    let half = follow(&m, course.positions[0], |q| &mut q.theta2, PI);
    let [low, high] = half.range(point!(m, p, y));
    exact(low, 4.0, size);
    exact(high - low, RISE, size);
    let x = point!(m, p, x);
    exact(x(&half.positions[0]) - x(&half.positions[STEPS as usize]), 4.0, size);
}

/// Between the middle of the ground link and its ends the line rises and comes back; it does so exactly as
/// Hoecken's, which is the same curve (the theorem of Roberts and Chebyshev on cognates).
#[test]
fn chebyshev_is_nearly_straight() {
    let m = ChebyshevCoupler::default();
    let start = ChebyshevCoordinates { theta2: 4.0_f64.atan2(3.0), theta3: PI, theta4: 4.0_f64.atan2(-3.0) };
    let course = turn(&m, start, |q| &mut q.theta3);
    closed_form!(m, course, theta3);
    rigid!(
        course,
        a - d = m.ground,
        a - b = m.rocker,
        c - d = m.rocker,
        b - p = m.coupler / 2.0,
        c - p = m.coupler / 2.0
    );
    let size = m.ground + 2.0 * m.rocker + m.coupler;
    let p = point!(m, p);
    for (span, x) in [(FRAC_PI_2, 0.0), (-FRAC_PI_2, 4.0)] {
        let course = follow(&m, start, |q| &mut q.theta3, span);
        closed_form!(m, course, theta3);
        let end = p(&course.positions[STEPS as usize]);
        exact(end.x, x, size);
        exact(end.y, 4.0, size);
        let [low, high] = course.range(point!(m, p, y));
        exact(low, 4.0, size);
        exact(high - low, RISE, size);
        // A quarter of the ground link from the middle.
        let [quarter] = course.roots(|q| p(q).x - (x + 2.0) / 2.0)[..] else { panic!("one crossing") };
        exact(p(&course.at(quarter)).y, 4.009_047_910_620_066, size);
    }
    // The rocker drives the same stretch: from y = 4 to y = 4.
    let m = ChebyshevRocker::default();
    let course = follow(&m, start, |q| &mut q.theta2, degrees(36.0) - start.theta2 + degrees(1.0));
    closed_form!(m, course, theta2);
    exact(course.range(point!(m, p, y))[1] - 4.0, RISE, size);
}

/// The apex passes through both pivots and the middle between them; the largest deviation from intersecting
/// circles in 40-digit arithmetic.
#[test]
fn roberts_is_nearly_straight() {
    let m = Roberts::default();
    // Where the apex is on the first pivot, C hangs above the middle, and B one apex angle further.
    let end = (1.0 / m.side).acos();
    let first = end + 2.0 * (m.coupler / 2.0 / m.side).asin();
    let start = RobertsCoordinates { theta2: first, theta3: degrees(-27.6), theta4: PI - end };
    let course = follow(&m, start, |q| &mut q.theta2, end - first);
    closed_form!(m, course, theta2);
    rigid!(course, a - d = m.ground, a - b = m.side, b - c = m.coupler, c - d = m.side, b - p = m.side, c - p = m.side);
    let size = m.ground + 4.0 * m.side + m.coupler;
    let p = point!(m, p);
    for (theta2, x) in [(first, 0.0), (m.height.atan2(m.coupler / 2.0), 1.0), (end, 2.0)] {
        let found = p(&course.at(theta2));
        exact(found.x, x, size);
        exact(found.y, 0.0, size);
    }
    let [low, high] = course.range(point!(m, p, y));
    exact(low, -0.009_943_170_941_156_022, size);
    exact(high, 0.0, size);
}

/// x = y^5 / (8 arm^3 half_link) near the middle; the ends of the stroke from intersecting circles in 40-digit
/// arithmetic.
#[test]
fn watt_line_touches_fivefold() {
    let m = WattLine::default();
    let start = WattLineCoordinates { theta: degrees(-20.0), phi: -FRAC_PI_2, psi: degrees(-160.0) };
    let course = follow(&m, start, |q| &mut q.theta, degrees(40.0));
    closed_form!(m, course, theta);
    rigid!(
        course,
        left - b = m.arm,
        b - c = 2.0 * m.half_link,
        c - right = m.arm,
        b - p = m.half_link,
        c - p = m.half_link
    );
    let size = 4.0 * m.arm + 4.0 * m.half_link;
    let p = point!(m, p);
    for (theta, [x, y]) in [
        (20.0, [0.020_015_353_302_028_83, 1.763_208_879_656_721]),
        (-20.0, [-0.014_855_361_898_719_738, -1.668_126_654_672_266_6]),
    ] {
        let found = p(&course.at(degrees(theta)));
        exact(found.x, x, size);
        exact(found.y, y, size);
    }
    for theta in [0.02, 0.04, 0.08] {
        let found = p(&course.at(theta));
        let ratio = found.x * 8.0 * m.arm.powi(3) * m.half_link / found.y.powi(5);
        // The next term of the series is theta^2.
        close((ratio - 1.0) / (theta * theta), 1.0, 0.02);
    }
}

#[test]
fn peaucellier_is_straight() {
    let m = Peaucellier::default();
    let (arm, side) = (degrees(34.9), degrees(72.5));
    let start = PeaucellierCoordinates {
        theta: 0.0,
        upper: arm,
        upper_side: side,
        lower: -arm,
        lower_side: -side,
        upper_tip: -side,
        lower_tip: side,
    };
    let size = 2.0 * m.crank + 2.0 * m.long + 4.0 * m.short;
    let line = (m.long * m.long - m.short * m.short) / (2.0 * m.crank);
    for span in [degrees(90.0), degrees(-90.0)] {
        let course = follow(&m, start, |q| &mut q.theta, span);
        closed_form!(m, course, theta);
        rigid!(
            course,
            o - centre = m.crank,
            centre - p = m.crank,
            o - upper = m.long,
            o - lower = m.long,
            p - upper = m.short,
            p - lower = m.short,
            q - upper = m.short,
            q - lower = m.short
        );
        for q in &course.positions {
            let motion = m.motion(q, 1.0, 0.0).unwrap();
            let tip = motion.points.q;
            exact(tip.position.x, line, size);
            let rates = nalgebra::SVector::from(motion.velocity).amax();
            let accelerations = nalgebra::SVector::from(motion.acceleration).amax();
            exact(tip.velocity.x, 0.0, size * rates);
            exact(tip.acceleration.x, 0.0, size * (rates * rates + accelerations));
            // P and Q are inverse.
            exact(motion.outputs.product.value, m.long * m.long - m.short * m.short, size);
        }
        assert!(course.range(point!(m, q, y)).into_iter().any(|y| y.abs() > 4.9));
    }
}

#[test]
fn hart_is_straight() {
    let m = Hart::default();
    let (long, short) = (degrees(145.1), degrees(107.5));
    let start = HartCoordinates { theta: 0.0, alpha: -long, beta: -short, gamma: short, delta: long };
    let size = 2.0 * (m.crank + m.long + m.short);
    let product = -m.part * (1.0 - m.part) * (m.long * m.long - m.short * m.short);
    for span in [degrees(90.0), degrees(-90.0)] {
        let course = follow(&m, start, |q| &mut q.theta, span);
        closed_form!(m, course, theta);
        rigid!(
            course,
            o - centre = m.crank,
            centre - p = m.crank,
            a - b = m.long,
            c - d = m.long,
            b - c = m.short,
            d - a = m.short,
            a - o = m.part * m.long,
            a - p = m.part * m.short,
            c - q = m.part * m.short
        );
        for q in &course.positions {
            let motion = m.motion(q, 1.0, 0.0).unwrap();
            let rates = nalgebra::SVector::from(motion.velocity).amax();
            let accelerations = nalgebra::SVector::from(motion.acceleration).amax();
            let tip = motion.points.q;
            exact(motion.outputs.product.value, product, size);
            exact(tip.position.x, product / (2.0 * m.crank), size);
            exact(tip.velocity.x, 0.0, size * rates);
            exact(tip.acceleration.x, 0.0, size * (rates * rates + accelerations));
        }
    }
}

/// The wheel starts and stops without a jolt, and turns by one slot.
#[test]
fn geneva_turns_one_slot() {
    let m = Geneva::default();
    let engaged = FRAC_PI_2 - PI / m.slots;
    let start = GenevaCoordinates { theta: -engaged, psi: PI / m.slots, s: m.crank };
    let course = follow(&m, start, |q| &mut q.theta, 2.0 * engaged);
    closed_form!(m, course, theta);
    rigid!(course, o - pin = m.crank, o - wheel = m.crank / (PI / m.slots).sin());
    let [first, middle, last] = [0, 180, 360].map(|step: usize| &course.positions[step]);
    close(last.psi - first.psi, -TAU / m.slots, 1e-15);
    for end in [first, last] {
        let motion = m.motion(end, 1.0, 0.0).unwrap();
        close(motion.velocity.psi, 0.0, 1e-15);
        exact(motion.outputs.depth.value, 0.0, m.crank);
        // Not without a jerk: omega^2 tan(pi / slots).
        close(motion.acceleration.psi.abs(), (PI / m.slots).tan(), 1e-14);
    }
    // Fastest in the middle: omega sin / (1 - sin) of half a slot.
    let half = (PI / m.slots).sin();
    close(m.velocity(&m.pose_at(middle), 1.0).unwrap().psi, -half / (1.0 - half), 1e-14);
}

/// The pen draws what the tracer draws, `ratio` times as large.
#[test]
fn pantograph_copies() {
    let m = Pantograph::default();
    let size = (m.a + m.b) * m.ratio;
    let mut q = PantographCoordinates { x: 5.0, y: 0.0, alpha: 0.9, beta: -0.6, gamma: 0.9, delta: -0.6 };
    for step in 0..=STEPS {
        let angle = degrees(f64::from(step));
        (q.x, q.y) = (4.0 + angle.cos(), 1.0 + 2.0 * angle.sin());
        let solution = m.solve(&q).unwrap();
        assert!(solution.same_branch);
        q = solution.coordinates;
        let points = m.points(&m.pose_at(&q)).unwrap();
        for axis in 0..2 {
            exact(points.pen[axis], m.ratio * points.tracer[axis], size);
        }
        // Velocity and acceleration too are `ratio` times as large, whatever the tracer does.
        let motion = m.motion(&q, PantographInputs { x: 0.3, y: -0.7 }, PantographInputs { x: -0.2, y: 0.4 }).unwrap();
        exact(motion.points.pen.velocity.x, m.ratio * 0.3, size);
        exact(motion.points.pen.velocity.y, m.ratio * -0.7, size);
        exact(motion.points.pen.acceleration.x, m.ratio * -0.2, size);
        exact(motion.points.pen.acceleration.y, m.ratio * 0.4, size);
    }
}

/// x = r cos(phi), to a rounding of the radius.
#[test]
fn scotch_yoke_is_a_cosine() {
    let m = ScotchYoke::default();
    let course = turn(&m, ScotchYokeCoordinates { phi: 0.0, x: 0.5 }, |q| &mut q.phi);
    closed_form!(m, course, phi);
    for q in &course.positions {
        close(q.x, m.r * q.phi.cos(), f64::EPSILON * m.r);
        let motion = m.motion(q, 2.0, 0.0).unwrap();
        exact(motion.velocity.x, -2.0 * m.r * q.phi.sin(), m.r);
        exact(motion.acceleration.x, -4.0 * q.x, m.r);
    }
}

#[test]
fn elliptic_trammel_draws_an_ellipse() {
    let m = EllipticTrammel::default();
    let course = turn(&m, EllipticTrammelCoordinates { theta: 0.0, x: -2.0, y: 0.0 }, |q| &mut q.theta);
    closed_form!(m, course, theta);
    rigid!(course, a - b = m.rod, a - pen = m.reach, b - pen = m.reach - m.rod);
    let pen = point!(m, pen);
    for q in &course.positions {
        let at = pen(q);
        exact((at.x / (m.reach - m.rod)).powi(2) + (at.y / m.reach).powi(2), 1.0, 1.0);
    }
}

/// The rear piston does what the front one did, the angle of the vee later.
#[test]
fn v_twin_runs_in_phase() {
    let m = VTwin::default();
    let start = VTwinCoordinates {
        theta: FRAC_PI_2,
        phi_front: degrees(61.4),
        s_front: 225.0,
        phi_rear: degrees(118.6),
        s_rear: 225.0,
    };
    let course = turn(&m, start, |q| &mut q.theta);
    closed_form!(m, course, theta);
    rigid!(course, o - pin = m.crank, pin - front = m.rod, pin - rear = m.rod);
    let later = m.vee.to_degrees().round() as usize;
    for (front, rear) in course.positions.iter().zip(&course.positions[later..]) {
        exact(rear.s_rear, front.s_front, m.crank + m.rod);
    }
    // Top dead centre with crank and rod in line.
    let [bottom, top] = course.range(|q| q.s_front);
    exact(top, m.rod + m.crank, m.rod + m.crank);
    exact(bottom, m.rod - m.crank, m.rod + m.crank);
}

#[test]
fn wiper_sweeps() {
    let m = Wiper::default();
    let start = WiperCoordinates {
        theta: FRAC_PI_2,
        phi: degrees(3.8),
        first: degrees(93.8),
        rod: degrees(10.0),
        second: degrees(93.8),
    };
    let course = turn(&m, start, |q| &mut q.theta);
    closed_form!(m, course, theta);
    rigid!(
        course,
        motor - first = m.base,
        motor - pin = m.crank,
        pin - first_pin = m.link,
        first - first_pin = m.arm,
        first - second = m.span,
        first_pin - second_pin = m.span,
        second - second_pin = m.arm,
        first - first_tip = m.blade,
        second - second_tip = m.blade,
    );
    let sweep = 2.0 * (m.crank / m.arm).asin();
    for of in [|q: &WiperCoordinates| q.first, |q: &WiperCoordinates| q.second] {
        let [least, largest] = course.range(of);
        close(largest - least, sweep, 1e-13);
    }
    // Both strokes take half a turn.
    let [first, second] = course.roots(|q| m.velocity(&m.pose_at(q), 1.0).unwrap().first)[..] else {
        panic!("two dead centres")
    };
    close(second - first, PI, 1e-13);
    for q in &course.positions {
        close(q.rod, m.tilt, 1e-14);
    }
}

/// The parallelogram is followed through both change points, between the steps at half degrees.
#[test]
fn coupled_wheels_stay_parallel() {
    let m = CoupledWheels::default();
    let half = degrees(0.5);
    let start = CoupledWheelsCoordinates { theta: half, rod: 0.0, follower: half };
    let course = follow(&m, start, |q| &mut q.theta, TAU);
    closed_form!(m, course, theta);
    rigid!(course, a - b = m.crank, a - d = m.base, b - c = m.base, c - d = m.crank);
    for q in &course.positions {
        // The Jacobian is singular with the sine of the crank's angle.
        let sine = q.theta.sin().abs();
        let error = ROUNDINGS * f64::EPSILON / sine;
        close(q.rod, 0.0, error);
        close(q.follower, q.theta, TAU * error);
        let ratios = m.velocity_ratios(&m.pose_at(q)).unwrap();
        close(ratios[0], 0.0, error / sine);
        close(ratios[1], 1.0, error / sine);
    }
}

#[test]
fn cardan_is_straight() {
    let m = Cardan::default();
    let course = turn(&m, CardanCoordinates { carrier: 0.0, roll: 0.1 }, |q| &mut q.carrier);
    closed_form!(m, course, carrier);
    rigid!(course, o - centre = m.ring - m.planet, centre - rim = m.planet, centre - pen = m.pen);
    for q in &course.positions {
        let motion = m.motion(q, 1.0, 0.0).unwrap();
        let rim = motion.points.rim;
        assert_eq!((rim.position.y, rim.velocity.y, rim.acceleration.y), (0.0, 0.0, 0.0));
        exact(rim.position.x, m.ring * q.carrier.cos(), m.ring);
        let pen = motion.points.pen.position;
        let [long, short] = [m.planet + m.pen, m.planet - m.pen];
        exact((pen.x / long).powi(2) + (pen.y / short).powi(2), 1.0, 1.0);
    }
}

/// Equal cranks that move as in a mirror keep the pen on the line of symmetry.
#[test]
fn five_bar_is_symmetric() {
    let m = FiveBar { a: 1.0, b: 2.75, c: 2.75, d: 1.0, e: 3.0 };
    let size = m.a + m.b + m.c + m.d + m.e;
    let mut q = FiveBarCoordinates { theta1: 0.0, theta2: degrees(79.5), theta3: degrees(100.5), theta4: PI };
    for step in 0..=STEPS {
        q.theta1 = degrees(f64::from(step));
        q.theta4 = PI - q.theta1;
        let solution = m.solve(&q).unwrap();
        assert!(solution.same_branch);
        q = solution.coordinates;
        let motion = m
            .motion(&q, FiveBarInputs { theta1: 1.0, theta4: -1.0 }, FiveBarInputs { theta1: 0.0, theta4: 0.0 })
            .unwrap();
        exact(motion.points.p.position.x, m.e / 2.0, size);
        exact(motion.points.p.velocity.x, 0.0, size);
        exact(motion.points.p.acceleration.x, 0.0, size);
        close(q.theta2 + q.theta3, PI, 1e-14);
    }
}

/// Geared two to one, the second crank turns twice backwards in one turn of the first, and all begins again.
#[test]
fn geared_five_bar_has_the_period_of_its_slower_crank() {
    let m = GearedFiveBar::default();
    let start = GearedFiveBarCoordinates { theta1: 0.0, theta2: 0.5, theta3: 2.0, theta4: m.phase };
    let course = turn(&m, start, |q| &mut q.theta1);
    closed_form!(m, course, theta1);
    let [first, half, last] = [0, 180, 360].map(|step: usize| course.positions[step]);
    close(last.theta4 - first.theta4, m.ratio * TAU, 1e-13);
    let p = point!(m, p);
    close((p(&last) - p(&first)).norm(), 0.0, 1e-13);
    assert!((p(&half) - p(&first)).norm() > 0.1);
}
