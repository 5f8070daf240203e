//! Mistakes in ranges: empty, reversed, in another unit, moving, not numbers, and where none may stand.

use linkage::linkage;

linkage! {
    pub mechanism Empty {
        param a = 2, d = 5;
        input theta;
        unknown s in .., phi;
        loop a@theta + d@0 = s@phi;
    }
}

linkage! {
    pub mechanism Reversed {
        param a = 2, d = 5;
        input theta;
        unknown s in 0.9..0.2, phi;
        loop a@theta + d@0 = s@phi;
    }
}

linkage! {
    pub mechanism OfOnePoint {
        param a = 2, d = 5;
        input theta in pi..180deg;
        unknown s, phi;
        loop a@theta + d@0 = s@phi;
    }
}

linkage! {
    pub mechanism Units {
        param a = 2, d = 5;
        input theta in 0..150;
        unknown s in 0.. 3deg, phi in 0..a;
        loop a@theta + d@0 = s@phi;
        output lean in -1..d = phi - theta;
    }
}

linkage! {
    pub mechanism Moving {
        param a = 2, d = 5;
        input theta;
        unknown s in 0..a + d * cos(theta), phi;
        loop a@theta + d@0 = s@phi;
    }
}

linkage! {
    pub mechanism NotNumbers {
        param a = 2, d = 5;
        input theta;
        unknown s in NaN..3, phi in 0..(1, 2);
        loop a@theta + d@0 = s@phi;
    }
}

linkage! {
    pub mechanism Closed {
        param a = 2, d = 5;
        input theta;
        unknown s in 0..=3, phi;
        loop a@theta + d@0 = s@phi;
    }
}

linkage! {
    pub mechanism Vector {
        param a = 2, d = 5;
        input theta;
        unknown s in (0, 3), phi;
        loop a@theta + d@0 = s@phi;
    }
}

linkage! {
    pub mechanism Alone {
        param a = 2, d = 5;
        input theta;
        unknown s in 3, phi;
        loop a@theta + d@0 = s@phi;
    }
}

linkage! {
    pub mechanism Elsewhere {
        param a in 1..3, d = 5;
        input theta;
        unknown s, phi;
        loop a@theta + d@0 = s@phi;
        point P in 0..1 = s@phi;
        let half in 0..2 = s / 2;
        output rest = half;
    }
}

linkage! {
    pub mechanism Stopped {
        param a = 2, d = 5, m = 1, e = 0.5;
        input theta;
        unknown s in 4.., phi;
        loop a@theta + d@0 = s@phi;
        body pin { mass m; center a@theta; }
        scene OneEnd { inertia; stop s, restitution e; }
        scene NoEnd { inertia; stop phi, restitution e; }
    }
}

fn main() {}
