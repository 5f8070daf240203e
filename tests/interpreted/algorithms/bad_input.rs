//! Mechanisms beyond a capacity, scenes without inertia, open chains, and user functions that return NaN: the typed errors of
//! emitted code, or of the design.

use linkage::circuits::{CircuitOptions, Circuits};
use linkage::range_of_motion::{RangeOfMotion, RangeOptions};
use linkage::simulation::{Start, simulate};
use linkage::{Branches, D, Inputs, Kinematic, Mechanism, PerInput, Real, Scene, linkage};
use linkage_interpreter::{Mechanism as Compiled, NotPrepared};

use super::{bits, coordinates, of_text};

/// A law that has a value up to 1.
fn fading<T: Real>(x: T) -> (T, T, T) {
    let (half, nothing) = (T::one() / (T::one() + T::one()), T::zero() / T::zero());
    if x < T::one() { (x * x * half, x, T::one()) } else { (nothing, nothing, nothing) }
}

with_text! {
    /// A crank whose follower has a law of its own.
    #[derive(Debug, Clone, Copy)]
    mechanism Follower {
        param k = 3, m = 1;
        input phi;
        unknown s;
        extern fn fading(phi) -> (height, height_rate, height_acceleration);
        equation s = height(phi);
        point P = (s, 0);
        body ball { mass m; inertia 0.1; center (s, phi); angle phi; }
        scene Fading { inertia; spring k on s; torque 20 on phi; }
    }

    /// Without equations.
    #[derive(Debug, Clone, Copy)]
    mechanism Lever {
        param l = 2, m = 1;
        input phi;
        point P = l@phi;
        body ball { mass m; center P; }
        scene Static { gravity (0, -9.81); }
        scene Swing { inertia; gravity (0, -9.81); }
    }
}

/// The law of the emitted code.
fn follower() -> Compiled {
    let of = of_text(OF_THIS_FILE, "Follower");
    let law = |x: &[f64]| {
        let (value, first, second) = fading(x[0]);
        vec![value, first, second]
    };
    of.with_function("height", law).expect("the function")
}

/// The range of a motion and ways beyond it, as texts.
fn motions<M: Kinematic<Scalar = f64, V = D<1>>>(m: &M, q: &M::Coordinates) -> Vec<String> {
    let range = match RangeOfMotion::of(m, q, RangeOptions::default()) {
        Ok(range) => range,
        Err(error) => return vec![format!("{error} {error:?}")],
    };
    let ways = [0.2, 0.99, 1.5, f64::NAN].map(|input| match range.at(input) {
        Ok(q) => bits(M::parts(&q).0.iter()),
        Err(error) => format!("{error} {error:?}"),
    });
    let ends = format!("{:?} {}", range.ends(), bits(&range.inputs()));
    ways.into_iter().chain([ends]).collect()
}

/// The circuits at inputs, as texts.
fn circuits<M: Kinematic<Scalar = f64, V = D<1>> + Branches>(m: &M) -> Vec<String> {
    let of = |input| match Circuits::of(m, input, CircuitOptions::default()) {
        Ok(found) => format!("{} {:?}", found.modes.len(), found.circuits),
        Err(error) => format!("{error} {error:?}"),
    };
    [0.2, 2.0, f64::NAN].map(of).into()
}

/// The last state of a simulation and its error.
fn motion<S: Scene<Scalar = f64, V = D<1>>>(scene: &S, q: &[Vec<f64>; 2]) -> String {
    let q = coordinates::<S::Mechanism>(q);
    let rates: Inputs<S> = PerInput::<S::Mechanism>::from([1.0]).into();
    match simulate(scene, Start { t: 0.0, q, input_rates: rates }, 5.0, 1e-6) {
        Ok(mut motion) => {
            let error = motion.finish(|_, _| true).err();
            let (unknowns, inputs) = S::Mechanism::parts(&motion.state().q);
            format!("{} {} {error:?}", motion.t(), bits(unknowns.iter().chain(&inputs)))
        }
        Err(error) => format!("{error} {error:?}"),
    }
}

