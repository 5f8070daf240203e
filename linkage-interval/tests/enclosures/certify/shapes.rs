//! The mechanisms of the tests.

use linkage_runtime::{D, Group};

use crate::certify::loops::{Angle, Fault, Length, Shape, Term};

const fn link(length: usize, angle: usize) -> Term {
    (1.0, Length::Parameter(length), Angle::Unknown(angle), 0)
}
const fn minus(length: usize, angle: usize) -> Term {
    (-1.0, Length::Parameter(length), Angle::Unknown(angle), 0)
}
const fn crank(length: usize) -> Term {
    (1.0, Length::Parameter(length), Angle::Input, 0)
}
/// A ground vector against the direction of the loop.
const fn ground(length: usize, quarters: u32) -> Term {
    (-1.0, Length::Parameter(length), Angle::Fixed, quarters)
}
/// The part of a vector across its link.
const fn across(term: Term, length: usize) -> Term {
    (term.0, Length::Parameter(length), term.2, 1)
}

macro_rules! four_bar {
    ($name:ident, $fault:expr) => {
        /// Ground, crank, coupler, rocker: crank + coupler = ground + rocker. The quantities are the pin B between coupler and
        /// rocker, and the transmission angle.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct $name;
        impl Shape for $name {
            type P = D<4>;
            type U = D<2>;
            type Q = D<3>;
            const LOOPS: &'static [&'static [Term]] = &[&[ground(0, 0), crank(1), link(2, 0), minus(3, 1)]];
            const POINTS: &'static [&'static [Term]] = &[&[crank(1), link(2, 0)]];
            const OUTPUTS: &'static [(usize, usize)] = &[(0, 1)];
            const UNKNOWN_ANGLES: &'static [bool] = &[true; 2];
            const GROUPS: &'static [Group<'static>] =
                &[Group { name: "phi, psi", equations: &[0, 1], unknowns: &[0, 1] }];
            const FAULT: Fault = $fault;
        }
    };
}
four_bar!(FourBar, Fault::None);
four_bar!(WrongJ, Fault::SignInJ);
four_bar!(WrongA, Fault::SignInA);
four_bar!(WrongGamma, Fault::SignInGamma);

/// A four-bar with the directions of its crank, of the coupler seen from its end, and of the pin between coupler and rocker.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Directions;
impl Directions {
    /// The number of the first direction.
    pub const FIRST: usize = 6;
}
impl Shape for Directions {
    type P = D<4>;
    type U = D<2>;
    type Q = D<12>;
    const LOOPS: &'static [&'static [Term]] = FourBar::LOOPS;
    const POINTS: &'static [&'static [Term]] = &[&[crank(1)], &[minus(2, 0)], &[crank(1), link(2, 0)]];
    const DIRECTIONS: &'static [&'static [(f64, usize)]] = &[
        &[(1.0, 0)],
        &[(1.0, 1)],
        &[(2.0, 1)],
        &[(1.0, 0), (-2.0, 1)],
        &[(2.0, 0), (-3.0, 1)],
        &[(-0.5, 0), (0.75, 2)],
    ];
    const UNKNOWN_ANGLES: &'static [bool] = FourBar::UNKNOWN_ANGLES;
    const GROUPS: &'static [Group<'static>] = FourBar::GROUPS;
}

/// A crank and a rod that push a slider: unknowns are the angle of the rod and the place of the slider.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliderCrank;
impl Shape for SliderCrank {
    type P = D<3>;
    type U = D<2>;
    type Q = D<2>;
    /// crank + rod = slider + offset
    const LOOPS: &'static [&'static [Term]] =
        &[&[crank(0), link(1, 0), (-1.0, Length::Unknown(1), Angle::Fixed, 0), ground(2, 1)]];
    const POINTS: &'static [&'static [Term]] = &[&[crank(0), link(1, 0)]];
    const UNKNOWN_ANGLES: &'static [bool] = &[true, false];
    const GROUPS: &'static [Group<'static>] = &[Group { name: "rod, slider", equations: &[0, 1], unknowns: &[0, 1] }];
}

/// A four-bar whose rocker drives a second dyad: angles of coupler, rocker, rod, second rocker. Parameters: ground, crank,
/// coupler, rocker, the arm of the rocker along and across it, rod, second rocker, the second ground along and across.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SixBar;
impl Shape for SixBar {
    type P = D<10>;
    type U = D<4>;
    type Q = D<4>;
    const LOOPS: &'static [&'static [Term]] = &[
        &[ground(0, 0), crank(1), link(2, 0), minus(3, 1)],
        &[link(4, 1), across(link(4, 1), 5), link(6, 2), minus(7, 3), ground(8, 0), ground(9, 1)],
    ];
    const POINTS: &'static [&'static [Term]] = &[&[link(4, 1), across(link(4, 1), 5), link(6, 2)]];
    const OUTPUTS: &'static [(usize, usize)] = &[(0, 1), (2, 3)];
    const UNKNOWN_ANGLES: &'static [bool] = &[true; 4];
    const GROUPS: &'static [Group<'static>] = &[
        Group { name: "coupler, rocker", equations: &[0, 1], unknowns: &[0, 1] },
        Group { name: "rod, second", equations: &[2, 3], unknowns: &[2, 3] },
    ];
    const USER_FUNCTIONS: &'static [Option<&'static str>] = &[None, None];
}

