use linkage::linkage;

linkage! {
    mechanism Angles {
        param a = 20, b = 55, c = 45, d = 60, r = 30, delta = 25deg, f = 60, g = 50, px = 30, py = 90;
        input theta;
        unknown beta, gamma, phi, psi;
        loop a@theta + b@beta = d@0 + c@gamma;
        point P = a@theta + r@(beta + delta);
        loop P + f@phi = (px, py) + g@psi;
        point F = (px, py) + g@psi;
    }

    mechanism Mirrored {
        param a = 20, b = 55, c = 45, d = 60, r = 30, delta = 25deg, f = 60, g = 50, px = 30, py = 90;
        input theta;
        unknown beta, gamma, phi, psi;
        loop a@theta + b@(-beta) = d@0 + c@(pi - gamma);
        point P = a@theta + r@(delta - beta);
        loop P + f@(pi/2 - phi) = (px, py) + g@(psi - pi);
        point F = (px, py) + g@(psi - pi);
    }

    mechanism Joints {
        param a = 20, b = 55, c = 45, d = 60, r = 30, delta = 25deg, f = 60, g = 50, px = 30, py = 90;
        input theta;
        unknown x, y, u, v, beta, gamma, phi, psi;
        loop a@theta + b@beta = (x, y);
        loop (x, y) = d@0 + c@gamma;
        point P = a@theta + r@(beta + delta);
        loop P + f@phi = (u, v);
        loop (u, v) = (px, py) + g@psi;
        point F = (u, v);
    }

    mechanism Distances {
        param a = 20, b = 55, c = 45, d = 60, r = 30, delta = 25deg, f = 60, g = 50, px = 30, py = 90;
        input theta;
        unknown x, y, u, v;
        equation norm((x, y) - a@theta) = b;
        equation norm((x, y) - (d, 0)) = c;
        let w = ((x, y) - a@theta) / b;
        point P = a@theta + r * (x(w)*cos(delta) - y(w)*sin(delta), x(w)*sin(delta) + y(w)*cos(delta));
        equation norm((u, v) - P) = f;
        equation norm((u, v) - (px, py)) = g;
        point F = (u, v);
    }
}

#[test]
fn stephenson_six_bar() {
    let mut most = 0;
    for degrees in 0..360 {
        let theta = f64::from(degrees).to_radians();
        most = most.max(crate::three_ways::same!(theta; Angles, Mirrored, Joints, Distances));
    }
    assert_eq!(most, 4);
}
