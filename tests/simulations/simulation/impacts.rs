//! Impacts and releases that are easily missed, or that repeat: several extrema of a gap in one step, contacts that
//! change together, impacts without end.

use linkage::contact::Change;
use linkage::integrate::Crossing;
use linkage::linkage;
use linkage::simulation::{Start, State, Then, simulate};
use linkage::{Mode, MotionError};

use linkage_oracle::close;

linkage! {
    /// A ball on a shaken table.
    mechanism Shake {
        param m = 1, g = 9.81, e = 0.3, a = 0.08344340442466998, w = 13.770068880951563, p = 3.9127965943108407, high = 5;
        input b, y;
        body ball { mass m; center (0, y); }
        scene Shaken { inertia; gravity (0, -g); drive b = a * sin(w * t + p); stop y - b in 0..high, restitution e; }
    }
}

linkage! {
    /// A rod between two stops of its ends, on a crank.
    mechanism Two {
        param l1 = 0.153, l2 = 0.306, a = 0.05, c = 0.001, j1 = 1e-3, m3 = 0.076, j3 = 2.7e-6, e = 0;
        input q1, q2, q3;
        point S = l1@q1 + l2@q2;
        body crank { inertia j1; angle q1; }
        body slider { mass m3; inertia j3; center S; angle q3; }
        scene Between {
            inertia;
            stop y(S) - a * sin(q3) in -1..c, restitution e;
            stop y(S) + a * sin(q3) in -1..c, restitution e;
        }
    }
}

linkage! {
    /// A ball between two walls that meet.
    mechanism Walls {
        param m = 1, e = 0.5, v = 1, l = 1;
        input a, b, x;
        body ball { mass m; center (x, 0); }
        scene Closing {
            inertia;
            drive a = v * t;
            drive b = l - v * t;
            stop x - a in 0..5, restitution e;
            stop b - x in 0..5, restitution e;
        }
    }
}

linkage! {
    /// Two blocks in a row at a wall, on a slope.
    mechanism Blocks {
        param m1 = 1, m2 = 1, slope = 0, wide = 0.15, e = 1, wall = 1;
        input x, u;
        body first { mass m1; center (x, 0); }
        body second { mass m2; center (x + u, 0); }
        scene AtWall {
            inertia;
            gravity (slope, 0);
            stop x in 0..9, restitution wall;
            stop u in wide..9, restitution e;
        }
    }
}

linkage! {
    /// Three blocks in a row at a wall, by their places.
    mechanism Places {
        param m1 = 1, m2 = 1, m3 = 1, wide = 0.16;
        input x, y, z;
        body first { mass m1; center (x, 0); }
        body second { mass m2; center (y, 0); }
        body third { mass m3; center (z, 0); }
        scene OfPlaces {
            inertia;
            stop x in 0..9, restitution 1;
            stop y - x in wide..9, restitution 1;
            stop z - y in wide..9, restitution 1;
        }
    }
}

linkage! {
    /// The three blocks by the gaps between them.
    mechanism Gaps {
        param m1 = 1, m2 = 1, m3 = 1, wide = 0.16;
        input x, u, v;
        body first { mass m1; center (x, 0); }
        body second { mass m2; center (x + u, 0); }
        body third { mass m3; center (x + u + v, 0); }
        scene OfGaps {
            inertia;
            stop x in 0..9, restitution 1;
            stop u in wide..9, restitution 1;
            stop v in wide..9, restitution 1;
        }
    }
}

linkage! {
    /// A double pendulum above a floor.
    mechanism Arm {
        param l1 = 1.4, l2 = 1.5, c1 = 0.5, c2 = 0.2, m1 = 0.6, j1 = 0.08, m2 = 0.4, j2 = 0.19, g = 9.81,
            floor = -0.35964761297919057, e = 0;
        input theta1, theta2;
        point A = l1@theta1;
        point B = A + l2@theta2;
        body upper { mass m1; inertia j1; center (c1 * l1)@theta1; angle theta1; }
        body lower { mass m2; inertia j2; center A + (c2 * l2)@theta2; angle theta2; }
        scene Falling { inertia; gravity (0, -g); stop y(A) in floor..9, restitution e; stop y(B) in floor..9, restitution e; }
    }
}

