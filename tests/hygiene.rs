//! A mechanism may be written in any scope, with any names, without the prelude and through a renamed crate.

#![deny(warnings)]

extern crate linkage as kinematics;

/// A mechanism without the prelude, through another name of the crate.
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
            derive limits, jerk, velocity_ratio_derivatives;
            derive sensitivity;
        }
    }
}

/// User functions with the names of functions that emitted code calls, and of their own arguments.
#[no_implicit_prelude]
mod functions {
    pub fn finite<T: ::kinematics::Real>(x: T) -> (T, T, T) {
        (x * x, x + x, T::one() + T::one())
    }

    mod table {
        pub fn sine<T: ::kinematics::Real>(x: T, factor: T) -> (T, T, T, T) {
            let (sine, cosine) = x.sin_cos();
            (factor * sine, factor * cosine, -factor * sine, -factor * cosine)
        }
    }

    ::kinematics::linkage! {
        pub mechanism Functions {
            param real = 2, extern_real = 3;
            input x;
            unknown pose, y;
            extern fn finite(finite) -> (finite, regular, unit);
            extern fn self::table::sine(X, motion) -> (Self_, newton, dd, rate_);
            equation pose = finite(-x) * real + finite(2 * x);
            equation y = pose + Self_(finite(x), extern_real) + finite(1);
            output slope = newton(x, 1);
            output still = newton(extern_real, real);
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

/// Names that emitted code uses for itself.
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
            derive sensitivity, jerk, velocity_ratio_derivatives;
        }
    }
}

/// Scenes without the prelude, with names that their code uses for itself, and with a user function.
#[no_implicit_prelude]
mod scenes {
    pub fn gas<T: ::kinematics::Real>(x: T) -> (T, T) {
        (x * x, x + x)
    }

    ::kinematics::linkage! {
        #[derive(::core::clone::Clone, ::core::fmt::Debug)]
        pub mechanism Acting {
            param mechanism = 1, l = 3, rates = 2, T = 0.5, reduced = 0.25, lambda_1 = 0.1, kinetic = 4;
            param sound = 0.5, stops = 0.25, Along = -7, Contact = 9;
            input blame;
            unknown phi2, x;
            extern fn gas(x) -> (pressure, slope);
            loop mechanism@blame + l@phi2 = (x, 0);
            body state { mass rates; center (x, 0); }
            body error { inertia reduced; angle blame; }
            scene Everything {
                inertia;
                gravity (T, -2 * T);
                torque lambda_1 * rate(x) * t + pressure(x) on blame;
                spring kinetic on blame - phi2;
                damper 0.3 between (x, 0) and mechanism@blame;
                potential pressure(x);
                friction sound, stops, pressure(x) on blame - phi2;
                stop x in Along..Contact, restitution stops;
                energy;
                power;
                reactions;
            }
            scene Given {
                inertia error;
                drive blame = T * t^2;
                power;
            }
            scene Weighing {
                gravity (0, -1) on state;
            }
        }
    }
}

/// Names of the functions of higher order, two inputs, a choice of drivers, and a large matrix of zeros.
mod orders {
    linkage::linkage! {
        #[derive(Clone)]
        pub mechanism Orders {
            param jerk = 1, sensitivity = 2.5, matrix = 2.2, eta = 0.8, e = 2, x_by_jerk = 1, _f, _g, _h, _i;
            coordinate sensitivity_by_jerk, p_sensitivity, x, y;
            loop jerk@x + sensitivity@sensitivity_by_jerk = e@0 + eta@y + matrix@p_sensitivity;
            point P = (x_by_jerk, matrix)@x;
            output x_ratio_derivative = x * y;
            derive velocity_ratio_derivatives, sensitivity, jerk;
            drive Both by x, y;
            drive Other by x, p_sensitivity;
        }
    }
}

