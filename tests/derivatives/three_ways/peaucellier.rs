use linkage::linkage;

linkage! {
    mechanism Angles {
        param crank = 1.6, long = 5, short = 3;
        input theta;
        unknown upper, upper_side, lower, lower_side, upper_tip, lower_tip;
        let inner = crank@0 + crank@theta;
        loop long@upper = inner + short@upper_side;
        loop long@lower = inner + short@lower_side;
        loop long@upper + short@upper_tip = long@lower + short@lower_tip;
        point Upper = long@upper;
        point Lower = long@lower;
        point Q = Upper + short@upper_tip;
    }

    mechanism Mirrored {
        param crank = 1.6, long = 5, short = 3;
        input theta;
        unknown upper, upper_side, lower, lower_side, upper_tip, lower_tip;
        let inner = crank@0 + crank@theta;
        loop long@(-upper) = inner + short@upper_side;
        loop long@lower = inner + short@(-lower_side);
        loop long@(-upper) + short@(pi - upper_tip) = long@lower + short@(-lower_tip);
        point Upper = long@(-upper);
        point Lower = long@lower;
        point Q = Lower + short@(-lower_tip);
    }

    mechanism Joints {
        param crank = 1.6, long = 5, short = 3;
        input theta;
        unknown ux, uy, lx, ly, qx, qy, upper, upper_side, lower, lower_side, upper_tip, lower_tip;
        let inner = crank@0 + crank@theta;
        loop (ux, uy) = long@upper;
        loop (ux, uy) = inner + short@upper_side;
        loop (lx, ly) = long@lower;
        loop (lx, ly) = inner + short@lower_side;
        loop (qx, qy) = (ux, uy) + short@upper_tip;
        loop (qx, qy) = (lx, ly) + short@lower_tip;
        point Upper = (ux, uy);
        point Lower = (lx, ly);
        point Q = (qx, qy);
    }

    mechanism Distances {
        param crank = 1.6, long = 5, short = 3;
        input theta;
        unknown ux, uy, lx, ly, qx, qy;
        let inner = crank@0 + crank@theta;
        equation norm((ux, uy)) = long;
        equation norm((ux, uy) - inner) = short;
        equation lx^2 + ly^2 = long^2;
        equation norm((lx, ly) - inner) = short;
        equation norm((qx, qy) - (ux, uy)) = short;
        equation norm((qx, qy) - (lx, ly)) = short;
        point Upper = (ux, uy);
        point Lower = (lx, ly);
        point Q = (qx, qy);
    }
}

#[test]
fn peaucellier() {
    for degrees in -70..=70 {
        let theta = f64::from(degrees).to_radians();
        // Two with both arms on one side have no rhombus.
        assert_eq!(crate::three_ways::same!(theta; Angles, Mirrored, Joints, Distances), 4);
    }
}
