use linkage::linkage;

linkage! {
    pub mechanism FourBar {
        parm l1 = 80, l2 = 20;
        param l3 = 50, l4 = 70rad;
        input theta2;
        unknown theta3, loop;
        scene Idle { inertia; }
        loop l2@theta2 + = l1@0;
        point P = (1, 2, 3);
        output o = sn(theta2) + sin(theta2, 3);
    }
}

fn main() {}
