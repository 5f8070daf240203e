//! Springs and potentials of lengths that pass through zero, where a length has no direction.

use linkage::simulation::{Start, simulate};
use linkage::{Error, MotionError, PositionError, linkage};
use linkage_oracle::close;

linkage! {
    /// A ball on a line.
    #[derive(Debug, Clone)]
    pub mechanism Bead {
        param m = 1, k = 100, c = 0.8, free = 0;
        input y;
        point A = (0, 0);
        point B = (0, y);
        body ball { mass m; center B; }
        scene Joined { inertia; spring k between A and B; energy; equilibrium; }
        scene Freed { inertia; spring k, 0 between A and B; energy; }
        scene Damped { inertia; damper c between A and B; power; }
        scene Kept { inertia; stop norm(B - A) in 0..c, restitution 1; }
        scene Braked { inertia; friction k on norm(B - A); }
        scene Loose { inertia; spring k, free between A and B; energy; equilibrium; }
    }
}

linkage! {
    /// A ball in the plane.
    #[derive(Debug, Clone)]
    pub mechanism Ball {
        param m = 1, k = 100, free = 0.2, x0 = 0.3, y0 = -0.1;
        input x, y;
        point P = (x0, y0);
        let d = (x, y) - P;
        body ball { mass m; center (x, y); }
        scene Sprung { inertia; spring k between P and (x, y); equilibrium; energy; power; }
        scene OnLength { inertia; spring k on norm(d); equilibrium; energy; }
        scene Squared { inertia; potential k/2 * norm(d)^2; equilibrium; energy; }
        scene Twice { inertia; potential k/2 * (norm(d) * norm(d)); equilibrium; energy; }
        scene Rooted { inertia; potential k/2 * sqrt(dot(d, d))^2; equilibrium; energy; }
        scene Dotted { inertia; potential k/2 * dot(d, d); equilibrium; energy; }
        scene Cubed { inertia; potential k/3 * norm(d)^3; }
        scene Magnitude { inertia; potential k/2 * (abs(x - x0)^2 + abs(y - y0)^2); equilibrium; energy; }
        scene Long { inertia; spring k, free between P and (x, y); equilibrium; energy; power; }
        scene LongOnLength { inertia; spring k, free on sqrt(dot(d, d)); equilibrium; energy; }
        scene LongStored { inertia; potential k/2 * (norm(d) - free)^2 + free*x; equilibrium; energy; }
        scene Quartic { inertia; potential k * (norm(d) - free)^4; equilibrium; energy; }
        scene Slowed { inertia; damper k between P and (x, y); power; }
        scene Drawn { inertia; torque k on norm(d); }
        scene Rubbed { inertia; friction k on norm(d); }
        scene RubbedBoth { inertia; friction k on x + norm(d) - abs(y - y0); }
        scene Bowl { inertia; stop norm(d) in 0..free, restitution 1; }
        scene Ring { inertia; stop norm(d) in free..1, restitution 1; }
        scene Wound { inertia; force (k * norm(d)^2, k * norm(d)^4) at (x, y); }
    }
}

linkage! {
    /// A slider-crank whose pin passes the fixed end of its spring.
    #[derive(Debug, Clone)]
    pub mechanism Crank {
        param r = 0.1, l = 0.3, m = 1, j = 0.01, k = 500;
        input phi;
        unknown psi, s;
        loop r@phi + l@psi = (s, 0);
        point B = r@phi;
        point F = r@(30deg);
        body crank { mass m; inertia j; center (r/2)@phi; angle phi; }
        body piston { mass m; center (s, 0); }
        scene Pulled { inertia; spring k between F and B; reaction at (0, 0); reaction at B; }
        scene Stored { inertia; potential k/2 * dot(B - F, B - F); reaction at (0, 0); reaction at B; }
    }
}

/// y = sin(10 t) / 10 passes zero at the start and twice in each period.
#[test]
fn a_spring_passes_zero_length() {
    macro_rules! follows {
        ($scene:expr) => {
            let (scene, q) = ($scene, BeadCoordinates { y: 0.0 });
            let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates: 1.0 }, 3.0, 1e-12).unwrap();
            for i in 0..=30 {
                let t = f64::from(i) / 10.0;
                let state = motion.at([t]).next().unwrap().unwrap();
                close("y", state.q.y, 0.1 * (10.0 * t).sin(), 1e-11);
            }
        };
    }
    follows!(Joined::default());
    follows!(Freed::default());
    let joined = Joined::default();
    assert_eq!(joined.acceleration(0.0, &BeadCoordinates { y: 0.0 }, 1.0).unwrap().y, 0.0);
    assert_eq!(joined.equilibrium(0.0, &BeadCoordinates { y: 0.7 }).unwrap().y, 0.0);
}

