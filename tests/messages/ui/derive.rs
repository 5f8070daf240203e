use linkage::linkage;

linkage! {
    pub mechanism Crank {
        param r = 2;
        input phi;
        unknown x;
        equation x = r * cos(phi);
        derive jerk, snap;
        derive sensitvity;
        derive jerk;
        derive;
        derive jerk sensitivity;
    }
}

linkage! {
    pub mechanism Plain {
        input a;
        unknown b;
        equation b = 2 * a;
        derive sensitivity;
    }
}

linkage! {
    pub mechanism Together {
        param a = 1, b = 2;
        input v;
        unknown x, y, z;
        equation x * y = v + a * z * z;
        equation y * z = b + x * x;
        equation z * x = v * y * y;
        derive sheet;
    }
}

fn main() {
    // The stub has the functions that are asked for.
    let crank = Crank::default();
    let pose = crank.pose_at(&CrankCoordinates { x: 2.0, phi: 0.0 });
    let _ = crank.jerk(&pose, &CrankRates { x: 2.0, phi: 0.0 }, &CrankAccelerations { x: 2.0, phi: 0.0 }, 0.0);
}
