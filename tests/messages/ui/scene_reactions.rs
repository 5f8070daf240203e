//! Joints that a scene may not name.

linkage::linkage! {
    pub mechanism Press {
        param a, b, d, m, j, mu, radius, g;
        input theta2;
        unknown theta3, s;
        loop a@theta2 + b@theta3 = (s, d);
        point A = a@theta2;
        point Loose = (g*theta2, 2*s);
        body rod { mass m; inertia j; center A + (b/2)@theta3; angle theta3; }
        scene Wrong {
            inertia;
            reaction at s;
            reaction on A;
            reaction;
            reaction of A;
            friction -1, reaction on s;
            friction reaction on s;
            reactions;
            reactions;
        }
    }
}

linkage::linkage! {
    pub mechanism Levers {
        param a, b, d, m, j, mu, radius, g;
        input theta2;
        unknown theta3, s;
        loop a@theta2 + b@theta3 = (s, d);
        point A = a@theta2;
        point Loose = (g*theta2, 2*s);
        body rod { mass m; inertia j; center A + (b/2)@theta3; angle theta3; }
        scene Nowhere {
            inertia;
            reaction at Loose;
            reaction on theta3;
            friction mu, radius, reaction on theta2 + theta3;
            friction mu, reaction on 2*s;
        }
    }
}

linkage::linkage! {
    pub mechanism Parallel {
        param a, b, c, m, mu, radius;
        input theta2;
        unknown theta3, theta4;
        loop a@theta2 + b@theta3 = (c, 0) + a@theta4;
        point Tail = a@theta2 + b@theta3 + a@theta2;
        body rod { mass m; center a@theta2 + b@theta3; }
        scene Dry {
            inertia;
            friction mu, radius, reaction on theta3 - theta2;
        }
    }
}

linkage::linkage! {
    pub mechanism Twice {
        param a, b, d;
        input s;
        unknown theta2, theta3;
        loop a@theta2 + b@theta3 = (s, d);
        point A = a@theta2;
        point C = (s, d);
        scene Several {
            force (1, 0) at C;
            reaction at A + C;
        }
    }
}

fn main() {}
