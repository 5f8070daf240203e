use linkage::linkage;

linkage! {
    /// Roberts' straight line: three equal isosceles triangles, of which the middle one, `B C P`, moves; its apex
    /// `P` passes through both ground pivots and the middle between them.
    ///
    /// R. Willis, "Principles of Mechanism" (1841), credits Richard Roberts of Manchester; no patent of his shows
    /// it, and an engraving of 1769 shows de Voglie's machine with the same linkage (E. S. Ferguson, "Kinematics of
    /// Mechanisms from the Time of Watt", 1962). Sides 13, 13, 10 so that the height is 12.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Roberts {
        param ground = 2, side = 1.3, coupler = 1, height = 1.2;
        input theta2;
        unknown theta3, theta4;

        loop side@theta2 + coupler@theta3 = ground@0 + side@theta4;

        point A = (0, 0);
        point D = (ground, 0);
        point B = side@theta2;
        point C = D + side@theta4;
        point P = B + (coupler/2, -height)@theta3;
        output deviation = y(P);
        derive intervals;
    }
}
