//! Tokens of Rust and of other macros: keywords as names, `r#type`, and fragments of `macro_rules`.

/// Names that are keywords of Rust, in all places; `r#l` is `l`.
mod keywords {
    #![allow(non_camel_case_types)]

    pub mod table {
        pub fn r#yield<T: linkage::Real>(x: T, r#const: T) -> (T, T, T, T) {
            (x * r#const, r#const, T::zero(), T::zero())
        }
    }

    linkage::linkage! {
        #[derive(Clone)]
        pub mechanism r#struct {
            param r#type = 1, r#l = 3, r#gen, r#box = 0.5;
            coordinate r#in, r#async, r#loop;
            extern fn table::r#yield(r#as, r#mut) -> (r#use, r#where, r#impl, r#trait);
            let r#let = type@r#in + r#l@r#async;
            loop r#let = (r#loop, 0);
            point r#fn = (r#type * r#gen)@r#in;
            point r#Crossing = r#let;
            output r#match = r#loop * l + r#use(r#in, 2);
            drive r#move by r#in;
            drive r#return by r#loop;
            body r#mod { mass 2; inertia r#gen; center (r#loop, 0); angle r#async; }
            body r#ref { mass 1; center (r#loop, 0); }
            scene r#while of r#move {
                inertia r#mod;
                gravity (0, -r#box) on r#ref;
                spring r#box on r#async;
                friction r#try, r#type on r#in;
                reactions;
                energy;
                power;
            }
            scene r#static of r#return { drive r#loop = r#box * t; inertia; power; }
            param r#try = 0.25;
            derive velocity_ratio_derivatives, sensitivity, jerk, limits, intervals, drawing, lanes, fpcore;
        }
    }

    #[test]
    fn names_are_without_their_sign_as_text() {
        let machine = r#move::from(r#struct { r#type: 1.0, l: 3.0, r#gen: 2.0 });
        assert_eq!(r#move::<f64>::NAME, "move");
        assert_eq!(structCoordinates::<f64>::NAMES, ["in", "async", "loop"]);
        assert_eq!(structPoints::<f64>::NAMES, ["fn", "Crossing"]);
        let q = structCoordinates { r#in: 0.5, r#async: -0.2, r#loop: 3.9 };
        let q = machine.solve(&q).unwrap().coordinates;
        let x = 0.5_f64.cos() + (9.0 - 0.5_f64.sin().powi(2)).sqrt();
        assert!((q.r#loop - x).abs() < 1e-14, "{q:?}");
        let motion = machine.motion(&q, 1.0, 0.0).unwrap();
        assert_eq!(motion.points.r#fn.position.x, 0.5_f64.cos() * 2.0);
        assert!((motion.outputs.r#match.value - (3.0 * x + 0.5 * 2.0)).abs() < 1e-13);
        let given = r#static::new(r#return::from(r#struct::from(machine.clone())), 0.5);
        assert_eq!(given.drive_forces(2.0, &q, 1.0).map(|staticDrives { r#loop }| r#loop.is_finite()), Ok(true));
        let (sheet, scene) = (format!("{:?}", r#move::<f64>::DERIVATION), format!("{:?}", r#while::<f64>::DERIVATION));
        assert!(sheet.contains("type") && scene.contains("try") && !sheet.contains("r#") && !scene.contains("r#"));
    }
}

/// Fragments of `macro_rules` are one operand each.
mod fragments {
    macro_rules! lever {
        ($name:ident, $x:expr, $n:literal, $call:expr, $word:ident, $body:block) => {
            linkage::linkage! {
                pub mechanism $name {
                    param a = 2 * $x, b = -$x, c = 12 / $x, d = 3 - $x, e = 2^$n, f = 6 * $n, $word = $n, g = $n;
                    input u;
                    unknown v;
                    equation v = u * $x;
                    point P = ($x)@(2 * $call);
                    output quotient = u / $x;
                    output power = $call^2;
                    output sum = a + b + c + d + e + f + $word + g;
                }
            }
        };
    }

    lever!(Sum, 1 + 2, -2, sin(u), r#type, {});
    lever!(Difference, 5 - 2, -2, u * u, kind, {});

    #[test]
    fn each_is_one_operand() {
        for found in [<[f64; 8]>::from(Sum::default()), <[f64; 8]>::from(Difference::default())] {
            assert_eq!(found, [6.0, -3.0, 4.0, 0.0, 0.25, -12.0, -2.0, -2.0]);
        }
        let sum = Sum::default();
        assert_eq!(sum.r#type, -2.0);
        let outputs = sum.motion(&SumCoordinates { v: 6.0, u: 2.0 }, 0.0, 0.0).unwrap().outputs;
        assert_eq!([outputs.quotient.value, outputs.power.value], [2.0 / 3.0, 2.0_f64.sin().powi(2)]);
        let outputs =
            Difference::default().motion(&DifferenceCoordinates { v: 6.0, u: 2.0 }, 0.0, 0.0).unwrap().outputs;
        assert_eq!(outputs.power.value, 16.0);
    }
}
