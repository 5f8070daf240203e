//! Generic functions of a user over the trait `Kinematic`: open chains, closed forms and Newton's method, mechanisms with and
//! without points and outputs, and names in the order of declaration.

use linkage::kinematic::{FullKinematics, Motion};
use linkage::{Build, Column, Dim, Elbow, Kinematic, Mechanism, PositionError, linkage};
use linkage_gallery::cart_pendulum::*;
use linkage_gallery::double_butterfly::*;
use linkage_gallery::four_bar::*;
use linkage_gallery::slider_crank::*;

linkage! {
    /// No point and no output.
    #[derive(Debug, Clone)]
    pub mechanism Bare {
        param a = 2, b = 5;
        input phi;
        unknown psi, s;
        loop a@phi + b@psi = s@0;
    }

    /// One output and no point; it has functions of its own with names of the traits.
    #[derive(Debug, Clone)]
    pub mechanism Own {
        param k = 3;
        input v;
        unknown u;
        equation u = k * sin(v);
        output double = 2 * u;
        derive limits;
    }
}

impl Own {
    /// No part of the library calls these.
    #[expect(dead_code, reason = "they are called by mistake alone")]
    fn residual(&self) -> ! {
        unreachable!()
    }
    #[expect(dead_code, reason = "they are called by mistake alone")]
    fn residual_scales(&self) -> ! {
        unreachable!()
    }
    #[expect(dead_code, reason = "they are called by mistake alone")]
    fn jacobian_unknowns(&self) -> ! {
        unreachable!()
    }
    #[expect(dead_code, reason = "they are called by mistake alone")]
    fn solve_jacobian(&self) -> ! {
        unreachable!()
    }
}

/// The names and velocities of the points of a mechanism at a position, then the outputs and their rates.
fn report<M: Kinematic<Scalar = f64>>(
    m: &M,
    q: &M::Coordinates,
    input_rates: M::Inputs,
) -> Result<Vec<String>, PositionError<M::Name>> {
    let pose = m.pose_at(q);
    let rates = m.velocity(&pose, input_rates)?;
    let velocities = M::each_point(m.point_velocities(&pose, &rates)?);
    let outputs = M::each_output(m.outputs(&pose)?).into_iter().zip(M::each_output(m.output_rates(&pose, &rates)?));
    let points = M::POINTS.iter().zip(velocities).map(|(name, v)| format!("{name} {:.6} {:.6}", v.x, v.y));
    let outputs = M::OUTPUTS.iter().zip(outputs).map(|(name, (value, rate))| format!("{name} {value:.6} {rate:.6}"));
    Ok(points.chain(outputs).collect())
}

/// All numbers of a column, or of a list by name, to be compared bit by bit.
fn bits<N: Dim>(numbers: Column<f64, N>) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

/// Laws of each mechanism: u' = W v', and so for points and outputs; accelerations come back from their parts, and the calls
/// of everything at once agree with one another.
fn agrees<M: Kinematic<Scalar = f64>>(m: &M, guess: &M::Coordinates, input_rates: M::Inputs, given: M::Inputs) {
    let branch = m.branch_of(&m.pose_at(guess));
    let FullKinematics { pose, rates, accelerations, points, outputs } =
        m.full_kinematics(guess, branch, input_rates, given).unwrap();
    let alone = m.kinematics(guess, branch, input_rates, given).unwrap();
    assert_eq!((alone.rates, alone.accelerations), (rates, accelerations));
    let q = M::coordinates_of(&pose);
    assert!(m.residual(&pose).largest() <= 1e-12 * m.residual_scales(&pose).sum().max(1.0));

    let (of_unknowns, of_inputs) = M::rate_parts(&rates);
    let expected = m.velocity_ratios(&pose).unwrap() * of_inputs;
    assert!((of_unknowns - expected).largest() <= 1e-12 * of_unknowns.norm().max(1.0));
    assert_eq!(bits(of_inputs), bits(input_rates.into()));
    // The columns of W, and rates of the inputs of which one is 1.
    let ratios = m.velocity_ratios(&pose).unwrap();
    for (input, by_name) in m.ratios_by_input(&pose).unwrap().iter().enumerate() {
        let (column, unit) = M::rate_parts(by_name);
        assert_eq!((bits(column), bits(unit)), (bits(ratios.column(input)), bits(M::V::least().unit::<f64>(input))));
    }
    let (second, given_back) = M::acceleration_parts(&accelerations);
    assert_eq!(bits(given_back), bits(given.into()));
    assert_eq!(M::accelerations(second, given_back), accelerations);

    let velocities = M::each_point(m.point_velocities(&pose, &rates).unwrap());
    let ratios = M::each_point(m.point_ratios(&pose).unwrap());
    assert_eq!(velocities.iter().count(), M::POINTS.len());
    for ((velocity, ratio), moving) in velocities.iter().zip(ratios).zip(M::each_point(points)) {
        let by_ratio = ratio * of_inputs;
        assert!(
            (velocity.x - by_ratio[0]).abs().max((velocity.y - by_ratio[1]).abs()) <= 1e-12 * velocity.norm().max(1.0)
        );
        assert!((velocity - moving.velocity).norm() <= 1e-12 * velocity.norm().max(1.0));
    }
    let values = M::each_output(m.outputs(&pose).unwrap());
    assert_eq!(values.iter().count(), M::OUTPUTS.len());
    for ((value, ratio), moving) in
        values.iter().zip(M::each_output(m.output_ratios(&pose).unwrap())).zip(M::each_output(outputs))
    {
        assert!((value - moving.value).abs() <= 1e-12 * value.abs().max(1.0));
        assert!(((ratio * of_inputs)[0] - moving.rate).abs() <= 1e-12 * moving.rate.abs().max(1.0));
    }

    let Motion { position, rates: again, .. } = m.motion(&q, input_rates, given).unwrap();
    let difference = M::rate_parts(&again).0 - of_unknowns;
    assert!(position == q && difference.largest() <= 1e-11 * of_unknowns.norm().max(1.0));
}

