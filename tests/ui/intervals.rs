//! Functions that compare numbers do not exist over intervals, and a mechanism without the request has no formulas.

use linkage::{Certifiable, Interval, linkage};

linkage! {
    mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 = l1@0 + l4@theta4;
        derive intervals;
    }

    mechanism Plain {
        param r = 1;
        input phi;
        unknown x;
        equation x = r * cos(phi);
    }
}

fn certified<M: Certifiable>(_: &M) {}

fn main() {
    let lengths = [80.0, 20.0, 50.0, 70.0].map(Interval::from);
    let bar = FourBar::from(lengths);
    let _ = bar.solve(&FourBarCoordinates { theta3: Interval::ENTIRE, theta4: Interval::ENTIRE, theta2: Interval::ENTIRE });
    certified(&FourBar::default());
    certified(&Plain::default());
}
