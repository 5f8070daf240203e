//! Frictions and stops where nothing accelerates, and parameters of effects that a scene does not name.

use linkage::linkage;

linkage! {
    pub mechanism Still {
        param r = 2, k, mu, e;
        input phi;
        unknown x;
        equation x = r * cos(phi);
        scene Held {
            spring k on x;
            friction mu, k on x;
            stop x in 0..1, restitution e;
        }
    }
}

linkage! {
    pub mechanism Slider {
        param r = 2, m = 1, mu, k, e;
        input phi;
        unknown x;
        equation x = r * cos(phi);
        body slider { mass m; center (x, 0); }
        scene Rough {
            inertia;
            friction mu, k on x;
        }
        scene Stopped {
            inertia;
            stop x in -1..1, restitution e;
        }
    }
}

fn main() {
    let rough = Rough { mechanism: Slider { r: 2.0 }, m: 1.0, mu: 0.3, k: 5.0 };
    println!("{} {}", rough.mu, rough.e);
    let stopped = Stopped { mechanism: Slider { r: 2.0 }, m: 1.0, e: 0.3, mu: 0.5 };
    println!("{}", stopped.check().is_ok());
}
