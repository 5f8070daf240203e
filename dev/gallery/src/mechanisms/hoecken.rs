use linkage::linkage;

linkage! {
    /// Hoecken's straight line: a crank-rocker whose coupler, prolonged to twice its length, draws a nearly straight
    /// line at nearly constant speed while the crank makes half a turn.
    ///
    /// K. Hoecken, "Steigerung der Wirtschaftlichkeit durch zweckmäßige Anwendung der Getriebelehre",
    /// Werkstattstechnik (1926), is the paper that is cited for it. Proportions 1 : 2 : 2.5 : 2.5 are those in common
    /// use; R. L. Norton, "Design of Machinery", chapter 3, tabulates others for shorter and straighter stretches.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism Hoecken {
        param crank = 1, ground = 2, coupler = 2.5, rocker = 2.5, reach = 5;
        input theta2;
        unknown theta3, theta4;

        loop crank@theta2 + coupler@theta3 = ground@0 + rocker@theta4;

        point A = (0, 0);
        point D = (ground, 0);
        point B = crank@theta2;
        point C = D + rocker@theta4;
        point P = B + reach@theta3;
        output height = y(P);
        derive intervals;
    }
}