/// |y|' = (y / |y|) y' has no direction at zero, but the force along y has: -c y'. In the plane it depends on the way there.
#[test]
fn a_damper_passes_zero_length() {
    let scene = Damped::default();
    let still = BeadCoordinates { y: 0.0 };
    assert_eq!(scene.forces(0.0, &still, 0.5).unwrap().x, -0.4);
    assert_eq!(scene.power(0.0, &still, 0.5).unwrap().dissipated, 0.2);
    // y'' = -c y' from -1/2 with y' = 1: y = -1/2 + (1 - exp(-c t)) / c passes zero at t = 0.639.
    let start = Start { t: 0.0, q: BeadCoordinates { y: -0.5 }, input_rates: 1.0 };
    let mut motion = simulate(&scene, start, 3.0, 1e-12).unwrap();
    motion.finish(|_, _| true).unwrap();
    close("y", motion.state().q.y, -0.5 + (1.0 - (-2.4_f64).exp()) / 0.8, 1e-11);

    let q = BallCoordinates { x: 0.3, y: -0.1 };
    let error = Slowed::default().forces(0.0, &q, BallInputs { x: 1.0, y: 0.0 }).unwrap_err();
    let quantity = "damper between P and a point";
    assert_eq!(error, MotionError::Position(PositionError::NotFinite { mechanism: "Slowed", quantity }));
}

/// Forces and torques by even powers of a length.
#[test]
fn laws_of_a_length_that_is_zero() {
    let q = BallCoordinates { x: 0.3, y: -0.1 };
    let wound = Wound::default();
    assert_eq!(wound.forces(0.0, &q, BallInputs { x: 1.0, y: 2.0 }).unwrap().as_slice(), [0.0, 0.0]);
    let motion = simulate(&wound, Start { t: 0.0, q, input_rates: BallInputs { x: 1.0, y: 2.0 } }, 0.3, 1e-9);
    motion.unwrap().finish(|_, _| true).unwrap();
}

/// The forces, stiffnesses and energies of scenes are those of the first.
macro_rules! agrees {
    ($expected:ident, $q:ident, $rates:ident: $($scene:expr),*) => {
        let (force, balance) = ($expected.forces(0.0, &$q, $rates).unwrap(), $expected.balance(0.0, &$q).unwrap());
        let energy = $expected.energy(&$q, $rates).unwrap();
        $(
            let scene = $scene;
            for (found, expected) in scene.forces(0.0, &$q, $rates).unwrap().iter().zip(&force) {
                close(stringify!($scene), *found, *expected, 1e-14 * expected.abs());
            }
            let found = scene.balance(0.0, &$q).unwrap();
            for (found, expected) in found.slopes.iter().flatten().zip(balance.slopes.iter().flatten()) {
                close("slope", *found, *expected, 1e-12);
            }
            let found = scene.energy(&$q, $rates).unwrap();
            close("energy", found.potential, energy.potential, 1e-14 * energy.potential);
        )*
    };
}

/// Every spelling gives one force and one stiffness, also at the point where the length is zero.
#[test]
fn spellings_of_one_spring() {
    let dotted = Dotted::default();
    for [dx, dy] in [[0.0, 0.0], [1e-300, 0.0], [0.0, -1e-9], [0.3, 0.4]] {
        let q = BallCoordinates { x: 0.3 + dx, y: -0.1 + dy };
        let rates = BallInputs { x: 0.2, y: -0.7 };
        agrees!(
            dotted, q, rates:
            Sprung::default(), OnLength::default(), Squared::default(), Twice::default(), Rooted::default(),
            Magnitude::default()
        );
    }
    let q = BallCoordinates { x: 0.3, y: -0.1 };
    assert_eq!(Cubed::default().forces(0.0, &q, BallInputs { x: 1.0, y: 0.0 }).unwrap().as_slice(), [0.0, 0.0]);
    let power = Sprung::default().power(0.0, &q, BallInputs { x: 1.0, y: 0.0 }).unwrap();
    assert_eq!((power.applied, power.dissipated), (0.0, 0.0));
}

