//! Frictions whose factors are not those that the name of the first one promises.

linkage::linkage! {
    pub mechanism Slide {
        param m = 2, mu = 0.1, mu_2 = 0.2, g = 9.81, load = 3, limit = 5, r = 0.1;
        input x;
        unknown s;
        equation s = 2 * x;
        body slide { mass m; center (x, 0); }
        scene Alone { inertia; gravity (0, -g); friction mu on x; }
        scene Second { inertia; gravity (0, -g); friction mu_2 on s; friction mu on m * s; }
        scene Meant { inertia; gravity (0, -g); friction limit on x; friction mu * load on s; friction mu, load on x; }
        scene Cut { inertia; friction mu, r, reaction at; }
        scene Short { inertia; friction mu, r; }
    }
}

linkage::linkage! {
    pub mechanism Pendulum {
        param m = 2, l = 1, mu = 0.1, r = 0.01, g = 9.81, rho = 0.001;
        input phi;
        body bob { mass m; center l@phi; }
        scene Without { inertia; gravity (0, -g); friction mu, reaction on phi; }
        scene Within { inertia; gravity (0, -g); friction mu, r, reaction on phi; friction rho, reaction on phi; }
    }
}

fn main() {}
