//! The four-bar of `doors` and `failures`.

use linkage::linkage;

linkage! {
    #[derive(Debug, Clone)]
    pub mechanism Rig {
        param a = 0.3, b = 0.9, c = 0.6, d = 1, m = 1, g = 9.81;
        input theta;
        unknown phi, psi;
        loop a@theta + b@phi = d@0 + c@psi;
        body crank { mass m; inertia m * a^2 / 12; center (a/2)@theta; angle theta; }
        body rocker { mass m; inertia m * c^2 / 12; center d@0 + (c/2)@psi; angle psi; }
        scene Idling { inertia; gravity (0, -g); energy; }
        scene Fading { inertia; gravity (0, -g); torque sqrt(1 - t) on theta; }
        scene Given { inertia; drive theta = 2 * t; }
    }
}

pub(super) fn start() -> RigCoordinates<f64> {
    Rig::default().solve(&RigCoordinates { theta: 0.0, phi: 0.8, psi: 1.9 }).unwrap().coordinates
}
