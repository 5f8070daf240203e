//! Figures of others for the car axis.

/// A run of another integrator.
pub struct Run {
    pub tolerance: f64,
    /// The largest relative error of a position at the end.
    pub positions: f64,
    /// That of a velocity, if it was noted.
    pub velocities: Option<f64>,
    pub steps: usize,
    pub evaluations: usize,
}

/// DOP853 of scipy on the four states that are left when the constraints are solved by hand: computed independently.
pub const DOP853: [Run; 2] = [
    Run { tolerance: 1e-6, positions: 2.7e-7, velocities: None, steps: 121, evaluations: 2078 },
    Run { tolerance: 1e-13, positions: 6.7e-13, velocities: Some(5.9e-10), steps: 802, evaluations: 10_226 },
];

/// A formulation of the problem, and how each solver ended with it.
pub struct Formulation {
    pub name: &'static str,
    pub tolerance: f64,
    pub outcomes: &'static [[&'static str; 2]],
}

/// The fourteen pairs of solver and formulation that SciMLBenchmarks.jl, page `DAE/caraxis`, lists with their outcome, as
/// printed in 2026 with ModelingToolkit 11.43.1; a later version of the page no longer lists the five of the reduced form.
/// RADAU5 of E. Hairer and G. Wanner succeeds there; it needs the differentiation index of each variable as an input.
pub const FAILURES: [Formulation; 3] = [
    Formulation {
        name: "mass matrix, index 3",
        tolerance: 1e-5,
        outcomes: &[
            ["Rodas4", "Unstable"],
            ["Rodas5P", "Unstable"],
            ["RadauIIA5", "Unstable"],
            ["FBDF", "Unstable"],
            ["QNDF", "Unstable"],
            ["NordsieckBDF", "Unstable"],
        ],
    },
    Formulation {
        name: "reduced by ModelingToolkit",
        tolerance: 1e-8,
        outcomes: &[
            ["Rodas5P", "InitialFailure"],
            ["RadauIIA5", "InitialFailure"],
            ["FBDF", "InitialFailure"],
            ["QNDF", "InitialFailure"],
            ["NordsieckBDF", "InitialFailure"],
        ],
    },
    Formulation {
        name: "residual, index 3",
        tolerance: 1e-5,
        outcomes: &[["IDA", "Unstable"], ["DASSL", "ErrorException"], ["DASKR", "Failure"]],
    },
];
