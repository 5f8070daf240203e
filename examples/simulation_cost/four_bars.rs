//! The four-bars, their initial and final states.

use linkage::linkage;

use super::problem::Problem;

linkage! {
    /// A four-bar of three uniform bars.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Bars {
        param a = 0.3, b = 0.9, c = 0.6, d = 1, m = 1, g = 9.81;
        /// The spring: stiffness, free length and fixed end.
        param k = 60, l0 = 0.3, xp = 0.5, yp = 1.2;
        input theta;
        unknown phi, psi;

        loop a@theta + b@phi = d@0 + c@psi;
        let C = d@0 + c@psi;

        body crank { mass m; inertia m * a^2 / 12; center (a/2)@theta; angle theta; }
        body coupler { mass m; inertia m * b^2 / 12; center a@theta + (b/2)@phi; angle phi; }
        body rocker { mass m; inertia m * c^2 / 12; center d@0 + (c/2)@psi; angle psi; }

        /// Weight only.
        scene Turning { inertia; gravity (0, -g); energy; }
        /// A spring acts on the pin of coupler and rocker.
        scene Sprung { inertia; gravity (0, -g); spring k, l0 between C and (xp, yp); energy; }
    }
}

/// The four-bar with a spring, for 5 s.
pub fn sprung() -> Problem<Sprung> {
    Problem::new(Sprung::default(), (START, 6.0), (5.0, SPRUNG))
}

/// The four-bar under its weight, for 20 s: 44 turns.
pub fn turning() -> Problem<Turning> {
    Problem::new(Turning::default(), (START, 12.0), (20.0, TURNED))
}

/// The initial position satisfies the loop equations to 16 digits.
const START: BarsCoordinates =
    BarsCoordinates { theta: 1.0, phi: 0.396_423_138_658_493_7, psi: 1.583_640_201_973_774_8 };

/// The final states, computed by orders 8(5,3) and 5(4) with 31 digits.
const SPRUNG: BarsCoordinates =
    BarsCoordinates { theta: 46.475_316_500_383_805, phi: 0.316_380_266_026_864_03, psi: 2.264_758_649_570_417 };
const TURNED: BarsCoordinates =
    BarsCoordinates { theta: 274.967_493_171_658_65, phi: 0.920_082_628_083_124_9, psi: 2.373_168_518_930_376 };
