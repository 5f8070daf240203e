//! A door with its closer, in plan view; metres, kilograms and seconds.

use linkage::linkage;

linkage! {
    /// A door closer with two arms, from the spindle on the door over the elbow to the shoe on the frame.
    #[derive(Debug, Clone)]
    pub mechanism DoorCloser {
        /// The spindle relative to the hinge, along and normal to the door; the two arms; the shoe.
        param a = 0.23, h = 0.04, b = 0.26, c = 0.29, shoe = 0.35, off = 0.02;
        /// The door: 40 kg, 0.9 m wide. The arms are uniform rods.
        param m = 40, width = 0.9, m2 = 0.35, m3 = 0.3;
        /// The spring at the spindle, and its unstretched angle.
        param k = 4, slack = 150deg;
        /// Oil damping at the spindle: during the swing, and in the last degrees, where the door must latch.
        param sweep = 16, latch = 2.5, from = 9deg, softness = 1deg;
        /// The restitution of the door frame, and the opening angle.
        param restitution = 0.35, widest = 110deg;

        input door;
        unknown alpha, beta;
        loop (a, h)@door + b@alpha = (shoe, off) + c@beta;

        output spindle = alpha - door;

        point Edge = width@door;
        point Spindle = (a, h)@door;
        point Elbow = Spindle + b@alpha;
        point Shoe = (shoe, off);

        body leaf { mass m; inertia m * width^2 / 12; center (width/2)@door; angle door; }
        body arm { mass m2; inertia m2 * b^2 / 12; center Spindle + (b/2)@alpha; angle alpha; }
        body link { mass m3; inertia m3 * c^2 / 12; center Shoe + (c/2)@beta; angle beta; }

        scene Closing {
            inertia;
            spring k, slack on spindle;
            damper latch + (sweep - latch) / (1 + exp((from - door) / softness)) on spindle;
            stop door in 0..widest, restitution restitution;
            energy;
            power;
        }
    }
}
