//! Frictions by forces that are zero in every motion.

linkage::linkage! {
    /// The force of the thread does not reach the guide of the nut.
    pub mechanism Screw {
        param r, alpha, m, g, mu, j;
        input phi;
        unknown s;
        equation s = r * tan(alpha) * phi;
        body spindle { inertia j; angle phi; }
        body nut { mass m; center (0, s); }
        scene Falling { inertia; gravity (0, -g); friction mu, reaction on s; }
        scene Given { inertia; gravity (0, -g); friction mu, m * g on s; }
    }
}

linkage::linkage! {
    /// Nothing presses the slide on its guide, unless it has weight.
    pub mechanism Slide {
        param m, g, mu;
        input x;
        body slide { mass m; center (x, 0); }
        scene Weightless { inertia; friction mu, reaction on x; }
        scene Heavy { inertia; gravity (0, -g); friction mu, reaction on x; }
    }
}

fn main() {}