#[test]
fn names_of_higher_order_that_emitted_code_uses() {
    let orders = orders::Both::from([1.0, 2.5, 2.2, 0.8, 2.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
    let guess = orders::OrdersCoordinates::<f64> { sensitivity_by_jerk: 0.8, p_sensitivity: 1.2, x: 1.1, y: 2.3 };
    let q = orders.solve(&guess).unwrap().coordinates;
    let pose = orders.pose_at(&q);
    let sensitivity = orders.sensitivity(&pose).unwrap();
    assert!(sensitivity.columns(5, 5).iter().all(|entry| *entry == 0.0), "{sensitivity}");
    // P = (x_by_jerk, matrix)@x turns with an input: its derivative by `matrix` is the unit vector across.
    let by_matrix = orders.point_sensitivities(&pose).unwrap().p.column(2).into_owned();
    assert!((by_matrix[0] + q.x.sin()).abs() + (by_matrix[1] - q.x.cos()).abs() < 1e-15, "{by_matrix}");
    let curved = orders.output_ratio_derivatives(&pose).unwrap().x_ratio_derivative;
    assert_eq!(curved.as_slice(), [0.0, 1.0, 1.0, 0.0]);
    // The other driver drives the coordinate that the first one leaves free.
    let other = orders::Other::from(orders::Orders::from(<[f64; 10]>::from(orders)));
    let pose = other.pose_at(&q);
    assert!(other.velocity_ratio_derivatives(&pose).is_ok() && other.sensitivity(&pose).is_ok());
}

#[test]
fn names_of_scenes_that_emitted_code_uses() {
    let scene = scenes::Everything::default();
    let guess = scenes::ActingCoordinates { blame: 0.5, phi2: -0.2, x: 3.9 };
    let q = scene.mechanism_.solve(&guess).unwrap().coordinates;
    let power = scene.power(2.0, &q, 1.5).unwrap();
    let rates = scene.rates(2.0, &q, 1.5).unwrap().rates;
    assert!((power.applied - (0.1 * rates.x * 2.0 + q.x * q.x) * 1.5).abs() < 1e-13, "{power:?}");
    assert!(scene.energy(&q, 1.5).is_ok() && scene.reactions(2.0, &q, 1.5).is_ok() && scene.check().is_ok());
    let [friction, stop] = scene.contacts(2.0, &q, &rates).unwrap();
    assert_eq!((friction.name, stop.name), ("friction on blame - phi2", "stop on x"));
    assert!(scene.equations(2.0, &q, 1.5).is_ok());
    let given = scenes::Given::new(scene.mechanism_, 0.5, 0.25);
    assert_eq!(given.drive_forces(2.0, &q, 1.5), Ok(scenes::GivenDrives { blame: 0.25 }));
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
fn functions_of_the_user() {
    let m = functions::Functions::default();
    let q = m.solve(&functions::FunctionsCoordinates { pose: 0.0, y: 0.0, x: 0.5 }).unwrap().coordinates;
    assert_eq!(q.pose, 0.25 * 2.0 + 1.0);
    assert_eq!(q.y, q.pose + 3.0 * 0.25_f64.sin() + 1.0);
    let motion = m.motion(&q, 2.0, 0.0).unwrap();
    assert_eq!(motion.rates.pose, 2.0 * (2.0 * 1.0 + 4.0));
    assert_eq!(motion.outputs.slope.value, 0.5_f64.cos());
    assert_eq!(motion.outputs.slope.acceleration, -4.0 * 0.5_f64.cos());
    assert_eq!(motion.outputs.still.rate, 0.0);
    assert_eq!(motion.outputs.still.value, 2.0 * 3.0_f64.cos());
}

#[test]
fn a_function_in_a_function_body() {
    fn square<T: linkage::Real>(x: T) -> (T, T, T) {
        (x * x, x + x, T::one() + T::one())
    }
    linkage::linkage! {
        mechanism Squared {
            input x;
            unknown y;
            extern fn square(x) -> (square, slope, bend);
            equation y = square(x) + square(3 * x);
        }
    }
    let squared = Squared::<f64>::new();
    let q = squared.solve(&SquaredCoordinates { y: 0.0, x: 2.0 }).unwrap().coordinates;
    assert_eq!(q.y, 40.0);
    assert_eq!(squared.velocity_ratios(&squared.pose_at(&q)).unwrap()[0], 40.0);
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
fn names_that_emitted_code_uses() {
    let greedy = greedy::Greedy::default();
    let guess = greedy::GreedyCoordinates::<f64> { acceleration: 0.349, right: 1.2, finite: -0.9 };
    let q = greedy.solve(&guess).unwrap().coordinates;
    let pose = greedy.pose_at(&q);
    let velocity = greedy.velocity(&pose, 1.0).unwrap();
    assert!((velocity.right + 0.44).abs() < 0.01, "{velocity:?}");
    let motion = greedy.motion(&q, 1.0, 0.0).unwrap();
    assert_eq!(motion.points.factors.position.x, 2.0);
    assert_eq!(motion.outputs.factors_x.value, q.right);
    let sensitivity = greedy.sensitivity(&pose).unwrap();
    let by_ground = q.finite.cos() / (50.0 * (q.finite - q.right).sin());
    assert!((sensitivity[(0, 0)] - by_ground).abs() < 1e-16, "{sensitivity} {by_ground}");
    assert!((motion.outputs.sin_right.value - 2.0 * q.right).abs() < 1e-15);
}

/// Configured out, a mechanism leaves nothing behind: another one may have its name and those of its types.
mod configured {
    linkage::linkage! {
        #[cfg(any())]
        #[derive(Clone)]
        pub mechanism Machine {
            param r = 1;
            coordinate a, b;
            drive Forward by a;
            drive Backward by b;
            equation a = r * b;
            point P = r@a;
            body wheel { inertia r; angle a; }
            scene Running of Forward { inertia; equilibrium; }
        }
        #[cfg(all())]
        // The macro must pass this attribute on to all items: nothing calls their functions.
        #[allow(dead_code)]
        mechanism Machine {
            input a;
            unknown b;
            equation a = 2 * b;
            scene Running { equilibrium; }
        }
    }

    #[test]
    fn the_other_machine_is_there() {
        let machine = Machine::default();
        assert_eq!(machine.solve(&MachineCoordinates { a: 3.0, b: 1.0 }).unwrap().coordinates.b, 1.5);
    }
}

/// A scene whose forces do not depend on the position, and that has no other number.
mod still {
    linkage::linkage! {
        pub mechanism Plain {
            param l = 1;
            input v;
            unknown u;
            equation u = l * v;
            body fixed { mass l; center (0, l); }
            scene Loaded { gravity (0, -9); equilibrium; }
            scene Idle { torque 0 on v; equilibrium; energy; power; reactions; }
            scene Flat { potential 0 * v; equilibrium; }
            scene Pushed { torque 1 on v; equilibrium; }
            scene Empty { equilibrium; }
        }
    }

    #[test]
    fn forces_that_vanish_are_in_balance_everywhere() {
        let plain = Plain::default();
        let q = PlainCoordinates { v: 0.5, u: 0.5 };
        assert_eq!(Loaded::from((plain, [])).balance(0.0, &q).unwrap().forces, [0.0]);
        assert_eq!(Pushed::from((Plain::default(), [])).balance(0.0, &q).unwrap().forces, [1.0]);
    }
}

/// The sine and the cosine of a sum of unknown angles, by its name and with a minus.
mod signed_angles {
    linkage::linkage! {
        pub mechanism Folded {
            param l = 2;
            input v;
            unknown a, b;
            equation a = l * v;
            equation b = l * a;
            let sum = a * b + v * l;
            point P = l@(-sum) + sum@(-2 * sum);
            point Q = l@sum;
            output o = -sum * sum + sin(-(v + a * b)) * cos(v + a * b) + (v + a * b);
        }
    }
}

/// Parts of a turn: some are constants of the scalar, others products with one.
mod turns {
    #![deny(unused_imports)]

    linkage::linkage! {
        pub mechanism Half {
            input v;
            unknown u;
            equation u = pi - v;
        }
        pub mechanism Seven {
            input v;
            unknown u;
            equation u = 7 * pi - v;
        }
    }

    #[test]
    fn parts_of_a_turn_are_right() {
        use std::f64::consts::PI;
        assert_eq!(Half::default().assemble(1.0, HalfBranch::new()).unwrap().u, PI - 1.0);
        assert_eq!(Seven::default().assemble(1.0, SevenBranch::new()).unwrap().u, 7.0 * PI - 1.0);
    }
}

/// Mechanisms, scenes, parameters and coordinates with names that emitted code uses.
#[no_implicit_prelude]
mod taken {
    ::kinematics::linkage! {
        pub mechanism Ok {
            param position = 1, limits = 3, T = 2, whose = 0.5;
            input newton;
            unknown ratios, velocity;
            loop position@newton + limits@ratios = (velocity, 0);
            point Vector2 = whose@newton;
            body Err { mass T; center (velocity, 0); }
            scene S { inertia; energy; gravity (0, -whose); }
            scene Option { inertia; spring whose on velocity; power; reactions; }
            derive limits;
        }
        pub mechanism Search {
            param turn = 1, guess = 3;
            coordinate pose, q, inputs;
            loop turn@pose + guess@q = (inputs, 0);
            drive Iterator by pose;
            drive Mechanism by inputs;
        }
        pub mechanism Solution {
            param r = 1, l = 3;
            input phi;
            unknown psi, x;
            loop r@phi + l@psi = (x, 0);
            body Piston { mass 2; center (x, 0); }
            scene Scene { inertia; }
            scene SS { inertia; energy; }
        }
        /// A mechanism with the name of a type that emitted code uses.
        pub mechanism Result {
            param __rt = 1, Self_ = 3;
            input phi;
            unknown psi, x;
            loop __rt@phi + Self_@psi = (x, 0);
        }
    }
}

#[test]
fn names_of_emitted_code_are_free() {
    let mechanism = taken::Ok::default();
    let branch =
        mechanism.branch_of(&mechanism.pose_at(&taken::OkCoordinates { newton: 0.5, ratios: -0.1, velocity: 3.8 }));
    let found = mechanism.assemble(0.5, branch).unwrap().coordinates();
    assert!((found.velocity - (0.5_f64.cos() + (9.0 - 0.5_f64.sin().powi(2)).sqrt())).abs() < 1e-15);
    // m v^2 / 2 of the slider at unit speed of the crank, by differences of the positions.
    let step = 1e-5;
    let [before, after] = [-step, step].map(|by| mechanism.assemble(0.5 + by, branch).unwrap().coordinates().velocity);
    let rate = (after - before) / (2.0 * step);
    let scene = taken::S { mechanism, t: 2.0 };
    assert!((scene.energy(&found, 1.0).unwrap().kinetic - rate * rate).abs() < 1e-9);
}