/// With a free length the force at zero length has no direction.
#[test]
fn a_free_length_leaves_the_direction_open() {
    let q = BallCoordinates { x: 0.3, y: -0.1 };
    let error = Long::default().forces(0.0, &q, BallInputs { x: 1.0, y: 0.0 }).unwrap_err();
    let quantity = "spring between P and a point";
    let expected = PositionError::NotFinite { mechanism: "Long", quantity };
    assert_eq!(error, MotionError::Position(expected));
    assert!(Error::from(error).to_string().contains("is not a finite number"));
    assert!(Long::default().balance(0.0, &q).is_err());
    assert!(LongOnLength::default().forces(0.0, &q, BallInputs { x: 1.0, y: 0.0 }).is_err());
    assert!(LongStored::default().balance(0.0, &q).is_err());
    assert!(Quartic::default().forces(0.0, &q, BallInputs { x: 1.0, y: 0.0 }).is_err());
    let loose = Loose { free: 0.1, ..Loose::default() };
    assert!(loose.forces(0.0, &BeadCoordinates { y: 0.0 }, 1.0).is_err());
}

/// A parameter may be zero at run time: a spring of that free length is one without, at every length.
#[test]
fn a_free_length_of_the_value_zero() {
    let plain = Sprung::default();
    for [dx, dy] in [[0.0, 0.0], [1e-300, 0.0], [0.0, -1e-9], [0.3, 0.4]] {
        let q = BallCoordinates { x: 0.3 + dx, y: -0.1 + dy };
        let rates = BallInputs { x: 0.2, y: -0.7 };
        agrees!(
            plain, q, rates:
            Long { free: 0.0, ..Long::default() },
            LongOnLength { free: 0.0, ..LongOnLength::default() },
            LongStored { free: 0.0, ..LongStored::default() }
        );
    }
    let q = BallCoordinates { x: 0.3, y: -0.1 };
    let still = Quartic { free: 0.0, ..Quartic::default() };
    assert_eq!(still.forces(0.0, &q, BallInputs { x: 1.0, y: 0.0 }).unwrap().as_slice(), [0.0, 0.0]);

    let (scene, q) = (Loose::default(), BeadCoordinates { y: 0.0 });
    let mut motion = simulate(&scene, Start { t: 0.0, q, input_rates: 1.0 }, 3.0, 1e-12).unwrap();
    for i in 0..=30 {
        let t = f64::from(i) / 10.0;
        close("y", motion.at([t]).next().unwrap().unwrap().q.y, 0.1 * (10.0 * t).sin(), 1e-11);
    }
    assert_eq!(scene.equilibrium(0.0, &BeadCoordinates { y: 0.7 }).unwrap().y, 0.0);
}

/// Without stiffness, damping or torque there is no force either.
#[test]
fn a_law_of_the_value_zero_needs_no_direction() {
    let (q, rates) = (BallCoordinates { x: 0.3, y: -0.1 }, BallInputs { x: 1.0, y: 2.0 });
    macro_rules! none {
        ($($scene:ident),*) => { $(
            assert!($scene::default().forces(0.0, &q, rates).is_err());
            let scene = $scene { k: 0.0, ..$scene::default() };
            assert_eq!(scene.forces(0.0, &q, rates).unwrap().as_slice(), [0.0, 0.0], stringify!($scene));
        )* };
    }
    none!(Long, LongOnLength, Slowed, Drawn);
    let power = Slowed { k: 0.0, ..Slowed::default() }.power(0.0, &q, rates).unwrap();
    assert_eq!(power.dissipated, 0.0);
}

