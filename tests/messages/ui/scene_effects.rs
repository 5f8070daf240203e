//! Mistakes in bodies and scenes, all at once.

use linkage::linkage;

linkage! {
    pub mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70, m2, j2, m3, g, k, c;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
        point G2 = (l2/2)@theta2;
        point G3 = l2@theta2 + (l3/2)@theta3;

        body crank { mass -2; center G2; inertia j2; angle theta2; }
        body coupler { mass m3 * cos(theta3); center G3; }
        body rocker { mass m3; }
        body crank { inertia j2; }
        body spare { masss m2; }
        body idle { mass m2; center G3; }
        body lost { mass m2; center G3; }

        scene Loaded {
            inertia crank, copler;
            gravity (0, -g * t) on coupler;
            gravity -g on coupler, rocker;
            spring k between G2;
            spring k * theta3, 3 between G2 and G3;
            damper -c on theta4;
            damper -2 on theta4;
            torque k * rate(theta2, theta3) on theta2;
            torque k;
            force (0, -c) on G2;
            force c at G2;
            potential k * t;
            drive theta3 = 2 * t;
            drive theta2 = 2 * theta3;
            drive theta2 = rate(theta2);
            friction k, c, m3, g on theta4;
            friction k between G2 and G3;
            friction -0.3, c * rate(theta4) on theta4;
            friction k on G2;
            friction k on l1 * l2;
            stop theta4 in 0..1;
            stop theta4 on 0..1, restitution 0.5;
            stop theta4 in 0..=1, restitution 0.5;
            stop theta4 in 1..0, restitution 1.5;
            stop theta4 in theta2..t, restitution rate(theta4);
            stops theta4 in 0..1, restitution 0.5;
            brake 3 on theta4;
            energy;
            energy;
        }
        scene Empty {}
        scene FourBar { inertia idle; }
        scene Other of Nothing { inertia idle; }
        scene Wrong on Nothing { inertia idle; }
    }
}

fn main() {}