/// The start on a table at the phase `p` at this time, at a height and a rate relative to the table.
fn above(scene: &Shaken<f64>, t: f64, height: f64, rate: f64) -> Start<f64, ShakeCoordinates<f64>, ShakeInputs<f64>> {
    let (sine, cosine) = (scene.w * t + scene.p).sin_cos();
    let (b, speed) = (scene.a * sine, scene.a * scene.w * cosine);
    Start { t, q: ShakeCoordinates { b, y: b + height }, input_rates: ShakeInputs { b: speed, y: speed + rate } }
}

/// The last bounce but one is some 80 microseconds, in steps of a tenth of a second: between two samples the gap has a
/// maximum, passes zero, and returns when the table falls away. The place at the end is 0.061692, computed
/// independently.
#[test]
fn no_bounce_on_a_shaken_table_is_missed() {
    let shaken = Shaken::default();
    let (b, y) = (shaken.a * shaken.p.sin(), 0.05075588799344169);
    let rates = ShakeInputs { b: shaken.a * shaken.w * shaken.p.cos(), y: -0.9611853539886392 };
    for tolerance in [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-12] {
        let start = Start { t: 0.0, q: ShakeCoordinates { b, y }, input_rates: rates };
        let mut motion = simulate(&shaken, start, 3927e-4, tolerance).unwrap();
        let (mut impacts, mut heights) = (0, y.abs() + b.abs());
        motion
            .finish(|state, _| {
                impacts += state.changes().count();
                // Two errors remain: the rounding of the time, times the rate, and the rounding of both heights.
                heights = heights.max(state.q.y.abs() + state.q.b.abs());
                let [gap, speed] = [state.q.y - state.q.b, (state.rates.y - state.rates.b).abs()];
                let rounding = f64::EPSILON * (state.t * speed + 4.0 * heights);
                assert!(gap >= -rounding, "{tolerance:e}: {gap:e} at {}", state.t);
                true
            })
            .unwrap();
        assert_eq!(impacts, 15, "{tolerance:e}");
        close("place", motion.state().q.y, 0.061_692, 5e-7 + tolerance);
    }
}

/// A bounce of 0.34 ms in a step of 40 ms, with the times of a series computed independently.
#[test]
fn a_short_bounce_before_a_table_falls_away() {
    let shaken = Shaken {
        m: 0.9103808861661061,
        a: 0.12786679053480446,
        w: 10.1647700681633,
        p: 4.844394310241354,
        high: 2.5805648677262703,
        e: 0.05853378092235655,
        ..Shaken::default()
    };
    for tolerance in [1e-6, 1e-9, 1e-11] {
        let start = above(&shaken, 0.010916285429518169, 0.2741267718691915, -0.7332967559388592);
        let motion = simulate(&shaken, start, 0.6, tolerance).unwrap();
        let changes: Vec<_> =
            motion.map(Result::unwrap).filter_map(|state| Some((state.t, state.changes().next()?.1))).collect();
        let at = |change: Change| changes.iter().find(|(_, other)| *other == change).unwrap().0;
        let bound = 100.0 * tolerance;
        close("rest", at(Change::Rests), 0.201051938, bound.max(1e-8));
        close("let go", at(Change::LetsGo), 0.223874821, bound.max(1e-8));
        let last = changes.iter().find(|(t, _)| *t > 0.3).unwrap();
        close("impact", last.0, 0.525052512, bound.max(1e-8));
    }
}

/// Both ends rest on their stops from 2.845 ms and let go together at 11.2909014 ms, computed independently for a rod
/// without rotation. The inertia of the rod has no effect, nor on the cost.
#[test]
fn two_stops_of_one_body_let_go_together() {
    for j3 in [2.7e-6, 1e-5, 1e-3] {
        let scene = Between { j3, ..Between::default() };
        let start = || Start {
            t: 0.0,
            q: TwoCoordinates { q1: 0.0, q2: 0.0, q3: 0.0 },
            input_rates: TwoInputs { q1: 150.0, q2: -75.0, q3: 0.0 },
        };
        let mut motion = simulate(&scene, start(), 0.03, 1e-10).unwrap();
        let mut changes = Vec::new();
        let seen = |changes: &mut Vec<_>, t: f64, what: &mut dyn Iterator<Item = Change>| {
            changes.extend(what.map(|change| (t, change)));
        };
        motion
            .finish(|state, _| {
                seen(&mut changes, state.t, &mut state.changes().map(|(_, change)| change));
                true
            })
            .unwrap();
        let times = [0.0028450132, 0.0028450132, 0.0112909014, 0.0112909014];
        let kinds = [Change::Rests, Change::Rests, Change::LetsGo, Change::LetsGo];
        assert_eq!(changes.len(), 4, "{changes:?}");
        for ((t, change), (time, kind)) in changes.iter().zip(times.into_iter().zip(kinds)) {
            close("time", *t, time, 1e-9);
            assert_eq!(*change, kind);
        }
        assert!(motion.counts().evaluations < 500, "{:?}", motion.counts());
        // Every time before the release, and at it, one after the other.
        let mut motion = simulate(&scene, start(), 0.03, 1e-10).unwrap();
        let outputs = [0.0105, 0.0111, changes[2].0, 0.0113, 0.03];
        let states: Vec<_> = motion.at(outputs).map(Result::unwrap).map(|state| (state.t, state.q.q1)).collect();
        assert!(states.iter().map(|(t, _)| *t).eq(outputs), "{states:?}");
        assert!(states.windows(2).all(|pair| pair[0].1 < pair[1].1), "{states:?}");
    }
}

