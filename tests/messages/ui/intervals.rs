//! A mechanism without the request has no formulas over intervals.

use linkage::{Certifiable, linkage};

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
    certified(&FourBar::default());
    certified(&Plain::default());
}