#[test]
fn user_functions_that_return_nan() {
    let (emitted, compiled) = (Follower::default(), follower());
    let prepared_design = compiled.design();
    let prepared = prepared_design.prepared().unwrap();
    let here = prepared.with_inputs::<D<1>>().unwrap();
    let expected = circuits(&emitted);
    assert!(expected[1].contains("not a finite number"), "{expected:?}");
    assert_eq!(expected, circuits(&here));
    for phi in [0.1, 0.99, 1.0, 1.5] {
        let at = [vec![fading(phi).0], vec![phi]];
        let expected = motions(&emitted, &coordinates::<Follower>(&at));
        assert_eq!(expected, motions(&here, &coordinates::<linkage_interpreter::AtRunTime<'_, D<1>>>(&at)), "{phi}");
        let scene = prepared_design.scene("Fading").unwrap();
        let scene = scene.prepared().unwrap();
        let expected = motion(&Fading::default(), &at);
        assert_eq!(expected, motion(&scene.with_inputs::<D<1>>().unwrap(), &at), "{phi}");
        assert!(
            expected.contains("NotFinite") || expected.contains("Singular") || expected.contains("StepTooSmall"),
            "{expected}"
        );
    }
    assert_eq!(prepared.failure(), None);
    // One that is not given has no numbers at all.
    let missing = of_text(OF_THIS_FILE, "Follower").design().prepared().map(|_| ());
    assert!(matches!(missing, Err(NotPrepared::Mistake(_))), "{missing:?}");
}

#[test]
fn open_chains() {
    let design = of_text(OF_THIS_FILE, "Lever").design();
    let prepared = design.prepared().unwrap();
    let here = prepared.with_inputs::<D<1>>().unwrap();
    let at = [vec![], vec![0.3]];
    let expected = motions(&Lever::default(), &coordinates::<Lever>(&at));
    assert_eq!(expected, motions(&here, &coordinates::<linkage_interpreter::AtRunTime<'_, D<1>>>(&at)));
    // Emitted open chains list no positions; this one has the only position there is.
    assert_eq!(circuits(&here)[..2], ["1 [[0]]"; 2]);
    let scene = design.scene("Swing").unwrap();
    let scene = scene.prepared().unwrap();
    assert_eq!(motion(&Swing::default(), &at), motion(&scene.with_inputs::<D<1>>().unwrap(), &at));
    let still = design.scene("Static").unwrap().prepared().map(|_| ());
    assert_eq!(still, Err(NotPrepared::NoInertia { scene: "Static".to_owned() }));
}

/// The largest number of each, and one more, which the error has.
#[test]
fn capacities() {
    let prepared = |text: &str| of_text(&format!("mechanism M {{ {text} }}"), "M").design().prepared().map(|_| ());
    let each = |count: usize, of: &dyn Fn(usize) -> String| (0..count).map(of).collect::<String>();
    let large = |of, count, most| Err(NotPrepared::TooLarge { of, count, most });
    let points = |count| format!("input phi; {}", each(count, &|place| format!("point P{place} = {}@phi;", place + 1)));
    assert_eq!((prepared(&points(24)), prepared(&points(25))), (Ok(()), large("points", 25, 24)));
    let outputs =
        |count| format!("input phi; {}", each(count, &|place| format!("output o{place} = {} * phi;", place + 2)));
    assert_eq!((prepared(&outputs(24)), prepared(&outputs(25))), (Ok(()), large("outputs", 25, 24)));
    let inputs = |count| each(count, &|place| format!("input x{place}; point P{place} = (x{place}, 0);"));
    assert_eq!((prepared(&inputs(6)), prepared(&inputs(7))), (Ok(()), large("inputs", 7, 6)));
    let unknowns = |count| {
        format!(
            "input phi; {}",
            each(count, &|place| format!("unknown s{place}; equation s{place} = {} * phi;", place + 1))
        )
    };
    assert_eq!((prepared(&unknowns(24)), prepared(&unknowns(25))), (Ok(()), large("unknowns", 25, 24)));
    let error = NotPrepared::TooLarge { of: "unknowns", count: 25, most: 24 }.to_string();
    assert_eq!(error, "there are 25 unknowns, more than the 24 that a mechanism at run time can have: use `linkage!`");
    // Of a scene.
    let contacts = |count| {
        let frictions = each(count, &|_| "friction 1 on x;".to_owned());
        let text = format!(
            "mechanism M {{ input x; body b {{ mass 1; center (x, 0); }} scene S {{ inertia; {frictions} }} }}"
        );
        of_text(&text, "M").design().scene("S").unwrap().prepared().map(|_| ())
    };
    assert_eq!((contacts(16), contacts(17)), (Ok(()), large("frictions and stops", 17, 16)));
}