/// The walls meet at t = 1/2: the ball passes from one to the other within the rounding error of the time.
#[test]
fn walls_that_meet_are_an_error_with_the_name_of_one() {
    for (e, x, speed) in [(0.5, 0.37, 3.0), (0.9, 0.37, 3.0), (0.7, 0.5, 10.0), (0.3, 0.9, 2.0)] {
        let scene = Closing { e, ..Closing::default() };
        let q = WallsCoordinates { a: 0.0, b: 1.0, x };
        let start = Start { t: 0.0, q, input_rates: WallsInputs { a: 1.0, b: -1.0, x: speed } };
        let mut motion = simulate(&scene, start, 1.0, 1e-9).unwrap();
        let error = motion.finish(|_, _| true).unwrap_err();
        let MotionError::ContactWithoutEnd { scene: "Closing", contact, t } = error else { panic!("{error}") };
        assert!(["stop on x - a", "stop on b - x"].contains(&contact), "{contact}");
        close("time", t, 0.5, 1e-14);
        // What was computed stays.
        close("place", motion.state().q.x, 0.5, 1e-14);
        assert!(motion.next().is_none());
    }
}

/// An arm rocks on its elbow and its tip, with rates that fall to 0.085 at each impact, and rests on both. The tip is hit
/// at 1.1561628948, 1.1658333996 and 1.1659036289, computed independently: the series ends at 1.1659041426.
#[test]
fn an_arm_rocks_to_rest_on_two_stops() {
    for tolerance in [1e-9, 1e-11] {
        let scene = Falling::default();
        let q = ArmCoordinates { theta1: 0.8, theta2: -2.0 };
        let start = Start { t: 0.0, q, input_rates: ArmInputs { theta1: 1.0, theta2: 1.0 } };
        let mut motion = simulate(&scene, start, 1.4, tolerance).unwrap();
        let mut rest = 0.0;
        motion
            .finish(|state, _| {
                if state.changes().any(|(_, change)| change == Change::Rests) {
                    rest = state.t;
                }
                true
            })
            .unwrap();
        close("rest", rest, 1.1659041426, 1e-8);
        assert!(motion.state().contacts.iter().all(|contact| contact.mode == Mode::AtLower), "{:?}", motion.state());
        assert_eq!(motion.state().rates, ArmRates { theta1: 0.0, theta2: 0.0 });
    }
}

/// User events in the same step as impacts: `at` returns the state at each, before it, and at times between them.
#[test]
fn outputs_between_events_and_impacts() {
    let shaken = Shaken::default();
    let start = || above(&shaken, 0.0, 0.05, -0.5);
    let all = |tolerance: f64| {
        simulate(&shaken, start(), 0.3, tolerance)
            .unwrap()
            .events([Crossing::Either], |state| Ok([state.q.y - state.q.b - 1e-3]), |_, _| Ok(Then::GoOn))
            .unwrap()
    };
    let points: Vec<_> = all(1e-9).map(Result::unwrap).map(|state| (state.t, state.q.y)).collect();
    let mut motion = all(1e-9);
    let mut times: Vec<f64> = points.iter().map(|point| point.0).collect();
    times.dedup();
    let between: Vec<f64> = times.windows(2).flat_map(|pair| [pair[0], 0.5 * (pair[0] + pair[1])]).collect();
    let states: Vec<_> = motion.at(between.iter().copied()).map(Result::unwrap).collect();
    assert_eq!(states.len(), between.len());
    for (state, &t) in states.iter().zip(&between) {
        assert!(state.t == t && state.q.y - state.q.b > -1e-9, "{t}: {:?}", state.q);
        if let Some((_, y)) = points.iter().find(|point| point.0 == t) {
            assert_eq!(state.q.y, *y);
        }
    }
}

