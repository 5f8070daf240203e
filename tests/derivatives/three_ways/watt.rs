use linkage::linkage;

linkage! {
    mechanism Angles {
        param a = 20, b = 55, c = 45, d = 60, e = 40, bend = 30deg, f = 60, g = 55, px = 120, py = 20;
        input theta;
        unknown beta, gamma, phi, psi;
        loop a@theta + b@beta = d@0 + c@gamma;
        loop d@0 + e@(gamma - bend) + f@phi = (px, py) + g@psi;
        point C = d@0 + c@gamma;
        point E = d@0 + e@(gamma - bend);
        point F = E + f@phi;
    }

    mechanism Mirrored {
        param a = 20, b = 55, c = 45, d = 60, e = 40, bend = 30deg, f = 60, g = 55, px = 120, py = 20;
        input theta;
        unknown beta, gamma, phi, psi;
        loop a@theta + b@(-beta) = d@0 + c@(-gamma);
        loop d@0 + e@(-gamma - bend) + f@(90deg - phi) = (px, py) - g@(psi);
        point C = d@0 + c@(-gamma);
        point E = d@0 + e@(-gamma - bend);
        point F = (px, py) - g@psi;
    }

    mechanism Joints {
        param a = 20, b = 55, c = 45, d = 60, e = 40, bend = 30deg, f = 60, g = 55, px = 120, py = 20;
        input theta;
        unknown cx, cy, ex, ey, fx, fy, beta, gamma, phi, psi;
        loop (cx, cy) = a@theta + b@beta;
        loop (cx, cy) = d@0 + c@gamma;
        loop (ex, ey) = d@0 + e@(gamma - bend);
        loop (fx, fy) = (ex, ey) + f@phi;
        loop (fx, fy) = (px, py) + g@psi;
        point C = (cx, cy);
        point E = (ex, ey);
        point F = (fx, fy);
    }

    mechanism Distances {
        param a = 20, b = 55, c = 45, d = 60, e = 40, bend = 30deg, f = 60, g = 55, px = 120, py = 20;
        input theta;
        unknown cx, cy, fx, fy;
        equation norm((cx, cy) - a@theta) = b;
        equation norm((cx, cy) - (d, 0)) = c;
        let u = ((cx, cy) - (d, 0)) / c;
        point C = (cx, cy);
        point E = (d, 0) + e * (x(u)*cos(bend) + y(u)*sin(bend), y(u)*cos(bend) - x(u)*sin(bend));
        equation norm((fx, fy) - E) = f;
        equation norm((fx, fy) - (px, py)) = g;
        point F = (fx, fy);
    }
}

#[test]
fn watt_six_bar() {
    let mut most = 0;
    for degrees in 0..360 {
        let theta = f64::from(degrees).to_radians();
        most = most.max(crate::three_ways::same!(theta; Angles, Mirrored, Joints, Distances));
    }
    assert_eq!(most, 4);
}
