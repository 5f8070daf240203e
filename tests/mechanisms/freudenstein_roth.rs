linkage! {
    /// Two equations of F. Freudenstein and B. Roth ("Numerical solution of systems of nonlinear equations", Journal of
    /// the ACM 10, 1963) with a third unknown that leads from (15, -2) to their root (5, 4): a curve with four limit
    /// points, the standard test of the continuation program PITCON (W. C. Rheinboldt and J. V. Burkardt, 1983).
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism FreudensteinRoth {
        coordinate x1, x2, x3;

        equation x1 - x2^3 + 5*x2^2 - 2*x2 - 13 + 34*(x3 - 1) = 0;
        equation x1 + x2^3 + x2^2 - 14*x2 - 29 + 10*(x3 - 1) = 0;

        drive FoldsOfX3 by x3;
        drive FoldsOfX1 by x1;
    }
}