/// Block 1 strikes the wall, without rebound, while block 2 touches it and moves towards it: it is struck at the same
/// time, before the slope pulls it from the wall. By impacts one after the other the rate of block 2 shrinks by a factor with
/// each two, until it is negligible: both rest, and slide down the slope together.
#[test]
fn an_impact_causes_another_one_at_the_same_time() {
    let scene = AtWall { m1: 1.1, m2: 2.8, slope: 3.0, e: 0.5, wall: 0.0, ..AtWall::default() };
    let q = BlocksCoordinates { x: 0.0, u: 0.15 };
    let start = Start { t: 2.7, q, input_rates: BlocksInputs { x: -1.0, u: 0.9 } };
    let (mut ball, mut block, mut count) = (-1.0_f64, -0.1_f64, 0);
    while ball.abs().max(block.abs()) > f64::EPSILON.sqrt() {
        count += 1;
        if ball < 0.0 {
            ball = 0.0;
        } else {
            let (mean, apart) = (2.8 * block / 3.9, -0.5 * block);
            (ball, block) = (mean - 2.8 / 3.9 * apart, mean + 1.1 / 3.9 * apart);
        }
    }
    assert!(count > 50, "{count}");
    let mut motion = simulate(&scene, start, 3.7, 1e-9).unwrap();
    assert_eq!(motion.state().rates.x, 0.0);
    assert_eq!(motion.state().rates.u, 0.0);
    motion.finish(|state, _| state.changes().count() == 0).unwrap();
    let state = motion.state();
    assert_eq!(state.t, 3.7, "{state:?}");
    close("x", state.q.x, 1.5, 1e-9);
    close("u", state.q.u, 0.15, 1e-9);
}

/// Without losses a block that comes strikes a lighter one against the wall again and again, here all at one time. The
/// rates are those of the impacts one after the other. If it is a million times as heavy, these are 3141.
#[test]
fn impacts_at_one_time_between_a_wall_and_a_block() {
    let start = || {
        let q = BlocksCoordinates { x: 0.0, u: 0.15 };
        Start { t: 0.0, q, input_rates: BlocksInputs { x: 0.1, u: -1.1 } }
    };
    for m2 in [1.0, 3.0, 100.0, 1e4] {
        let scene = AtWall { m2, ..AtWall::default() };
        let (mut ball, mut block, mut count) = (0.1_f64, -1.0_f64, 0);
        while block < ball || ball < 0.0 {
            count += 1;
            if block < ball {
                let mean = (ball + m2 * block) / (1.0 + m2);
                (ball, block) = (2.0 * mean - ball, 2.0 * mean - block);
            } else {
                ball = -ball;
            }
        }
        let motion = simulate(&scene, start(), 1.0, 1e-9).unwrap();
        let rates = motion.state().rates;
        println!("{m2}: {count} impacts, {ball} {block}");
        // A rounding error of the block's rate is 2 m2 times as large in the ball's.
        let allowed = 1e-15 * m2 * f64::from(count);
        close("ball", rates.x, ball, allowed);
        close("block", rates.x + rates.u, block, allowed);
    }
    let heavy = AtWall { m2: 1e6, ..AtWall::default() };
    let error = simulate(&heavy, start(), 1.0, 1e-9).err().unwrap();
    let MotionError::ContactWithoutEnd { scene: "AtWall", t: 0.0, .. } = error else { panic!("{error}") };
}

