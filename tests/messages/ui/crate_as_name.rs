use linkage::linkage;

macro_rules! mistaken {
    () => {
        linkage! {
            mechanism Parameter {
                param $crate = 1;
                input v;
                unknown u;
                equation u = $crate * v;
            }
            mechanism Input {
                input $crate;
                unknown u;
                equation u = 2 * $crate;
            }
            mechanism Unknown {
                input v;
                unknown $crate;
                equation $crate = 2 * v;
            }
            mechanism Point {
                input v;
                point $crate = 2@v;
                output $crate = v;
                let $crate = v;
                body $crate { mass 1; center (v, 0); }
                extern fn $crate::gas($crate) -> ($crate, slope);
                scene $crate { inertia; }
            }
        }
    };
}

mistaken!();

linkage! {
    mechanism crate {}
}

linkage! {
    mechanism Words {
        param self = 1;
        input super;
        unknown Self;
        point crate = (1, 0);
        equation Self = super * self;
        param r#crate_ = 2;
        output o = r#crate_ * Self;
    }
}

fn main() {}
