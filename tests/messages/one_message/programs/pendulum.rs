use linkage::linkage;

linkage! {
    /// A pendulum, of which the program names no coordinate.
    #[derive(Debug, Clone)]
    pub mechanism Pendulum {
        param g = 9.81, m = 3, l = 2;
        input phi;
        point P = l@phi;
        body bob { mass m; center P; inertia m * l^2; angle phi; }
        scene Swing { inertia; gravity (g, 0); energy; }
    }
}

pub fn height(pendulum: &Pendulum, q: &PendulumCoordinates) -> Result<f64, linkage::Error> {
    Ok(pendulum.points(&pendulum.pose_at(q))?.p.x)
}

pub fn energy(scene: &Swing, q: &PendulumCoordinates, inputs: &PendulumInputs, branch: PendulumBranch) -> Result<f64, linkage::Error> {
    let pose = scene.mechanism.assemble(inputs.clone(), branch)?;
    println!("{pose:?}");
    Ok(scene.energy(q, 1.0)?.kinetic)
}
