use linkage::linkage;

linkage! {
    /// Rack-and-pinion steering: the pinion moves the rack, whose ends pull the steering arms of both front wheels by tie
    /// rods. The car looks along y; the arms point backwards and inwards.
    ///
    /// Ackermann's condition is cot(outer) - cot(inner) = track / wheelbase: W. Matschinsky, "Road Vehicle Suspensions"
    /// (1999). The dimensions, in metres, are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism RackSteering {
        param track = 1.4, arm = 0.14, inset = 12deg, rack_length = 0.62, setback = 0.18, rod = 0.365, pinion = 0.008;
        input wheel;
        unknown rack, left, left_rod, right, right_rod;
        derive jerk, velocity_ratio_derivatives, sensitivity, intervals;

        equation rack = -pinion * wheel;
        let left_end = (rack - rack_length/2, -setback);
        let right_end = (rack + rack_length/2, -setback);
        loop left_end + rod@left_rod = (-track/2, 0) + arm@(left + inset - 90deg);
        loop right_end + rod@right_rod = (track/2, 0) + arm@(right - inset - 90deg);

        point LeftEnd = left_end;
        point RightEnd = right_end;
        point LeftJoint = (-track/2, 0) + arm@(left + inset - 90deg);
        point RightJoint = (track/2, 0) + arm@(right - inset - 90deg);
        /// The difference of the steering angles, which Ackermann's condition asks for in a turn.
        output toe = left - right;
        output travel = rack;
    }
}
