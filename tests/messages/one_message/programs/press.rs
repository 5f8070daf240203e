use linkage::linkage;
use linkage::simulation::{Start, simulate};

linkage! {
    /// A press with a joint that rubs and a ram that hits a stop.
    #[derive(Debug, Clone)]
    pub mechanism Press {
        param r = 0.1, l = 0.35;
        param j = 0.02, m = 0.8, g = 9.81, k = 40, c = 0.6, omega = 12;
        param mu = 0.2, radius = 0.01, load = 90, e = 0.3;
        input phi;
        unknown psi, z;

        loop r@phi - l@psi = (z, 0);

        point B = r@phi;
        output joint = phi - psi;

        body crank { inertia j; angle phi; }
        body ram { mass m; center (z, 0); }

        scene Working {
            inertia;
            gravity (-g, 0);
            spring k, 0.2 on z;
            damper c on phi;
            torque 0.5 on phi;
            friction mu, radius, load on joint;
            stop z in 0.24..1, restitution e;
            energy;
        }
        scene Driven {
            inertia crank, ram;
            force (0, -3) at B;
            drive phi = omega * t;
            reactions;
        }
    }
}

pub fn main() -> Result<(), linkage::Error> {
    let scene = Working { g: 1.62, ..Working::default() };
    let start = PressCoordinates { phi: 1.0, psi: 0.2, z: 0.4 };
    let mut motion = simulate(&scene, Start { t: 0.0, q: start, input_rates: 3.0 }, 0.5, 1e-9)?;
    motion.finish(|state, _| state.q.z.is_finite())?;
    let q = motion.state().q;
    println!("{} J at {} m", scene.energy(&q, 1.0)?.kinetic, scene.mechanism.pose_at(&q).z);
    let driven = Driven::default();
    let rate = driven.drives(0.0).phi.rate;
    println!("{} N m", driven.drive_forces(0.0, &q, rate)?.phi + driven.omega);
    println!("{} N", driven.reactions(0.0, &q, rate)?.multipliers.norm());
    Ok(())
}
