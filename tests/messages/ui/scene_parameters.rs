//! The numbers of an effect that a scene does not name: there is no place for them.

use linkage::linkage;

linkage! {
    #[derive(Clone, Copy)]
    pub mechanism Slider {
        param r = 2, m = 1, g = 9.81, k = 40, c = 5, f = 3, mu = 0.2, load = 30, upper = 2, e = 0.5, omega = 3;
        input phi;
        unknown x;
        equation x = r * cos(phi);
        body slider { mass m; center (x, 0); }

        scene Bare { inertia; }
        scene Weighed { inertia; gravity (-g, 0); }
        scene Sprung { inertia; spring k on x; }
        scene Damped { inertia; damper c on x; }
        scene Pushed { inertia; torque f on x; }
        scene Rough { inertia; friction mu, load on x; }
        scene Stopped { inertia; stop x in -2..upper, restitution e; }
        scene Driven { inertia; drive phi = omega * t; }
    }
}

fn main() {
    let slider = Slider { r: 2.0 };
    let (bare, rough) = (Bare::default(), Rough::default());
    let _ = (bare.g, bare.k, bare.c, bare.f, bare.omega);
    let _ = (bare.mu, bare.load, bare.upper, bare.e);
    // The friction does not bring the stop.
    let _ = (rough.upper, rough.e);
    let _ = Stopped { mu: 0.2, ..Stopped::default() };
    let _ = Weighed { k: 40.0, ..Weighed::default() };
    // Neither gravity nor friction in a place for the mass.
    let _ = Bare::new(slider, 1.0, 9.81);
    let _ = Bare::new(slider, 1.0, 0.2, 30.0);
    // Nor a restitution in a place for the friction.
    let _ = Rough::new(slider, 1.0, 0.2, 30.0, 0.5);
    let q = SliderCoordinates { phi: 0.3, x: 1.9 };
    // Nor what tells where the contacts are, nor what the drive takes.
    let _ = bare.contacts(0.0, &q, &q);
    let _ = rough.drives(0.0);
}
