//! A scene has no parameters and functions that it does not declare.

use linkage::linkage;

linkage! {
    pub mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70, m2 = 1, j2 = 2, m3 = 3, g = 9.81, k = 4, c = 5;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
        point G2 = (l2/2)@theta2;
        point G3 = l2@theta2 + (l3/2)@theta3;

        body crank { mass m2; center G2; inertia j2; angle theta2; }
        body coupler { mass m3; center G3; }

        scene Idle { inertia; gravity (0, -g); }
        scene Light { inertia crank; damper c on theta4; }
        scene Held { gravity (0, -g); spring k on theta4; }
    }
}

fn main() {
    let (idle, light, held) = (Idle::default(), Light::default(), Held::default());
    // The mechanism has the parameters of its geometry.
    let _ = idle.mechanism.m2;
    // Neither the spring nor the damper.
    let _ = (idle.k, idle.c);
    // Neither gravity nor the other body.
    let _ = (light.g, light.m3);
    // Nothing accelerates without inertia, so its parameters are absent.
    let _ = held.j2;
    let q = FourBarCoordinates { theta2: 0.3, theta3: 1.2, theta4: -1.0 };
    let _ = held.acceleration(0.0, &q, 1.0);
    let _ = held.mass_matrix(&q);
    // Functions that the scene does not request.
    let _ = idle.energy(&q, 1.0);
    let _ = idle.reactions(0.0, &q, 1.0);
    let _ = idle.drive_forces(0.0, &q, 1.0);
}
