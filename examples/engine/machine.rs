//! The engine: one cylinder of four strokes, in metres, kilograms and seconds; x points up, along the cylinder.

use std::f64::consts::TAU;

use linkage::linkage;

/// The start of the energy balance: firing top dead centre, with unburnt mixture in the cylinder.
pub const START: EngineCoordinates<f64> = EngineCoordinates { phi: 0.0, psi: 0.0, z: 0.1865 };

/// The crank angle from one firing to the next.
pub const CYCLE: f64 = 2.0 * TAU;

/// The crank angles in degrees at which the gas laws have kinks: valve events, start and end of combustion.
pub const KINKS: [f64; 7] = [-200.0, -160.0, SPARK, 130.0, 180.0, 340.0, 380.0];

/// Twenty degrees before top dead centre.
const SPARK: f64 = -20.0;

/// The laws of valves and combustion over the crank angle, 0 at firing top dead centre.
mod gas {
    use linkage::Real;
    use linkage::nalgebra::convert;

    /// The angle within the cycle that begins as the intake valve closes, at 200 degrees before firing.
    fn within<T: Real>(phi: T) -> T {
        let (first, cycle) = (convert::<f64, T>((-200_f64).to_radians()), T::two_pi() + T::two_pi());
        phi - ((phi - first) / cycle).floor() * cycle
    }

    /// The 3-4-5 polynomial from 0 to 1 between two angles, with two derivatives.
    pub fn gate<T: Real>(phi: T, from: T, to: T) -> (T, T, T) {
        let x = ((within(phi) - from) / (to - from)).clamp(T::zero(), T::one());
        let [two, six, ten, fifteen, thirty, sixty] = [2.0, 6.0, 10.0, 15.0, 30.0, 60.0].map(convert::<f64, T>);
        let square = x * (T::one() - x);
        (
            x * x * x * (ten - x * (fifteen - six * x)),
            thirty * square * square / (to - from),
            sixty * square * (T::one() - two * x) / ((to - from) * (to - from)),
        )
    }

    /// The burnt fraction of the mixture, Wiebe's function of J. B. Heywood, "Internal Combustion Engine Fundamentals"
    /// (1988), equation 9.30 with a = 5 and m = 2, with two derivatives.
    pub fn burnt<T: Real>(phi: T, start: T, duration: T) -> (T, T, T) {
        let [two, three, a] = [2.0, 3.0, 5.0].map(convert::<f64, T>);
        let x = ((within(phi) - start) / duration).max(T::zero());
        let unburnt = (-a * x * x * x).exp();
        let first = three * a * x * x;
        let second = two * three * a * x;
        (T::one() - unburnt, first * unburnt / duration, (second - first * first) * unburnt / (duration * duration))
    }
}

linkage! {
    /// A slider-crank driven by gas.
    ///
    /// Pressure by L. Eriksson and I. Andersson, "An Analytic Model for Cylinder Pressure in a Four Stroke SI Engine",
    /// SAE 2002-01-0371: interpolated between the polytropes of compression and expansion during combustion; the
    /// manifold pressure while a valve is open.
    #[derive(Debug, Clone)]
    pub mechanism Engine {
        /// Crank radius and length of the rod.
        param r = 0.043, l = 0.1435;
        /// Bore and compression ratio.
        param bore = 0.086, compression = 10;
        /// Pressures of the manifolds and of the environment, Pa.
        param intake = 0.9e5, exhaust = 1.1e5, ambient = 1e5;
        /// Polytropic exponents of compression and expansion, and the temperature ratio of combustion.
        param kc = 1.3, ke = 1.28, heat = 3.4;
        /// Start and duration of combustion, in crank angle.
        param spark = -20deg, duration = 60deg;
        /// The crank with counterweight: mass, distance of the mass centre opposite the pin, inertia.
        param m2 = 2.4, b2 = 0.012, j2 = 3.5e-3;
        /// The rod: mass, distance of the mass centre from the crank pin, inertia.
        param m3 = 0.55, b3 = 0.043, j3 = 1.9e-3;
        param m4 = 0.45;
        param flywheel = 0.05, g = 9.81;
        /// Piston rings: friction coefficient, tension force, and the area under gas pressure.
        param mu = 0.08, tension = 400, face = 8e-4;
        /// An eddy current brake: torque divided by speed.
        param brake = 0.105;

        input phi;
        unknown psi, z;
        loop r@phi + l@psi = (z, 0);

        point Bearing = (0, 0);
        point Pin = r@phi;
        point Crank = (-b2)@phi;
        point Rod = Pin + b3@psi;
        point Piston = (z, 0);

        let area = pi / 4 * bore^2;
        let clearance = 2 * r * area / (compression - 1);
        let full = 2 * r * area + clearance;
        output volume = clearance + area * (r + l - z);

        extern fn gas::burnt(phi, start, duration) -> (burnt, burning, burning_rate);
        extern fn gas::gate(phi, from, to) -> (gate, gate_slope, gate_bend);
        let compressed = intake * exp(kc * ln(full / volume));
        let expanded = heat * intake * exp((kc - ke) * ln(compression)) * exp(ke * ln(full / volume));
        let burning_part = burnt(phi, spark, duration);
        let closed = compressed + burning_part * (expanded - compressed);
        let open = 1 - gate(phi, -200deg, -160deg) + gate(phi, 130deg, 180deg);
        let sucking = 1 - gate(phi, 0, 40deg) + gate(phi, 340deg, 380deg);
        let manifold = exhaust + sucking * (intake - exhaust);
        output pressure = closed + open * (manifold - closed);

        body crank { mass m2; inertia j2; center Crank; angle phi; }
        body wheel { inertia flywheel; angle phi; }
        body rod { mass m3; inertia j3; center Rod; angle psi; }
        body piston { mass m4; center Piston; }

        /// The engine on its brake.
        scene Running {
            inertia;
            gravity (-g, 0);
            force (-area * (pressure - ambient), 0) at Piston;
            friction mu, tension + face * pressure on z;
            damper brake on phi;
            energy;
            power;
            reaction at Bearing;
            reaction at Pin;
            reaction at Piston;
            reaction on z;
        }

        /// Without the friction of the rings.
        scene Frictionless {
            inertia;
            gravity (-g, 0);
            force (-area * (pressure - ambient), 0) at Piston;
            damper brake on phi;
        }

        /// Without gas.
        scene Motored {
            inertia;
            gravity (-g, 0);
            friction mu, tension on z;
            damper brake on phi;
        }
    }
}
