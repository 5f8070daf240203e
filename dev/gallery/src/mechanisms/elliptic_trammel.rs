use linkage::linkage;

linkage! {
    /// The elliptic trammel, or trammel of Archimedes: the ends of a rod slide on two lines at right angles, and
    /// every point of it draws an ellipse.
    ///
    /// The theorem is in Proclus' commentary on Euclid; nothing ties it to Archimedes. The dimensions are this
    /// gallery's; with `reach` beyond `rod` the pen stands outside both sliders.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism EllipticTrammel {
        param rod = 2, reach = 3.5;
        input theta;
        unknown x, y;

        loop (x, 0) + rod@theta = (0, y);

        point O = (0, 0);
        point A = (x, 0);
        point B = (0, y);
        point Pen = A + reach@theta;
        output radius = norm(Pen);

        derive jerk, velocity_ratio_derivatives, sensitivity, intervals;
    }
}
