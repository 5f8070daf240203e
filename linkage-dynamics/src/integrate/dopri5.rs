//! The pair of Dormand and Prince of order 5(4) with dense output of order 4.
//!
//! Coefficients: Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*, 2nd ed. (1993), table 5.2
//! of section II.5 (after Dormand and Prince, 1980); dense output and step control as in their code DOPRI5.

use super::tableau::{Control, Method, Stage, Tableau, Weights};

/// Dormand and Prince's method of order 5 with an error estimate of order 4: 6 evaluations a step, dense output of
/// order 4 without further evaluations.
#[derive(Debug, Clone, Copy)]
pub struct Dopri5;

impl Method for Dopri5 {
    const TABLEAU: Tableau = Tableau {
        order: 5,
        stages: STAGES,
        solution: SOLUTION,
        end: 6,
        errors: [ERROR, &[]],
        dense_stages: &[],
        dense: &[DENSE],
        control: Control { exponent: 0.2 - 0.75 * 0.04, beta: 0.04, shrink: 0.2, grow: 10.0, stability: 3.25 },
    };
}

const STAGES: &[Stage] = &[
    Stage { node: 1.0 / 5.0, weights: &[(0, 1.0 / 5.0)] },
    Stage { node: 3.0 / 10.0, weights: &[(0, 3.0 / 40.0), (1, 9.0 / 40.0)] },
    Stage { node: 4.0 / 5.0, weights: &[(0, 44.0 / 45.0), (1, -56.0 / 15.0), (2, 32.0 / 9.0)] },
    Stage {
        node: 8.0 / 9.0,
        weights: &[(0, 19372.0 / 6561.0), (1, -25360.0 / 2187.0), (2, 64448.0 / 6561.0), (3, -212.0 / 729.0)],
    },
    Stage {
        node: 1.0,
        weights: &[
            (0, 9017.0 / 3168.0),
            (1, -355.0 / 33.0),
            (2, 46732.0 / 5247.0),
            (3, 49.0 / 176.0),
            (4, -5103.0 / 18656.0),
        ],
    },
];

const SOLUTION: Weights =
    &[(0, 35.0 / 384.0), (2, 500.0 / 1113.0), (3, 125.0 / 192.0), (4, -2187.0 / 6784.0), (5, 11.0 / 84.0)];

const ERROR: Weights = &[
    (0, 71.0 / 57600.0),
    (2, -71.0 / 16695.0),
    (3, 71.0 / 1920.0),
    (4, -17253.0 / 339_200.0),
    (5, 22.0 / 525.0),
    (6, -1.0 / 40.0),
];

const DENSE: Weights = &[
    (0, -12_715_105_075.0 / 11_282_082_432.0),
    (2, 87_487_479_700.0 / 32_700_410_799.0),
    (3, -10_690_763_975.0 / 1_880_347_072.0),
    (4, 701_980_252_875.0 / 199_316_789_632.0),
    (5, -1_453_857_185.0 / 822_651_844.0),
    (6, 69_997_945.0 / 29_380_423.0),
];
