use linkage::linkage;

linkage! {
    mechanism Angles {
        param bar = 50, arm = 30;
        input s;
        unknown phi, q;
        loop (s, 0) + bar@phi = (0, q);
        point B = (0, q);
        point P = (s, 0) + (bar + arm)@phi;
    }

    mechanism Mirrored {
        param bar = 50, arm = 30;
        input s;
        unknown phi, q;
        loop (s, 0) + bar@(pi - phi) = (0, q);
        point B = (0, q);
        point P = (s, 0) + (bar + arm)@(pi - phi);
    }

    mechanism Joints {
        param bar = 50, arm = 30;
        input s;
        unknown phi, x, y;
        loop (x, y) = (s, 0) + bar@phi;
        equation x = 0;
        point B = (x, y);
        point P = (s, 0) + (bar + arm)@phi;
    }

    mechanism Distances {
        param bar = 50, arm = 30;
        input s;
        unknown q;
        equation norm((s, -q)) = bar;
        point B = (0, q);
        point P = (s, 0) + (1 + arm/bar) * (-s, q);
    }

    mechanism Squares {
        param bar = 50, arm = 30;
        input s;
        unknown q;
        equation s^2 + q^2 = bar^2;
        point B = (0, q);
        point P = (s, 0) + (1 + arm/bar) * (-s, q);
    }
}

#[test]
fn trammel() {
    for s in -49..=49 {
        assert_eq!(crate::three_ways::same!(f64::from(s); Angles, Mirrored, Joints, Distances, Squares), 2);
    }
}
