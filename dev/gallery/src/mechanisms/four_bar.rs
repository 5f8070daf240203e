use linkage::linkage;

linkage! {
    /// Four-bar linkage; the loop runs A-B-C-D with l4 from C to D.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism FourBar {
        param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
        input theta2;
        unknown theta3, theta4;

        loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;

        point B = l2@theta2;
        point C = B + l3@theta3;
        point G2 = (l2/2)@theta2;
        point G3 = B + (l3/2)@theta3;
        point G4 = C + (l4/2)@theta4;
        /// Transmission angle.
        output mu = theta3 - theta4;
        derive intervals;
    }
}
