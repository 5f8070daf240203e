//! Simulations backward in time.

use linkage::simulation::{Start, State, simulate};
use linkage::{MotionError, linkage};

use linkage_oracle::close;

linkage! {
    /// A block between a spring, a damper, a friction and a stop.
    mechanism Sledge {
        param m = 2, k = 50, c = 0.5, limit = 0.3, e = 0.5, low = -0.2;
        input x;
        unknown y;
        equation y = x;
        body block { mass m; center (x, 0); }
        scene Damped { inertia; spring k on x; damper c on x; }
        scene Rubbing { inertia; spring k on x; friction limit on x; }
        scene Hitting { inertia; spring k on x; damper c on x; stop x in low..9, restitution e; }
        scene Both { inertia; spring k on x; stop x in low..9, restitution 1; friction limit on x; }
    }
}

fn at(x: f64) -> SledgeCoordinates {
    SledgeCoordinates { x, y: x }
}

#[test]
fn energy_lost_in_contacts_does_not_return() {
    let irreversible = |scene, contact| Some(MotionError::Irreversible { scene, contact });
    let (start, end) = (Start { t: 1.0, q: at(0.3), input_rates: 0.1 }, 0.0);
    assert_eq!(simulate(&Rubbing::default(), start, end, 1e-9).err(), irreversible("Rubbing", "friction on x"));
    assert_eq!(simulate(&Both::default(), start, end, 1e-9).err(), irreversible("Both", "stop on x"));
    for e in [0.0, 0.5, 1.0] {
        let scene = Hitting { e, ..Hitting::default() };
        let error = simulate(&scene, start, end, 1e-9).err();
        assert_eq!(error, irreversible("Hitting", "stop on x"));
        assert!(error.unwrap().to_string().contains("backwards in time"));
        assert!(simulate(&scene, start, 2.0, 1e-9).is_ok());
        assert!(simulate(&scene, start, 1.0, 1e-9).is_ok());
    }
}

/// Energy dissipated by dampers returns.
#[test]
fn a_damped_motion_goes_back_where_it_came_from() {
    let damped = Damped::default();
    let mut motion = simulate(&damped, Start { t: 0.0, q: at(0.3), input_rates: 0.1 }, 3.0, 1e-13).unwrap();
    motion.finish(|_, _| true).unwrap();
    let State { q, rates, .. } = *motion.state();
    let mut motion = simulate(&damped, Start { t: 3.0, q, input_rates: rates.x }, 0.0, 1e-13).unwrap();
    motion.finish(|_, _| true).unwrap();
    close("place", motion.state().q.x, 0.3, 1e-11);
    close("rate", motion.state().rates.x, 0.1, 1e-10);
}
