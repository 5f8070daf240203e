//! Joints whose forces the mechanism does not say.

linkage::linkage! {
    /// The third crank of a parallelogram takes a part of the load.
    pub mechanism ThreeCranks {
        param a, b, c, m, j, mu, radius, normal;
        input theta;
        unknown phi, psi, chi, s;
        loop a@theta + b@phi = (b, 0) + a@psi;
        implied loop a@theta + c@phi = (c, 0) + a@psi;
        loop a@theta + b@phi + c@chi = (s, 0);
        point A = a@theta;
        point B = A + b@phi;
        body coupler { mass m; inertia j; center A + (b/2)@phi; angle phi; }
        scene Redundant {
            inertia;
            friction mu, radius, reaction on theta;
            friction mu, radius, reaction at B on psi - phi;
            friction mu, radius, normal on phi - theta;
            friction mu, reaction on s;
            reactions;
        }
    }
}

linkage::linkage! {
    /// The driving four-bar carries the load of a parallelogram, whatever its third crank carries.
    pub mechanism Train {
        param a, b, c, d, e, m, j, mu, radius;
        input theta;
        unknown beta, gamma, phi, psi;
        loop a@theta + b@beta = (d, 0) + c@gamma;
        loop (d, 0) + a@gamma + e@phi = (d + e, 0) + a@psi;
        implied loop (d, 0) + a@gamma + c@phi = (d + c, 0) + a@psi;
        point P = (d, 0) + a@gamma;
        body rod { mass m; inertia j; center a@theta + (b/2)@beta; angle beta; }
        scene Driven { inertia; friction mu, radius, reaction on beta - theta; }
        scene Following { inertia; friction mu, radius, reaction at P on phi - gamma; }
    }
}

linkage::linkage! {
    /// The outer loop says nothing new.
    pub mechanism Outer {
        param a, b, c, d, e, f, h, m, j, mu, radius;
        input theta;
        unknown beta, gamma, delta, epsilon;
        loop a@theta + b@beta = (d, 0) + c@gamma;
        loop (d, 0) + c@gamma + e@delta = (h, 0) + f@epsilon;
        implied loop a@theta + b@beta + e@delta = (h, 0) + f@epsilon;
        body rod { mass m; inertia j; center a@theta + (b/2)@beta; angle beta; }
        scene Determined {
            inertia;
            friction mu, radius, reaction on beta - theta;
            friction mu, radius, reaction on epsilon;
        }
    }
}

linkage::linkage! {
    /// The second loop begins at a joint of the first.
    pub mechanism Floating {
        param a, b, c, d, e, f, h, m, j;
        input theta;
        unknown beta, gamma, delta, epsilon;
        loop a@theta + b@beta = (d, 0) + c@gamma;
        loop h@beta + e@delta = f@gamma + a@epsilon;
        body rod { mass m; inertia j; center a@theta + (b/2)@beta; angle beta; }
        scene Turning { inertia; reactions; }
    }
}

fn main() {}
