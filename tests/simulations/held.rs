//! Simulations that own their scene, or share it with others.

use std::sync::Arc;
use std::thread;

use linkage::MotionError;
use linkage::simulation::{RealTime, Simulation, Start, State, simulate};

linkage::linkage! {
    #[derive(Debug, Clone)]
    mechanism Pendulum {
        param l = 0.5, m = 2, g = 9.81;
        input phi;
        body bob { mass m; center l@phi; }
        scene Swinging { inertia; gravity (0, -g); }
    }
}

type Started = Start<f64, PendulumCoordinates, f64>;

fn start() -> Started {
    Start { t: 0.0, q: PendulumCoordinates { phi: 0.3 }, input_rates: 0.0 }
}

/// A machine that owns its simulations.
struct Machine {
    simulation: Simulation<'static, Swinging>,
    steps: RealTime<'static, Swinging>,
}

impl Machine {
    fn new(scene: &Swinging) -> Result<Self, MotionError> {
        Ok(Self {
            simulation: simulate(scene.clone(), start(), 2.0, 1e-9)?,
            steps: RealTime::new(scene.clone(), start(), 0.01)?,
        })
    }

    fn moved(mut self) -> Result<(Self, [State<Swinging>; 2]), MotionError> {
        self.simulation.finish(|_, _| true)?;
        for _ in 0..10 {
            self.steps.step()?;
        }
        let states = [*self.simulation.state(), self.steps.state()?];
        Ok((self, states))
    }
}

/// It may be returned, moved and stored while it runs, and has the digits of a simulation that borrows.
#[test]
fn a_struct_owns_its_simulations() {
    let scenes = [9.81, 1.62].map(|g| Swinging { g, ..Swinging::default() });
    let machines = scenes.each_ref().map(|scene| Machine::new(scene).unwrap());
    for (machine, scene) in machines.into_iter().map(Box::new).zip(scenes).rev() {
        let (machine, states) = machine.moved().unwrap();
        let mut borrowed = simulate(&scene, start(), 2.0, 1e-9).unwrap();
        borrowed.finish(|_, _| true).unwrap();
        let mut steps = RealTime::new(&scene, start(), 0.01).unwrap();
        (0..10).for_each(|_| steps.step().unwrap());
        assert_eq!(states, [*borrowed.state(), steps.state().unwrap()]);
        assert_eq!(machine.steps.t(), steps.t());
    }
}

/// Two threads simulate one scene, to different times.
#[test]
fn two_threads_share_a_scene() {
    let scene = Arc::new(Swinging::default());
    let threads = [1.0, 2.0].map(|end| {
        let mut motion = simulate(Arc::clone(&scene), start(), end, 1e-9).unwrap();
        thread::spawn(move || {
            motion.finish(|_, _| true).unwrap();
            *motion.state()
        })
    });
    let states = threads.map(|thread| thread.join().unwrap());
    for (state, end) in states.iter().zip([1.0, 2.0]) {
        let mut motion = simulate(&*scene, start(), end, 1e-9).unwrap();
        motion.finish(|_, _| true).unwrap();
        assert_eq!(state, motion.state());
    }
    assert_eq!(Arc::strong_count(&scene), 1);
}

/// A scene that is owned says at a wrong start what one that is borrowed says.
#[test]
fn errors_of_an_owned_scene() {
    let late = |t: f64| Start { t, ..start() };
    let [owned, borrowed] = [
        simulate(Swinging::default(), late(f64::NAN), 1.0, 1e-9).err(),
        simulate(&Swinging::default(), late(f64::NAN), 1.0, 1e-9).err(),
    ];
    assert!(owned.is_some() && format!("{owned:?}") == format!("{borrowed:?}"), "{owned:?} {borrowed:?}");
}