#[test]
fn every_kind_of_mechanism() {
    let four_bar = FourBar::default();
    let q = four_bar.assemble(0.3, FourBarBranch::new(Elbow::Left)).unwrap().coordinates();
    agrees(&four_bar, &q, 1.5.into(), 0.25.into());
    let engine = Engine::default();
    let q = engine.solve(&SliderCrankCoordinates { z3: engine.z1 + 0.9 * engine.z2, phi1: 0.5, phi2: -0.2 }).unwrap();
    agrees(&engine, &q.coordinates, 0.7.into(), (-0.5).into());
    let butterfly = DoubleButterfly::default();
    let pose = butterfly.branches(0.6).unwrap().next().unwrap().pose;
    agrees(&butterfly, &pose.coordinates(), 1.0.into(), 0.5.into());
    let cart = CartPendulumCoordinates { x: 0.3, phi: 0.7 };
    agrees(
        &CartPendulum::default(),
        &cart,
        CartPendulumInputs { x: 1.0, phi: -2.0 },
        CartPendulumInputs { x: 0.0, phi: 1.0 },
    );
    let bare = Bare::default();
    let q = bare.assemble(0.4, BareBranch::new(linkage::Slider::Far)).unwrap().coordinates();
    agrees(&bare, &q, 1.0.into(), 0.0.into());
    agrees(&Own::default(), &OwnCoordinates { u: 0.0, v: 0.4 }, 1.0.into(), 0.0.into());
}

#[test]
fn points_and_outputs_by_name() {
    let own = Own::default();
    let q = OwnCoordinates { u: 3.0 * 0.5_f64.sin(), v: 0.5 };
    assert_eq!(report(&own, &q, 2.0.into()).unwrap(), ["double 2.876553 10.530991"]);
    assert_eq!(report(&Bare::default(), &BareCoordinates { phi: 0.0, psi: 0.0, s: 7.0 }, 1.0.into()).unwrap().len(), 0);
    let cart = CartPendulumCoordinates { x: 0.3, phi: 0.0 };
    let lines = report(&CartPendulum::default(), &cart, CartPendulumInputs { x: 1.0, phi: -2.0 }).unwrap();
    let names: Vec<&str> = lines.iter().map(|line| line.split(' ').next().unwrap()).collect();
    assert_eq!(names, ["Cart", "Bob", "height"]);
    assert_eq!(lines[0], "Cart 1.000000 0.000000");
    assert_eq!(<FourBar as Kinematic>::POINTS, FourBarPoints::<f64>::NAMES);
    assert_eq!(<FourBar as Kinematic>::OUTPUTS, FourBarOutputs::<f64>::NAMES);
    assert_eq!(<<FourBar as Kinematic>::N as Dim>::CAPACITY, FourBarCoordinates::<f64>::NAMES.len());
}

/// Functions of the user with names of functions of `Mechanism` are not called by emitted code.
#[test]
fn functions_of_the_user_with_names_of_the_traits() {
    let own = Own::default();
    let pose = own.pose_at(&OwnCoordinates { u: 3.0 * 0.5_f64.sin(), v: 0.5 });
    assert_eq!(own.jacobian(&pose)[(0, 0)], 1.0);
    assert!(Mechanism::residual(&own, &pose).largest() < 1e-15);
    assert!(own.limits(0.5, OwnBranch::new()).is_ok());
}
