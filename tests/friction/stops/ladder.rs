//! A ladder that falls onto the slot of its input, compared with a ball.

use linkage::contact::Change;
use linkage::simulation::{Start, State, simulate};
use linkage::{InputError, Mode, MotionError, linkage};

use linkage_oracle::close;

use super::POSITION_ERROR;

linkage! {
    /// A ladder whose ends slide in two slots at right angles, askew to the axes. All its mass is at the upper end, and
    /// its lower end drives it: not where the ladder lies along the slot of that end, where y is zero.
    #[derive(Debug, Clone)]
    mechanism Ladder {
        param l = 1, m = 2, g = 9.81, askew = 0.3, drop = 0.03, e = 0.5;
        coordinate x, y, theta;
        loop x@askew + y@(askew + 90deg) = l@theta;
        drive Foot by x;
        output tilt = 2 * (theta - askew);
        output over = y - drop * x;
        body top { mass m; center y@(askew + 90deg); }
        scene Floor of Foot { inertia; torque -m * g on y; stop y in 0..l, restitution e; }
        scene Roof of Foot { inertia; torque m * g on y; stop y in -l..0, restitution e; }
        scene Tilted of Foot { inertia; torque -m * g on y; stop tilt in 0..2, restitution e; }
        scene TiltedBack of Foot { inertia; torque m * g on y; stop tilt in -2..0, restitution e; }
        scene Over of Foot { inertia; torque -m * g on y; stop over in 0..l, restitution e; }
        scene Under of Foot { inertia; torque m * g on y; stop over in -l..0, restitution e; }
    }
}

/// The time, the height over the stop, its rate, the change at that time, and the mode from there on.
type Moment = (f64, f64, f64, Option<Change>, Mode);

/// A ball that falls from this height over its stop.
struct Fall {
    height: f64,
    g: f64,
    e: f64,
    /// The scale of heights.
    size: f64,
}

impl Fall {
    fn speed(&self) -> f64 {
        (2.0 * self.g * self.height).sqrt()
    }

    /// The time of an impact and the rate there: T (1 + 2 (e + e^2 + ... + e^k)) and e^k g T.
    fn impact(&self, k: i32) -> (f64, f64) {
        let first = self.speed() / self.g;
        let flights: f64 = (1..=k).map(|k| 2.0 * self.e.powi(k)).sum();
        (first * (1.0 + flights), self.speed() * self.e.powi(k))
    }

    /// Compares heights over the stop with those of a ball.
    fn compare(&self, moments: &[Moment]) {
        let (first, speed) = (self.speed() / self.g, self.speed());
        let mut impacts = 0;
        for &(t, height, rate, change, mode) in moments {
            assert!(height > -POSITION_ERROR * self.size, "{t}: {height:e}");
            match change {
                Some(Change::Impact | Change::Rests) => {
                    let (time, before) = self.impact(impacts);
                    // The rounding error of the position of an impact counts for more the slower it is.
                    let late = 4.0 * POSITION_ERROR * self.size / before;
                    close("time", t, time, 1e-11 * first + late);
                    close("rate", -rate, before, 1e-11 * speed + late * self.g);
                    impacts += 1;
                    let is_slow = self.e * before < 1e-6 * speed.max((self.size * self.g).sqrt());
                    assert!(change == Some(Change::Impact) || is_slow, "rests after {impacts} at {before:e}");
                }
                Some(other) => panic!("{other:?} at {t}"),
                None if mode != Mode::Open => {
                    assert!(height.abs() <= POSITION_ERROR * self.size && rate == 0.0, "{t}: {height:e} {rate:e}");
                }
                None => {
                    let (hit, before) = if impacts > 0 { self.impact(impacts - 1) } else { (0.0, 0.0) };
                    let (start, up) = if impacts > 0 { (0.0, self.e * before) } else { (self.height, 0.0) };
                    let (flight, late) = (t - hit, 8.0 * POSITION_ERROR * self.size / before.max(1e-9 * speed));
                    let tolerance = 1e-11 * self.size + late * up;
                    close("height", height, start + flight * (up - 0.5 * self.g * flight), tolerance);
                    close("rate", rate, up - self.g * flight, 1e-10 * speed + late * self.g);
                }
            }
        }
        let last = moments.iter().rev().find_map(|moment| moment.3);
        assert_eq!(last, Some(Change::Rests), "after {impacts}");
        assert!(if self.e == 0.0 { impacts == 1 } else { impacts > 8 }, "{impacts}");
    }
}

