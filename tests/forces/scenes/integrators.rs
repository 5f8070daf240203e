//! A scene as a system of differential equations.

use linkage::{Column, D, Mechanism, Scene, StateParts};

use super::machines::*;
use super::virtual_work::agrees;

/// The state of a scene as plain numbers, integrated by the classical method of Runge and Kutta.
#[test]
fn a_state_for_integrators() {
    fn run<S: Scene<Scalar = f64>>(
        scene: &S,
        mut y: Column<f64, S::State>,
        step: f64,
        steps: usize,
    ) -> Column<f64, S::State> {
        let mut t = 0.0;
        for _ in 0..steps {
            let a = scene.derivative(t, &y).unwrap();
            let b = scene.derivative(t + step / 2.0, &(y + a * (step / 2.0))).unwrap();
            let c = scene.derivative(t + step / 2.0, &(y + b * (step / 2.0))).unwrap();
            let d = scene.derivative(t + step, &(y + c * step)).unwrap();
            y = scene.project(&(y + (a + (b + c) * 2.0 + d) * (step / 6.0))).unwrap();
            t += step;
        }
        y
    }
    let idle = Idle::default();
    let guess = LoadedFourBarCoordinates { theta2: 0.3, theta3: 1.2, theta4: -1.0 };
    let start = idle.start(0.0, &guess, &LoadedFourBarInputs { theta2: 10.0 }).unwrap();
    let energy = |y: &Column<f64, D<4>>| {
        let StateParts { q, input_rates: rates } = Idle::parts(y);
        let energy = idle.energy(&q, rates).unwrap();
        energy.kinetic + energy.potential
    };
    let total = energy(&start);
    let errors =
        [200, 400].map(|steps| (energy(&run(&idle, start, 1.0 / f64::from(steps), steps as usize)) - total) / total);
    println!("{total} {errors:?}");
    assert!(errors[1].abs() < 1e-6 && errors[0].abs() > 10.0 * errors[1].abs(), "{errors:?}");
    // The parts of the derivative agree with it.
    let derivative = idle.derivative(0.0, &start).unwrap();
    let equations = idle.equations(0.0, &start).unwrap();
    let acceleration = equations.forces / equations.mass[(0, 0)];
    agrees("v''", acceleration[0], derivative[3], 0.0);
    let StateParts { q, input_rates: rates } = Idle::parts(&start);
    let moving = equations.ratios.column(0) * rates.theta2;
    (0..2).for_each(|at| agrees("u'", moving[at], derivative[at], 0.0));
    let four_bar = &idle.mechanism;
    let pose = four_bar.pose_at(&q);
    let rates = four_bar.velocity(&pose, rates).unwrap();
    let all = four_bar.acceleration(&pose, &rates, acceleration[0]).unwrap();
    let of_unknowns = equations.ratios * acceleration + equations.bias;
    agrees("theta3''", of_unknowns[0], all.theta3, 0.0);
    agrees("theta4''", of_unknowns[1], all.theta4, 0.0);
    assert_eq!(idle.contacts(0.0, &q, &rates).unwrap(), []);
    // The crank has made more than a turn, and so have the angles.
    let end = run(&idle, start, 0.005, 200);
    let q = Idle::parts(&end).q;
    assert!(q.theta2 > 7.0, "{q:?}");
    let four_bar = &idle.mechanism;
    assert!(four_bar.residual(&four_bar.pose_at(&q)).largest() < 1e-15, "{q:?}");
}
