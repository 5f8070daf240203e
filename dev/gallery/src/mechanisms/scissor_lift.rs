use linkage::linkage;

linkage! {
    /// A scissor lift of five stages: a foot slides towards the other, and the bars of each stage, pinned in the middle, push
    /// the next stage up. With equal bars all stages are alike, and the height is 5 sqrt(bar^2 - foot^2).
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism ScissorLift {
        param bar = 2;
        input foot;
        unknown up1, back1, up2, back2, up3, back3, up4, back4, up5, back5;
        derive jerk, velocity_ratio_derivatives, sensitivity, intervals;

        let r0 = (foot, 0);
        loop (bar/2)@up1 = r0 + (bar/2)@back1;
        let l1 = r0 + bar@back1;
        let r1 = bar@up1;
        loop l1 + (bar/2)@up2 = r1 + (bar/2)@back2;
        let l2 = r1 + bar@back2;
        let r2 = l1 + bar@up2;
        loop l2 + (bar/2)@up3 = r2 + (bar/2)@back3;
        let l3 = r2 + bar@back3;
        let r3 = l2 + bar@up3;
        loop l3 + (bar/2)@up4 = r3 + (bar/2)@back4;
        let l4 = r3 + bar@back4;
        let r4 = l3 + bar@up4;
        loop l4 + (bar/2)@up5 = r4 + (bar/2)@back5;

        point Foot = r0;
        point Left = r4 + bar@back5;
        point Right = l4 + bar@up5;
        output height = y(Left);
    }
}