/// A crank whose angle is twice that of a slotted link: crank = s at 2 u. Unknowns u and s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSpeed;
impl Shape for HalfSpeed {
    type P = D<1>;
    type U = D<2>;
    type Q = D<0>;
    const LOOPS: &'static [&'static [Term]] = &[&[crank(0), (-1.0, Length::Unknown(1), Angle::Twice(0), 0)]];
    const UNKNOWN_ANGLES: &'static [bool] = &[true, false];
    const GROUPS: &'static [Group<'static>] = &[Group { name: "u, s", equations: &[0, 1], unknowns: &[0, 1] }];
}

/// A four-bar whose equations have a user function.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UserFunction;
impl Shape for UserFunction {
    type P = D<4>;
    type U = D<2>;
    type Q = D<0>;
    const LOOPS: &'static [&'static [Term]] = FourBar::LOOPS;
    const UNKNOWN_ANGLES: &'static [bool] = FourBar::UNKNOWN_ANGLES;
    const GROUPS: &'static [Group<'static>] = FourBar::GROUPS;
    const USER_FUNCTIONS: &'static [Option<&'static str>] = &[Some("lift")];
}

/// Jansen's leg: angles of b, j, d, e, c, k, f, g, h, i; parameters a to m in order without the letters' gaps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jansen;
impl Shape for Jansen {
    type P = D<13>;
    type U = D<10>;
    type Q = D<2>;
    const LOOPS: &'static [&'static [Term]] = &[
        &[
            crank(12),
            link(9, 1),
            (1.0, Length::Parameter(0), Angle::Fixed, 0),
            (1.0, Length::Parameter(11), Angle::Fixed, 1),
            minus(1, 0),
        ],
        &[link(1, 0), link(4, 3), minus(3, 2)],
        &[
            crank(12),
            link(10, 5),
            (1.0, Length::Parameter(0), Angle::Fixed, 0),
            (1.0, Length::Parameter(11), Angle::Fixed, 1),
            minus(2, 4),
        ],
        &[link(3, 2), link(5, 6), minus(2, 4), minus(6, 7)],
        &[link(6, 7), link(7, 8), minus(8, 9)],
    ];
    const POINTS: &'static [&'static [Term]] = &[&[ground(0, 0), ground(11, 1), link(2, 4), link(8, 9)]];
    const UNKNOWN_ANGLES: &'static [bool] = &[true; 10];
    const GROUPS: &'static [Group<'static>] = &[
        Group { name: "b, j", equations: &[0, 1], unknowns: &[0, 1] },
        Group { name: "d, e", equations: &[2, 3], unknowns: &[2, 3] },
        Group { name: "c, k", equations: &[4, 5], unknowns: &[4, 5] },
        Group { name: "f, g", equations: &[6, 7], unknowns: &[6, 7] },
        Group { name: "h, i", equations: &[8, 9], unknowns: &[8, 9] },
    ];
}

/// The double butterfly, by its crank: angles of coupler, upper, rocker, lower, link, strut. Parameters: ab, ac, ce, ef, bf,
/// gh, ij, then x and y of d, g, j, h, i.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoubleButterfly;
impl Shape for DoubleButterfly {
    type P = D<17>;
    type U = D<6>;
    type Q = D<2>;
    const LOOPS: &'static [&'static [Term]] = &[
        &[ground(0, 0), crank(1), link(2, 0), link(3, 1), minus(4, 2)],
        &[
            crank(1),
            (-1.0, Length::Parameter(7), Angle::Input, 0),
            (-1.0, Length::Parameter(8), Angle::Input, 1),
            link(2, 0),
            link(9, 1),
            across(link(9, 1), 10),
            minus(13, 3),
            across(minus(13, 3), 14),
            minus(5, 4),
        ],
        &[
            ground(0, 0),
            crank(7),
            across(crank(7), 8),
            minus(11, 2),
            across(minus(11, 2), 12),
            link(15, 3),
            across(link(15, 3), 16),
            link(6, 5),
        ],
    ];
    const POINTS: &'static [&'static [Term]] = &[&[crank(1), link(2, 0)]];
    const UNKNOWN_ANGLES: &'static [bool] = &[true; 6];
    const GROUPS: &'static [Group<'static>] = &[Group {
        name: "coupler, upper, rocker, lower, link, strut",
        equations: &[0, 1, 2, 3, 4, 5],
        unknowns: &[0, 1, 2, 3, 4, 5],
    }];
}

/// Its dimensions.
pub const DOUBLE_BUTTERFLY: [f64; 17] =
    [6.0, 1.0, 6.0, 3.5, 4.0, 3.5, 3.5, 0.2, -1.0, 5.0, -3.0, 0.4, 1.5, 2.0, 0.0, 2.0, -4.0];

/// Its eight positions at crank angle zero, to five digits.
pub const MODES: [[f64; 6]; 8] = [
    [-0.21163, -2.40725, -2.01856, 1.54648, -1.31196, -0.57797],
    [-0.84441, 2.34804, -2.62073, 1.60988, 0.05267, -0.86107],
    [0.62356, -2.74926, 2.56957, 1.884, 1.4217, -1.13972],
    [1.48217, -0.82178, 2.11932, 2.0518, -0.14368, -1.06665],
    [1.30218, -0.54212, 1.67334, 0.5842, 0.15264, 1.45842],
    [1.10285, -1.90346, 2.60441, 0.30661, 2.53157, 1.10412],
    [-0.17282, -2.22456, -1.88021, 0.71886, -1.63277, 0.55874],
    [-1.23228, 1.67047, -2.56614, 0.46128, -0.07893, 0.68548],
];
