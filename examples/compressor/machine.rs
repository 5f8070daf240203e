//! The compressor: one cylinder, in metres, kilograms and seconds; x points along the cylinder to its head.

use linkage::linkage;

/// The law of the air in the cylinder.
pub mod air {
    use linkage::Real;
    use linkage::nalgebra::convert;

    /// The pressure at a crank angle; `ratio` is crank radius / rod length, `clearance` the volume at the upper dead
    /// point over the swept one. The valves open at the pressures of inlet and outlet, with no loss.
    pub fn pressure<T: Real>(phi: T, ratio: T, clearance: T, inlet: T, outlet: T, exponent: T) -> T {
        let (sine, cosine) = (phi.sin(), phi.cos());
        let rod = (T::one() - ratio * ratio * sine * sine).sqrt();
        // The piston's way from the upper dead point over the stroke.
        let way = (T::one() - cosine + (T::one() - rod) / ratio) * convert::<f64, T>(0.5);
        let volume = clearance + way;
        let power = |base: T| (base.ln() * exponent).exp();
        if sine > T::zero() {
            (outlet * power(clearance / volume)).max(inlet)
        } else {
            (inlet * power((clearance + T::one()) / volume)).min(outlet)
        }
    }
}

linkage! {
    /// A slider-crank that compresses air, with a counterweight on its crank and a balance shaft that turns against it.
    #[derive(Debug, Clone)]
    pub mechanism Compressor {
        /// Crank radius and length of the rod.
        param r = 0.035, l = 0.14;
        param bore = 0.08, clearance = 0.06;
        /// Pressures of inlet and outlet, Pa, and the polytropic exponent.
        param inlet = 1e5, outlet = 8e5, exponent = 1.3;
        /// The crank without counterweight: mass, distance of the mass centre towards its pin, inertia.
        param m2 = 0.9, b2 = 0.008, j2 = 9e-4;
        /// The rod: mass, distance of the mass centre from the crank pin, inertia.
        param m3 = 0.45, b3 = 0.042, j3 = 1.4e-3;
        param m4 = 0.38;
        /// The counterweight opposite the crank pin, and the mass on the balance shaft, at their radii.
        param counterweight = 0, rc = 0.045, balance = 0, rb = 0.03;
        /// The place of the balance shaft, the pin of the piston below its crown, and the speed.
        param depth = 0.07, crown = 0.03, omega = 150;

        input phi;
        unknown psi, z;
        loop r@phi + l@psi = (z, 0);

        point Bearing = (0, 0);
        point CrankPin = r@phi;
        point Rod = CrankPin + b3@psi;
        point PistonPin = (z, 0);
        point Crown = (z + crown, 0);
        point Shaft = (-depth, 0);

        extern fn air::pressure(phi, ratio, clearance, inlet, outlet, exponent) -> (law);
        let pressure = law(phi, r / l, clearance, inlet, outlet, exponent);

        body crank { mass m2; inertia j2; center b2@phi; angle phi; }
        body weight { mass counterweight; center (-rc)@phi; }
        body rod { mass m3; inertia j3; center Rod; angle psi; }
        body piston { mass m4; center PistonPin; }
        body shaft { mass balance; center Shaft + rb@(pi - phi); }

        /// At constant speed: the loads on all joints, and the torque of the shaft.
        scene Running {
            inertia;
            force (-pi / 4 * bore^2 * (pressure - inlet), 0) at Crown;
            drive phi = omega * t;
            reaction at Bearing;
            reaction at CrankPin;
            reaction at PistonPin;
            reaction at Shaft;
            reaction on z;
        }
    }
}
