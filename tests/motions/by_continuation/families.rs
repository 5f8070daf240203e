//! Families of six-bars, each as a mechanism and as equations written by hand.

use linkage::linkage;
use rand::Rng;
use rand::rngs::SmallRng;

use crate::by_continuation::continuation::{Equations, Part, Position};

linkage! {
    /// A four-bar, and a dyad between its coupler and a second crank, the input: a group of four links.
    #[derive(Debug, Clone)]
    pub mechanism Stephenson {
        param a, b, c, d, px, py, e, f, x, y;
        input v;
        unknown t, p, r, u;
        loop a@t + b@p = d@0 + c@r;
        loop a@t + (px, py)@p + e@u = (x, y) + f@v;
        derive limits;
    }
}

linkage! {
    /// Two four-bars in a row: the second dyad hangs on the coupler and the rocker of the first.
    #[derive(Debug, Clone)]
    pub mechanism Watt {
        param a, b, c, d, px, py, qx, qy, e, f;
        input v;
        unknown p, r, u, w;
        loop a@v + b@p = d@0 + c@r;
        loop a@v + (px, py)@p + e@u = d@0 + (qx, qy)@r + f@w;
        derive limits;
    }
}

linkage! {
    /// A four-bar whose rocker moves a slider.
    #[derive(Debug, Clone)]
    pub mechanism Slider {
        param a, b, c, d, qx, qy, e, h;
        input v;
        unknown p, r, u, s;
        loop a@v + b@p = d@0 + c@r;
        loop d@0 + (qx, qy)@r + e@u = (s, h);
        derive limits;
    }
}

/// A length between 0.5 and 5, and a coordinate up to 3 either way; half of the linkages have multiples of 1 / 2.
struct Sizes<'a> {
    random: &'a mut SmallRng,
    are_round: bool,
}

impl Sizes<'_> {
    fn length(&mut self) -> f64 {
        let size: f64 = self.random.random_range(0.5..5.0);
        if self.are_round { (2.0 * size).round() / 2.0 } else { size }
    }

    fn offset(&mut self) -> f64 {
        let size: f64 = self.random.random_range(-3.0..3.0);
        if self.are_round { (2.0 * size).round() / 2.0 } else { size }
    }
}

/// A family of linkages.
pub trait Family: Sized + std::fmt::Debug + linkage::Branches<Scalar = f64, V = linkage::D<1>> {
    fn random(random: &mut SmallRng, are_round: bool) -> Self;

    fn equations(&self) -> Equations;

    /// The input and the unknowns.
    fn position(q: &Self::Coordinates) -> Position;

    /// The limits of the input about a position.
    fn limits_at(
        &self,
        q: &Self::Coordinates,
        branch: Self::Branch,
    ) -> Result<linkage::Limits<f64>, linkage::PositionError>;
}

impl Family for Stephenson {
    fn random(random: &mut SmallRng, are_round: bool) -> Self {
        let mut of = Sizes { random, are_round };
        let [a, b, c, d, e, f] = std::array::from_fn(|_| of.length());
        let [px, py, x, y] = std::array::from_fn(|_| of.offset());
        Self { a, b, c, d, px, py, e, f, x, y }
    }

    fn equations(&self) -> Equations {
        let Self { a, b, c, d, px, py, e, f, x, y } = *self;
        let first = vec![Part::Link(1, a, 0.0), Part::Link(2, b, 0.0), Part::Ground(-d, 0.0), Part::Link(3, -c, 0.0)];
        let second = [Part::Link(1, a, 0.0), Part::Link(2, px, py), Part::Link(4, e, 0.0), Part::Ground(-x, -y)];
        let second = second.into_iter().chain([Part::Link(0, -f, 0.0)]).collect();
        Equations { loops: [first, second], angles: [true; 5], are_groups: false }
    }

    fn position(q: &StephensonCoordinates) -> Position {
        Position::new(q.v, q.t, q.p, q.r, q.u)
    }

    fn limits_at(
        &self,
        q: &StephensonCoordinates,
        branch: Self::Branch,
    ) -> Result<linkage::Limits<f64>, linkage::PositionError> {
        self.limits(q, branch)
    }
}

impl Family for Watt {
    fn random(random: &mut SmallRng, are_round: bool) -> Self {
        let mut of = Sizes { random, are_round };
        let [a, b, c, d, e, f] = std::array::from_fn(|_| of.length());
        let [px, py, qx, qy] = std::array::from_fn(|_| of.offset());
        Self { a, b, c, d, px, py, qx, qy, e, f }
    }

    fn equations(&self) -> Equations {
        let Self { a, b, c, d, px, py, qx, qy, e, f } = *self;
        let first = vec![Part::Link(0, a, 0.0), Part::Link(1, b, 0.0), Part::Ground(-d, 0.0), Part::Link(2, -c, 0.0)];
        let second = [Part::Link(0, a, 0.0), Part::Link(1, px, py), Part::Link(3, e, 0.0), Part::Ground(-d, 0.0)];
        let second = second.into_iter().chain([Part::Link(2, -qx, -qy), Part::Link(4, -f, 0.0)]).collect();
        Equations { loops: [first, second], angles: [true; 5], are_groups: true }
    }

    fn position(q: &WattCoordinates) -> Position {
        Position::new(q.v, q.p, q.r, q.u, q.w)
    }

    fn limits_at(
        &self,
        q: &WattCoordinates,
        branch: Self::Branch,
    ) -> Result<linkage::Limits<f64>, linkage::PositionError> {
        self.limits(q.v, branch)
    }
}

impl Family for Slider {
    fn random(random: &mut SmallRng, are_round: bool) -> Self {
        let mut of = Sizes { random, are_round };
        let [a, b, c, d, e] = std::array::from_fn(|_| of.length());
        let [qx, qy, h] = std::array::from_fn(|_| of.offset());
        Self { a, b, c, d, qx, qy, e, h }
    }

    fn equations(&self) -> Equations {
        let Self { a, b, c, d, qx, qy, e, h } = *self;
        let first = vec![Part::Link(0, a, 0.0), Part::Link(1, b, 0.0), Part::Ground(-d, 0.0), Part::Link(2, -c, 0.0)];
        let second = vec![Part::Ground(d, -h), Part::Link(2, qx, qy), Part::Link(3, e, 0.0), Part::Slide(4, -1.0)];
        Equations { loops: [first, second], angles: [true, true, true, true, false], are_groups: true }
    }

    fn position(q: &SliderCoordinates) -> Position {
        Position::new(q.v, q.p, q.r, q.u, q.s)
    }

    fn limits_at(
        &self,
        q: &SliderCoordinates,
        branch: Self::Branch,
    ) -> Result<linkage::Limits<f64>, linkage::PositionError> {
        self.limits(q.v, branch)
    }
}

/// A number of [0, 2 pi) at which a linkage of round lengths has no singular position by design.
pub fn start(random: &mut SmallRng) -> f64 {
    random.random_range(0.0..std::f64::consts::TAU)
}
