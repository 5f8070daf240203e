use linkage::linkage;

linkage! {
    pub mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70, big = 1e400;
        input theta2;
        unknown theta3, theta4;
        loop l2@theta2 + l3@theta3 + l4@theta4 = big * l1@0;
        output nothing = theta3 / (2 - 2);
        output none = theta4 * ln(-1);
        output neither = theta4 ^ 0.5;
    }
}

fn main() {}
