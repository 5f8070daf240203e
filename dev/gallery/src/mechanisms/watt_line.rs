use linkage::linkage;

linkage! {
    /// Watt's straight line: two equal arms and a link between them, whose middle draws the slender crossing of a
    /// figure of eight.
    ///
    /// James Watt, British patent 1432 of 1784, and his letters of that year. The dimensions are this gallery's: the
    /// arms are level and the link upright in the middle of the stroke, where the path has five points in common
    /// with its tangent: x = y^5 / (8 `arm`^3 `half_link`) + ...
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism WattLine {
        param arm = 5, half_link = 1;
        input theta;
        unknown phi, psi;

        let left = (-arm, half_link);
        let right = (arm, -half_link);
        loop left + arm@theta + (2 * half_link)@phi = right + arm@psi;

        point Left = left;
        point Right = right;
        point B = left + arm@theta;
        point C = right + arm@psi;
        point P = B + half_link@phi;
        output deviation = x(P);
        derive intervals;
    }
}