/// A friction without a limit needs no direction, and |y|' has that of y'.
#[test]
fn a_friction_along_a_length_that_is_zero() {
    let q = BallCoordinates { x: 0.3, y: -0.1 };
    let rates = BallInputs { x: 1.0, y: 2.0 };
    macro_rules! free {
        ($($scene:ident),*) => { $(
            let start = |q, input_rates| Start { t: 0.0, q, input_rates };
            let error = simulate(&$scene::default(), start(q, rates), 1.0, 1e-9).err().unwrap().to_string();
            assert!(error.contains("friction") && error.contains("is not a finite number"), "{error}");
            let scene = $scene { k: 0.0, ..$scene::default() };
            for [x, y] in [[0.3, -0.1], [-0.7, -2.1]] {
                let q = BallCoordinates { x, y };
                let mut motion = simulate(&scene, start(q, rates), 3.0, 1e-9).unwrap();
                motion.finish(|_, _| true).unwrap();
                close("x", motion.state().q.x, x + 3.0, 1e-12);
                close("y", motion.state().q.y, y + 6.0, 1e-12);
            }
            let mut motion = simulate(&scene, start(q, BallInputs { x: 0.0, y: 0.0 }), 3.0, 1e-9).unwrap();
            motion.finish(|_, _| true).unwrap();
            assert_eq!([motion.state().q.x, motion.state().q.y], [0.3, -0.1]);
        )* };
    }
    free!(Rubbed, RubbedBoth);

    // y'' = -k sign y' from y = -1/20 with y' = 5: through zero, at rest after v^2 / (2 k)
    let start = Start { t: 0.0, q: BeadCoordinates { y: -0.05 }, input_rates: 5.0 };
    let scene = Braked::default();
    let mut motion = simulate(&scene, start, 1.0, 1e-9).unwrap();
    motion.finish(|_, _| true).unwrap();
    close("y", motion.state().q.y, -0.05 + 25.0 / 200.0, 1e-10);
}

/// A pin with play in a round hole, at first in the middle; a length is not stopped at zero.
#[test]
fn a_stop_on_a_length_that_is_zero() {
    // free = 0.2: from the middle along (0.6, 0.8) at unit speed, at the rim after 0.2, through the middle after 0.4, ...
    let scene = Bowl::default();
    for [t, s] in [[0.0, 0.0], [-0.1, 0.1]] {
        let q = BallCoordinates { x: 0.3 - 0.6 * s, y: -0.1 - 0.8 * s };
        let start = Start { t, q, input_rates: BallInputs { x: 0.6, y: 0.8 } };
        let mut motion = simulate(&scene, start, 1.5, 1e-9).unwrap();
        motion.finish(|_, _| true).unwrap();
        let state = motion.state();
        // 1.5 = 0.2 + 3 * 0.4 + 0.1: after four impacts 0.1 from the rim behind the middle.
        close("x", state.q.x, 0.3 - 0.6 * 0.1, 1e-12);
        close("y", state.q.y, -0.1 - 0.8 * 0.1, 1e-12);
        close("x'", state.rates.x, 0.6, 1e-12);
    }
    let rest = Start { t: 0.0, q: BallCoordinates { x: 0.3, y: -0.1 }, input_rates: BallInputs { x: 0.0, y: 0.0 } };
    simulate(&scene, rest, 1.5, 1e-9).unwrap().finish(|_, _| true).unwrap();
    // An end at zero that is known at run time only.
    let ring = Ring { free: 0.0, ..Ring::default() };
    let start = Start { t: 0.0, q: BallCoordinates { x: 0.3, y: -0.1 }, input_rates: BallInputs { x: 0.6, y: 0.8 } };
    let error = simulate(&ring, start, 1.5, 1e-9).err().unwrap().to_string();
    assert!(error.contains("stop") && error.contains("is not a finite number"), "{error}");

    // c = 0.8: from -0.3 with y' = 1 through zero to 0.8, and back
    let scene = Kept::default();
    let start = Start { t: 0.0, q: BeadCoordinates { y: -0.3 }, input_rates: 1.0 };
    let mut motion = simulate(&scene, start, 2.0, 1e-9).unwrap();
    motion.finish(|_, _| true).unwrap();
    close("y", motion.state().q.y, 0.8 - 0.9, 1e-12);
}

#[test]
fn forces_in_joints_where_the_ends_meet() {
    let (pulled, stored) = (Pulled::default(), Stored::default());
    for degrees in [0.0_f64, 30.0, 200.0] {
        let q = pulled.mechanism.assemble(degrees.to_radians(), CrankBranch { psi_s: linkage::Slider::Far });
        let q = q.unwrap().coordinates();
        let (one, other) = (pulled.reactions(0.0, &q, 20.0).unwrap(), stored.reactions(0.0, &q, 20.0).unwrap());
        close(
            "origin",
            (one.origin_on_crank - other.origin_on_crank).norm(),
            0.0,
            1e-12 * other.origin_on_crank.norm(),
        );
        close("B", (one.b_on_crank - other.b_on_crank).norm(), 0.0, 1e-12 * other.origin_on_crank.norm());
    }
}
