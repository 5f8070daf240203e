//! Mechanisms of one loop for pictures and certificates.

use linkage::linkage;
use linkage_interpreter::Mechanism as Compiled;

use super::of_text;

with_text! {
    /// A crank-rocker.
    #[derive(Debug, Clone, Copy)]
    pub mechanism CrankRocker {
        param ground = 80, crank = 20, coupler = 50, rocker = 70;
        input theta;
        unknown phi, psi in 60deg..115deg;
        loop crank@theta + coupler@phi = ground@0 + rocker@psi;
        point A = crank@theta;
        point C = crank@theta + coupler@phi;
        output swing = psi;
        output height = rocker * sin(psi);
        derive drawing;
        derive intervals;
    }

    /// A double rocker: the input turns back at dead points.
    #[derive(Debug, Clone, Copy)]
    pub mechanism Rocker {
        param ground = 4, crank = 3, coupler = 2, rocker = 2.5;
        input theta;
        unknown phi, psi;
        loop crank@theta + coupler@phi = ground@0 + rocker@psi;
        derive drawing;
        derive intervals;
    }

    /// An oscillating block.
    #[derive(Debug, Clone, Copy)]
    pub mechanism Block {
        param ground = 3, crank = 1;
        input theta;
        unknown s, psi;
        loop crank@theta = ground@0 + s@psi;
        point Pin = crank@theta;
        output turned = psi - theta;
        derive drawing;
        derive intervals;
    }
}

/// One of them as it is compiled at run time.
pub fn compiled(name: &str) -> Compiled {
    of_text(OF_THIS_FILE, name)
}
