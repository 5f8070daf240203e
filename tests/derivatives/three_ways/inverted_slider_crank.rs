use linkage::linkage;

linkage! {
    mechanism Angles {
        param a = 40, c = 20, d = 100;
        input theta;
        unknown gamma, s;
        loop a@theta = d@0 + c@gamma + s@(gamma + 90deg);
        point A = a@theta;
        point Foot = d@0 + c@gamma;
    }

    mechanism Mirrored {
        param a = 40, c = 20, d = 100;
        input theta;
        unknown gamma, s;
        loop a@theta = d@0 + c@(-gamma) + s@(90deg - gamma);
        point A = a@theta;
        point Foot = d@0 + c@(-gamma);
    }

    mechanism Joints {
        param a = 40, c = 20, d = 100;
        input theta;
        unknown x, y, gamma, s;
        loop a@theta = (x, y) + s@(gamma + 90deg);
        loop (x, y) = d@0 + c@gamma;
        point A = a@theta;
        point Foot = (x, y);
    }

    /// The foot is on the circle of Thales over the line from the pivot to the pin.
    mechanism Distances {
        param a = 40, c = 20, d = 100;
        input theta;
        unknown x, y;
        equation norm((x, y) - (d, 0)) = c;
        equation dot((x, y) - (d, 0), (x, y) - a@theta) = 0;
        point A = a@theta;
        point Foot = (x, y);
    }
}

#[test]
fn inverted_slider_crank() {
    for degrees in 0..360 {
        let theta = f64::from(degrees).to_radians();
        assert_eq!(crate::three_ways::same!(theta; Angles, Mirrored, Joints, Distances), 2);
    }
}
