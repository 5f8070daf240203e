//! The four-bar linkage.

use linkage::linkage;

linkage! {
    /// Crank a, coupler b with the point P, rocker c, ground d.
    pub mechanism FourBar {
        param a = 40, b = 120, c = 80, d = 100, px = 60, py = 30;
        input theta2;
        unknown theta3, theta4;
        loop a@theta2 + b@theta3 = c@theta4 + d@0;
        point P = a@theta2 + (px, py)@theta3;
        output mu = theta4 - theta3;
        derive lanes;
    }
}
