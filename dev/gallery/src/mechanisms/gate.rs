use linkage::linkage;

linkage! {
    /// A gate with stops, which a cylinder opens: the cylinder has a stroke, and its arm about the hinge must not be too short.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Gate {
        param arm = 0.5, away = 0.9, behind = 0.3, shut = 0.48, stroke = 0.75, least = 0.16;
        input theta in -10deg..100deg;
        unknown psi, l in ..shut + stroke;

        loop arm@theta = (away, -behind) + l@psi;

        point Eye = arm@theta;
        output reach in least.. = cross(arm@theta, 1@psi);
        derive limits, intervals;
    }
}