/// A scene whose stop is above or below, at this part of the length, from this angle off the slot.
macro_rules! falls {
    ($scene:ident, $sign:expr, $rest:expr, $l:expr, $e:expr, $lift:expr) => {{
        let mut scene = $scene::<f64>::default();
        (scene.mechanism.l, scene.e) = ($l, $e);
        let (askew, sign, l): (f64, f64, f64) = (scene.mechanism.askew, $sign, $l);
        let (sine, cosine) = (sign * $lift).sin_cos();
        let start = LadderCoordinates { x: l * cosine, y: l * sine, theta: askew + sign * $lift };
        let rest: f64 = $rest;
        let fall = Fall { height: (l * sine - l * rest).abs(), g: scene.g, e: $e, size: l };
        let end = (fall.speed() / fall.g) * 4.0;
        let mut motion = simulate(&scene, Start { t: 0.0, q: start, input_rates: 0.0 }, end, 1e-13).unwrap();
        let mut moments = Vec::<Moment>::new();
        let mut note = |state: &State<$scene>| {
            let touch = state.contacts[0];
            moments.push((state.t, sign * (state.q.y - l * rest), sign * state.rates.y, touch.change, touch.mode));
        };
        let mut last = 0.0;
        while let Some(state) = motion.advance().unwrap() {
            let times = (1..4).map(|part| last + (state.t - last) * f64::from(part) / 4.0);
            motion.at(times).for_each(|state| note(&state.unwrap()));
            note(&state);
            last = state.t;
        }
        assert!(motion.passages().exchanges >= 1);
        fall.compare(&moments);
    }};
}

/// Both bounds, on the coordinate and on outputs, where the ladder lies along the slot of its input or nearly.
#[test]
fn it_falls_as_a_ball_does() {
    let nearly = 0.03_f64.atan().sin();
    for l in [1e-3, 1.0, 1e3] {
        for e in [0.0, 0.2, 0.5] {
            for lift in [0.04, 0.3, 0.9] {
                falls!(Floor, 1.0, 0.0, l, e, lift);
                falls!(Roof, -1.0, 0.0, l, e, lift);
                falls!(Tilted, 1.0, 0.0, l, e, lift);
                falls!(TiltedBack, -1.0, 0.0, l, e, lift);
                falls!(Over, 1.0, nearly, l, e, lift);
                falls!(Under, -1.0, nearly, l, e, lift);
            }
        }
    }
}

/// A start at rest on the stop rests there, on either side of it within rounding error, and a start beyond it is an
/// error.
#[test]
fn it_begins_on_its_stop() {
    let (mut below, mut above) = (0, 0);
    for l in [1e-3, 1.0, 1e3] {
        for askew in (0..40).map(|i| 0.01 + 0.15 * f64::from(i)) {
            let mut scene = Over::default();
            (scene.mechanism.l, scene.mechanism.askew) = (l, askew);
            let at = |lean: f64| LadderCoordinates { x: l * lean.cos(), y: l * lean.sin(), theta: askew + lean };
            let lean = scene.mechanism.drop.atan();
            let mut motion = simulate(&scene, Start { t: 0.0, q: at(lean), input_rates: 0.0 }, 1.0, 1e-12).unwrap();
            let over = |q: &LadderCoordinates<f64>| q.y - scene.mechanism.drop * q.x;
            below += u32::from(over(&motion.state().q) < 0.0);
            above += u32::from(over(&motion.state().q) > 0.0);
            assert_eq!(motion.state().mode("stop on over"), Some(Mode::AtLower), "{l} {askew}");
            motion
                .finish(|state, _| {
                    assert!(state.changes().count() == 0 && state.rates.y == 0.0, "{state:?}");
                    true
                })
                .unwrap();
            assert!(over(&motion.state().q).abs() <= POSITION_ERROR * l);
            let error = simulate(&scene, Start { t: 0.0, q: at(lean - 1e-9), input_rates: 0.0 }, 1.0, 1e-12).err();
            assert!(matches!(error, Some(MotionError::Input(InputError::BeyondStop { .. }))), "{error:?}");
        }
    }
    assert!(below > 0 && above > 0, "{below} {above}");
}
