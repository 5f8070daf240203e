use linkage::linkage;

linkage! {
    /// Coupled wheels of a locomotive: a crank drives a parallelogram through its change points, where the Jacobian
    /// is singular and another motion, the antiparallelogram, branches off.
    ///
    /// F. Reuleaux, "Theoretische Kinematik" (1875), discusses how the change points are passed. The dimensions are
    /// this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism CoupledWheels {
        param crank = 0.3, base = 1.5;
        input theta;
        unknown rod, follower;

        loop crank@theta + base@rod = base@0 + crank@follower;

        point A = (0, 0);
        point D = (base, 0);
        point B = crank@theta;
        point C = D + crank@follower;
        point Middle = B + (base/2)@rod;
        output lag = theta - follower;
        derive intervals;
    }
}
