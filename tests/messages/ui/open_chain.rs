use linkage::linkage;

linkage! {
    pub mechanism Nothing {
        param _l = 1;
        input _theta;
    }
}

linkage! {
    pub mechanism Arm {
        param l = 1;
        input theta;
        unknown phi;
        point A = l@theta;
        point B = A + l@phi;
    }
}

linkage! {
    pub mechanism Pendulum {
        param l = 1, m = 2;
        input theta, phi;
        point A = l@theta;
        derive limits;
        body bob { mass m; center A; }
        scene Swinging { inertia; reactions; }
    }
}

linkage! {
    pub mechanism Rod {
        param l = 1, m = 2;
        input theta;
        point A = l@theta;
        derive limits;
        body bob { mass m; center A; }
        scene Turning { inertia; reactions; }
    }
}

linkage! {
    pub mechanism Block {
        param m = 2;
        input x;
        body block { mass m; center (x, 0); }
        scene Sliding { inertia; }
        derive velocity_ratio_derivatives;
    }
}

fn main() {
    // The stubs have the functions of open chains.
    let arm = Pendulum::default();
    let still = PendulumInputs { theta: 0.0 };
    let found = arm.full_kinematics(still, PendulumBranch::new(), still, still);
    println!("{:?}", found.map(|found| found.points.a.position));
    let _ = Turning::default().acceleration(0.0, &RodCoordinates { theta: 0.0 }, 0.0);
}