/// The first of three blocks that touch strikes the wall, then the others, which go on together: a stop that is closed takes
/// part without rebound, whether its scalar is a coordinate or a difference of two. The impact with the
/// wall leaves a rounding error in the rate of the gap between the other two. They stay together all the same.
#[test]
fn blocks_in_touch_stay_in_touch_in_all_coordinates() {
    for (m1, m2, m3, rate) in [(2.6, 1.3, 1.8, 1.4), (0.7, 0.3, 1.1, 1.0), (1.7, 0.9, 0.37, 0.3), (1.0, 1.0, 1.0, 1.3)]
    {
        // The impact with the two that are one, and once more with the wall where the first comes back.
        let all: f64 = m1 + m2 + m3;
        let expected = [((m1 - m2 - m3) / all * rate).abs(), 2.0 * m1 / all * rate, 2.0 * m1 / all * rate];
        let places = OfPlaces { m1, m2, m3, ..OfPlaces::default() };
        let (q, input_rates) =
            (PlacesCoordinates { x: 0.0, y: 0.16, z: 0.32 }, PlacesInputs { x: -rate, y: 0.0, z: 0.0 });
        let motion = simulate(&places, Start { t: 0.0, q, input_rates }, 1.0, 1e-9).unwrap();
        let rates = motion.state().rates;
        let by_places = [rates.x, rates.y, rates.z];
        assert_eq!(motion.state().mode("stop on z - y"), Some(Mode::AtLower));
        let gaps = OfGaps { m1, m2, m3, ..OfGaps::default() };
        let (q, input_rates) = (GapsCoordinates { x: 0.0, u: 0.16, v: 0.16 }, GapsInputs { x: -rate, u: rate, v: 0.0 });
        let motion = simulate(&gaps, Start { t: 0.0, q, input_rates }, 1.0, 1e-9).unwrap();
        let rates = motion.state().rates;
        let by_gaps = [rates.x, rates.x + rates.u, rates.x + rates.u + rates.v];
        for (found, expected) in by_places.iter().chain(&by_gaps).zip(expected.iter().chain(&expected)) {
            close("rate", *found, *expected, 1e-15 * rate);
        }
        assert_eq!(motion.state().mode("stop on v"), Some(Mode::AtLower));
    }
}

/// A ball bounces to rest on a table that is still or shaken, and leaves it where it falls faster than the ball, or just
/// as fast: the largest acceleration of some tables is g, so that the load of the ball falls to a rounding error. Each time
/// after the last state has a state, and the ball is neither in the table nor, at rest, above it.
#[test]
fn a_ball_at_rest_is_on_its_table_at_all_times() {
    // 64 ulps of 4 m, which no coordinate exceeds.
    const RESOLUTION: f64 = 256.0 * f64::EPSILON;
    let just = |w: f64, p: f64| (9.81 / (w * w), w, p);
    let tables =
        [(0.0, 1.0, 0.0), (0.02, 9.0, 0.3), (0.12, 10.0, 1.0), just(10.0, 1.0), just(2.39, 2.92), just(13.6, 0.4)];
    let mut rests = 0;
    for (a, w, p) in tables {
        for (e, height) in [(0.0, 0.3), (0.05, 0.2), (0.5, 0.29), (0.3, 0.0)] {
            let scene = Shaken { m: 1.7, e, a, w, p, ..Shaken::default() };
            for tolerance in [1e-4, 1e-6, 1e-9, 1e-11] {
                let simulation = || simulate(&scene, above(&scene, -0.7, height, 0.0), 2.2, tolerance).unwrap();
                let check = |result: Option<Result<State<Shaken<f64>>, MotionError>>, t: f64| {
                    let state =
                        result.unwrap().unwrap_or_else(|error| panic!("{a} {e} at {tolerance:e}, t = {t}: {error}"));
                    let gap = state.q.y - state.q.b;
                    let is_at_rest = state.mode("stop on y - b") == Some(Mode::AtLower);
                    let is_right = gap >= -tolerance && (!is_at_rest || gap <= RESOLUTION);
                    assert!(is_right, "{a} {e} at {tolerance:e}, t = {t}: {gap:e}, {:?}", state.contacts);
                };
                let mut motion = simulation();
                let mut last = motion.t();
                while let Some(state) = motion.advance().unwrap() {
                    if state.changes().any(|(_, change)| change == Change::LetsGo) {
                        rests += 1;
                        let gap = state.q.y - state.q.b;
                        assert!(gap.abs() <= RESOLUTION, "{a} {e} at {tolerance:e}, t = {}: {gap:e}", state.t);
                    }
                    for part in [0.125, 0.25, 0.5, 0.75, 1.0] {
                        let t = last + (state.t - last) * part;
                        if t > last && t <= state.t {
                            check(motion.at([t]).next(), t);
                        }
                    }
                    last = state.t;
                }
                let times = (0..200).map(|i| -0.7 + 2.9 * f64::from(i) / 200.0);
                let mut motion = simulation();
                let mut states = motion.at(times.clone());
                for t in times {
                    check(states.next(), t);
                }
            }
        }
    }
    println!("{rests} times let go");
    assert!(rests > 20);
}
