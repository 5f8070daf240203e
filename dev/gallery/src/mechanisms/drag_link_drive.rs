use linkage::linkage;

linkage! {
    /// A drag link whose follower turns a wheel, a rack, a screw and a belt; the wheel carries a rocker of its own.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism DragLinkDrive {
        param ground = 1, crank = 3, coupler = 2.5, follower = 2;
        param r = 0.7, lead = 0.3, driving = 0.8, driven = 0.35, arm = 0.4, rod = 3, rest = 3.1, offset = 0.3;
        input theta2;
        unknown theta3, theta4, wheel, rack, nut, pulley, rod_angle, rocker_angle, tilt;

        loop crank@theta2 + coupler@theta3 = ground@0 + follower@theta4;
        equation 2 * wheel = -3 * theta4;
        equation rack = r * theta4;
        equation nut = lead * theta4 / (2*pi);
        equation driving * theta4 = driven * pulley;
        loop arm@wheel + rod@rod_angle = rest@offset + (5/2)@rocker_angle;
        equation tilt = rocker_angle / 3 + nut;

        point Rim = r@wheel;
        point Belt = driven@pulley;
        point Nut = (nut, 0.5);
        point Tilted = 2@tilt;
        output travel = rack;
        derive intervals;
    }
}
