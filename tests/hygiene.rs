//! Where and how a mechanism may be written: any scope, any names, no prelude, a renamed crate.

#![deny(warnings)]

extern crate linkage as kinematics;

/// Without the prelude, and through another name of the crate.
#[no_implicit_prelude]
mod bare {
    ::kinematics::linkage! {
        /// A pendulum on a slider.
        #[derive(::core::clone::Clone, ::core::fmt::Debug)]
        pub mechanism Slider {
            param r = 1, l = 3;
            input phi1;
            unknown phi2, x;
            loop r@phi1 + l@phi2 = (x, 0);
            point P = r@phi1;
            output lift = l - x;
        }
    }
}

/// Two mechanisms in one invocation, one without parameters.
mod two {
    linkage::linkage! {
        pub mechanism First {
            input a;
            unknown b;
            equation b = 2 * a;
        }
        pub mechanism Second {
            param k;
            input a;
            unknown b;
            equation b = k * sin(a);
        }
    }

    pub fn second() -> Second<f64> {
        Second::new(3.0)
    }
}

/// Names that emitted code would like for itself.
mod greedy {
    linkage::linkage! {
        pub mechanism Greedy {
            param pose = 80, q = 20, rate = 50, determinant = 70, factors = 1;
            input acceleration;
            unknown right, finite;
            loop q@acceleration + rate@right + determinant@finite = pose@0;
            let inverse_determinant = factors * 2;
            point Factors = (inverse_determinant, factors);
            output sin_right = right * inverse_determinant;
            output factors_x = right;
        }
    }
}

#[test]
fn no_prelude() {
    let slider = bare::Slider::default();
    let q = slider.solve(&bare::SliderCoordinates { phi1: 0.5, phi2: -0.2, x: 3.9 }).unwrap().coordinates;
    assert!((q.x - (0.5_f64.cos() + 3.0 * (1.0 - (0.5_f64.sin() / 3.0).powi(2)).sqrt())).abs() < 1e-14);
}

#[test]
fn in_a_function_body() {
    linkage::linkage! {
        mechanism Local {
            param r = 2;
            input phi;
            unknown x;
            equation x = r * cos(phi);
        }
    }
    let local = Local::default();
    let q = local.solve(&LocalCoordinates { phi: 0.3, x: 0.0 }).unwrap().coordinates;
    assert_eq!(q.x, 2.0 * 0.3_f64.cos());
}

#[test]
fn several_in_one_invocation() {
    let first = two::First::default();
    let q = first.solve(&two::FirstCoordinates { a: 1.5, b: 0.0 }).unwrap().coordinates;
    assert_eq!(q.b, 3.0);
    let second = two::second();
    let q = second.solve(&two::SecondCoordinates { a: 1.5, b: 0.0 }).unwrap().coordinates;
    assert_eq!(q.b, 3.0 * 1.5_f64.sin());
}

#[test]
fn greedy_names() {
    let greedy = greedy::Greedy::default();
    let guess = greedy::GreedyCoordinates::<f64> { acceleration: 0.349, right: 1.2, finite: -0.9 };
    let q = greedy.solve(&guess).unwrap().coordinates;
    let pose = greedy.pose_at(&q);
    let velocity = greedy.velocity(&pose, 1.0).unwrap();
    assert!((velocity.right + 0.44).abs() < 0.01, "{velocity:?}");
    let motion = greedy.motion(&q, 1.0, 0.0).unwrap();
    assert_eq!(motion.points.factors.position.x, 2.0);
    assert_eq!(motion.outputs.factors_x.value, q.right);
    assert!((motion.outputs.sin_right.value - 2.0 * q.right).abs() < 1e-15);
}
