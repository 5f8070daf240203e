use linkage::linkage;

linkage! {
    /// A strand from the end of a lever to a sprocket, whose free length and its arc on the sprocket add up.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism SprocketStrand {
        param r = 0.5, lever = 0.5, across = 1.75, down = 2.5;
        input theta;
        unknown phi2 in pi..3*pi/2, s2, c2;

        loop r@phi2 + s2@(phi2 + pi/2) = (across, -down) + lever@theta;
        equation c2 = s2 + r * (phi2 - pi);

        point Leaves = r@phi2;
        output total = c2;
        derive lanes, intervals;
    }
}
