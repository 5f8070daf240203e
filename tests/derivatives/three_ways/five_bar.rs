use linkage::linkage;

linkage! {
    mechanism Angles {
        param a = 20, b = 50, c = 45, e = 25, d = 50;
        input left, right;
        unknown beta, gamma;
        loop a@left + b@beta = d@0 + e@right + c@gamma;
        point C = a@left + b@beta;
    }

    mechanism Mirrored {
        param a = 20, b = 50, c = 45, e = 25, d = 50;
        input left, right;
        unknown beta, gamma;
        loop a@left - b@(-beta) = d@0 + e@right + c@(90deg - gamma);
        point C = a@left - b@(-beta);
    }

    mechanism Joints {
        param a = 20, b = 50, c = 45, e = 25, d = 50;
        input left, right;
        unknown x, y, beta, gamma;
        loop a@left + b@beta - (x, y) = 0;
        loop d@0 + e@right + c@gamma - (x, y) = 0;
        point C = (x, y);
    }

    mechanism Distances {
        param a = 20, b = 50, c = 45, e = 25, d = 50;
        input left, right;
        unknown x, y;
        equation b = norm(a@left - (x, y));
        equation norm(d@0 + e@right - (x, y))^2 = c^2;
        point C = (x, y);
    }
}

#[test]
fn five_bar() {
    let mut found = 0;
    for (left, right) in (0..36).flat_map(|left| (0..36).map(move |right| (left, right))) {
        let inputs = nalgebra::vector![left, right].map(|tens| f64::from(10 * tens).to_radians());
        found += crate::three_ways::same!(inputs; Angles, Mirrored, Joints, Distances);
    }
    assert!(found > 2000, "{found}");
}
