//! Characters that begin no token: the compiler reports each, and the macro reads the rest. Greek letters make names.

linkage::linkage! {
    mechanism FourBar {
        param l1 = 80″, l2 = 20 × 1, l3 = 50, l4 = 70, δ = 20°;
        input θ₂;
        unknown θ3, θ4;
        loop l2@θ₂ + l3@θ3 = l1@0 − l4@(θ4 + δ);
        output μ² = (θ3 − θ4)²;
    }
}

fn main() {
    FourBar::default();
}
