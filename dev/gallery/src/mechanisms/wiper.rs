use linkage::linkage;

linkage! {
    /// Windscreen-wiper drive: the motor's crank swings the first wiper by a central crank-rocker, and a coupling
    /// rod carries the swing to the second wiper by a parallelogram.
    ///
    /// The dimensions are this gallery's. crank^2 + base^2 = link^2 + arm^2 makes both strokes take the same time,
    /// and then sin(sweep / 2) = crank / arm.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Wiper {
        param crank = 40, link = 148.5, arm = 50, base = 151.5, span = 400, tilt = 10deg, blade = 450, lead = 20deg;
        input theta;
        unknown phi, first, rod, second;

        loop crank@theta + link@phi = base@0 + arm@first;
        loop arm@first + span@rod = span@tilt + arm@second;

        point Motor = (0, 0);
        point First = (base, 0);
        point Second = First + span@tilt;
        point Pin = crank@theta;
        point FirstPin = First + arm@first;
        point SecondPin = Second + arm@second;
        point FirstTip = First + blade@(first - lead);
        point SecondTip = Second + blade@(second - lead);
        output mu = first - phi;
        derive intervals;
    }
}
