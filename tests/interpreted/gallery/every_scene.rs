//! A short motion of every scene of the gallery that has inertia: the bits and the words of emitted code.

use linkage::position::newton_any_branch;
use linkage::{Column, D, PerInput, Scene};
use linkage_gallery::Fixture;

use crate::algorithms::scenes::{Named, same};
use crate::algorithms::{Numbers, Positions, coordinates};

/// A start of a scene: a position of its mechanism at the laws of driven inputs, with their rates.
fn start<M, S>(scene: &S) -> (Numbers, Vec<f64>)
where
    M: Fixture<Scalar = f64>,
    S: Scene<Scalar = f64, Mechanism = M>,
{
    let mut numbers = Positions::<M>::drawn(80).starts.swap_remove(0);
    let laws = scene.prescribed(0.0);
    for (input, law) in numbers[1].iter_mut().zip(&laws) {
        *input = law.map_or(*input, |law| law.value);
    }
    let rates = laws.iter().map(|law| law.map_or(0.7, |law| law.rate)).collect();
    // The position at the laws, if there is one; without it the error is compared.
    if let Ok(found) = newton_any_branch(scene.mechanism(), &coordinates::<M>(&numbers)) {
        let (unknowns, inputs) = M::parts(&found.coordinates);
        numbers = [unknowns.as_slice().to_vec(), inputs.as_slice().to_vec()];
    }
    (numbers, rates)
}

/// All that a scene of the gallery computes in a short motion.
fn compare<const V: usize, M, S>()
where
    M: Fixture<Scalar = f64, V = D<V>>,
    S: Scene<Scalar = f64, Mechanism = M, V = D<V>> + Default,
{
    let scene = S::default();
    let (numbers, rates) = start::<M, S>(&scene);
    let rates: PerInput<M> = Column::from_slice(&rates).expect("as many inputs");
    let q = coordinates::<M>(&numbers);
    let found = same(Named::of(M::FILE, M::NAME, S::NAME), &scene, &[], q, rates, [0.0, 0.05]);
    assert!(found.len() > 10, "{}", S::NAME);
}

macro_rules! every_scene {
    ($($file:ident: $($Scene:ident)+;)*) => {
        $($(compare::<_, _, linkage_gallery::$file::$Scene<f64>>();)+)*
    };
}

#[test]
fn every_scene_of_the_gallery() {
    every_scene! {
        andrews_scene: Squeezing;
        belt: Carried Driven;
        block: Sliding Sprung Pushed Swelling Rocked Bouncing;
        car_axis: Riding;
        cart_pendulum: Rolling Sprung Rubbing Shaken;
        double_pendulum: Swinging Damped Half;
        five_bar_contacts: Braked Clamped Stopped Narrow Shaken Curved;
        five_bar_scenes: Free Half;
        five_windows: FiveFalling;
        four_bar_effects: Bare Weighed Sprung Twisted Damped Pushed Turned Rough Stopped Worn Measured Loaded Driven Mounted Smooth Everything;
        four_bar_scenes: Idle Loaded Driven;
        one_window: OneFalling;
        pendulum: Swinging Rubbing Worn;
        slider_crank_contacts: Guided Jointed;
        slider_crank_scenes: Turning Worn Steady Pushed;
        three_link_arm: Falling Pushed Moved Led;
        two_windows: TwoFalling;
        yoke: Scotch;
    }
}
