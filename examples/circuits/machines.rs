//! The linkages of the page.

use linkage::linkage;

linkage! {
    /// A four-bar; its links say whether one of them turns.
    pub mechanism FourBar {
        param ground = 4, crank = 1.5, coupler = 3.5, rocker = 3;
        input theta;
        unknown phi, psi;
        loop crank@theta + coupler@phi = ground@0 + rocker@psi;
        derive drawing;
    }
    /// A slider-crank, driven by its slider.
    pub mechanism SliderCrank {
        param crank = 1, rod = 3;
        input s;
        unknown phi, psi;
        loop crank@phi + rod@psi = s@0;
        derive drawing;
    }
    /// Crank and rocker of a four-bar are ternary, and a dyad joins their other arms. The dimensions are those of the
    /// gallery.
    pub mechanism StephensonI {
        param a = 2, b = 7, c = 6, d = 8, px = 1, py = -2, qx = 3, qy = -4, e = 7, f = 6;
        input theta;
        unknown beta, gamma, rho, sigma;
        loop a@theta + b@beta = d@0 + c@gamma;
        loop (px, py)@theta + e@rho = d@0 + (qx, qy)@gamma + f@sigma;
        derive drawing;
    }
    /// Cranks and rods of equal lengths.
    pub mechanism Parallelogram {
        param crank = 1, rod = 3;
        input theta;
        unknown phi, psi;
        loop crank@theta + rod@phi = rod@0 + crank@psi;
        derive drawing;
    }
    /// Two cranks, geared to one another, and a dyad.
    pub mechanism GearedFiveBar {
        param a = 1, b = 2.4, d = 0.8, e = 2, phase = 40deg;
        input theta;
        unknown geared, phi, psi;
        loop a@theta + b@phi = e@0 + d@geared + b@psi;
        equation 3 * geared = phase - 2 * theta;
        derive drawing;
    }
    /// Stephenson III, driven by the far link of its dyad. Two of its modes change places while they are regular, and a
    /// full turn of the crank from mode 1 ends on mode 3.
    pub mechanism Triad {
        param a = 4.9, b = 1.23, c = 4.18, d = 1.52, px = 0.83, py = -2.31, e = 4.26, f = 2.25, fx = 2.04, fy = 1.17;
        input theta;
        unknown alpha, beta, gamma, epsilon;
        loop a@alpha + b@beta = d@0 + c@gamma;
        loop a@alpha + (px, py)@beta + e@epsilon = (fx, fy) + f@theta;
        derive drawing;
    }
    /// Four ternary links and three couplers, without a four-bar loop. The dimensions are those of the gallery.
    pub mechanism DoubleButterfly {
        param ab = 6, ac = 1, dx = 0.2, dy = -1, ce = 6, ef = 3.5, gx = 5, gy = -3, bf = 4, jx = 0.4, jy = 1.5,
            dh = 2, ix = 2, iy = -4, gh = 3.5, ij = 3.5;
        input crank;
        unknown coupler, upper, rocker, lower, link, strut;
        let e = ac@crank + ce@coupler;
        let d = (dx, dy)@crank;
        loop e + ef@upper = ab@0 + bf@rocker;
        loop e + (gx, gy)@upper = d + dh@lower + gh@link;
        loop d + (ix, iy)@lower + ij@strut = ab@0 + (jx, jy)@rocker;
        derive drawing;
    }
}
