//! A six-bar.

use linkage::linkage;

linkage! {
    /// Watt's six-bar chain with a binary link as the ground (Watt I): a four-bar whose coupler and rocker are both
    /// ternary, and a dyad between them. R is the pin of the dyad, two links away from the ground.
    ///
    /// Name of the inversion as in J. M. McCarthy and G. S. Soh, "Geometric Design of Linkages".
    pub mechanism WattSixBar {
        param a = 2, b = 7, c = 6, d = 8, px = 4, py = 4, qx = 8, qy = -2, e = 6, f = 7;
        input theta2;
        unknown theta3, theta4, theta5, theta6;
        loop a@theta2 + b@theta3 = d@0 + c@theta4;
        loop a@theta2 + (px, py)@theta3 + e@theta5 = d@0 + (qx, qy)@theta4 + f@theta6;
        point R = a@theta2 + (px, py)@theta3 + e@theta5;
        output mu = theta5 - theta6;
        derive lanes;
    }
}
