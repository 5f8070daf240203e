use linkage::{Mechanism, Real, linkage};

/// A valve's lift over the angle of its cam, with three derivatives.
fn rise<T: Real>(phi: T, h: T) -> (T, T, T, T) {
    let (sine, cosine) = phi.sin_cos();
    (h * (T::one() - cosine), h * sine, h * cosine, -h * sine)
}

linkage! {
    /// A slider-crank that its crank or its piston drives.
    #[derive(Debug, Clone)]
    pub mechanism SliderCrank {
        param r = 1, l = 3;
        coordinate phi, psi, x;

        extern fn rise(phi, h) -> (lift, slope, bend, change);
        let rod = l@psi;
        loop r@phi + rod = (x, 0);

        point Middle = r@phi + rod / 2;
        output valve = lift(phi, 0.1);

        drive Compressor by phi;
        drive Engine by x;

        derive limits, jerk, velocity_ratio_derivatives;
        derive sensitivity, lanes;
    }
}

/// The largest residual of the equations of any mechanism.
fn residual<M: Mechanism<Scalar = f64>>(mechanism: &M, q: &M::Coordinates) -> f64 {
    mechanism.residual(&mechanism.pose_at(q)).largest()
}

pub fn main() -> Result<(), linkage::Error> {
    let compressor = Compressor::default();
    let branch = CompressorBranch::new(linkage::Slider::Near);
    let pose = compressor.assemble(1.0, branch)?;
    let rates = compressor.velocity(&pose, 2.0)?;
    let accelerations = compressor.acceleration(&pose, &rates, 0.0)?;
    println!("{}", compressor.jerk(&pose, &rates, &accelerations, 0.0)?.x);
    println!("{} {}", compressor.points(&pose)?.middle.x, compressor.outputs(&pose)?.valve);
    println!("{}", compressor.sensitivity(&pose)?.norm() + compressor.velocity_ratio_derivatives(&pose)?.len() as f64);
    println!("{:?}", compressor.limits(1.0, branch)?);
    let engine = Engine::from(SliderCrank::from(compressor.clone()));
    let q = SliderCrankCoordinates { phi: 1.0, psi: -0.3, x: 3.4 };
    println!("{} {}", residual(&engine, &q), residual(&compressor, &pose.coordinates()));
    let batch = Compressor::batch(compressor, CompressorInputs { phi: &[1.0, 1.1][..] }, branch, 1.0.into(), 0.0.into())?;
    let (mut lifts, mut accepted) = ([0.0; 2], [false; 2]);
    let columns = CompressorColumns { valve: Some(&mut lifts[..]), ..Default::default() };
    batch.run(&mut columns.list(), &mut accepted)?;
    Ok(())
}
