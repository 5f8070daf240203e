//! `Default`, which is emitted with the default values of the parameters.

linkage::linkage! {
    #[derive(Debug, Clone, Default)]
    mechanism Press {
        param r = 2, l = 5;
        input phi;
        unknown beta, s;
        loop r@phi + l@beta = s@0;
    }
}

linkage::linkage! {
    #[derive(std::default::Default)]
    mechanism Crank {
        param r;
        input phi;
        unknown x;
        equation x = r * cos(phi);
        /// With weight.
        #[derive(Default)]
        scene Heavy { gravity (0, -9.81); inertia; }
        body pin { mass 1; center (x, 0); }
    }
}

linkage::linkage! {
    mechanism Rod {
        param r = 1;
        input phi;
        unknown x;
        equation x = r * cos(phi);
        derive Default, Clone;
    }
}

fn main() {
    // The other traits are derived.
    println!("{:?}", Press::default().clone());
}
