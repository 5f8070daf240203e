//! Mistakes in scenes that are found when names are resolved, and when scenes are derived.

use linkage::linkage;

linkage! {
    pub mechanism Gears {
        param r = 2, j;
        coordinate a, b;
        equation a = r * b;
        drive ByA by a;
        drive ByB by b;
        body frame { mass j; center (r, 1); }
        body left { inertia j; angle a; }
        scene Still of ByA { inertia frame; }
        scene Which { inertia left; }
        scene ByB of ByA { inertia left; }
    }
}

linkage! {
    pub mechanism Floating {
        param r = 2, m = 1;
        input a, c;
        unknown b;
        equation a + c = r * b;
        body wheel { mass m; center (a, 0); }
        scene Rolling { inertia wheel; }
    }
}

linkage! {
    pub mechanism Idle {
        param r = 2, m = 1, j = 3;
        input a;
        unknown b;
        equation a = r * b;
        body wheel { mass m; center (a, 0); }
        body other { inertia j; angle b; }
        scene Turning { inertia wheel; }
    }
}

linkage! {
    pub mechanism Named {
        param r = 2;
        input a;
        unknown b;
        equation a = r * b;
        scene Scene { torque t on b; }
    }
}

fn main() {}
