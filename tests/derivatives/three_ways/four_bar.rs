use linkage::linkage;

linkage! {
    mechanism Angles {
        param a = 20, b = 55, c = 45, d = 60, r = 30, delta = 25deg;
        input theta;
        unknown beta, gamma;
        loop a@theta + b@beta = d@0 + c@gamma;
        point B = a@theta;
        point C = B + b@beta;
        point P = B + r@(beta + delta);
    }

    mechanism Mirrored {
        param a = 20, b = 55, c = 45, d = 60, r = 30, delta = 25deg;
        input theta;
        unknown beta, gamma;
        loop a@theta + b@(-beta) = d@0 + c@(pi - gamma);
        point B = a@theta;
        point C = d@0 + c@(pi - gamma);
        point P = B + r@(delta - beta);
    }

    mechanism Joints {
        param a = 20, b = 55, c = 45, d = 60, r = 30, delta = 25deg;
        input theta;
        unknown x, y, beta, gamma;
        loop a@theta + b@beta = (x, y);
        loop (x, y) = d@0 + c@gamma;
        point B = a@theta;
        point C = (x, y);
        point P = B + r@(beta + delta);
    }

    mechanism Distances {
        param a = 20, b = 55, c = 45, d = 60, r = 30, delta = 25deg;
        input theta;
        unknown x, y;
        equation norm((x, y) - a@theta) = b;
        equation norm((x, y) - (d, 0)) = c;
        point B = a@theta;
        point C = (x, y);
        let u = (C - B) / b;
        point P = B + r * (x(u)*cos(delta) - y(u)*sin(delta), x(u)*sin(delta) + y(u)*cos(delta));
    }

    mechanism Squares {
        param a = 20, b = 55, c = 45, d = 60, r = 30, delta = 25deg;
        input theta;
        unknown x, y;
        let rod = (x, y) - a@theta;
        equation dot(rod, rod) = b^2;
        equation (x - d)^2 + y^2 = c^2;
        point B = a@theta;
        point C = (x, y);
        point P = B + r/b * (x(rod)*cos(delta) - y(rod)*sin(delta), x(rod)*sin(delta) + y(rod)*cos(delta));
    }

    mechanism WrittenOut {
        param a = 20, b = 55, c = 45, d = 60, r = 30, delta = 25deg;
        input theta;
        unknown x, y;
        equation x^2 + y^2 - 2*a*(x*cos(theta) + y*sin(theta)) + a^2 = b^2;
        equation sqrt((d - x)^2 + y^2) = c;
        point B = a@theta;
        point C = (x, y);
        let u = (C - B) / b;
        point P = B + r * (x(u)*cos(delta) - y(u)*sin(delta), x(u)*sin(delta) + y(u)*cos(delta));
    }

    /// An angle for the coupler, a distance for the rocker.
    mechanism Mixed {
        param a = 20, b = 55, c = 45, d = 60, r = 30, delta = 25deg;
        input theta;
        unknown x, y, beta;
        loop a@theta + b@beta = (x, y);
        equation norm((x, y) - (d, 0)) = c;
        point B = a@theta;
        point C = (x, y);
        point P = B + r@(beta + delta);
    }

    mechanism MixedSquares {
        param a = 20, b = 55, c = 45, d = 60, r = 30, delta = 25deg;
        input theta;
        unknown x, y, beta;
        loop a@theta = (x, y) + b@(-beta);
        equation (x - d)^2 + y^2 = c^2;
        point B = a@theta;
        point C = (x, y);
        point P = B - r@(delta - beta);
    }
}

#[test]
fn four_bar() {
    for degrees in 0..360 {
        let theta = f64::from(degrees).to_radians();
        let count = crate::three_ways::same!(theta; Angles, Mirrored, Joints, Distances, Squares, WrittenOut, Mixed, MixedSquares);
        assert_eq!(count, 2);
    }
}
