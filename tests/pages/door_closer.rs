//! The example `door_closer`: it comes to rest on its stop, and its energy account balances.

use linkage::Mode;
use linkage::contact::Change;

use linkage_examples::door_closer::closing::{END, Run};
use linkage_examples::door_closer::machine::Closing;

fn run(scene: Closing<f64>) -> Run {
    Run::new(scene, 100_f64.to_radians()).unwrap()
}

#[test]
fn it_rests_on_its_stop() {
    let run = run(Closing::default());
    let rest = run.impacts[run.impacts.len() - 1];
    assert_eq!(rest.changes().collect::<Vec<_>>(), [("stop on door", Change::Rests)]);
    let after: Vec<_> = run.moments.iter().filter(|state| state.t > rest.t).collect();
    assert!(after.len() > 8 && after[after.len() - 1].t == END);
    for state in after {
        assert_eq!((state.mode("stop on door"), state.rates.door), (Some(Mode::AtLower), 0.0));
        // The event has the rounding error of its time: the door moves less than the last rate times that.
        assert!(state.q.door.abs() < 1e-20, "{:e}", state.q.door);
    }
}

/// The energy of the spring goes into oil and impacts, each with its own account, and none of it returns.
#[test]
fn energy_never_grows() {
    for restitution in [0.0, 0.2, 0.35, 0.6] {
        let run = run(Closing { restitution, ..Closing::default() });
        let [start, end] = [run.energies[0], run.energies[run.energies.len() - 1]];
        let given = start - end;
        // From the angle of the spindle alone: at rest before and after.
        let scene = &run.scene;
        let stored = |angle: f64| scene.k / 2.0 * (angle - scene.slack).powi(2);
        let [first, last] = [run.moments[0].q, run.moments[run.moments.len() - 1].q];
        let expected = stored(first.alpha - first.door) - stored(last.alpha - last.door);
        assert!((given - expected).abs() < 1e-13 * start && given > 30.0, "{given} {expected}");
        let gap = given - run.oil - run.blows;
        assert!(gap.abs() < 1e-9 * given, "{restitution}: {gap:e} of {given}");
        assert!(run.oil > 0.0 && run.blows > 0.0);
        for pair in run.energies.windows(2) {
            assert!(pair[1] <= pair[0] + 1e-15 * start, "{restitution}: {pair:?}");
        }
    }
}

/// Without restitution the first impact is the last; with more of it there are more.
#[test]
fn restitution_counts_the_impacts() {
    let counts = [0.0, 0.2, 0.6].map(|restitution| {
        let run = run(Closing { restitution, ..Closing::default() });
        // Between the impacts the door is open.
        assert!(run.moments.iter().all(|state| state.q.door > -1e-12));
        run.impacts.len()
    });
    assert!(counts[0] == 1 && counts[1] > 5 && counts[2] > counts[1], "{counts:?}");
}
