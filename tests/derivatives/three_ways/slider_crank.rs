use linkage::linkage;

linkage! {
    mechanism Angles {
        param a = 20, b = 70, h = 9, slope = 15deg;
        input theta;
        unknown beta, s;
        loop a@theta + b@beta = (0, h) + s@slope;
        point B = a@theta;
        point C = (0, h) + s@slope;
    }

    mechanism Mirrored {
        param a = 20, b = 70, h = 9, slope = 15deg;
        input theta;
        unknown beta, s;
        loop a@theta = b@(pi - beta) + (0, h) + s@slope;
        point B = a@theta;
        point C = (0, h) + s@slope;
    }

    mechanism Joints {
        param a = 20, b = 70, h = 9, slope = 15deg;
        input theta;
        unknown x, y, beta, s;
        loop a@theta + b@beta = (x, y);
        loop (x, y) = (0, h) + s@slope;
        point B = a@theta;
        point C = (x, y);
    }

    mechanism Distances {
        param a = 20, b = 70, h = 9, slope = 15deg;
        input theta;
        unknown s;
        equation norm((0, h) + s@slope - a@theta) = b;
        point B = a@theta;
        point C = (0, h) + s@slope;
    }

    /// The guide as an equation of its line.
    mechanism Line {
        param a = 20, b = 70, h = 9, slope = 15deg;
        input theta;
        unknown x, y;
        equation y = h + tan(slope) * x;
        equation (x - a*cos(theta))^2 + (y - a*sin(theta))^2 = b^2;
        point B = a@theta;
        point C = (x, y);
    }
}

#[test]
fn slider_crank() {
    for degrees in 0..360 {
        let theta = f64::from(degrees).to_radians();
        assert_eq!(crate::three_ways::same!(theta; Angles, Mirrored, Joints, Distances, Line), 2);
    }
}
