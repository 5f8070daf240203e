use linkage::linkage;

linkage! {
    mechanism Angles {
        param boom = 40, d = 60, h = 10;
        input stroke;
        unknown phi, psi;
        loop stroke@phi = (d, h) + boom@psi;
        point Pin = (d, h) + boom@psi;
    }

    mechanism Mirrored {
        param boom = 40, d = 60, h = 10;
        input stroke;
        unknown phi, psi;
        loop stroke@(-phi) = (d, h) + boom@(pi - psi);
        point Pin = (d, h) + boom@(pi - psi);
    }

    mechanism Joints {
        param boom = 40, d = 60, h = 10;
        input stroke;
        unknown phi, psi, x, y;
        loop stroke@phi = (x, y);
        loop (x, y) = (d, h) + boom@psi;
        point Pin = (x, y);
    }

    mechanism Distances {
        param boom = 40, d = 60, h = 10;
        input stroke;
        unknown x, y;
        equation norm((x, y)) = stroke;
        equation norm((x, y) - (d, h)) = boom;
        point Pin = (x, y);
    }

    mechanism Lever {
        param boom = 40, d = 60, h = 10;
        input stroke;
        unknown psi;
        equation norm((d, h) + boom@psi) = stroke;
        point Pin = (d, h) + boom@psi;
    }
}

#[test]
fn cylinder() {
    for stroke in 21..=100 {
        assert_eq!(crate::three_ways::same!(f64::from(stroke); Angles, Mirrored, Joints, Distances, Lever), 2);
    }
}

/// A negative length of a cylinder has no position where its equation is one for a distance.
#[test]
fn a_negative_distance() {
    let m = Distances::default();
    assert_eq!(m.branches(-50.0).unwrap().count(), 0);
    let branch = DistancesBranch::all().next().unwrap();
    let error = m.assemble(-50.0, branch).unwrap_err();
    let linkage::PositionError::Unbuildable { mechanism: "Distances", group: "x, y", gap: 1.0, inputs } = error else {
        panic!("{error:?}")
    };
    assert!(inputs.iter().eq([("stroke", -50.0)]), "{inputs:?}");
}
